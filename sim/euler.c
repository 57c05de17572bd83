/* The two Euler methods: one force a step, first order. */
#include "sim/bodies.h"
#include "sim/methods.h"
#include "sim/sweep.h"

/* v += a dt, then x += v dt: velocity first. The update with which the paper's claims hold. */
static void velocity_first(struct sim *sim, uint32_t begin, uint32_t end, double dt, struct sim_seen *seen)
{
    row *position = (row *)sim->position, *velocity = (row *)sim->velocity;
    const row *force = (const row *)sim->force;
    const double *mass = sim->mass;
    struct sim_seen now = *seen;
    for (uint32_t p = begin; p < end; p++) {
        const row before = position[p];
        velocity[p] += force[p] * (dt / mass[p]);
        position[p] += velocity[p] * dt;
        sweep_see(&now, mass[p], &position[p], &velocity[p], &before);
    }
    *seen = now;
}

/* x += v dt, then v += a dt with the acceleration at the old place: the textbook's Euler. */
static void position_first(struct sim *sim, uint32_t begin, uint32_t end, double dt, struct sim_seen *seen)
{
    row *position = (row *)sim->position, *velocity = (row *)sim->velocity;
    const row *force = (const row *)sim->force;
    const double *mass = sim->mass;
    struct sim_seen now = *seen;
    for (uint32_t p = begin; p < end; p++) {
        const row before = position[p];
        position[p] += velocity[p] * dt;
        velocity[p] += force[p] * (dt / mass[p]);
        sweep_see(&now, mass[p], &position[p], &velocity[p], &before);
    }
    *seen = now;
}

static enum status symplectic_euler(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    sim_forces_then(sim, &(struct sim_move){velocity_first, dt});
    sim_advance_scalars(sim, dt);
    return STATUS_OK;
}

static enum status explicit_euler(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    sim_forces_then(sim, &(struct sim_move){position_first, dt});
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += dt * sim->scalar_rate[i];
    return STATUS_OK;
}

const struct integrator integrator_symplectic_euler = {.name = "symplectic-euler",
                                                       .order = 1,
                                                       .flags = INTEGRATOR_SYMPLECTIC | INTEGRATOR_ONE_SWEEP,
                                                       .evaluations = 1,
                                                       .oscillation_limit = 2,
                                                       .decay_limit = 2,
                                                       .advance = symplectic_euler,
                                                       .source = "paper 3.1, velocity first"};

/* Any step is unstable without damping. */
const struct integrator integrator_explicit_euler = {.name = "explicit-euler",
                                                     .order = 1,
                                                     .evaluations = 1,
                                                     .oscillation_limit = 0,
                                                     .decay_limit = 2,
                                                     .advance = explicit_euler,
                                                     .source = "paper 3.1, position first"};
