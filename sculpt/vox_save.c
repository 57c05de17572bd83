/* Octrees as MagicaVoxel models. A model's coordinates are bytes, so that a long sculpture becomes several
 * models, which a scene graph puts side by side. */
#include "common/array.h"
#include "common/file.h"
#include "common/little_endian.h"
#include "sculpt/sculpt.h"
#include "sculpt/vox.h"

#include <stdlib.h>
#include <string.h>

/* Sizes in the file are signed 32-bit numbers; a MiB is left for all that is not voxels. */
#define CELLS_MAX ((INT32_MAX - (1 << 20)) / 4)

struct writer {
    unsigned char *items; /* the file so far */
    size_t count, capacity;
    bool failed;
};

static void put_bytes(struct writer *writer, const void *bytes, size_t size)
{
    if (writer->failed || !ARRAY_RESERVE(writer, size)) {
        writer->failed = true;
        return;
    }
    memcpy(writer->items + writer->count, bytes, size);
    writer->count += size;
}

static void put_number(struct writer *writer, size_t value)
{
    unsigned char bytes[4];
    put_bits(bytes, value, sizeof bytes);
    put_bytes(writer, bytes, sizeof bytes);
}

static void set_number(struct writer *writer, size_t at, size_t value)
{
    if (!writer->failed)
        put_bits(writer->items + at, value, 4);
}

/* Begins a chunk; its sizes are set by end_chunk() with what this returns. */
static size_t begin_chunk(struct writer *writer, const char *name)
{
    put_bytes(writer, name, 4);
    put_number(writer, 0);
    put_number(writer, 0);
    return writer->count;
}

static void end_chunk(struct writer *writer, size_t contents)
{
    set_number(writer, contents - 8, writer->count - contents);
}

static void put_string(struct writer *writer, const char *text)
{
    put_number(writer, strlen(text));
    put_bytes(writer, text, strlen(text));
}

/* A part of the sculpture that fits into one model: its first and last cell. */
struct tile {
    int low[3], high[3];
};

struct tile_cells {
    struct writer *writer;
    const struct tile *tile;
    size_t count;
};

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* The cells of a leaf that lie in the tile. Up is z in the file: (x, y, z) becomes (x, -z, y). */
static bool put_leaf(void *context, const struct octree_leaf *leaf)
{
    struct tile_cells *cells = context;
    const struct tile *tile = cells->tile;
    for (int z = larger(leaf->z, tile->low[2]); z <= smaller(leaf->z + leaf->side - 1, tile->high[2]); z++)
        for (int y = larger(leaf->y, tile->low[1]); y <= smaller(leaf->y + leaf->side - 1, tile->high[1]);
             y++)
            for (int x = larger(leaf->x, tile->low[0]); x <= smaller(leaf->x + leaf->side - 1, tile->high[0]);
                 x++) {
                const unsigned char voxel[4] = {
                    (unsigned char)(x - tile->low[0]), (unsigned char)(tile->high[2] - z),
                    (unsigned char)(y - tile->low[1]), (unsigned char)leaf->material};
                put_bytes(cells->writer, voxel, sizeof voxel);
                cells->count++;
            }
    return !cells->writer->failed;
}

/* A tile as a model; nothing when it is empty. */
static bool put_model(struct writer *writer, const struct octree *tree, const struct tile *tile)
{
    size_t before = writer->count;
    size_t contents = begin_chunk(writer, "SIZE");
    put_number(writer, (size_t)(tile->high[0] - tile->low[0] + 1));
    put_number(writer, (size_t)(tile->high[2] - tile->low[2] + 1));
    put_number(writer, (size_t)(tile->high[1] - tile->low[1] + 1));
    end_chunk(writer, contents);
    contents = begin_chunk(writer, "XYZI");
    put_number(writer, 0);
    struct tile_cells cells = {writer, tile, 0};
    octree_visit(tree, tile->low, tile->high, put_leaf, &cells);
    if (cells.count == 0) {
        writer->count = before;
        return false;
    }
    set_number(writer, contents, cells.count);
    end_chunk(writer, contents);
    return true;
}

