#include "sim/limit_point.h"
#include "sim/areas.h"
#include "sim/membrane_kernels.h"

#include <math.h>
#include <string.h>

/* Stretches that are looked through, in these ratios. */
static const double farthest = 20, ratio = 1.001;

/* The pressure that the skin holds at a stretch: of a membrane dW/dL = skin x 2 dw/dL1 with dw/dL1 = 2 L (w_a
 * + L^2 w_D), of springs it is sum k r^2 (L - 1). */
static double held_at(const struct sim_balloon *b, const struct limit_point *limit, double stretch)
{
    const double square = stretch * stretch, scale = limit->skin / (3 * limit->rest_volume * square);
    if (!b->membrane)
        return scale * b->now->spring_factor * (stretch - 1);
    const struct membrane *m = b->membrane;
    const struct membrane_response w = m->kernels->respond(&m->law, 2 * square, square * square, 0);
    return scale * 4 * stretch * (w.a + square * w.d);
}

/* The first stretch from which on it holds less. */
static void find_limit(const struct sim *sim, const struct sim_balloon *b, struct limit_point *limit)
{
    limit->skin = b->membrane ? membrane_scale(b) : 0;
    for (uint32_t e = b->edge_begin; e < b->edge_end && !b->membrane; e++)
        limit->skin += sim->init_spring_const[e] * sim->rest_length[e] * sim->rest_length[e];
    limit->stretch = INFINITY;
    limit->pressure = 0;
    for (double stretch = ratio; stretch < farthest && isinf(limit->stretch); stretch *= ratio) {
        const double held = held_at(b, limit, stretch);
        if (held < limit->pressure)
            limit->stretch = stretch;
        limit->pressure = fmax(limit->pressure, held);
    }
}

void limit_point_open(struct sim *sim, const struct sim_balloon *b, struct limit_point *limit)
{
    *limit = (struct limit_point){
        .rest_volume = areas_change(sim, b, sim->position[b->point_begin], NULL, NULL, sim->velocity).volume};
}

static void tell(struct sim *sim, const struct sim_balloon *b, struct limit_point *limit, double stretch)
{
    const double pressure = b->now->pressure;
    double end = stretch;
    while (end < farthest && held_at(b, limit, end) < pressure)
        end *= ratio;
    char how[64] = "nothing but its bursting stops it";
    if (end < farthest)
        snprintf(how, sizeof how, "it jumps to %.3g times its size, or bursts", end);
    snprintf(limit->text, sizeof limit->text,
             "past the limit point: its skin holds %.4g at the most, at %.4g times its size; under %.4g %s",
             limit->pressure, limit->stretch, pressure, how);
    sim_tell(sim, b, "pressure", limit->text);
}

void limit_point_watch(struct sim *sim, const struct sim_balloon *b, struct limit_point *limit)
{
    enum { SELDOM = 16 }; /* steps: so that it costs next to nothing */
    if (sim->steps % SELDOM || sim->broken)
        return;
    if (limit->state == LIMIT_UNKNOWN)
        find_limit(sim, b, limit);
    const double stretch = cbrt(areas_volume(sim, b, NULL, sim->position[b->point_begin]) /
                                limit->rest_volume);
    const bool swollen = stretch > limit->stretch,
               past = swollen && held_at(b, limit, stretch) < b->now->pressure;
    if (past && limit->state == LIMIT_AHEAD)
        tell(sim, b, limit, stretch);
    if (past || !swollen || limit->state == LIMIT_UNKNOWN) /* not again while it swings about where it ends */
        limit->state = swollen ? LIMIT_PASSED : LIMIT_AHEAD;
}
