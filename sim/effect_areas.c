/* A pressure that is given, on areas (areas.h): what the paper's pressure is where points
 * are alike, on any mesh. */
#include "common/vec3.h"
#include "sim/areas.h"
#include "sim/effects.h"
#include "sim/limit_point.h"
#include "sim/vectors.h"

#include <stdlib.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->pressure_on == SCENE_ON_AREAS && !balloon->gas.on;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    b->limit = malloc(sizeof *b->limit);
    if (!b->limit)
        return error_no_memory(err, "the limit point");
    sim->bytes += sizeof *b->limit;
    limit_point_open(sim, b, b->limit);
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    free(b->limit);
    b->limit = NULL;
}

static void after(struct sim *sim, struct sim_balloon *b)
{
    limit_point_watch(sim, b, b->limit);
}

static struct areas_pressure pressure_of(const struct sim_balloon *b)
{
    return (struct areas_pressure){.constant = b->now->pressure};
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    const struct areas_pressure pressure = pressure_of(b);
    areas_push(sim, b, NULL, &pressure);
}

static void product(struct sim *sim, struct sim_balloon *b, double a, double (*dx)[4], double f,
                    double (*dv)[4], double (*df)[4])
{
    (void)f;
    (void)dv;
    const struct areas_pressure pressure = pressure_of(b);
    if (a != 0)
        areas_product(sim, b, &pressure, &(struct areas_pressure){0}, NULL, a, dx, df);
}

/* Twice as stiff, for edges that grow to twice their length before the bound is found anew. */
static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    areas_bound(sim, b, 2 * b->now->pressure, rows);
}

static double power_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct sim_balloon *b = context;
    double power = 0;
    for (uint32_t p = begin; p < end; p++)
        if (p - b->point_begin < b->point_end - b->point_begin)
            power += vec3_dot(sim->normal[p], sim->velocity[p]);
    return power;
}

static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    (void)dissipated;
    *work += b->now->pressure / 6 * vector_sum(sim, power_block, b);
}

const struct effect effect_areas = {.name = "pressure_on",
                                    .phase = EFFECT_FORCES,
                                    .wanted = wanted,
                                    .open = open,
                                    .close = close,
                                    .apply = apply,
                                    .after = after,
                                    .product = product,
                                    .bound = bound,
                                    .power = power,
                                    .source = "virtual work of p V"};
