/*
 * The symplectic Runge-Kutta-Nystroem method SRKN_6^b of Blanes & Moan, J. Comp. Appl. Math. 142 (2002) 313,
 * table 3: seven kicks and six drifts in a symmetric row, fourth order with a small constant. Without damping
 * each kick takes one force, and the last is the next step's first: six a step.
 *
 *     kick   v += b dt f(x)/m        b1 a1 b2 a2 b3 a3 b4 a3 b3 a2 b2 a1 b1
 *     drift  x += a dt v
 *
 * Damping is split off from the motion: while x stands still in a kick, v' = f(x, v)/m is a small problem
 * of its own, solved by the classic Runge-Kutta method to the same order, four forces a kick. A symmetric
 * row that meets the two conditions of third order has fourth order for any two flows that follow each
 * other, so the order stays 4 with damping, at 28 forces a step: rk4 is then the cheaper one, and nothing
 * is left to be symplectic about.
 *
 * Scalars flow during the kicks, as velocities do, and places of bodies among them during the drifts; where
 * they are gas, on which forces depend, kicks are solved as with damping.
 */
#include "sim/rkn4.h"
#include "sim/bodies.h"
#include "sim/effect_gas.h"
#include "sim/methods.h"
#include "sim/vectors.h"

#include <stdlib.h>
#include <string.h>

enum { STAGES = 4 }; /* of a damped kick */
#define B1 0.0829844064174052
#define B2 0.396309801498368
#define B3 -0.0390563049223486
#define A1 0.245298957184271
#define A2 0.604872665711080
const double rkn4_kick[RKN4_KICKS] = {B1, B2, B3, 1 - 2 * (B1 + B2 + B3), B3, B2, B1};
const double rkn4_drift[RKN4_KICKS] = {0, A1, A2, 0.5 - (A1 + A2), 0.5 - (A1 + A2), A2, A1};

struct rkn4 {
    uint64_t remembers; /* 1: scratch[0] is the acceleration at the end of the last step */
};

static enum status open(struct sim *sim, struct error *err)
{
    sim->method = calloc(1, sizeof(struct rkn4));
    return sim->method ? STATUS_OK : error_no_memory(err, "the method");
}

static void close(struct sim *sim)
{
    free(sim->method);
}

static size_t blocks(struct sim *sim, struct sim_block *list)
{
    struct rkn4 *rkn4 = sim->method;
    list[0] = (struct sim_block){"rkn4", rkn4, sizeof *rkn4};
    list[1] = (struct sim_block){"acceleration", sim->scratch[0], sim->point_count * sizeof *sim->scratch[0]};
    return 2;
}

static void evaluate(struct sim *sim)
{
    sim_forces(sim);
    vector_over_mass(sim, sim->scratch[0], sim->force);
}

/* The acceleration is constant while x is, and rates that are linear in v are had by that of the middle.
 * Velocities must not differ by a bit for it, whether anything is integrated along or not. */
static void kick_scalars(struct sim *sim, double dt)
{
    vector_copy(sim, sim->scratch[1], sim->velocity);
    vector_add(sim, sim->velocity, dt / 2, sim->scratch[0]);
    sim_forces(sim);
    sim_hold_bodies(sim, sim->scalar_rate);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += dt * sim->scalar_rate[i];
    vector_copy(sim, sim->velocity, sim->scratch[1]);
}

static void drift(struct sim *sim, double dt)
{
    vector_add(sim, sim->position, dt, sim->velocity);
    sim_drift_bodies(sim, dt, NULL);
}

static void advance_conservative(struct sim *sim, double dt)
{
    struct rkn4 *rkn4 = sim->method;
    for (int k = 0; k < RKN4_KICKS; k++) {
        if (k > 0)
            drift(sim, dt * rkn4_drift[k]);
        if (k > 0 || !rkn4->remembers || sim->changed)
            evaluate(sim);
        if (sim->scalar_count > 0)
            kick_scalars(sim, dt * rkn4_kick[k]);
        vector_add(sim, sim->velocity, dt * rkn4_kick[k], sim->scratch[0]);
    }
    rkn4->remembers = 1;
}

