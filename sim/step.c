/*
 * One time step, as the paper's section 3.5 lists it: 1 points, 2 edges, 3 triangles, 4 pressure. Part 5, drawing, is
 * the renderer's.
 */
#include "common/vec3.h"
#include "sim/sim.h"

#include <string.h>

/* Part 1: "initialize acceleration and normal vectors to (0,0,0)". */
static void clear_points(struct sim *sim)
{
    memset(sim->force, 0, sim->point_count * sizeof *sim->force);
    memset(sim->normal, 0, sim->point_count * sizeof *sim->normal);
}

/* Part 2: springs and dampers. With l = a - b and its length |l|,
 *     f_a = -[k_s (|l| - r) + k_d (v . l)/|l|] l/|l|,   f_b = -f_a      Witkin, SIGGRAPH '95 course notes 34
 * The paper prints |v| under the damper's l: a misprint, since that would be 0/0 in a balloon at rest. An edge of no
 * length has no direction and pulls at nothing. */
static void edge_forces(struct sim *sim)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const double damping = b->damping;
        for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
            if (!sim->edge_active[e])
                continue;
            const uint32_t p = sim->edge_point[e][0], q = sim->edge_point[e][1];
            double l[3], v[3];
            vec3_sub(sim->position[p], sim->position[q], l);
            vec3_sub(sim->velocity[p], sim->velocity[q], v);
            const double length = vec3_length(l);
            const double inverse = length > 0 ? 1 / length : 0;
            const double pull = sim->current_spring_const[e] * (length - sim->rest_length[e]) +
                                damping * vec3_dot(v, l) * inverse;
            const double scale = pull * inverse;
            for (int i = 0; i < 3; i++) {
                sim->force[p][i] -= scale * l[i];
                sim->force[q][i] += scale * l[i];
            }
        }
    }
}

/* Part 3: each active triangle adds its unit normal to its three points'. A triangle without area has none to add. */
static void triangle_normals(struct sim *sim)
{
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        const uint32_t *p = sim->triangle_point[t];
        double n[3];
        vec3_triangle(sim->position[p[0]], sim->position[p[1]], sim->position[p[2]], n);
        const double length = vec3_length(n);
        const double inverse = length > 0 ? 1 / length : 0;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                sim->normal[p[k]][i] += n[i] * inverse;
    }
}

/* Part 4: normalize the normals; pressure is a force along them. A point that lost its last triangle has no normal, and
 * nothing for the air to press on. */
static void pressure_forces(struct sim *sim)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++) {
            const double length = vec3_length(sim->normal[p]);
            const double inverse = length > 0 ? 1 / length : 0;
            for (int i = 0; i < 3; i++) {
                sim->normal[p][i] *= inverse;
                sim->force[p][i] += b->pressure * sim->normal[p][i];
            }
        }
}

void sim_forces(struct sim *sim)
{
    clear_points(sim);
    edge_forces(sim);      /* 2  springs and dampers                     */
    triangle_normals(sim); /* 3  face normals, added to the points       */
    pressure_forces(sim);  /* 4  pressure along each point's normal      */
}

/* Part 2: "check if the length of the edge is greater than the threshold value". */
static void break_edges(struct sim *sim)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
            if (!sim->edge_active[e])
                continue;
            const uint32_t *p = sim->edge_point[e];
            sim->length[e] = vec3_distance(sim->position[p[0]], sim->position[p[1]]);
            if (sim->length[e] > b->threshold_length)
                sim_break_edge(sim, e);
        }
}

/* Part 3: "if more than one edge is inactive, set triangle inactive". */
static void tear_triangles(struct sim *sim)
{
    if (!sim->edges_broke)
        return;
    sim->edges_broke = false;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const uint32_t *e = sim->triangle_edge[t];
        const int left = sim->edge_active[e[0]] + sim->edge_active[e[1]] + sim->edge_active[e[2]];
        if (left < 2)
            sim->triangle_active[t] = 0;
    }
}

/* What the user changes by hand between two steps: "the time interval or the internal air pressure" (3.5). */
static void change_by_schedule(struct sim *sim)
{
    const struct scene *scene = sim->scene;
    while (sim->next_change < scene->schedule_count && scene->schedule[sim->next_change].at <= sim->time)
        sim_change(sim, &scene->schedule[sim->next_change++]);
}

/* The first point whose place or speed is no number any more ends the run. 0 times that is NaN, and 0 for any
 * other, so that one sum asks them all. */
static enum status check_finite(const struct sim *sim, struct error *err)
{
    double sum[3] = {0};
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            sum[i] += 0 * sim->position[p][i] + 0 * sim->velocity[p][i];
    return sum[0] + sum[1] + sum[2] == 0 ? STATUS_OK : sim_diverged(sim, err);
}

enum status sim_step(struct sim *sim, struct error *err)
{
    change_by_schedule(sim);
    sim->integrator->advance(
        sim);            /* 1  positions, velocities; asks sim_forces() as often as its order needs */
    break_edges(sim);    /* 2  edges past the threshold let go   } once, at the end of a step, so that */
    tear_triangles(sim); /* 3  triangles that lost two edges     } no trial state breaks anything      */
    sim->steps++;
    sim->steps_since++;
    sim->time = sim->time_base + (double)sim->steps_since * sim->step;
    effects_run(sim, EFFECT_AFTER_STEP);
    return check_finite(sim, err);
}
