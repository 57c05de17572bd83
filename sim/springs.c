#include "sim/springs.h"
#include "common/vec3.h"
#include "sim/measure.h"

#include <math.h>

/* The cotangent of a triangle's angle at corner k; 0 where it has no area. */
static double cotangent(const struct sim *sim, const uint32_t *p, int k)
{
    double u[3], v[3], cross[3];
    vec3_sub(sim->position[p[(k + 1) % 3]], sim->position[p[k]], u);
    vec3_sub(sim->position[p[(k + 2) % 3]], sim->position[p[k]], v);
    vec3_cross(u, v, cross);
    const double twice_area = vec3_length(cross);
    return twice_area > 0 ? vec3_dot(u, v) / twice_area : 0;
}

void springs_by_cotangent(struct sim *sim, const struct sim_balloon *b)
{
    const double scale = b->scene->spring * sqrt(3) / 2; /* 1 where all angles are 60 degrees */
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        sim->init_spring_const[e] = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++) /* side k runs from corner k to the next */
            sim->init_spring_const[sim->triangle_edge[t][k]] += scale * cotangent(sim, sim->triangle_point[t],
                                                                                  (k + 2) % 3);
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
        sim->init_spring_const[e] = fmax(sim->init_spring_const[e], 0);
        sim->current_spring_const[e] = sim->init_spring_const[e] * b->scene->spring_factor;
    }
}

void springs_mass_by_area(struct sim *sim, const struct sim_balloon *b)
{
    double skin = 0, mass = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const double area = sim_area(sim, t);
        skin += area;
        for (int k = 0; k < 3 && area > 0; k++)
            sim->mass[sim->triangle_point[t][k]] = 0;
    }
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        mass += sim->mass[p] > 0 ? 0 : b->scene->point_mass;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            sim->mass[sim->triangle_point[t][k]] += skin > 0 ? mass * (sim_area(sim, t) / skin) / 3 : 0;
}
