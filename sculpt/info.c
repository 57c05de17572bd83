#include "sculpt/info.h"

struct materials {
    uint64_t cells[OCTREE_MATERIALS];
};

static bool count_material(void *context, const struct octree_leaf *leaf)
{
    struct materials *materials = context;
    materials->cells[leaf->material] += (uint64_t)leaf->side * leaf->side * leaf->side;
    return true;
}

unsigned info_main_material(const struct octree *tree)
{
    struct materials materials = {0};
    unsigned most = 1;
    octree_visit_all(tree, count_material, &materials);
    for (unsigned m = 2; m < OCTREE_MATERIALS; m++)
        if (materials.cells[m] > materials.cells[most])
            most = m;
    return most;
}

static void print_bounds(const struct octree_info *info, double cell, FILE *stream)
{
    static const char *const names[3] = {"bounds x", "bounds y", "bounds z"};
    for (int k = 0; k < 3 && info->cells > 0; k++)
        fprintf(stream, "%-14s %d to %d (%g to %g)\n", names[k], info->low[k], info->high[k],
                info->low[k] * cell, (info->high[k] + 1) * cell);
}

static void print_materials(const struct octree *tree, FILE *stream)
{
    struct materials materials = {0};
    octree_visit_all(tree, count_material, &materials);
    for (int m = 1; m < OCTREE_MATERIALS; m++)
        if (materials.cells[m] > 0)
            fprintf(stream, "material %-5d %llu cells, coefficient %g\n", m,
                    (unsigned long long)materials.cells[m], (double)tree->coefficient[m]);
}

static void print_chunk(const struct octree_chunks *chunks, const char *name, const char *title, FILE *stream)
{
    const struct octree_chunk *chunk = octree_chunks_find(chunks, name);
    if (chunk)
        fprintf(stream, "%-14s %zu bytes\n", title, chunk->data.size);
    else
        fprintf(stream, "%-14s none\n", title);
}

void info_print(const struct octree *tree, const struct octree_chunks *chunks, FILE *stream)
{
    const struct octree_info info = octree_measure(tree);
    const double side = 1 << tree->depth;
    fprintf(stream, "%-14s %u (%d cells a side)\n", "depth", tree->depth, 1 << tree->depth);
    fprintf(stream, "%-14s %llu\n", "cells", (unsigned long long)info.cells);
    fprintf(stream, "%-14s %g\n", "volume", (double)info.cells / (side * side * side));
    fprintf(stream, "%-14s %zu, %zu of them full\n", "leaves", info.leaves, info.full_leaves);
    fprintf(stream, "%-14s %llu\n", "exposed faces", (unsigned long long)info.exposed_faces);
    fprintf(stream, "%-14s %g\n", "face area", (double)info.exposed_faces / (side * side));
    print_bounds(&info, 1 / side, stream);
    fprintf(stream, "%-14s %zu\n", "bytes", info.bytes);
    print_materials(tree, stream);
    print_chunk(chunks, OCTREE_CHUNK_LOG, "chip log", stream);
    print_chunk(chunks, OCTREE_CHUNK_PREVIEW, "preview", stream);
}
