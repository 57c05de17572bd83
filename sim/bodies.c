#include "sim/bodies.h"

#include <stdlib.h>

enum status sim_add_body(struct sim *sim, uint32_t *first, struct error *err)
{
    struct sim_body *longer = realloc(sim->body, (sim->body_count + 1) * sizeof *longer);
    if (!longer)
        return error_no_memory(err, "the quantities that are integrated");
    sim->body = longer;
    enum status status = sim_add_scalars(sim, SIM_BODY_SCALARS, first, err);
    if (!status)
        sim->body[sim->body_count++] = (struct sim_body){*first, *first + 3};
    return status;
}

bool sim_is_of_body(const struct sim *sim, uint32_t scalar)
{
    for (uint32_t i = 0; i < sim->body_count; i++)
        if (scalar >= sim->body[i].place && scalar < sim->body[i].place + SIM_BODY_SCALARS)
            return true;
    return false;
}

void sim_drift_bodies(struct sim *sim, double dt, const double *rate)
{
    for (const struct sim_body *b = sim->body; b < sim->body + sim->body_count; b++)
        for (uint32_t i = 0; i < 3; i++)
            sim->scalar[b->place + i] += dt * (sim->scalar[b->speed + i] +
                                               (rate ? dt / 2 * rate[b->speed + i] : 0));
}

void sim_hold_bodies(const struct sim *sim, double *rate)
{
    for (const struct sim_body *b = sim->body; b < sim->body + sim->body_count; b++)
        for (uint32_t i = 0; i < 3; i++)
            rate[b->place + i] = 0;
}
