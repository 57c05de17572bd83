/*
 * Arithmetic on vectors with a row of four for each point (position, velocity, force, sim->scratch[i]), for
 * the integrators and their solvers: shared out among the workers, and equal to the bit for any number of
 * them. The fourth of a row is 0 and stays so. Nothing here allocates or fails.
 *
 *     struct vector_term stage[] = {{dt / 2, sim->scratch[0]}, {dt / 2, sim->scratch[1]}};
 *     vector_combine(sim, sim->position, start, stage, 2);          position = start + dt/2 k0 + dt/2 k1
 *     double squares = vector_dot(sim, residual, residual);
 */
#ifndef SIM_VECTORS_H
#define SIM_VECTORS_H

#include "sim/sim.h"

/* Points whose contributions are added up before they go into the whole: sums are bounded to this order. */
enum { VECTOR_BLOCK = 256 };

struct vector_term {
    double factor;
    double (*rows)[4];
};

/* to = from. */
void vector_copy(struct sim *sim, double (*to)[4], double (*from)[4]);

/* The state that methods move, places, speeds and scalars, into sim->scratch[row] and the next one; and back
 * from there. */
void vector_keep_state(struct sim *sim, int row);
void vector_return_to(struct sim *sim, int row);

/* y += factor x. */
void vector_add(struct sim *sim, double (*y)[4], double factor, double (*x)[4]);

/* y = base + the terms, added in their order; terms with the factor 0 are left out. base NULL: 0. y may be
 * base or one of the terms. At most SIM_VECTORS_MAX terms. */
void vector_combine(struct sim *sim, double (*y)[4], double (*base)[4], const struct vector_term *terms,
                    size_t count);

/* y = x / mass. y may be x. */
void vector_over_mass(struct sim *sim, double (*y)[4], double (*x)[4]);

/* The sum over all points of what `function` returns for each block of points from begin to end (at most
 * VECTOR_BLOCK of them); called on any worker, and added up in the order of the points. */
double vector_sum(struct sim *sim,
                  double (*function)(const struct sim *sim, uint32_t begin, uint32_t end, void *context),
                  void *context);

/* a . b over all points. */
double vector_dot(struct sim *sim, double (*a)[4], double (*b)[4]);

#endif
