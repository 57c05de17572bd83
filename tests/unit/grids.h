/* Dense grids of cells, which octrees are held against, and boxes of cells as shapes. */
#ifndef TESTS_UNIT_GRIDS_H
#define TESTS_UNIT_GRIDS_H

#include "trees.h"

enum { DEPTH = 4, SIDE = 1 << DEPTH, CELLS = SIDE * SIDE * SIDE };

struct grid {
    unsigned char cell[SIDE][SIDE][SIDE]; /* [z][y][x] */
};

/* A box of cells, as a shape. A vague one says nothing about cubes that can be split, which is allowed and
 * gives splitting and merging more to do. */
struct cells {
    int low[3], high[3];
    bool vague;
};

/* Cells from first to last along each axis: are all of them in the box, is none? */
static inline void compare(const struct cells *cells, const int first[3], int side, bool *inside,
                           bool *outside)
{
    *inside = true;
    *outside = false;
    for (int k = 0; k < 3; k++) {
        int last = first[k] + side - 1;
        *inside = *inside && first[k] >= cells->low[k] && last <= cells->high[k];
        *outside = *outside || last < cells->low[k] || first[k] > cells->high[k];
    }
}

static inline struct octree_cover cells_cover(const void *shape, const double corner[3], double side,
                                              bool cells)
{
    struct octree_cover cover = {0};
    for (int i = 0; i < 8; i++) {
        const struct cells *box = shape;
        int first[3];
        bool inside, outside;
        for (int k = 0; k < 3; k++)
            first[k] = (int)lround((corner[k] + (i >> k & 1) * side) * SIDE);
        compare(box, first, (int)lround(side * SIDE), &inside, &outside);
        cover.inside |= (unsigned)(inside && (cells || !box->vague)) << i;
        cover.outside |= (unsigned)(outside && !box->vague) << i;
    }
    return cover;
}

static inline struct cells random_cells(uint64_t *seed)
{
    struct cells cells = {.vague = random_bits(seed) % 2};
    for (int k = 0; k < 3; k++) {
        int a = (int)(random_bits(seed) % SIDE), b = (int)(random_bits(seed) % SIDE);
        cells.low[k] = a < b ? a : b;
        cells.high[k] = a < b ? b : a;
    }
    return cells;
}

static inline void set_grid(struct grid *grid, const struct cells *cells, unsigned material)
{
    for (int z = cells->low[2]; z <= cells->high[2]; z++)
        for (int y = cells->low[1]; y <= cells->high[1]; y++)
            for (int x = cells->low[0]; x <= cells->high[0]; x++)
                grid->cell[z][y][x] = (unsigned char)material;
}

static inline void assert_same_cells(const struct octree *tree, const struct grid *grid)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                if (octree_at(tree, x, y, z) != grid->cell[z][y][x])
                    fail_msg("cell %d %d %d is %u, must be %u", x, y, z, octree_at(tree, x, y, z),
                             grid->cell[z][y][x]);
}

/* A tree and its grid after some random boxes of 0, 1, 2 or 3. */
static inline struct octree random_tree(uint64_t seed, int boxes, struct grid *grid)
{
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 0);
    memset(grid, 0, sizeof *grid);
    for (int i = 0; i < boxes; i++) {
        struct cells cells = random_cells(&seed);
        unsigned material = (unsigned)(random_bits(&seed) % 4);
        assert_ok(octree_apply(&tree, cells_cover, &cells, material, &err), &err);
        set_grid(grid, &cells, material);
    }
    return tree;
}

#endif
