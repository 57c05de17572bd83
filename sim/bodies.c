#include "sim/bodies.h"

#include <stdlib.h>

enum status sim_add_body(struct sim *sim, uint32_t *first, struct error *err)
{
    uint32_t *longer = realloc(sim->body, (sim->body_count + 1) * sizeof *longer);
    if (!longer)
        return error_no_memory(err, "the quantities that are integrated");
    sim->body = longer;
    enum status status = sim_add_scalars(sim, SIM_BODY_SCALARS, first, err);
    if (!status)
        sim->body[sim->body_count++] = *first;
    return status;
}

bool sim_is_of_body(const struct sim *sim, uint32_t scalar)
{
    for (uint32_t i = 0; i < sim->body_count; i++)
        if (scalar >= sim->body[i] && scalar < sim->body[i] + SIM_BODY_SCALARS)
            return true;
    return false;
}

void sim_drift_bodies(struct sim *sim, double dt, const double *rate)
{
    for (const uint32_t *b = sim->body; b < sim->body + sim->body_count; b++)
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t speed = *b + SIM_BODY_SPEED + i;
            sim->scalar[*b + SIM_BODY_PLACE + i] += dt *
                                                    (sim->scalar[speed] + (rate ? dt / 2 * rate[speed] : 0));
        }
}

void sim_hold_bodies(const struct sim *sim, double *rate)
{
    for (const uint32_t *b = sim->body; b < sim->body + sim->body_count; b++)
        for (uint32_t i = 0; i < 3; i++)
            rate[*b + SIM_BODY_PLACE + i] = 0;
}

void sim_advance_scalars(struct sim *sim, double dt)
{
    sim_hold_bodies(sim, sim->scalar_rate);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += dt * sim->scalar_rate[i];
    sim_drift_bodies(sim, dt, NULL);
}
