/* All points fall alike. What gas weighs, and the air that it stands in for, is the gas's own
 * business (effect_gas.c). */
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/guard.h"

static bool wanted(const struct scene *scene)
{
    return scene->gravity.on;
}

static void fall(struct sim *sim, const struct sim_balloon *balloon, const struct sim_part *part)
{
    (void)balloon;
    const double *a = sim->scene->gravity.acceleration;
    const double x = a[0], y = a[1], z = a[2];
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        sim->force[p][0] += sim->mass[p] * x;
        sim->force[p][1] += sim->mass[p] * y;
        sim->force[p][2] += sim->mass[p] * z;
    }
}

static void bound(const struct sim *sim, const struct sim_balloon *balloon, const struct guard_rows *rows)
{
    (void)balloon;
    for (uint32_t p = 0; p < sim->point_count; p++)
        rows->push[p] += sim->mass[p] * vec3_length(sim->scene->gravity.acceleration);
}

static double energy(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    double sum = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            sum -= sim->mass[p] * vec3_dot(sim->scene->gravity.acceleration, sim->position[p]);
    return sum;
}

const struct effect effect_gravity = {.name = "gravity",
                                      .phase = EFFECT_FORCES,
                                      .scene_wanted = wanted,
                                      .finish = fall,
                                      .bound = bound,
                                      .energy = energy,
                                      .source = "Newton 1687"};
