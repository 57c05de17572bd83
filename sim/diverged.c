/* What a run that came to grief says: where, when, and what is likely to blame. */
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/reorder.h"

#include <math.h>

static bool is_nowhere(const struct sim *sim, uint32_t p)
{
    for (int i = 0; i < 3; i++)
        if (!isfinite(sim->position[p][i]) || !isfinite(sim->velocity[p][i]))
            return true;
    return false;
}

/* The first point that is nowhere, or else the one with the most energy, and its balloon. What is kept for
 * points to come has none. */
static uint32_t worst_point(const struct sim *sim, const struct sim_balloon **balloon)
{
    uint32_t worst = 0;
    double most = -1;
    *balloon = sim->balloons;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        for (uint32_t p = b->point_begin; p < b->point_end; p++) {
            const double energy = is_nowhere(sim, p)
                                      ? INFINITY
                                      : sim->mass[p] * vec3_dot(sim->velocity[p], sim->velocity[p]);
            if (energy > most) {
                most = energy;
                worst = p;
                *balloon = b;
            }
        }
    }
    return worst;
}

/* " on an edge to point 7 of length 3e9": of the point's active edges the longest, or one that
 * has no length any more. */
static void describe_edge(const struct sim *sim, const struct sim_balloon *b, uint32_t p, char *text,
                          size_t size)
{
    uint32_t other = p;
    double longest = -1;
    for (uint32_t e = b->edge_begin; e < b->edge_end && !isnan(longest); e++) {
        const uint32_t *ends = sim->edge_point[e];
        const double length = sim_edge_length(sim, e);
        if (sim->edge_active[e] && (ends[0] == p || ends[1] == p) && !(length <= longest)) {
            longest = length;
            other = ends[0] == p ? ends[1] : ends[0];
        }
    }
    if (other == p)
        snprintf(text, size, ", with no edge left");
    else
        snprintf(text, size, ", on an edge of length %g to point %u", longest, reorder_name(b, other));
}

enum status sim_diverged(struct sim *sim, double energy, struct error *err)
{
    const struct sim_balloon *b = NULL;
    const uint32_t p = worst_point(sim, &b);
    char edge[96], advice[256] = "the step is surely stable: is a scene so violent meant?";
    describe_edge(sim, b, p, edge, sizeof edge);
    const bool is_too_large = sim->whole_step > guard_stable_step(sim);
    if (is_too_large)
        guard_describe(sim, advice, sizeof advice);
    else if (sim->scene->drag.on)
        snprintf(
            advice, sizeof advice,
            "steps of %g are surely stable at the speeds of the start only, and drag grows with speed: try a "
            "smaller time.step",
            sim->step);
    else if (sim->scene->time.guard == SCENE_GUARD_OFF)
        snprintf(advice, sizeof advice,
                 "what is left is stable in such steps, and time.guard = \"off\" asks for no more: try "
                 "time.guard=substep");
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): point %u of balloons[%zu] is at (%g, %g, %g), moving at "
        "(%g, %g, %g)%s; kinetic energy %g; %s%s",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, reorder_name(b, p),
        (size_t)(b - sim->balloons), sim->position[p][0], sim->position[p][1], sim->position[p][2],
        sim->velocity[p][0], sim->velocity[p][1], sim->velocity[p][2], edge, energy, advice,
        is_too_large && sim->scene->time.guard == SCENE_GUARD_OFF ? "; time.guard=substep splits it" : "");
}
