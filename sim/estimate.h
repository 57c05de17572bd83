/*
 * The error that a run achieves, measured beside it: two companions follow with half and a quarter of its
 * step (where a method chooses its steps, also with a tenth and a hundredth of its tolerance), and what lies
 * between the three tells how fast they converge (Richardson, Phil. Trans. A 226 (1927) 299).
 *
 *     if (estimate_open(&sim, meshes, workers, &estimate, err)) ...
 *     if (estimate_compare(estimate, &sim, &error, err)) ...           whenever a frame is due
 *     estimate_print(estimate, stdout);
 *     estimate_close(estimate);
 *
 * With d1 and d2 the RMS distances of the points, run to companion and companion to companion, and r = d1/d2,
 * the differences are a geometric series, and the run's error is their sum d1 r/(r - 1). Companions stop at
 * the first break: from there on a run and one next to it go apart, whatever their steps.
 */
#ifndef SIM_ESTIMATE_H
#define SIM_ESTIMATE_H

#include "sim/sim.h"

struct estimate;

/* Opens the companions of a sim that has not stepped; meshes and workers as for sim_open().
 * Errors: those of sim_open(). */
enum status estimate_open(const struct sim *sim, const struct mesh *meshes, unsigned workers,
                          struct estimate **estimate, struct error *err);

/* Lets the companions catch up with sim->time. *error becomes the run's error there, in mean radii at rest;
 * NAN once something broke. Errors: those of sim_step(), of a companion; it asks sim->goes_on. */
enum status estimate_compare(struct estimate *estimate, const struct sim *sim, double *error,
                             struct error *err);

/* "position error 2.1e-5 of the radius; halving it would take 1.4 x the time": the largest error until the
 * first break, and the price by the observed order and the companion's work, in evaluations of the forces
 * and what takes as long. */
void estimate_print(const struct estimate *estimate, FILE *stream);

void estimate_close(struct estimate *estimate); /* NULL is fine */

#endif
