#include "sculpt/bricks.h"

#include "common/array.h"

#include <string.h>

/* A brick's cells and one more to each side, a bit a cell: bit x + 1 of row [z + 1][y + 1]. */
enum { ROWS = BRICK_SIDE + 2 };

struct brick_cells {
    const struct octree *tree;
    int first[3]; /* cell of bit 0, row 0 */
    uint64_t row[ROWS][ROWS];
    bool mixed; /* of more than one material */
    unsigned material;
};

int bricks_along(const struct octree *tree)
{
    return ((1 << tree->depth) + BRICK_SIDE - 1) / BRICK_SIDE;
}

static bool mark_leaf(void *context, const struct octree_leaf *leaf)
{
    struct brick_cells *cells = context;
    const int start[3] = {leaf->x, leaf->y, leaf->z};
    int low[3], high[3]; /* of the leaf within the rows */
    for (int i = 0; i < 3; i++) {
        low[i] = start[i] - cells->first[i];
        high[i] = low[i] + leaf->side - 1;
        low[i] = low[i] < 0 ? 0 : low[i];
        high[i] = high[i] >= ROWS ? ROWS - 1 : high[i];
    }
    const uint64_t bits = (((uint64_t)1 << (high[0] - low[0] + 1)) - 1) << low[0];
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            cells->row[z][y] |= bits;
    cells->mixed |= cells->material && cells->material != leaf->material;
    cells->material = leaf->material;
    return true;
}

static void mark_cells(struct brick_cells *cells, const struct octree *tree, const int brick[3])
{
    *cells = (struct brick_cells){.tree = tree};
    int low[3], high[3];
    const int side = 1 << tree->depth;
    for (int i = 0; i < 3; i++) {
        cells->first[i] = brick[i] * BRICK_SIDE - 1;
        low[i] = cells->first[i] < 0 ? 0 : cells->first[i];
        high[i] = cells->first[i] + ROWS > side ? side - 1 : cells->first[i] + ROWS - 1;
    }
    octree_visit(tree, low, high, mark_leaf, cells);
}

static unsigned material_at(const struct brick_cells *cells, int x, int y, int z)
{
    if (!cells->mixed)
        return cells->material;
    return octree_at(cells->tree, cells->first[0] + x, cells->first[1] + y, cells->first[2] + z);
}

/* The exposed ones of a row's cells become faces, a run of one material each. For faces along x a run is one
 * cell: its neighbours in the run lie in other rows. */
static bool add_row(struct brick_faces *faces, const struct brick_cells *cells, uint64_t exposed, int y,
                    int z, int side)
{
    exposed &= (((uint64_t)1 << BRICK_SIDE) - 1) << 1; /* the borders belong to other bricks */
    while (exposed) {
        if (!ARRAY_RESERVE(faces, 1))
            return false;
        const int x = __builtin_ctzll(exposed);
        const unsigned material = material_at(cells, x, y, z);
        int length = 1;
        if (side >= 2)
            while (exposed >> (x + length) & 1 && material_at(cells, x + length, y, z) == material)
                length++;
        exposed &= ~((((uint64_t)1 << length) - 1) << x);
        struct brick_face face = {
            .length = (uint16_t)length, .side = (uint8_t)side, .material = (uint8_t)material};
        const int cell[3] = {x, y, z};
        for (int i = 0; i < 3; i++)
            face.corner[i] = (uint16_t)(cells->first[i] + cell[i] + (side == 2 * i + 1));
        faces->items[faces->count++] = face;
    }
    return true;
}

enum status brick_find_faces(const struct octree *tree, const int brick[3], struct brick_faces *faces,
                             struct error *err)
{
    struct brick_cells cells;
    mark_cells(&cells, tree, brick);
    faces->count = 0;
    bool enough = true;
    for (int z = 1; z <= BRICK_SIDE && enough; z++)
        for (int y = 1; y <= BRICK_SIDE && enough; y++) {
            const uint64_t row = cells.row[z][y];
            const uint64_t beside[6] = {
                row << 1,           row >> 1, cells.row[z][y - 1], cells.row[z][y + 1], cells.row[z - 1][y],
                cells.row[z + 1][y]};
            for (int side = 0; side < 6 && row; side++)
                enough &= add_row(faces, &cells, row & ~beside[side], y, z, side);
        }
    return enough ? STATUS_OK : error_no_memory(err, "the faces of a brick");
}

void bricks_of_region(const struct octree *tree, const struct octree_region *region, int first[3],
                      int last[3])
{
    const int along = bricks_along(tree);
    for (int i = 0; i < 3; i++) {
        first[i] = (region->low[i] - 1 < 0 ? 0 : region->low[i] - 1) / BRICK_SIDE;
        last[i] = (region->high[i] + 1) / BRICK_SIDE;
        last[i] = last[i] >= along ? along - 1 : last[i];
    }
}
