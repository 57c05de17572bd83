/*
 * The sorted triangles in one eye's picture, cell by cell: squares of its pixels, each with those that reach
 * into it, in the order of all. Drawn cell by cell, with the scissor around each, they make the same picture
 * to the bit. A renderer that works tile by tile, as software does, finds a tile's triangles close together
 * in memory then, and corners that neighbours share shaded already: sorted triangles on the whole lie far
 * from their neighbours, and drawing them takes up to twice as long.
 *
 *     struct cells cells = {0};
 *     if (cells_build(&cells, &geometry, &eye, err)) ...          once a frame and eye; keeps its memory
 *     for (int i = 0; i < cells.columns * cells.rows; i++)
 *         ... triangles begin[i] .. begin[i + 1] of indices ...
 *     cells_clear(&cells);
 */
#ifndef RENDER_CELLS_H
#define RENDER_CELLS_H

#include "render/geometry.h"

enum { CELLS_ACROSS_MAX = 32 };

/* Columns and rows of cells that a triangle reaches: from the first to before the second. */
struct cells_range {
    uint8_t from[2], to[2];
};

struct cells {
    int corner[2];     /* of the first cell: pixels from the lower left of the eye's picture */
    int side;          /* pixels */
    int columns, rows; /* cells are numbered row by row, from below */
    size_t begin[CELLS_ACROSS_MAX * CELLS_ACROSS_MAX + 1]; /* of each cell's triangles */
    struct {
        uint32_t *items;
        size_t count, capacity;
    } indices; /* 3 for each triangle of each cell */
    struct {
        float (*items)[2];
        size_t count, capacity;
    } places; /* of the vertices, in cells; NAN: before the near plane */
    struct {
        struct cells_range *items;
        size_t count, capacity;
    } ranges; /* of the triangles */
};

/* Where triangles are sorted, and many enough; not with smooth outlines, of whose samples Mesa's software
 * loses some along a scissor's edge. */
bool cells_are_worth_it(const struct geometry *geometry, const struct render_view *view);

/* Of the translucent triangles, in the order in which they are. Errors: STATUS_NO_MEMORY. */
enum status cells_build(struct cells *cells, const struct geometry *geometry, const struct camera_eye *eye,
                        struct error *err);
void cells_clear(struct cells *cells);

#endif
