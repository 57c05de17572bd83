/* What springs and points are worth where they are not all alike as in the paper. Both are for a balloon
 * whose tables are filled with what is at rest. */
#ifndef SIM_SPRINGS_H
#define SIM_SPRINGS_H

#include "sim/sim.h"

/* Spring constants in proportion to the cotangents of the two angles across an edge at rest, so that an
 * irregular mesh is stretched evenly by an even pull, as a uniform sheet is (Pinkall and Polthier,
 * Experimental Mathematics 2, 1993): the forces at a point are sum k (L - 1) r u = (L - 1) sum k (x_q - x_p),
 * which are 0 for these k in any flat mesh. 0 where the sum is negative. */
void springs_by_cotangent(struct sim *sim, const struct sim_balloon *balloon);

/* Masses of points in proportion to the areas around them, with the scene's for their mean, so that pressure
 * on areas moves an irregular mesh as it does a uniform sheet. What carries no skin keeps the scene's. */
void springs_mass_by_area(struct sim *sim, const struct sim_balloon *balloon);

#endif
