/*
 * Eight numbers of single precision at once, for what is only to be told apart roughly: each result is to be
 * trusted to its rounding and no further (lanes.h has four of double precision). With the machine's own
 * instructions where it has vectors that wide.
 */
#ifndef SIM_LANES8_H
#define SIM_LANES8_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#ifdef __SSE__
#include <immintrin.h>
#endif

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

typedef float lanes8 __attribute__((vector_size(8 * sizeof(float)), may_alias));
typedef int32_t lanes8_mask
    __attribute__((vector_size(8 * sizeof(int32_t)), may_alias)); /* -1 where true, else 0 */

/* x, y and z of eight vectors. */
struct lanes8_vec {
    lanes8 x, y, z;
};

static inline lanes8 lanes8_all(float number)
{
    return (lanes8){number, number, number, number, number, number, number, number};
}

static inline lanes8 lanes8_select(lanes8_mask mask, lanes8 where_true, lanes8 where_false)
{
    return (lanes8)(((lanes8_mask)where_true & mask) | ((lanes8_mask)where_false & ~mask));
}

static inline lanes8 lanes8_max(lanes8 a, lanes8 b)
{
#ifdef __AVX__
    return (lanes8)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return lanes8_select(a > b, a, b);
#endif
}

static inline lanes8 lanes8_min(lanes8 a, lanes8 b)
{
#ifdef __AVX__
    return (lanes8)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return lanes8_select(a < b, a, b);
#endif
}

static inline lanes8 lanes8_sqrt(lanes8 a)
{
#ifdef __AVX__
    return (lanes8)_mm256_sqrt_ps((__m256)a);
#else
    for (int i = 0; i < 8; i++)
        a[i] = sqrtf(a[i]);
    return a;
#endif
}

static inline lanes8 lanes8_size(lanes8 a)
{
    return (lanes8)((lanes8_mask)a & INT32_MAX);
}

/* A bit for each that is true. */
static inline unsigned lanes8_bits(lanes8_mask mask)
{
#ifdef __AVX__
    return (unsigned)_mm256_movemask_ps((__m256)mask);
#elif defined __SSE__
    const __m128 *half = (const __m128 *)&mask;
    return (unsigned)(_mm_movemask_ps(half[0]) | _mm_movemask_ps(half[1]) << 4);
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (unsigned)(mask[i] & 1) << i;
    return bits;
#endif
}

static inline struct lanes8_vec lanes8_sub(struct lanes8_vec a, struct lanes8_vec b)
{
    return (struct lanes8_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct lanes8_vec lanes8_scale(lanes8 s, struct lanes8_vec a)
{
    return (struct lanes8_vec){s * a.x, s * a.y, s * a.z};
}

/* a + s b */
static inline struct lanes8_vec lanes8_add(struct lanes8_vec a, lanes8 s, struct lanes8_vec b)
{
    return (struct lanes8_vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline lanes8 lanes8_dot(struct lanes8_vec a, struct lanes8_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct lanes8_vec lanes8_cross(struct lanes8_vec a, struct lanes8_vec b)
{
    return (struct lanes8_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The turned table: number i of every row becomes row i. */
static inline void lanes8_turn(const lanes8 in[8], lanes8 out[8])
{
    lanes8 half[2][4];
    for (int i = 0; i < 2; i++) {
        const lanes8 *r = in + 4 * i;
        const lanes8 low01 = __builtin_shufflevector(r[0], r[1], 0, 8, 1, 9, 4, 12, 5, 13),
                     low23 = __builtin_shufflevector(r[2], r[3], 0, 8, 1, 9, 4, 12, 5, 13),
                     high01 = __builtin_shufflevector(r[0], r[1], 2, 10, 3, 11, 6, 14, 7, 15),
                     high23 = __builtin_shufflevector(r[2], r[3], 2, 10, 3, 11, 6, 14, 7, 15);
        half[i][0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
        half[i][1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
        half[i][2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
        half[i][3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
    }
    for (int k = 0; k < 4; k++) {
        out[k] = __builtin_shufflevector(half[0][k], half[1][k], 0, 1, 2, 3, 8, 9, 10, 11);
        out[k + 4] = __builtin_shufflevector(half[0][k], half[1][k], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

/* from[index], of eight indices below 2^31. */
static inline lanes8 lanes8_pick(const float *from, lanes8_mask index)
{
#ifdef __AVX2__
    return (lanes8)_mm256_i32gather_ps(from, (__m256i)index, sizeof *from);
#else
    lanes8 picked;
    for (int i = 0; i < 8; i++)
        picked[i] = from[index[i]];
    return picked;
#endif
}

#endif
