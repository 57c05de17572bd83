#include "sim/runge_kutta.h"

#include "sim/methods.h"
#include "sim/vectors.h"

const struct runge_kutta runge_kutta_classic = {
    4, {{0}, {1.0 / 2}, {0, 1.0 / 2}, {0, 0, 1}}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

const struct runge_kutta runge_kutta_dormand_prince = {
    7,
    {{0},
     {1.0 / 5},
     {3.0 / 40, 9.0 / 40},
     {44.0 / 45, -56.0 / 15, 32.0 / 9},
     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0}};

void runge_kutta_begin(struct sim *sim, const struct runge_kutta *method)
{
    vector_keep_state(sim, 2 * method->stages);
}

void runge_kutta_state(struct sim *sim, const struct runge_kutta *method, const double *weights, double dt)
{
    const int stages = method->stages;
    struct vector_term terms[RUNGE_KUTTA_STAGES_MAX] = {0};
    for (int i = 0; i < stages; i++)
        terms[i] = (struct vector_term){dt * weights[i], sim->scratch[i]};
    vector_combine(sim, sim->position, sim->scratch[2 * stages], terms, (size_t)stages);
    for (int i = 0; i < stages; i++)
        terms[i].rows = sim->scratch[stages + i];
    vector_combine(sim, sim->velocity, sim->scratch[2 * stages + 1], terms, (size_t)stages);
    for (uint32_t s = 0; s < sim->scalar_count; s++) {
        sim->scalar[s] = sim->scalar_scratch[2 * stages + 1][s];
        for (int i = 0; i < stages; i++)
            if (weights[i] != 0)
                sim->scalar[s] += dt * weights[i] * sim->scalar_scratch[i][s];
    }
}

void runge_kutta_stage(struct sim *sim, const struct runge_kutta *method, int i, double dt)
{
    if (i > 0)
        runge_kutta_state(sim, method, method->a[i], dt);
    sim_forces(sim);
    vector_copy(sim, sim->scratch[i], sim->velocity);
    vector_over_mass(sim, sim->scratch[method->stages + i], sim->force);
    for (uint32_t s = 0; s < sim->scalar_count; s++)
        sim->scalar_scratch[i][s] = sim->scalar_rate[s];
}

static enum status rk4(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    runge_kutta_begin(sim, &runge_kutta_classic);
    for (int i = 0; i < runge_kutta_classic.stages; i++)
        runge_kutta_stage(sim, &runge_kutta_classic, i, dt);
    runge_kutta_state(sim, &runge_kutta_classic, runge_kutta_classic.weights, dt);
    return STATUS_OK;
}

/* The limits are where |1 + z + z^2/2 + z^3/6 + z^4/24| = 1 on the imaginary and the negative real
 * axis: 2 sqrt 2, 2.785. */
const struct integrator integrator_rk4 = {.name = "rk4",
                                          .order = 4,
                                          .evaluations = 4,
                                          .vectors = RUNGE_KUTTA_VECTORS(4),
                                          .oscillation_limit = 2.828427,
                                          .decay_limit = 2.785293,
                                          .advance = rk4,
                                          .source = "Kutta 1901, the classic one"};
