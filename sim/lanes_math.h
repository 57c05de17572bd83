/*
 * Exponentials and logarithms of four numbers at once, for laws with powers of stretches (lanes.h).
 * Series whose coefficients are those of the functions' definitions, cut where what is left out is below
 * the last bit; relative errors stay below 4e-16. The C library's take one number at a time, and differ
 * from system to system.
 */
#ifndef SIM_LANES_MATH_H
#define SIM_LANES_MATH_H

#include "sim/lanes.h"

#define LANES_LN2_HIGH \
    0x1.62e42feep-1 /* ln 2 in two parts: the first has 31 bits, so that its multiples are exact */
#define LANES_LN2_LOW 0x1.a39ef35793c76p-33
#define LANES_BIASED \
    0x1.8p52 /* added to a small number, its lowest bits are that number rounded to a whole one */

/* c0 + c1 x + c2 x^2 + c3 x^3, by pairs: half as long to wait for as one after the other. */
static inline lanes lanes_cubic(const double c[4], lanes x, lanes square)
{
    return (c[0] + c[1] * x) + (c[2] + c[3] * x) * square;
}

/* e^x for |x| <= 700; beyond, that of +-700. With x = n ln 2 + r, |r| <= ln 2/2: 2^n (1 + r +
 * r^2/2! + ... + r^13/13!). */
static inline lanes lanes_exp(lanes x)
{
    static const double part[14] = {1,
                                    1,
                                    1.0 / 2,
                                    1.0 / 6,
                                    1.0 / 24,
                                    1.0 / 120,
                                    1.0 / 720,
                                    1.0 / 5040,
                                    1.0 / 40320,
                                    1.0 / 362880,
                                    1.0 / 3628800,
                                    1.0 / 39916800,
                                    1.0 / 479001600,
                                    1.0 / 6227020800}; /* 1/k! */
    x = lanes_min(lanes_max(x, lanes_all(-700)), lanes_all(700));
    const lanes biased = x * M_LOG2E + LANES_BIASED, n = biased - LANES_BIASED;
    const lanes r = x - n * LANES_LN2_HIGH - n * LANES_LN2_LOW;
    const lanes r2 = r * r, r4 = r2 * r2;
    const lanes last = lanes_cubic(&part[8], r, r2) + (part[12] + part[13] * r) * r4;
    const lanes sum = lanes_cubic(part, r, r2) + (lanes_cubic(&part[4], r, r2) + last * r4) * r4;
    const lane_mask scale = ((lane_mask)biased + 1023) << 52; /* the bits of 2^n */
    return sum * (lanes)scale;
}

/* ln x of a positive, normal x. With x = 2^n m, m from sqrt(1/2) to sqrt 2, and s = (m - 1)/(m + 1):
 *     n ln 2 + 2 (s + s^3/3 + ... + s^21/21),   |s| <= .172 */
static inline lanes lanes_log(lanes x)
{
    static const double part[10] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                    1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
    const lane_bits one = (lane_bits)lanes_all(1), least = (lane_bits)lanes_all(M_SQRT1_2),
                    bits = (lane_bits)x;
    const lane_bits biased = (bits + (one - least)) >> 52; /* n + 1023 */
    const lanes m = (lanes)(bits - ((biased << 52) - one));
    const lanes n = (lanes)(biased + (lane_bits)lanes_all(LANES_BIASED)) - (LANES_BIASED + 1023);
    const lanes s = (m - 1) / (m + 1), s2 = s * s, s4 = s2 * s2, s8 = s4 * s4;
    const lanes last = lanes_cubic(&part[4], s2, s4) + (part[8] + part[9] * s2) * s8;
    const lanes sum = (lanes_cubic(part, s2, s4) + last * s8) * s2;
    return n * LANES_LN2_HIGH + (2 * s + (2 * s * sum + n * LANES_LN2_LOW));
}

#endif
