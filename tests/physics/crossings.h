/* Whether skins cross, by looking at every edge and every triangle: no tree, no boxes, no list. */
#ifndef TESTS_PHYSICS_CROSSINGS_H
#define TESTS_PHYSICS_CROSSINGS_H

#include "common/vec3.h"
#include "sim/sim.h"

#include <stdlib.h>

/* Six times the signed volume of a, b, c, d. */
static inline double crossings_volume(const double *a, const double *b, const double *c, const double *d)
{
    double ab[3], ac[3], ad[3], n[3];
    vec3_sub(b, a, ab);
    vec3_sub(c, a, ac);
    vec3_sub(d, a, ad);
    vec3_cross(ab, ac, n);
    return vec3_dot(n, ad);
}

static inline bool crossings_of(const struct sim *sim, const uint32_t *edge, const uint32_t *t)
{
    double(*x)[4] = sim->position;
    for (int i = 0; i < 2; i++)
        if (edge[i] == t[0] || edge[i] == t[1] || edge[i] == t[2])
            return false;
    for (int k = 0; k < 3; k++) { /* far apart, as nearly all are */
        const double a = x[edge[0]][k], b = x[edge[1]][k];
        if (fmax(a, b) < fmin(fmin(x[t[0]][k], x[t[1]][k]), x[t[2]][k]) ||
            fmin(a, b) > fmax(fmax(x[t[0]][k], x[t[1]][k]), x[t[2]][k]))
            return false;
    }
    const double *a = x[edge[0]], *b = x[edge[1]];
    const bool sides[2] = {crossings_volume(x[t[0]], x[t[1]], x[t[2]], a) > 0,
                           crossings_volume(x[t[0]], x[t[1]], x[t[2]], b) > 0};
    const bool turns[3] = {crossings_volume(a, b, x[t[0]], x[t[1]]) > 0,
                           crossings_volume(a, b, x[t[1]], x[t[2]]) > 0,
                           crossings_volume(a, b, x[t[2]], x[t[0]]) > 0};
    return sides[0] != sides[1] && turns[0] == turns[1] && turns[1] == turns[2];
}

/* Of each triangle, from where to where it is. */
static inline double (*crossings_extents(const struct sim *sim))[2][3]
{
    double(*extent)[2][3] = calloc(sim->triangle_count, sizeof *extent);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            const uint32_t *p = sim->triangle_point[t];
            const double a = sim->position[p[0]][i], b = sim->position[p[1]][i], c = sim->position[p[2]][i];
            extent[t][0][i] = fmin(fmin(a, b), c);
            extent[t][1][i] = fmax(fmax(a, b), c);
        }
    return extent;
}

static inline bool crossings_apart(double a[2][3], double b[2][3])
{
    bool apart = false;
    for (int i = 0; i < 3; i++)
        apart |= a[1][i] < b[0][i] || b[1][i] < a[0][i];
    return apart;
}

/* Edges through triangles, of skin that is still there. */
static inline size_t crossings_count(const struct sim *sim)
{
    size_t count = 0;
    double(*extent)[2][3] = crossings_extents(sim);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (uint32_t u = 0; u < sim->triangle_count; u++)
            for (int k = 0; k < 3 && sim->triangle_active[t] && sim->triangle_active[u] &&
                            !crossings_apart(extent[t], extent[u]);
                 k++)
                count += crossings_of(sim, sim->edge_point[sim->triangle_edge[u][k]], sim->triangle_point[t]);
    free(extent);
    return count;
}

#endif
