/*
 * Sandpaper and heat. The sculpture is taken in tiles of 32 cells a side, each with the cells around it, a
 * bit a cell and a word a row, so that one row is decided about at once. What goes is noted for all tiles
 * first and then taken away: so no cell is decided about by what has gone already.
 */
#include "sculpt/smooth.h"

#include "common/array.h"
#include "sculpt/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TILE = 32, PADDED = TILE + 2 };

/* Full cells of a tile and around it: bit x + 1 of row[z + 1][y + 1]. */
struct window {
    int corner[3];
    uint64_t row[PADDED][PADDED];
};

/* Cells of a tile that go: bit x of gone[z][y]. */
struct tile {
    int corner[3];
    double cells; /* a side of the cube */
    uint32_t gone[TILE][TILE];
};

struct tiles {
    struct tile *items;
    size_t count, capacity;
};

static bool fill_rows(void *context, const struct octree_leaf *leaf)
{
    struct window *window = context;
    const int *corner = window->corner, first[3] = {corner[0] - 1, corner[1] - 1, corner[2] - 1};
    rows_mark(&window->row[0][0], PADDED, first, leaf);
    return true;
}

static void look(const struct octree *tree, const int corner[3], struct window *window)
{
    int low[3], high[3];
    memset(window, 0, sizeof *window);
    for (int k = 0; k < 3; k++) {
        window->corner[k] = corner[k];
        low[k] = corner[k] - 1;
        high[k] = corner[k] + TILE;
    }
    octree_visit(tree, low, high, fill_rows, window);
}

/* Full cells with an exposed face, of one row. */
static uint64_t exposed(const struct window *window, int z, int y)
{
    uint64_t row = window->row[z][y];
    return row & ~(row << 1 & row >> 1 & window->row[z][y - 1] & window->row[z][y + 1] &
                   window->row[z - 1][y] & window->row[z + 1][y]);
}

/* Adds a bit worth 2^from to each cell's count: bit x of digit[d] is worth 2^d for cell x. */
static inline void add_bits(uint64_t digit[5], int from, uint64_t bits)
{
    for (int d = from; d < 5; d++) {
        const uint64_t carry = digit[d] & bits;
        digit[d] ^= bits;
        bits = carry;
    }
}

/* Full cells that have fewer than 14 full ones among the 27 around them, of one row. All are counted at once,
 * in binary, three of a row together. */
static uint64_t standing_out(const struct window *window, int z, int y)
{
    uint64_t digit[5] = {0};
    for (int i = 0; i < 9; i++) {
        const uint64_t row = window->row[z + i / 3 - 1][y + i % 3 - 1], below = row << 1, above = row >> 1;
        add_bits(digit, 0, row ^ below ^ above);
        add_bits(digit, 1, (row & below) | (row & above) | (below & above));
    }
    uint64_t at_least_14 = digit[4] | (digit[3] & digit[2] & digit[1]);
    return window->row[z][y] & ~at_least_14;
}

/* Those of the bits of a row of cells that lie in a ball. The sum is taken as for a sphere's chip. */
static uint32_t within(const struct smooth_balls *balls, double half, const int first[3], uint32_t bits)
{
    uint32_t in = 0;
    for (int b = 0; b < balls->count; b++) {
        double square[3];
        for (int k = 1; k < 3; k++) {
            double off = (2 * first[k] + 1) * half - balls->centre[b][k];
            square[k] = off * off;
        }
        for (int x = 0; x < TILE; x++) {
            double off = (2 * (first[0] + x) + 1) * half - balls->centre[b][0];
            in |= (uint32_t)(off * off + square[1] + square[2] <= balls->radius * balls->radius) << x;
        }
    }
    return in & bits;
}

/* What goes of a tile; false when nothing does. */
static bool decide(const struct window *window, enum chip_kind kind, const struct smooth_balls *balls,
                   struct tile *tile)
{
    uint32_t any = 0;
    for (int z = 0; z < TILE; z++)
        for (int y = 0; y < TILE; y++) {
            uint64_t bits = window->row[z + 1][y + 1];
            if (bits != 0)
                bits = kind == CHIP_HEAT ? exposed(window, z + 1, y + 1) : standing_out(window, z + 1, y + 1);
            uint32_t gone = (uint32_t)(bits >> 1);
            const int first[3] = {tile->corner[0], tile->corner[1] + y, tile->corner[2] + z};
            if (gone != 0)
                gone = within(balls, 0.5 / tile->cells, first, gone);
            tile->gone[z][y] = gone;
            any |= gone;
        }
    return any != 0;
}

