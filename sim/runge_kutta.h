/*
 * Explicit Runge-Kutta methods on positions, velocities and scalars at once: what rk4 and
 * rk-adaptive share. Stage i is
 *
 *     y_i = y_0 + dt (a[i][0] k_0 + ... + a[i][i-1] k_{i-1}),   k_i = (v, f/m, scalar_rate) at y_i
 *
 *     runge_kutta_begin(sim, t);                        y_0 is the state at hand
 *     for (i = 0; i < t->stages; i++)
 *         runge_kutta_stage(sim, t, i, dt);             the state becomes y_i, k_i is kept
 *     runge_kutta_state(sim, t, t->weights, dt);        y_0 + dt sum weights[i] k_i
 *
 * In sim->scratch the k_i of positions come first, then those of velocities, then y_0:
 * RUNGE_KUTTA_VECTORS(stages).
 */
#ifndef SIM_RUNGE_KUTTA_H
#define SIM_RUNGE_KUTTA_H

#include "sim/sim.h"

enum { RUNGE_KUTTA_STAGES_MAX = 7 };
#define RUNGE_KUTTA_VECTORS(stages) (2 * (stages) + 2)

struct runge_kutta {
    int stages;
    double a[RUNGE_KUTTA_STAGES_MAX][RUNGE_KUTTA_STAGES_MAX];
    double weights[RUNGE_KUTTA_STAGES_MAX];
};

extern const struct runge_kutta runge_kutta_classic; /* Kutta 1901, order 4 */
extern const struct runge_kutta
    runge_kutta_dormand_prince; /* Dormand & Prince 1980, RK5(4)7M; its last stage is the result */

/* y_0 = the state. */
void runge_kutta_begin(struct sim *sim, const struct runge_kutta *method);

/* The state = y_i; evaluates k_i. */
void runge_kutta_stage(struct sim *sim, const struct runge_kutta *method, int i, double dt);

/* The state = y_0 + dt sum weights[i] k_i. weights: [stages] */
void runge_kutta_state(struct sim *sim, const struct runge_kutta *method, const double *weights, double dt);

#endif
