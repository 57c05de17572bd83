/*
 * Four triangles at once: a `lanes` has one number of each of the four, and arithmetic on it is that of GCC's
 * and clang's vectors. The four numbers of a result are what each triangle alone would give, to the bit,
 * whatever the machine's vectors are.
 */
#ifndef SIM_LANES_H
#define SIM_LANES_H

#include "sim/rows.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Whether a vector is handed over in one register or in two changes nothing for functions that are
 * all compiled in place. */
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

typedef double lanes __attribute__((vector_size(4 * sizeof(double))));
typedef int64_t lane_mask __attribute__((vector_size(4 * sizeof(int64_t)))); /* -1 where true, else 0 */
typedef uint64_t lane_bits __attribute__((vector_size(4 * sizeof(uint64_t))));

/* For functions that are compiled once for each of what their callers know. */
#define INLINE static inline __attribute__((always_inline))

/* x, y and z of four vectors. */
struct lanes3 {
    lanes x, y, z;
};

static inline lanes lanes_all(double number)
{
    return (lanes){number, number, number, number};
}

/* Four numbers that follow each other in memory. */
typedef double unaligned_lanes
    __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

static inline lanes lanes_at(const double *number)
{
    return (lanes) * (const unaligned_lanes *)number;
}

static inline void lanes_put(lanes numbers, double *to)
{
    *(unaligned_lanes *)to = (unaligned_lanes)numbers;
}

static inline lanes lanes_select(lane_mask mask, lanes where_true, lanes where_false)
{
    return (lanes)(((lane_mask)where_true & mask) | ((lane_mask)where_false & ~mask));
}

/* a > b ? a : b, also where one is no number; and likewise. */
static inline lanes lanes_max(lanes a, lanes b)
{
#ifdef SIM_WIDE
    return (lanes)__builtin_ia32_maxpd256(a, b);
#else
    return lanes_select(a > b, a, b);
#endif
}

static inline lanes lanes_min(lanes a, lanes b)
{
#ifdef SIM_WIDE
    return (lanes)__builtin_ia32_minpd256(a, b);
#else
    return lanes_select(a < b, a, b);
#endif
}

static inline double lanes_largest(lanes a)
{
    return fmax(fmax(a[0], a[1]), fmax(a[2], a[3]));
}

static inline lanes lanes_size(lanes a)
{
    return (lanes)((lane_mask)a & INT64_MAX);
}

static inline bool lanes_any(lane_mask mask)
{
#ifdef SIM_WIDE
    return __builtin_ia32_movmskpd256((lanes)mask) != 0;
#else
    return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}

/* Of four flags that follow each other, each 0 or 1. */
static inline bool four_are_set(const unsigned char *flag)
{
    return flag[0] & flag[1] & flag[2] & flag[3];
}

static inline lanes lanes_sqrt(lanes a)
{
    return (lanes){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
}

static inline lanes lanes_dot(struct lanes3 a, struct lanes3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct lanes3 lanes_cross(struct lanes3 a, struct lanes3 b)
{
    return (struct lanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline struct lanes3 lanes_sum(lanes s, struct lanes3 a, lanes t, struct lanes3 b)
{
    return (struct lanes3){s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

/* One of its numbers, four times; `i` is known when it is compiled. GCC 12 would take numbers but
 * the first out one by one. */
INLINE row lanes_spread(lanes a, int i)
{
#ifdef SIM_WIDE
    const lanes spread[4] = {
        __builtin_shufflevector(a, a, 0, 0, 0, 0), __builtin_shufflevector(a, a, 1, 1, 1, 1),
        __builtin_shufflevector(a, a, 2, 2, 2, 2), __builtin_shufflevector(a, a, 3, 3, 3, 3)};
    return (row)spread[i];
#else
    return (row){a[i], a[i], a[i], a[i]};
#endif
}

/* The turned table: row i of in is column i of out. Where the machine has no vectors of four,
 * numbers move one by one. */
static inline void lanes_turn(const row in[4], row out[4])
{
#ifdef SIM_WIDE
    const row low01 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6),
              high01 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7),
              low23 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6),
              high23 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
    out[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    out[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
#else
    for (int i = 0; i < 4; i++)
        out[i] = (row){in[0][i], in[1][i], in[2][i], in[3][i]};
#endif
}

static inline struct lanes3 lanes_of_rows(const row in[4])
{
    row out[4];
    lanes_turn(in, out);
    return (struct lanes3){(lanes)out[0], (lanes)out[1], (lanes)out[2]};
}

static inline void lanes_to_rows(struct lanes3 in, row out[4])
{
    const row turned[4] = {(row)in.x, (row)in.y, (row)in.z, (row){0}};
    lanes_turn(turned, out);
}

#endif
