/* "Spring constants may not be the same for all springs. They can be set as a function of the height of the
 * balloon", which makes it expand in the middle more than at the top or bottom (paper 3.1). */
#include "common/scene_checks.h"
#include "sim/effects.h"

#include <math.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->spring_by_height.on;
}

/* The factor at the height of each edge's middle: 0 for the lowest point of the balloon at
 * rest, 1 for the highest. */
static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++) {
        low = fmin(low, sim->position[p][1]);
        high = fmax(high, sim->position[p][1]);
    }
    if (!(high - low > 1e-9 * balloon->radius)) /* but for rounding */
        return scene_contradiction(
            sim->scene, (size_t)(balloon - sim->balloons), "spring_by_height",
            balloon->scene->spring_by_height.line, err,
            "all points are at one height, over which nothing varies; take a mesh that "
            "does not lie flat, or leave it out");
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++) {
        const uint32_t *p = sim->edge_point[e];
        double middle = (sim->position[p[0]][1] + sim->position[p[1]][1]) / 2;
        double factor = scene_profile_at(&balloon->scene->spring_by_height.profile,
                                         (middle - low) / (high - low));
        sim->init_spring_const[e] *= factor;
        sim->current_spring_const[e] = sim->init_spring_const[e] * balloon->now->spring_factor;
    }
    return STATUS_OK;
}

const struct effect effect_spring_by_height = {
    .name = "spring_by_height", .phase = EFFECT_OPEN, .wanted = wanted, .open = open, .source = "paper 3.1"};
