#include "sim/ccd.h"
#include "common/vec3.h"

static double clamp(double value)
{
    return value > 0 ? (value < 1 ? value : 1) : 0;
}

/* The nearest place of the triangle 1 2 3 to the point 0, by the region of Voronoi that the point is in
 * (Ericson, Real-Time Collision Detection, 5.1.5). A triangle without area falls through to its edges. */
static void weigh_triangle(double x[4][3], double weight[4])
{
    double ab[3], ac[3], ap[3], bp[3], cp[3];
    vec3_sub(x[2], x[1], ab);
    vec3_sub(x[3], x[1], ac);
    vec3_sub(x[0], x[1], ap);
    vec3_sub(x[0], x[2], bp);
    vec3_sub(x[0], x[3], cp);
    const double d1 = vec3_dot(ab, ap), d2 = vec3_dot(ac, ap), d3 = vec3_dot(ab, bp), d4 = vec3_dot(ac, bp),
                 d5 = vec3_dot(ab, cp), d6 = vec3_dot(ac, cp);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    double b = 0, c = 0; /* of corners 2 and 3 */
    if (d1 <= 0 && d2 <= 0) {
        b = c = 0;
    } else if (d3 >= 0 && d4 <= d3) {
        b = 1;
    } else if (d6 >= 0 && d5 <= d6) {
        c = 1;
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        b = d1 / (d1 - d3);
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        c = d2 / (d2 - d6);
    } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
        c = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        b = 1 - c;
    } else {
        const double sum = va + vb + vc;
        b = sum > 0 ? vb / sum : 0;
        c = sum > 0 ? vc / sum : 0;
    }
    weight[0] = 1;
    weight[1] = b + c - 1;
    weight[2] = -b;
    weight[3] = -c;
}

/* The nearest places of the edges 0 1 and 2 3 (the same, 5.1.9). */
static void weigh_edges(double x[4][3], double weight[4])
{
    double d1[3], d2[3], r[3];
    vec3_sub(x[1], x[0], d1);
    vec3_sub(x[3], x[2], d2);
    vec3_sub(x[0], x[2], r);
    const double a = vec3_dot(d1, d1), e = vec3_dot(d2, d2), f = vec3_dot(d2, r), c = vec3_dot(d1, r),
                 b = vec3_dot(d1, d2), denominator = a * e - b * b;
    double s = denominator > 0 ? clamp((b * f - c * e) / denominator) : 0;
    double t = e > 0 ? (b * s + f) / e : 0;
    if (t < 0 || t > 1) {
        t = clamp(t);
        s = a > 0 ? clamp((b * t - c) / a) : 0;
    }
    weight[0] = 1 - s;
    weight[1] = s;
    weight[2] = t - 1;
    weight[3] = -t;
}

double ccd_distance(enum ccd_kind kind, double x[4][3], struct ccd_touch *touch)
{
    if (kind == CCD_POINT_TRIANGLE)
        weigh_triangle(x, touch->weight);
    else
        weigh_edges(x, touch->weight);
    for (int k = 0; k < 3; k++) {
        touch->normal[k] = 0;
        for (int i = 0; i < 4; i++)
            touch->normal[k] += touch->weight[i] * x[i][k];
    }
    touch->distance = vec3_length(touch->normal);
    for (int k = 0; k < 3; k++)
        touch->normal[k] *= touch->distance > 0 ? 1 / touch->distance : 0;
    return touch->distance;
}

double ccd_approach(enum ccd_kind kind, double from[4][3], double to[4][3])
{
    const int first = kind == CCD_POINT_TRIANGLE ? 1 : 2; /* points of the first feature */
    double mean[3], largest[2] = {0};
    for (int k = 0; k < 3; k++)
        mean[k] = (to[0][k] - from[0][k] + to[1][k] - from[1][k] + to[2][k] - from[2][k] + to[3][k] -
                   from[3][k]) /
                  4;
    for (int i = 0; i < 4; i++) {
        double way[3];
        for (int k = 0; k < 3; k++)
            way[k] = to[i][k] - from[i][k] - mean[k];
        largest[i >= first] = fmax(largest[i >= first], vec3_dot(way, way));
    }
    return sqrt(largest[0]) + sqrt(largest[1]);
}

double ccd_apart(enum ccd_kind kind, const struct ccd_touch *touch, double x[4][3])
{
    const int first = kind == CCD_POINT_TRIANGLE ? 1 : 2;
    double least = INFINITY, most = -INFINITY; /* of the first feature, of the second */
    for (int i = 0; i < 4; i++) {
        const double along = vec3_dot(touch->normal, x[i]);
        if (i < first)
            least = fmin(least, along);
        else
            most = fmax(most, along);
    }
    return least - most;
}

/* They never move past a tenth of what was free between them: nearer than that counts as a touch, and so does
 * what takes too many steps. */
bool ccd_meet(enum ccd_kind kind, double from[4][3], double to[4][3], double gap, struct ccd_touch *touch)
{
    enum { STEPS_MAX = 100 };
    const double approach = ccd_approach(kind, from, to);
    const double near = 0.1 * (touch->distance - gap);
    touch->time = 0;
    for (int step = 0; step < STEPS_MAX; step++) {
        const double ahead = 0.9 * (touch->distance - gap);
        if (touch->time * approach + ahead >= approach)
            return false;
        touch->time += ahead / approach;
        double x[4][3];
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++)
                x[i][k] = from[i][k] + touch->time * (to[i][k] - from[i][k]);
        if (ccd_distance(kind, x, touch) - gap < near)
            return true;
    }
    return true;
}
