/* Vectors are double[3]. Small enough to be inline, and nothing more than is used. */
#ifndef COMMON_VEC3_H
#define COMMON_VEC3_H

#include <math.h>

static inline void vec3_sub(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static inline double vec3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vec3_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double vec3_length(const double a[3])
{
    return sqrt(vec3_dot(a, a));
}

/* To length 1; no direction stays none. */
static inline void vec3_unit(double a[3])
{
    const double length = vec3_length(a);
    for (int i = 0; i < 3; i++)
        a[i] = length > 0 ? a[i] / length : 0;
}

static inline double vec3_square_distance(const double a[3], const double b[3])
{
    double d[3];
    vec3_sub(a, b, d);
    return vec3_dot(d, d);
}

static inline double vec3_distance(const double a[3], const double b[3])
{
    return sqrt(vec3_square_distance(a, b));
}

/* The cross product of two sides: twice the triangle's area along its normal. */
static inline void vec3_triangle(const double a[3], const double b[3], const double c[3], double out[3])
{
    double ab[3], ac[3];
    vec3_sub(b, a, ab);
    vec3_sub(c, a, ac);
    vec3_cross(ab, ac, out);
}

#endif
