/*
 * Boxes around what moves in straight lines: one around it where the lines begin, and one where they
 * end. Whatever is apart along an axis at both ends, the same one before the other, is so all the way:
 * the gap is at least what lies in between. So boxes of two features that move along together are as
 * good as if they stood still.
 *
 * The lowest corner is kept turned round, as minus its numbers: of two boxes together both corners are the
 * larger ones, and one box's lowest corner plus the other's highest is how far they reach into each other,
 * and negative where they are apart.
 *
 * A fourth axis, x + y + z, tells slanting things apart and costs nothing, since four numbers are compared
 * at once; a place that is off by r is off by no more than sqrt(3) r along it.
 *
 * In single precision, each a hair too large.
 */
#ifndef SIM_CONTACT_BOX_H
#define SIM_CONTACT_BOX_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

/* x, y, z and their sum. The compilers' vectors: comparisons in loops would stay one by one. */
typedef float box_row __attribute__((vector_size(4 * sizeof(float)), may_alias));
typedef int32_t box_mask __attribute__((vector_size(4 * sizeof(int32_t))));

struct contact_extent {
    box_row low, high; /* low turned round */
};

struct contact_box {
    struct contact_extent at[2]; /* where the lines begin and end */
};

/* Number by number. */
static inline box_row box_most(box_row a, box_row b)
{
#ifdef __SSE__
    return (box_row)_mm_max_ps((__m128)a, (__m128)b);
#else
    const box_mask mask = b > a;
    return (box_row)((mask & (box_mask)b) | (~mask & (box_mask)a));
#endif
}

/* Whether any number of it would be negative as one of a row. */
static inline bool box_any_negative(box_mask mask)
{
#ifdef __SSE__
    return _mm_movemask_ps((__m128)mask) != 0;
#else
    return (mask[0] | mask[1] | mask[2] | mask[3]) < 0;
#endif
}

/* The box of nothing. */
static inline struct contact_box contact_box_empty(void)
{
    const struct contact_extent none = {{-INFINITY, -INFINITY, -INFINITY, -INFINITY},
                                        {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};
    return (struct contact_box){{none, none}};
}

/* Of a point that goes from one place to another, with room on all sides. Rounding to single precision moves
 * a number by 6e-8 of it. */
static inline struct contact_box contact_box_point(const double from[3], const double to[3], double room)
{
    const double *ends[2] = {from, to};
    struct contact_box box;
    for (int e = 0; e < 2; e++) {
        const double *x = ends[e];
        const double sum = x[0] + x[1] + x[2], sizes = fabs(x[0]) + fabs(x[1]) + fabs(x[2]);
        const box_row at = {(float)x[0], (float)x[1], (float)x[2], (float)sum},
                      size = {(float)fabs(x[0]), (float)fabs(x[1]), (float)fabs(x[2]), (float)sizes},
                      wide = {1, 1, 1, 1.7321F}, off = (float)(1.000001 * room) * wide + 2e-7F * size;
        box.at[e] = (struct contact_extent){off - at, at + off};
    }
    return box;
}

static inline void contact_box_join(struct contact_box *box, const struct contact_box *other)
{
    for (int e = 0; e < 2; e++) {
        box->at[e].low = box_most(box->at[e].low, other->at[e].low);
        box->at[e].high = box_most(box->at[e].high, other->at[e].high);
    }
}

/* Whether joining the other would change nothing. */
static inline bool contact_box_has(const struct contact_box *box, const struct contact_box *other)
{
    const struct contact_extent *x = box->at, *y = other->at;
    return !box_any_negative((y[0].low > x[0].low) | (y[0].high > x[0].high) | (y[1].low > x[1].low) |
                             (y[1].high > x[1].high));
}

/* Of an edge, and of a triangle, from the boxes of all points. */
static inline struct contact_box contact_box_edge(const struct contact_box *point, const uint32_t p[2])
{
    struct contact_box box = point[p[0]];
    contact_box_join(&box, &point[p[1]]);
    return box;
}

static inline struct contact_box contact_box_triangle(const struct contact_box *point, const uint32_t p[3])
{
    struct contact_box box = contact_box_edge(point, p);
    contact_box_join(&box, &point[p[2]]);
    return box;
}

static inline bool contact_boxes_meet(const struct contact_box *a, const struct contact_box *b)
{
    const struct contact_extent *x = a->at, *y = b->at;
    const box_mask above = (box_mask)(x[0].low + y[0].high) & (box_mask)(x[1].low + y[1].high),
                   below = (box_mask)(x[0].high + y[0].low) & (box_mask)(x[1].high + y[1].low);
    return !box_any_negative(above | below);
}

#endif