/* How the cells that go cover a cube of cells within the tile. */
static void cover_cube(const struct tile *tile, const int at[3], int side, bool *inside, bool *outside)
{
    uint32_t any = 0, all = UINT32_MAX, bits = (UINT32_MAX >> (TILE - side)) << at[0];
    for (int z = at[2]; z < at[2] + side; z++)
        for (int y = at[1]; y < at[1] + side; y++) {
            any |= tile->gone[z][y];
            all &= tile->gone[z][y];
        }
    *inside = (all & bits) == bits;
    *outside = (any & bits) == 0;
}

static struct octree_cover tile_covers(const void *shape, const double corner[3], double side, bool cells)
{
    (void)cells;
    const struct tile *tile = shape;
    const int cube = (int)(side * tile->cells);
    struct octree_cover cover = {0};
    for (int i = 0; i < 8; i++) {
        int at[3];
        bool inside = false, outside = false;
        for (int k = 0; k < 3; k++) {
            at[k] = (int)(corner[k] * tile->cells) + (i >> k & 1) * cube - tile->corner[k];
            outside = outside || at[k] >= TILE || at[k] + cube <= 0;
        }
        if (!outside && cube <= TILE)
            cover_cube(tile, at, cube, &inside, &outside);
        cover.inside |= (unsigned)inside << i;
        cover.outside |= (unsigned)outside << i;
    }
    return cover;
}

static bool meets(const struct smooth_balls *balls, const struct tile *tile)
{
    for (int b = 0; b < balls->count; b++) {
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            double low = tile->corner[k] / tile->cells, high = low + TILE / tile->cells;
            double off = fmax(fmax(low - balls->centre[b][k], balls->centre[b][k] - high), 0);
            sum += off * off;
        }
        if (sum <= balls->radius * balls->radius)
            return true;
    }
    return false;
}

/* The cells around all balls, in whole tiles and within the cube; false when there is none. */
static bool bounds(const struct smooth_balls *balls, int cells, int low[3], int high[3])
{
    for (int k = 0; k < 3; k++) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (int b = 0; b < balls->count; b++) {
            least = fmin(least, balls->centre[b][k] - balls->radius);
            most = fmax(most, balls->centre[b][k] + balls->radius);
        }
        if (most < 0 || least > 1)
            return false;
        low[k] = (int)(fmax(least, 0) * cells) / TILE * TILE;
        high[k] = (int)(fmin(most, 1) * cells);
        high[k] = high[k] < cells ? high[k] : cells - 1;
    }
    return true;
}

static enum status find_tiles(const struct octree *tree, enum chip_kind kind,
                              const struct smooth_balls *balls, struct tiles *tiles, struct error *err)
{
    int low[3], high[3];
    const int cells = 1 << tree->depth;
    struct tile tile = {.cells = cells};
    struct window window;
    if (!bounds(balls, cells, low, high))
        return STATUS_OK;
    int *at = tile.corner;
    for (at[2] = low[2]; at[2] <= high[2]; at[2] += TILE)
        for (at[1] = low[1]; at[1] <= high[1]; at[1] += TILE)
            for (at[0] = low[0]; at[0] <= high[0]; at[0] += TILE) {
                if (!meets(balls, &tile))
                    continue;
                look(tree, at, &window);
                if (!decide(&window, kind, balls, &tile))
                    continue;
                if (!ARRAY_RESERVE(tiles, 1))
                    return error_no_memory(err, "what is smoothed");
                tiles->items[tiles->count++] = tile;
            }
    return STATUS_OK;
}

enum status smooth(struct octree *tree, enum chip_kind kind, const struct smooth_balls *balls,
                   struct error *err)
{
    struct tiles tiles = {0};
    enum status status = find_tiles(tree, kind, balls, &tiles, err);
    for (size_t i = 0; i < tiles.count && !status; i++)
        status = octree_apply(tree, tile_covers, &tiles.items[i], 0, err);
    free(tiles.items);
    return status;
}