/* There may be none. */
static void copy(double *to, const double *from, size_t bytes)
{
    if (bytes > 0)
        memcpy(to, from, bytes);
}

/* v' = f(x, v)/m over dt with x as it is; what flows changes forces, too. */
static void kick_damped(struct sim *sim, double dt)
{
    static const double node[STAGES] = {0, 0.5, 0.5, 1},
                        weight[STAGES] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    struct vector_term terms[STAGES];
    double *const *rate = sim->scalar_scratch, *scalar = sim->scalar_scratch[STAGES];
    const size_t scalars = sim->scalar_count * sizeof *scalar;
    vector_copy(sim, sim->scratch[STAGES], sim->velocity);
    copy(scalar, sim->scalar, scalars);
    for (int i = 0; i < STAGES; i++) {
        if (i > 0)
            vector_combine(sim, sim->velocity, sim->scratch[STAGES],
                           &(struct vector_term){dt * node[i], sim->scratch[i - 1]}, 1);
        for (uint32_t s = 0; s < sim->scalar_count && i > 0; s++)
            sim->scalar[s] = scalar[s] + dt * node[i] * rate[i - 1][s];
        sim_forces(sim);
        vector_over_mass(sim, sim->scratch[i], sim->force);
        sim_hold_bodies(sim, sim->scalar_rate);
        copy(rate[i], sim->scalar_rate, scalars);
        terms[i] = (struct vector_term){dt * weight[i], sim->scratch[i]};
    }
    vector_combine(sim, sim->velocity, sim->scratch[STAGES], terms, STAGES);
    copy(sim->scalar, scalar, scalars);
    for (int i = 0; i < STAGES; i++)
        for (uint32_t s = 0; s < sim->scalar_count; s++)
            sim->scalar[s] += dt * weight[i] * rate[i][s];
}

static void advance_damped(struct sim *sim, double dt)
{
    for (int k = 0; k < RKN4_KICKS; k++) {
        if (k > 0)
            drift(sim, dt * rkn4_drift[k]);
        kick_damped(sim, dt * rkn4_kick[k]);
    }
    ((struct rkn4 *)sim->method)->remembers = 0;
}

/* Whether forces change while x does not. */
static bool is_damped(const struct sim *sim)
{
    for (size_t i = 0; i < sim->balloon_count; i++)
        if (sim->settings[i].damping != 0 || gas_flows(&sim->balloons[i]))
            return true;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++)
        if (sim->hooks[EFFECT_FORCES][i].effect->damps)
            return true;
    return false;
}

int rkn4_evaluations(const struct sim *sim)
{
    return is_damped(sim) ? RKN4_KICKS * STAGES : integrator_rkn4.evaluations;
}

static enum status advance(struct sim *sim, double dt, struct error *err)
{
    (void)err;
    if (is_damped(sim))
        advance_damped(sim, dt);
    else
        advance_conservative(sim, dt);
    return STATUS_OK;
}

/* Limits of the whole row, found numerically: the half trace of its matrix leaves [-1, 1] at 3.1635 for an
 * oscillator, and the product of the kicks' decays leaves it at 8.58. */
const struct integrator integrator_rkn4 = {.name = "rkn4",
                                           .order = 4,
                                           .flags = INTEGRATOR_SYMPLECTIC,
                                           .evaluations = 6,
                                           .vectors = STAGES + 1,
                                           .oscillation_limit = 3.163,
                                           .decay_limit = 8.58,
                                           .open = open,
                                           .close = close,
                                           .advance = advance,
                                           .blocks = blocks,
                                           .source = "Blanes & Moan 2002, SRKN_6^b, damping split off"};
