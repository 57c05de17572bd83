/*
 * How far pairs are apart, eight at a time, for contact_kernels.c.
 *
 * In single precision, which is enough to tell most pairs from those that touch. Each place is rounded to
 * 6e-8 of its numbers, and each difference, product and sum of two places once more: a separation of points
 * is off by no more than 22 such parts, and 20 more where places in between are taken, of the sum of a
 * point's numbers. So much and some more is taken off.
 */
#ifndef SIM_CONTACT_APART_H
#define SIM_CONTACT_APART_H

#include "sim/contact_kernels.h"
#include "sim/lanes8.h"

#include <string.h>

#define APART_ROUNDING 3e-6F

/* Eight pairs at one time. */
struct apart_eight {
    struct lanes8_vec x[4];
};

/* As they are at first and at last; what rounding may come to. */
struct apart_ways {
    struct apart_eight first, last;
    lanes8 lost;
};

static inline lanes8 apart_clamp(lanes8 value)
{
    return lanes8_min(lanes8_max(value, lanes8_all(0)), lanes8_all(1));
}

/* 0 where there is nothing to divide by. */
static inline lanes8 apart_divide(lanes8 a, lanes8 b)
{
    const lanes8_mask some = b > 0;
    return (lanes8)((lanes8_mask)a & some) / lanes8_select(some, b, lanes8_all(1));
}

/* From the nearest place on the line from 0 to `side` to `place`. */
static inline struct lanes8_vec apart_from_side(struct lanes8_vec side, struct lanes8_vec place)
{
    const lanes8 along = apart_clamp(apart_divide(lanes8_dot(place, side), lanes8_dot(side, side)));
    return lanes8_add(place, -along, side);
}

static inline struct lanes8_vec apart_select(lanes8_mask mask, struct lanes8_vec a, struct lanes8_vec b)
{
    return (struct lanes8_vec){lanes8_select(mask, a.x, b.x), lanes8_select(mask, a.y, b.y),
                               lanes8_select(mask, a.z, b.z)};
}

static inline struct lanes8_vec apart_shorter(struct lanes8_vec a, struct lanes8_vec b)
{
    return apart_select(lanes8_dot(a, a) < lanes8_dot(b, b), a, b);
}

/* From the nearest place of the triangle 1 2 3 to the point 0: across its plane where the point is over it,
 * else from the nearest side. */
static inline struct lanes8_vec apart_from_triangle(const struct apart_eight *f)
{
    const struct lanes8_vec ab = lanes8_sub(f->x[2], f->x[1]), ac = lanes8_sub(f->x[3], f->x[1]),
                            ap = lanes8_sub(f->x[0], f->x[1]), normal = lanes8_cross(ab, ac);
    const lanes8 square = lanes8_dot(normal, normal), c = lanes8_dot(lanes8_cross(ab, ap), normal),
                 b = lanes8_dot(lanes8_cross(ap, ac), normal);
    const struct lanes8_vec across = lanes8_scale(apart_divide(lanes8_dot(ap, normal), square), normal),
                            side = apart_shorter(
                                apart_shorter(apart_from_side(ab, ap), apart_from_side(ac, ap)),
                                apart_from_side(lanes8_sub(f->x[3], f->x[2]), lanes8_sub(f->x[0], f->x[2])));
    return apart_select((b >= 0) & (c >= 0) & (b + c <= square) & (square > 0), across, side);
}

/* From the nearest place of the edge 2 3 to that of the edge 0 1 (ccd.c). */
static inline struct lanes8_vec apart_from_edge(const struct apart_eight *f)
{
    const struct lanes8_vec d1 = lanes8_sub(f->x[1], f->x[0]), d2 = lanes8_sub(f->x[3], f->x[2]),
                            r = lanes8_sub(f->x[0], f->x[2]);
    const lanes8 a = lanes8_dot(d1, d1), e = lanes8_dot(d2, d2), g = lanes8_dot(d2, r), c = lanes8_dot(d1, r),
                 b = lanes8_dot(d1, d2);
    const lanes8 free_s = apart_clamp(apart_divide(b * g - c * e, a * e - b * b)),
                 free_t = apart_divide(b * free_s + g, e), t = apart_clamp(free_t);
    const lanes8 s = lanes8_select(t == free_t, free_s, apart_clamp(apart_divide(b * t - c, a)));
    return lanes8_add(lanes8_add(r, s, d1), -t, d2);
}

static inline struct lanes8_vec apart_way(const struct apart_eight *f, enum ccd_kind kind)
{
    return kind == CCD_EDGES ? apart_from_edge(f) : apart_from_triangle(f);
}

/* How far the first features begin before the second ones end along a direction that the way has, whatever
 * its length. From the first point, so that what is rounded is small. */
