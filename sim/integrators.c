#include "sim/sim.h"

#include <string.h>

/* v += a dt, then x += v dt: velocity first. The update with which the paper's claims hold. */
static void symplectic_euler(struct sim *sim)
{
    sim_forces(sim);
    const double dt = sim->step;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double kick = dt / sim->mass[p];
        for (int i = 0; i < 3; i++) {
            sim->velocity[p][i] += sim->force[p][i] * kick;
            sim->position[p][i] += sim->velocity[p][i] * dt;
        }
    }
}

/* x += v dt, then v += a dt with the acceleration at the old place: the textbook's Euler. */
static void explicit_euler(struct sim *sim)
{
    sim_forces(sim);
    const double dt = sim->step;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double kick = dt / sim->mass[p];
        for (int i = 0; i < 3; i++) {
            sim->position[p][i] += sim->velocity[p][i] * dt;
            sim->velocity[p][i] += sim->force[p][i] * kick;
        }
    }
}

static const struct integrator symplectic = {"symplectic-euler", 1, symplectic_euler,
                                             "paper 3.1, velocity first"};
static const struct integrator textbook = {"explicit-euler", 1, explicit_euler, "paper 3.1, position first"};

const struct integrator *const integrators[] = {&symplectic, &textbook, NULL};

const struct integrator *integrator_find(const char *name)
{
    for (size_t i = 0; integrators[i]; i++)
        if (!strcmp(integrators[i]->name, name))
            return integrators[i];
    return NULL;
}
