/*
 * The limit point of a balloon whose pressure is given. Swelling alike in all directions to L times its size
 * it holds the pressure dW/dV = (dW/dL)/(3 V0 L^2): of thin rubber that rises to a limit (at L = 7^(1/6) =
 * 1.383 of a neo-Hookean one) and falls from there on. More pressure than the limit is held by nothing, and
 * neither is a balloon that was pushed past where it would hold its pressure again: it jumps, to where its
 * skin stiffens or to its bursting (for instance Mueller & Strehlow, Rubber and Rubber Balloons, 2004). That
 * is no fault of the numbers, but whoever set the pressure wants to know.
 *
 *     limit_point_open(sim, balloon, &limit)      at rest
 *     limit_point_watch(sim, balloon, limit)      after each step: tells when the balloon has gone past
 *
 * Nothing that it keeps has any bearing on what comes.
 */
#ifndef SIM_LIMIT_POINT_H
#define SIM_LIMIT_POINT_H

#include "sim/sim.h"

struct limit_point {
    double rest_volume;
    /* mu x thickness x area at rest of a membrane; of springs the sum of k_s r^2, for a spring_factor of 1 */
    double skin;
    double stretch, pressure; /* at the limit; a stretch of INFINITY: there is none */
    enum { LIMIT_UNKNOWN, LIMIT_AHEAD, LIMIT_PASSED } state;
    char text[192]; /* what is told */
};

/* Takes the volume at rest. */
void limit_point_open(struct sim *sim, const struct sim_balloon *balloon, struct limit_point *limit);

/* By the state after the last sim_forces(), now and then: tells (sim_tell) that the skin no longer
 * holds its pressure, and where that ends. Nothing once something broke, and nothing of a state that
 * was past it when first seen. */
void limit_point_watch(struct sim *sim, const struct sim_balloon *balloon, struct limit_point *limit);

#endif
