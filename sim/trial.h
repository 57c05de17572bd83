/*
 * Trials: what a method would do with the present state, and at what price, before it is let loose on it.
 * Nothing breaks in a trial, and the state is put back to the bit. Prices are counted, never timed, so that
 * the same scene gives the same answer on any machine, under any load, with any number of threads.
 */
#ifndef SIM_TRIAL_H
#define SIM_TRIAL_H

#include "sim/sim.h"

/* Rows of sim->scratch that a trial needs, from the one that it is told on. */
enum { TRIAL_VECTORS = 3 };

/* Work of one step of an implicit method, at the least: two evaluations with
 * derivatives and three iterations. */
enum { TRIAL_IMPLICIT_LEAST = 35 };

/* The most work of one that a trial sees through: what the guard splits no step further
 * than (GUARD_PARTS_MAX). */
enum { TRIAL_WORK_MAX = 1000000 };

struct trial_result {
    double error;  /* RMS over the points, in mean radii, a step of the scene; INFINITY: it got nowhere */
    double work;   /* evaluations of the forces a step of the scene, or what takes as long */
    bool in_parts; /* it had no solution over the steps' lengths: what two lengths differ by tells no error */
    bool too_dear; /* more than it was told, and given up; the work is what it had taken by then */
};

/* Runs `steps` of the scene's steps by a method that is open, whose own is `own` (struct sim, method),
 * once in `parts` and once in twice as many: their distance is the error of the first but for one part
 * in 2^order, which is taken into account. It gives up beyond `most` work of an implicit method, up to
 * TRIAL_WORK_MAX; what others take is known beforehand. `rows` is the first of TRIAL_VECTORS of
 * sim->scratch that the method does not use. */
struct trial_result trial_run(struct sim *sim, const struct integrator *method, void *own, uint32_t parts,
                              uint32_t steps, double most, int rows);

#endif
