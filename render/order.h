/*
 * In which order translucent triangles are drawn: what is behind first. Each has one number, its nearness to
 * the eye, and a frame sorts them by it, once for both eyes.
 *
 *     const double closed = order_is_whole(skin);                   how far a skin is closed, 0 to 1
 *     triangle.nearness = order_nearness(corner, closed);           for each triangle
 *     if (order_indices(&geometry, true, err)) ...                  once all are there: what is drawn, in order
 *
 * No single number orders all triangles rightly. Those of torn skin go by their middles. Closed skin is
 * seen from outside: a triangle goes by its nearest corner where its outside is seen, and by its farthest
 * where its inside is, since what lies close behind its outside, as where it is pressed flat, is its inside,
 * which by the middles would show through at random. Skin that is torn a little goes by a mean of the two.
 * Exact order, pixel by pixel, is what layers.c is for.
 */
#ifndef RENDER_ORDER_H
#define RENDER_ORDER_H

#include "render/render.h"

#include <stdint.h>

struct geometry;

/* A triangle on its way into the index array. */
struct order_triangle {
    uint32_t vertex[3];
    uint32_t nearness; /* larger is nearer: the bits of its square distance upside down */
};

/* Whether all of a skin's triangles are there. */
bool order_is_whole(const struct render_skin *skin);

/* Of a triangle with these corners, seen from the origin; closed: 1 of closed skin, 0 of torn. */
uint32_t order_nearness(double corner[3][3], double closed);

/* Farthest first; spare has room for as many. Equal ones keep their order. */
void order_sort(struct order_triangle *triangles, struct order_triangle *spare, size_t count);

/* Puts the geometry's translucent triangles behind the opaque ones in its indices, farthest first if they are
 * to be sorted. Error: STATUS_NO_MEMORY. */
enum status order_indices(struct geometry *geometry, bool sorted, struct error *err);

#endif
