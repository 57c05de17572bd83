/*
 * Exponentials and logarithms of four numbers at once, for laws with powers of stretches (lanes.h). Series whose coefficients are those of the
 * functions' definitions, cut where what is left out is below the last bit; relative errors stay below 4e-16. The C
 * library's take one number at a time, and differ from system to system.
 */
#ifndef SIM_LANES_MATH_H
#define SIM_LANES_MATH_H

#include "sim/lanes.h"

#define LANES_LN2_HIGH \
    0x1.62e42feep-1 /* ln 2 in two parts: the first has 31 bits, so that its multiples are exact */
#define LANES_LN2_LOW 0x1.a39ef35793c76p-33
#define LANES_BIASED \
    0x1.8p52 /* added to a small number, its lowest bits are that number rounded to a whole one */

/* e^x for |x| <= 700; beyond, that of +-700. With x = n ln 2 + r, |r| <= ln 2/2: 2^n (1 + r + r^2/2! + ... + r^13/13!). */
static inline lanes lanes_exp(lanes x)
{
    static const double part[] = {1,
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
    const lanes square = r * r; /* even and odd powers apart: half as long to wait for */
    lanes even = lanes_all(part[12]), odd = lanes_all(part[13]);
    for (int k = 10; k >= 0; k -= 2) {
        even = even * square + part[k];
        odd = odd * square + part[k + 1];
    }
    const lanes sum = even + r * odd;
    const lane_mask scale = ((lane_mask)biased + 1023) << 52; /* the bits of 2^n */
    return sum * (lanes)scale;
}

/* ln x of a positive, normal x. With x = 2^n m, m from sqrt(1/2) to sqrt 2, and s = (m - 1)/(m + 1):
 *     n ln 2 + 2 (s + s^3/3 + ... + s^21/21),   |s| <= .172 */
static inline lanes lanes_log(lanes x)
{
    const lane_mask bits = (lane_mask)x;
    const lane_mask above = (lane_mask)((lanes)((bits & 0xfffffffffffff) | 0x3ff0000000000000) > M_SQRT2);
    const lane_mask exponent = (bits >> 52) - 1023 - above;
    const lanes m = (lanes)(bits - (exponent << 52));
    const lanes n = {(double)exponent[0], (double)exponent[1], (double)exponent[2], (double)exponent[3]};
    const lanes s = (m - 1) / (m + 1), square = s * s;
    lanes sum = lanes_all(0);
    for (int k = 21; k >= 3; k -= 2)
        sum = (1.0 / k + sum) * square;
    return n * LANES_LN2_HIGH + (2 * s + (2 * s * sum + n * LANES_LN2_LOW));
}

#endif
