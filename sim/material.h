/* What stretched skin looks like (paper 3.3). */
#ifndef SIM_MATERIAL_H
#define SIM_MATERIAL_H

#include "sim/sim.h"

/* The mean length of a triangle's three edges over their mean rest length; 1 where that is 0. */
double sim_triangle_stretch(const struct sim *sim, uint32_t triangle);

/* Opacity and highlight exponent of each triangle from its stretch. Arrays of triangle_count, the
 * caller's. */
void sim_material(const struct sim *sim, float *opacity, float *shininess);

#endif