static inline lanes8 apart_along(const struct apart_eight *f, enum ccd_kind kind, struct lanes8_vec n)
{
    const lanes8 x1 = lanes8_dot(n, lanes8_sub(f->x[1], f->x[0])),
                 high = lanes8_max(lanes8_dot(n, lanes8_sub(f->x[2], f->x[0])),
                                   lanes8_dot(n, lanes8_sub(f->x[3], f->x[0])));
    if (kind == CCD_EDGES)
        return lanes8_min(lanes8_all(0), x1) - high;
    return -lanes8_max(x1, high);
}

static inline lanes8 apart_numbers(struct lanes8_vec x)
{
    return lanes8_size(x.x) + lanes8_size(x.y) + lanes8_size(x.z);
}

static inline struct apart_ways apart_gather(const struct contact_flock *flock, const uint32_t (*points)[4])
{
    struct apart_ways f;
    lanes8 numbers = lanes8_all(0);
    for (int k = 0; k < 4; k++) {
        lanes8 rows[8], turned[8];
        for (int i = 0; i < 8; i++)
            rows[i] = *(const lanes8 *)flock->ends[points[i][k]];
        lanes8_turn(rows, turned);
        f.first.x[k] = (struct lanes8_vec){turned[0], turned[1], turned[2]};
        f.last.x[k] = (struct lanes8_vec){turned[4], turned[5], turned[6]};
        numbers = lanes8_max(numbers, lanes8_max(apart_numbers(f.first.x[k]), apart_numbers(f.last.x[k])));
        f.first.x[k] = lanes8_add(f.first.x[k], lanes8_all(flock->gone),
                                  lanes8_sub(f.last.x[k], f.first.x[k]));
    }
    f.lost = APART_ROUNDING * numbers;
    return f;
}

static inline struct lanes8_vec apart_unit(struct lanes8_vec way, lanes8 length)
{
    return lanes8_scale(apart_divide(lanes8_all(1), length), way);
}

/* contact_kernels.h: apart */
static inline void apart_eight(const struct contact_flock *flock, enum ccd_kind kind,
                               const uint32_t (*points)[4], float (*apart)[2])
{
    const struct apart_ways f = apart_gather(flock, points);
    const struct lanes8_vec way = apart_way(&f.first, kind),
                            n = apart_unit(way, lanes8_sqrt(lanes8_dot(way, way)));
    const lanes8 begin = apart_along(&f.first, kind, n) - f.lost,
                 end = apart_along(&f.last, kind, n) - f.lost;
    for (int i = 0; i < 8; i++) {
        apart[i][0] = begin[i];
        apart[i][1] = end[i];
    }
}

/*
 * What is free between two features, and more than what ccd_approach() says, never falls by more than their
 * points go together. They stay clear of each other in a step that takes no more than half of the distance d
 * at which it begins, since the gap is no more than d/2. If they are `end` apart now, and their points go b
 * before a later step and t in it, d is at least end - b: they do while b + 2 t < end. In this step, in which
 * they have come t so far, d was no more than end + t: a push by u leaves the gap free while u < (end - t)/2,
 * which is t + 2 u < end.
 */
static inline void apart_note(lanes8_mask sure, lanes8 end, lanes8 lost, float *clear)
{
    const lanes8 free = lanes8_select(sure, end - 4 * lost, lanes8_all(0));
    memcpy(clear, &free, sizeof free);
}

/*
 * contact_kernels.h: open; a bit for each. A way from one feature to the other is never shorter than they are
 * apart. Features that slide past each other are often not apart at last along the direction in which they
 * are nearest at first, but along the one in which they are nearest then.
 */
static inline unsigned apart_open(const struct contact_flock *flock, float thickness, enum ccd_kind kind,
                                  const uint32_t (*points)[4], float *clear)
{
    const struct apart_ways f = apart_gather(flock, points);
    const struct lanes8_vec way = apart_way(&f.first, kind);
    const lanes8 length = lanes8_sqrt(lanes8_dot(way, way));
    const struct lanes8_vec n = apart_unit(way, length);
    const lanes8 gap = lanes8_min(length, lanes8_all(thickness)) * 0.50001F + f.lost;
    const lanes8 end = apart_along(&f.last, kind, n);
    const lanes8_mask sure = (apart_along(&f.first, kind, n) > gap) & (end > gap);
    apart_note(sure, end, f.lost, clear);
    const unsigned clear_ones = lanes8_bits(sure);
    if (clear_ones == 0xff)
        return 0;
    const struct lanes8_vec then = apart_way(&f.last, kind),
                            m = apart_unit(then, lanes8_sqrt(lanes8_dot(then, then)));
    return 0xff & ~(clear_ones | lanes8_bits((apart_along(&f.first, kind, m) > gap) &
                                             (apart_along(&f.last, kind, m) > gap)));
}

#endif
