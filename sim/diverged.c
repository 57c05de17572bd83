/* What a run that came to grief says: where, when, and what is likely to blame. */
#include "sim/sim.h"

#include <math.h>
#include <stdlib.h>

static uint32_t largest_degree(const struct sim *sim, const struct sim_balloon *balloon)
{
    const uint32_t points = balloon->point_end - balloon->point_begin;
    uint32_t *degree = calloc(points, sizeof *degree), largest = 0;
    if (!degree)
        return 0;
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++)
        for (int k = 0; k < 2; k++) {
            uint32_t d = ++degree[sim->edge_point[e][k] - balloon->point_begin];
            largest = d > largest ? d : largest;
        }
    free(degree);
    return largest;
}

double sim_stable_step(const struct sim *sim, const struct sim_balloon *balloon)
{
    double k = 0;
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++)
        k = fmax(k, sim->current_spring_const[e]);
    const double mu = 2.0 * largest_degree(sim, balloon), d = balloon->now->damping,
                 m = balloon->scene->point_mass;
    if (!(mu > 0) || (k == 0 && d == 0))
        return 0;
    return 4 * m / mu /
           (d + sqrt(d * d + 4 * k * m / mu)); /* the positive root, in the form that does not cancel */
}

static bool is_nowhere(const struct sim *sim, uint32_t p)
{
    for (int i = 0; i < 3; i++)
        if (!isfinite(sim->position[p][i]) || !isfinite(sim->velocity[p][i]))
            return true;
    return false;
}

enum status sim_diverged(const struct sim *sim, struct error *err)
{
    uint32_t p = 0;
    while (p + 1 < sim->point_count && !is_nowhere(sim, p))
        p++;
    size_t b = 0;
    while (b + 1 < sim->balloon_count && p >= sim->balloons[b].point_end)
        b++;
    const double stable = sim_stable_step(sim, &sim->balloons[b]);
    char advice[160] = "";
    if (stable > 0 && sim->step > stable)
        snprintf(advice, sizeof advice,
                 "; time.step is %g, and steps up to %.3g are surely stable with these springs and dampers",
                 sim->step, stable);
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): point %u of balloons[%zu] is at (%g, %g, %g), moving at "
        "(%g, %g, %g)%s",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, p - sim->balloons[b].point_begin, b,
        sim->position[p][0], sim->position[p][1], sim->position[p][2], sim->velocity[p][0],
        sim->velocity[p][1], sim->velocity[p][2], advice);
}
