/*
 * The field on the 9 x 9 x 9 corners of a brick, and along the grid's edges in it.
 *
 *     struct block block;
 *     if (block_init(&block, &grid)) ...                       one for each thread
 *     if (block_move(&block, at)) ...                          gathers the fields around
 *     if (block_sample(&block)) ...                            block.values
 *     struct line line = block_line(&block, axis, at);
 *     value = line_value(&line, x, &slope);
 *     block_clear(&block);
 *
 * The field is a sum of products of one-dimensional sums, so it is added up along one axis after the other:
 * each row of fields along x at 9 places, then planes at 9 x 9, then the block at 9 x 9 x 9. That takes a few
 * numbers a corner where adding up every box of fields at every corner took hundreds. Along an edge of the
 * grid two of the three coordinates lie on tabulated lines: what is left there is a one-dimensional sum of a
 * few terms, and so is its gradient.
 */
#ifndef SURFACE_BLOCK_H
#define SURFACE_BLOCK_H

#include "surface/grid.h"
#include "surface/window.h"

enum {
    BLOCK_ROW = BRICK_CORNERS + 1, /* an even number of doubles, for vectors */
    BLOCK_VALUES = BRICK_CORNERS * BRICK_CORNERS * BRICK_CORNERS
};

struct block {
    const struct grid *grid; /* borrowed */
    int corner[3];
    struct window window;            /* around some blocks that lie together */
    int window_at[3], window_bricks; /* the first of these bricks, in bricks; how many along an axis, or 0 */
    struct profile profile[3][BRICK_CORNERS]; /* of the block's lines */
    int low[3], size[3];                      /* the cells, and planes, of the window that reach the block */
    /* [BRICK_CORNERS][2][layer][size[2]][size[1]] by place along x: sums of rows, their slopes. */
    double *row;
    double *share; /* [size[1]][BLOCK_ROW] of a layer: by place along y, the sums of cells */
    double *line;  /* [layer][3][longest of size] */
    /* [BRICK_CORNERS][2][layer][size[1]][size[0]] by place along z: sums of cells along z, their slopes. */
    double *beam;
    unsigned beams; /* bit i: those of place i are known */
    size_t rows, row_room, share_room, line_room, beam_room;
    struct profiles profiles;    /* of the point or edge at hand */
    double values[BLOCK_VALUES]; /* x fastest */
};

/* How many cells there are along x and y, of all layers. */
static inline size_t block_beam(const struct block *block)
{
    return (size_t)block->grid->field->layers * (size_t)block->size[1] * (size_t)block->size[0];
}

/* False when there is no memory. */
bool block_init(struct block *block, const struct grid *grid);
void block_clear(struct block *block);

/* Moves to the brick at this place, in bricks, and gathers the fields around it, up to half a cube beyond,
 * unless those around a brick near by still do. False when there is no memory. */
bool block_move(struct block *block, const int at[3]);

/* Fills block->values. The same corner gets the same bits in any block, and from a probe. False
 * when there is no memory. */
bool block_sample(struct block *block);

/* The field and its gradient at any point of the block, with the same bits as from a probe. */
double block_value(struct block *block, const double point[3], double gradient[3]);

/* The same at a corner, 0 .. 8 along each axis; it need not have been sampled. */
double block_corner(const struct block *block, const int at[3], double gradient[3]);

/* The field along the edge of the grid that begins at the block's corner `at` and runs along `axis`. It is
 * valid until the next call of this block. The block was sampled. */
struct line {
    struct block *block;
    int axis, size;
    double *sum; /* [layer][3][size]: by cell along the axis, what its one-dimensional sum is multiplied with;
                     first for the value, then for the derivatives along the next two axes */
};

struct line block_line(struct block *block, int axis, const int at[3]);

/* The field at coordinate x along the line, in cells of the octree, and its derivative. */
double line_value(const struct line *line, double x, double *slope);

/* The gradient at the point of the last line_value(), whose slope that gave. */
void line_gradient(const struct line *line, double slope, double gradient[3]);

/* The derivative along the line at its two ends, of which `at` is the first. */
void line_slopes(const struct line *line, const int at[3], double slope[2]);

#endif