static void put_transform(struct writer *writer, size_t id, const char *translation)
{
    size_t contents = begin_chunk(writer, "nTRN");
    put_number(writer, id);
    put_number(writer, 0); /* no attributes */
    put_number(writer, id + 1);
    put_number(writer, UINT32_MAX); /* reserved */
    put_number(writer, UINT32_MAX); /* no layer */
    put_number(writer, 1);          /* frame */
    put_number(writer, translation != NULL);
    if (translation) {
        put_string(writer, "_t");
        put_string(writer, translation);
    }
    end_chunk(writer, contents);
}

/* Node 0 moves nothing, node 1 is the group, model i hangs on nodes 2 i + 2 (where it is) and 2 i + 3. */
static void put_graph(struct writer *writer, const struct tile *tiles, size_t count)
{
    put_transform(writer, 0, NULL);
    size_t contents = begin_chunk(writer, "nGRP");
    put_number(writer, 1);
    put_number(writer, 0);
    put_number(writer, count);
    for (size_t i = 0; i < count; i++)
        put_number(writer, 2 * i + 2);
    end_chunk(writer, contents);
    for (size_t i = 0; i < count; i++) {
        char translation[64];
        const struct tile *tile = &tiles[i];
        snprintf(translation, sizeof translation, "%d %d %d",
                 tile->low[0] + (tile->high[0] - tile->low[0] + 1) / 2,
                 -tile->high[2] + (tile->high[2] - tile->low[2] + 1) / 2,
                 tile->low[1] + (tile->high[1] - tile->low[1] + 1) / 2);
        put_transform(writer, 2 * i + 2, translation);
        contents = begin_chunk(writer, "nSHP");
        put_number(writer, 2 * i + 3);
        put_number(writer, 0);
        put_number(writer, 1);
        put_number(writer, i);
        put_number(writer, 0);
        end_chunk(writer, contents);
    }
}

/* Cuts the bounds into tiles and writes those that are not empty. */
static void put_models(struct writer *writer, const struct octree *tree, const struct octree_info *info)
{
    enum { TILES_MAX = 4 * 4 * 4 }; /* (2^OCTREE_DEPTH_MAX / VOX_SIDE_MAX)^3 */
    struct tile tiles[TILES_MAX];
    size_t count = 0;
    for (int z = info->low[2]; z <= info->high[2]; z += VOX_SIDE_MAX)
        for (int y = info->low[1]; y <= info->high[1]; y += VOX_SIDE_MAX)
            for (int x = info->low[0]; x <= info->high[0]; x += VOX_SIDE_MAX) {
                struct tile tile = {.low = {x, y, z}};
                for (int k = 0; k < 3; k++)
                    tile.high[k] = smaller(tile.low[k] + VOX_SIDE_MAX - 1, info->high[k]);
                if (put_model(writer, tree, &tile))
                    tiles[count++] = tile;
            }
    if (count > 1)
        put_graph(writer, tiles, count);
}

enum status vox_save(const struct octree *tree, const char *path, struct error *err)
{
    struct octree_info info = octree_measure(tree);
    if (info.cells == 0)
        return error_set(err, STATUS_RANGE, "%s: the sculpture is empty; a .vox model needs a cell", path);
    if (info.cells > CELLS_MAX)
        return error_set(err, STATUS_RANGE, "%s: %llu cells; a .vox file holds at most %d", path,
                         (unsigned long long)info.cells, CELLS_MAX);
    struct writer writer = {0};
    put_bytes(&writer, "VOX ", 4);
    put_number(&writer, 150);
    size_t contents = begin_chunk(&writer, "MAIN");
    put_models(&writer, tree, &info);
    set_number(&writer, contents - 4, writer.count - contents);
    struct file_out *out;
    enum status status = writer.failed ? error_no_memory(err, path) : file_out_open(path, &out, err);
    if (!status) {
        fwrite(writer.items, 1, writer.count, file_out_stream(out));
        status = file_out_commit(out, err);
    }
    free(writer.items);
    return status;
}
