/* Inside the sculptor: the two ways in which voxelise.c asks what is inside. */
#ifndef SCULPT_VOXELISE_PARTS_H
#define SCULPT_VOXELISE_PARTS_H

#include "common/mesh.h"

/*
 * Where the lines through the cells' centres along one axis cross the mesh. Cells are counted
 * along three axes that follow each other as x y z x do: `column` = v * side + u stands for the
 * line, and w runs along it.
 *
 * Corners are rounded to 2^-15 of a cell and lie on even numbers of half of that; centres lie on odd ones, so
 * that no face that is square to an axis passes through one. Where a line meets an edge it is taken to pass
 * beside it by (e, e^2), e above 0 but smaller than anything: each line crosses a closed mesh as often
 * inwards as outwards, to the bit.
 */
struct crossings {
    /* By column: first cell whose centre lies behind the crossing, times 2, + 1 if it goes out. */
    uint32_t *items;
    uint32_t *begin; /* [side * side + 1] where each column's begin; those of the last one end at the last */
};

/* More crossings than this are refused: half a gigabyte of them. */
#define CROSSINGS_MAX ((size_t)1 << 27)

/* Finds them for lines along `axis`. Positions are in cells, from 0 to side. Errors: STATUS_RANGE for more
 * than CROSSINGS_MAX, STATUS_NO_MEMORY. */
enum status crossings_find(const struct mesh *mesh, int axis, int side, struct crossings *crossings,
                           struct error *err);
void crossings_clear(struct crossings *crossings);

/* The generalised winding number: the part of the sphere that the mesh covers as seen from a point, each
 * triangle counted with its sense. */
struct winding;
enum status winding_new(const struct mesh *mesh, struct winding **winding, struct error *err);
void winding_free(struct winding *winding);

/* That part for a single triangle: van Oosterom and Strackee, "The solid angle of a plane triangle", IEEE
 * Trans. Biomed. Eng. 30, 1983. */
double winding_of_triangle(const struct mesh *mesh, uint32_t triangle, const double point[3]);

/* Within about 0.02 of the exact sum over all triangles. */
double winding_at(const struct winding *winding, const double point[3]);

#endif
