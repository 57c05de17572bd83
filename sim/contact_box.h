/*
 * Boxes around what moves in straight lines: one around it where the lines begin, and one where they end. Whatever is apart along an axis at
 * both ends, the same one before the other, is so all the way: the gap is at least what lies in between. So boxes of two features that
 * move along together are as good as if they stood still.
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

/* x, y, z and 0. The compilers' vectors: comparisons in loops would stay one by one. */
typedef float box_row __attribute__((vector_size(4 * sizeof(float)), may_alias));
typedef int32_t box_mask __attribute__((vector_size(4 * sizeof(int32_t)))); /* -1 where true, else 0 */

struct contact_box {
    box_row low[2], high[2]; /* where the lines begin and end */
};

/* Number by number. */
static inline box_row box_least(box_row a, box_row b)
{
#ifdef __SSE__
    return (box_row)_mm_min_ps((__m128)a, (__m128)b);
#else
    const box_mask mask = b < a;
    return (box_row)((mask & (box_mask)b) | (~mask & (box_mask)a));
#endif
}

static inline box_row box_most(box_row a, box_row b)
{
#ifdef __SSE__
    return (box_row)_mm_max_ps((__m128)a, (__m128)b);
#else
    const box_mask mask = b > a;
    return (box_row)((mask & (box_mask)b) | (~mask & (box_mask)a));
#endif
}

/* The box of nothing. */
static inline struct contact_box contact_box_empty(void)
{
    const box_row far = {INFINITY, INFINITY, INFINITY, 0};
    return (struct contact_box){{far, far}, {-far, -far}};
}

/* Of a point that goes from one place to another, with room on all sides. Rounding to single precision moves a number by 6e-8 of it. */
static inline struct contact_box contact_box_point(const double from[3], const double to[3], double room)
{
    const double *ends[2] = {from, to};
    struct contact_box box;
    for (int e = 0; e < 2; e++) {
        const double *x = ends[e];
        const box_row at = {(float)x[0], (float)x[1], (float)x[2], 0},
                      size = {(float)fabs(x[0]), (float)fabs(x[1]), (float)fabs(x[2]), 0},
                      off = (float)(1.000001 * room) + 2e-7F * size;
        box.low[e] = at - off;
        box.high[e] = at + off;
    }
    return box;
}

static inline void contact_box_join(struct contact_box *box, const struct contact_box *other)
{
    for (int e = 0; e < 2; e++) {
        box->low[e] = box_least(box->low[e], other->low[e]);
        box->high[e] = box_most(box->high[e], other->high[e]);
    }
}

static inline bool contact_boxes_meet(const struct contact_box *a, const struct contact_box *b)
{
    typedef int64_t halves __attribute__((vector_size(2 * sizeof(int64_t))));
    const box_mask below = (a->high[0] < b->low[0]) & (a->high[1] < b->low[1]),
                   above = (b->high[0] < a->low[0]) & (b->high[1] < a->low[1]);
    const halves apart = (halves)(below | above);
    return (apart[0] | apart[1]) == 0;
}

#endif
