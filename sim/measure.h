/* Areas and pieces of a skin: what the log, the table of pieces and the series of meshes have
 * in common (measure.c). */
#ifndef SIM_MEASURE_H
#define SIM_MEASURE_H

#include "sim/sim.h"

/* Area of a triangle as it is, and at rest, by the rest lengths of its edges. */
double sim_area(const struct sim *sim, uint32_t triangle);
double sim_rest_area(const struct sim *sim, uint32_t triangle);

/* Shear modulus times thickness of a balloon's skin, force over length: of springs that of a lattice of them,
 * sqrt(3)/4 k (Seung & Nelson, Phys. Rev. A 38 (1988) 1005). */
double sim_stiffness(const struct sim *sim, const struct sim_balloon *balloon);

/* Joins the active triangles that share an edge, in sim->piece. O(triangles). */
void sim_find_pieces(struct sim *sim);

/* Of an active triangle, after sim_find_pieces(): an edge of its piece, the same for all of
 * the piece's triangles. */
uint32_t sim_piece_of(struct sim *sim, uint32_t triangle);

#endif
