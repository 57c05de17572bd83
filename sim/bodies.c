#include "sim/bodies.h"

#include <stdlib.h>

enum status sim_add_body(struct sim *sim, const struct sim_balloon *balloon, uint32_t *first,
                         struct error *err)
{
    struct sim_body *longer = realloc(sim->body, (sim->body_count + 1) * sizeof *longer);
    if (!longer)
        return error_no_memory(err, "the quantities that are integrated");
    sim->body = longer;
    enum status status = sim_add_scalars(sim, SIM_BODY_SCALARS, first, err);
    if (!status)
        sim->body[sim->body_count++] = (struct sim_body){*first, balloon};
    return status;
}

const struct sim_body *sim_body_of(const struct sim *sim, uint32_t scalar)
{
    for (uint32_t n = 0; n < sim->body_count; n++)
        if (scalar >= sim->body[n].first && scalar < sim->body[n].first + SIM_BODY_SCALARS)
            return &sim->body[n];
    return NULL;
}

void sim_drift_bodies(struct sim *sim, double dt, const double *rate)
{
    for (uint32_t n = 0; n < sim->body_count; n++)
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t speed = sim->body[n].first + SIM_BODY_SPEED + i;
            sim->scalar[sim->body[n].first + SIM_BODY_PLACE + i] += dt * (sim->scalar[speed] +
                                                                          (rate ? dt / 2 * rate[speed] : 0));
        }
}

void sim_hold_bodies(const struct sim *sim, double *rate)
{
    for (uint32_t n = 0; n < sim->body_count; n++)
        for (uint32_t i = 0; i < 3; i++)
            rate[sim->body[n].first + SIM_BODY_PLACE + i] = 0;
}

void sim_advance_scalars(struct sim *sim, double dt)
{
    sim_hold_bodies(sim, sim->scalar_rate);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += dt * sim->scalar_rate[i];
    sim_drift_bodies(sim, dt, NULL);
}
