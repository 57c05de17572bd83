/* What the loops of a step (forces.c) work out of rows, one by one and four at once. */
#ifndef SIM_FORCES_MATH_H
#define SIM_FORCES_MATH_H

#include "sim/lanes.h"

#include <math.h>

static inline double dot(row a, row b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Four wide where rows fit registers; GCC 12 takes a row that does not apart at each shuffle. */
static inline row cross(row a, row b)
{
#ifdef SIM_WIDE
    const row a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3),
              b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const row zxy = a * b_yzx - a_yzx * b;
    return __builtin_shufflevector(zxy, zxy, 1, 2, 0, 3);
#else
    return (row){a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
#endif
}

static inline double length_of(row a)
{
    return sqrt(dot(a, a));
}

/* What has no length has no direction either. */
static inline double inverse(double length)
{
    return length > 0 ? 1 / length : 0;
}

/* The lengths of four rows, and the inverses of four lengths: each as of one alone, to the bit. */
static inline lanes lengths_of(const row a[4])
{
    const struct lanes3 turned = lanes_of_rows(a);
    return lanes_sqrt(lanes_dot(turned, turned));
}

static inline lanes inverses(lanes length)
{
    return lanes_select(length > 0, 1 / length, lanes_all(0));
}

#endif
