/* The two Euler methods: one force a step, first order. */
#include "sim/methods.h"
#include "sim/rows.h"

/* v += a dt, then x += v dt: velocity first. The update with which the paper's claims hold. */
static void part_velocity_first(struct sim *sim, const struct sim_part *part, void *context)
{
    const double dt = *(double *)context, *mass = sim->mass;
    row *position = (row *)sim->position, *velocity = (row *)sim->velocity;
    const row *force = (const row *)sim->force;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const row v = velocity[p] + force[p] * (dt / mass[p]);
        velocity[p] = v;
        position[p] += v * dt;
    }
}

/* x += v dt, then v += a dt with the acceleration at the old place: the textbook's Euler. */
static void part_position_first(struct sim *sim, const struct sim_part *part, void *context)
{
    const double dt = *(double *)context, *mass = sim->mass;
    row *position = (row *)sim->position, *velocity = (row *)sim->velocity;
    const row *force = (const row *)sim->force;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const row v = velocity[p];
        position[p] += v * dt;
        velocity[p] = v + force[p] * (dt / mass[p]);
    }
}

static void advance_scalars(struct sim *sim, double dt)
{
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += sim->scalar_rate[i] * dt;
}

static enum status symplectic_euler(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    sim_forces(sim);
    sim_each_part(sim, part_velocity_first, &dt);
    advance_scalars(sim, dt);
    return STATUS_OK;
}

static enum status explicit_euler(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    sim_forces(sim);
    sim_each_part(sim, part_position_first, &dt);
    advance_scalars(sim, dt);
    return STATUS_OK;
}

const struct integrator integrator_symplectic_euler = {.name = "symplectic-euler",
                                                       .order = 1,
                                                       .flags = INTEGRATOR_SYMPLECTIC,
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
