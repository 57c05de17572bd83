/*
 * Velocity Verlet: Swope, Andersen, Berens & Wilson, J. Chem. Phys. 76 (1982) 637. One force a step, second
 * order, symplectic without damping.
 *
 *     v += dt/2 a;  x += dt v;  a = f(x, v + dt/2 a)/m;  v += dt/2 a
 *
 * Dampers ask for the velocity at the end of the step, which is not known before their force is. They get its
 * prediction by the last acceleration. That is off by dt^2, so the velocity is by dt^3 a step: the order
 * stays second. The price is stability against strong damping: a pure decay at rate c is stable up to c dt =
 * 1, half of Euler's (the larger root of s^2 - (1 - 3z/2) s - z/2, z = c dt, reaches -1 there).
 *
 * The acceleration is remembered from step to step; it is asked anew after everything that makes forces jump.
 */
#include "sim/bodies.h"
#include "sim/methods.h"
#include "sim/sweep.h"
#include "sim/vectors.h"

#include <stdlib.h>

struct verlet {
    uint64_t remembers; /* 1: scratch[0] and its scalars are the accelerations at the end of the last step */
};

static enum status open(struct sim *sim, struct error *err)
{
    sim->method = calloc(1, sizeof(struct verlet));
    return sim->method ? STATUS_OK : error_no_memory(err, "the method");
}

static void close(struct sim *sim)
{
    free(sim->method);
}

static size_t blocks(struct sim *sim, struct sim_block *list)
{
    struct verlet *verlet = sim->method;
    list[0] = (struct sim_block){"verlet", verlet, sizeof *verlet};
    list[1] = (struct sim_block){"acceleration", sim->scratch[0], sim->point_count * sizeof *sim->scratch[0]};
    list[2] = (struct sim_block){"rate", sim->scalar_scratch[0], sim_state_scalars(sim) * sizeof(double)};
    return 3;
}

static void remember(struct sim *sim)
{
    vector_over_mass(sim, sim->scratch[0], sim->force);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar_scratch[0][i] = sim->scalar_rate[i];
    sim_hold_bodies(sim, sim->scalar_scratch[0]);
}

/* The first half: velocities are left at the end of the step, as they are predicted. */
static void part_predict(struct sim *sim, const struct sim_part *part, void *context)
{
    const double dt = *(double *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++) {
            const double kick = dt / 2 * sim->scratch[0][p][i];
            sim->position[p][i] += (sim->velocity[p][i] + kick) * dt;
            sim->velocity[p][i] += kick + kick;
        }
}

/* The second half: v + dt a0 becomes v + dt/2 (a0 + a1). */
static void correct(struct sim *sim, uint32_t begin, uint32_t end, double dt, struct sim_seen *seen)
{
    row *velocity = (row *)sim->velocity, *acceleration = (row *)sim->scratch[0];
    const row *force = (const row *)sim->force, *position = (const row *)sim->position;
    const double *mass = sim->mass;
    struct sim_seen now = *seen;
    for (uint32_t p = begin; p < end; p++) {
        const row a = force[p] * (1 / mass[p]);
        velocity[p] += dt / 2 * (a - acceleration[p]);
        acceleration[p] = a;
        sweep_see(&now, mass[p], &position[p], &velocity[p], &position[p]);
    }
    *seen = now;
}

/* The same for scalars: Heun's rule. */
static void advance_scalars(struct sim *sim, double dt, double weight_before, double weight_now)
{
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += dt * (weight_before * sim->scalar_scratch[0][i] + weight_now * sim->scalar_rate[i]);
}

static enum status advance(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    struct verlet *verlet = sim->method;
    if (!verlet->remembers || sim->changed) {
        sim_forces(sim);
        remember(sim);
    }
    verlet->remembers = 1;
    sim_each_part(sim, part_predict, &dt);
    sim_drift_bodies(sim, dt, sim->scalar_scratch[0]);
    advance_scalars(sim, dt, 1, 0);
    sim_forces_then(sim, &(struct sim_move){correct, dt});
    sim_hold_bodies(sim, sim->scalar_rate);
    advance_scalars(sim, dt, -0.5, 0.5);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar_scratch[0][i] = sim->scalar_rate[i];
    return STATUS_OK;
}

const struct integrator integrator_verlet = {
    .name = "verlet",
    .order = 2,
    .flags = INTEGRATOR_SYMPLECTIC,
    .evaluations = 1,
    .vectors = 1,
    .oscillation_limit = 2,
    .decay_limit = 1,
    .open = open,
    .close = close,
    .advance = advance,
    .blocks = blocks,
    .source = "Swope, Andersen, Berens & Wilson 1982, velocity form"};
