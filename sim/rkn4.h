/* The coefficients of rkn4, in the order of the step: drift 0 (of nothing), kick 0, drift
 * 1, kick 1, ... (rkn4.c). */
#ifndef SIM_RKN4_H
#define SIM_RKN4_H

struct sim;

enum { RKN4_KICKS = 7 };
extern const double rkn4_kick[RKN4_KICKS], rkn4_drift[RKN4_KICKS]; /* shares of the step; each adds up to 1 */

/* Of sim_forces() that a step takes of this scene: 6, with damping 28. */
int rkn4_evaluations(const struct sim *sim);

#endif
