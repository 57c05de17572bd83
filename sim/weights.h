/*
 * What an error of a state is measured in, for methods that choose their own steps: places in the mean radius
 * R of their balloon at rest, speeds in R times the rate w at which it breathes, w^2 = sum k r^2 / sum m |x -
 * c|^2 over its edges (k spring constant, r rest length) and points: all edges stretched alike store sum k
 * r^2 e^2/2 while points move |x - c| e. Without springs, w is one over the time of the run. None of it
 * depends on units, nor on where the origin is.
 */
#ifndef SIM_WEIGHTS_H
#define SIM_WEIGHTS_H

#include "sim/sim.h"

/* Finds each balloon's rate at rest. Error: STATUS_RANGE when the scene's tolerance is below what the
 * precision of positions can give, which says what it can. */
enum status weights_open(struct sim *sim, struct error *err);

/* What an error of that scalar is measured in where it is a body's, as a point's place or speed is; 0: it is
 * none. */
double weights_of_body(const struct sim *sim, uint32_t scalar);

/* Likewise, at the least, where it begins at nothing: of what was brought into a balloon, what gas fills
 * that; of what a viscous spring has given way, the mean edge; 0: it is none of these. */
double weights_of_growing(const struct sim *sim, uint32_t scalar);

/* RMS distance of the points, each in its balloon's mean radius, from one set of rows of [point_count] to
 * another. */
double weights_distance(const struct sim *sim, double (*from)[4], double (*to)[4]);

/* RMS over the points of (dx, dv), both rows of [point_count], over the tolerance. */
double weights_norm(struct sim *sim, double (*dx)[4], double (*dv)[4], double tolerance);

#endif
