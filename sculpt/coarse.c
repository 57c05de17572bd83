#include "sculpt/coarse.h"

#include <stdlib.h>

struct counts {
    unsigned shift; /* cells to coarse cells */
    int side;       /* of the coarse cube */
    uint32_t *full; /* [side^3] by z, y, x: full cells of each coarse one */
};

static bool count_leaf(void *context, const struct octree_leaf *leaf)
{
    struct counts *counts = context;
    const int length = leaf->side >> counts->shift ? leaf->side >> counts->shift : 1;
    const int low[3] = {leaf->x >> counts->shift, leaf->y >> counts->shift, leaf->z >> counts->shift};
    const uint32_t part = (uint32_t)(leaf->side / length); /* of a coarse cell's side */
    for (int z = low[2]; z < low[2] + length; z++)
        for (int y = low[1]; y < low[1] + length; y++)
            for (int x = low[0]; x < low[0] + length; x++)
                counts->full[((size_t)z * (size_t)counts->side + (size_t)y) * (size_t)counts->side +
                             (size_t)x] += part * part * part;
    return true;
}

static enum status fill(const struct counts *counts, struct octree *tree, struct error *err)
{
    enum status status = STATUS_OK;
    const uint32_t *full = counts->full;
    const uint32_t half = UINT32_C(1) << (3 * counts->shift - 1);
    for (int z = 0; z < counts->side; z++)
        for (int y = 0; y < counts->side; y++)
            for (int x = 0; x < counts->side && !status; x++)
                if (*full++ >= half)
                    status = octree_set(tree, x, y, z, 1, err);
    return status;
}

enum status sculpt_coarsen(const struct octree *tree, unsigned depth, struct octree *coarse,
                           struct error *err)
{
    if (tree->depth <= depth)
        return octree_copy(coarse, tree, err);
    struct counts counts = {.shift = tree->depth - depth, .side = 1 << depth};
    struct octree made = {0};
    counts.full = calloc((size_t)1 << 3 * depth, sizeof *counts.full);
    if (!counts.full)
        return error_no_memory(err, "a coarse sculpture");
    octree_visit_all(tree, count_leaf, &counts);
    enum status status = octree_init(&made, depth, 0, err);
    if (!status)
        status = fill(&counts, &made, err);
    free(counts.full);
    if (status) {
        octree_clear(&made);
        return status;
    }
    octree_clear(coarse);
    *coarse = made;
    return STATUS_OK;
}
