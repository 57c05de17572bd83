#include "sim/weights.h"

#include "sim/bodies.h"
#include "sim/gas.h"
#include "sim/membrane.h"
#include "sim/vectors.h"

#include <float.h>
#include <math.h>

static double breathing_rate(const struct sim *sim, const struct sim_balloon *b)
{
    double stiffness = 0, inertia = 0;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        stiffness += sim->current_spring_const[e] * sim->rest_length[e] * sim->rest_length[e];
    if (b->membrane) /* stretched alike both ways it stores mu V 12 e^2/2, whatever the law */
        stiffness = 12 * membrane_scale(b);
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        for (int i = 0; i < 3; i++) {
            const double arm = sim->position[p][i] - b->centre[i];
            inertia += sim->mass[p] * arm * arm;
        }
    const double rate = stiffness > 0 && inertia > 0 ? sqrt(stiffness / inertia) : 0;
    return fmax(rate, 1 / fmax(sim->scene->time.end, sim->step));
}

/* Positions that are n radii from the origin carry a rounding error of n DBL_EPSILON/2, and a step
 * adds up some ten terms. */
static double reachable(const struct sim *sim, const struct sim_balloon *b)
{
    double far = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        for (int i = 0; i < 3; i++)
            far = fmax(far, fabs(sim->position[p][i]));
    return 8 * DBL_EPSILON * far / b->radius;
}

enum status weights_open(struct sim *sim, struct error *err)
{
    const double tolerance = sim->scene->time.tolerance;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        struct sim_balloon *b = &sim->balloons[i];
        b->breathing_rate = breathing_rate(sim, b);
        if (tolerance < reachable(sim, b))
            return error_set(
                err, STATUS_RANGE,
                "time.tolerance = %g: balloons[%zu] is so far from the origin that positions of 16 "
                "digits give %.1g radii at best; ask for %.1g, or move it nearer",
                tolerance, i, reachable(sim, b), 10 * reachable(sim, b));
    }
    return STATUS_OK;
}

double weights_of_body(const struct sim *sim, uint32_t scalar)
{
    const struct sim_body *body = sim_body_of(sim, scalar);
    if (!body)
        return 0;
    const double place = body->balloon->radius;
    return scalar < body->first + SIM_BODY_SPEED ? place : place * body->balloon->breathing_rate;
}

double weights_of_growing(const struct sim *sim, uint32_t scalar)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->gas && scalar == b->gas->scalar + GAS_BROUGHT)
            return b->gas->filling;
        else if (scalar - b->arms < b->arm_count)
            return b->mean_rest_length;
    return 0;
}

struct difference {
    double (*x)[4], (*v)[4];
};

static double squares(double (*rows)[4], uint32_t begin, uint32_t end)
{
    double sum[4] = {0};
    for (uint32_t p = begin; p < end; p++)
        for (int i = 0; i < 4; i++)
            sum[i] += rows[p][i] * rows[p][i];
    return sum[0] + sum[1] + sum[2];
}

/* A block's points may belong to several balloons. */
static double block_squares(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct difference *d = context;
    double sum = 0;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct sim_balloon *b = &sim->balloons[i];
        const uint32_t from = begin > b->point_begin ? begin : b->point_begin,
                       to = end < b->point_end ? end : b->point_end;
        if (from >= to)
            continue;
        const double speed = b->radius * b->breathing_rate;
        sum += squares(d->x, from, to) / (b->radius * b->radius) + squares(d->v, from, to) / (speed * speed);
    }
    return sum;
}

double weights_norm(struct sim *sim, double (*dx)[4], double (*dv)[4], double tolerance)
{
    const double sum = vector_sum(sim, block_squares, &(struct difference){dx, dv});
    return sqrt(sum / sim->point_count) / tolerance;
}

double weights_distance(const struct sim *sim, double (*from)[4], double (*to)[4])
{
    double sum = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        double own = 0;
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            for (int i = 0; i < 3; i++)
                own += (to[p][i] - from[p][i]) * (to[p][i] - from[p][i]);
        sum += b->radius > 0 ? own / (b->radius * b->radius) : own;
    }
    return sqrt(sum / sim->point_count);
}
