/* Areas and pieces of a skin: what the log, the table of pieces and the series of meshes have
 * in common (measure.c). */
#ifndef SIM_MEASURE_H
#define SIM_MEASURE_H

#include "common/vec3.h"
#include "sim/sim.h"

/* Area of a triangle as it is, and at rest, by the rest lengths of its edges. */
double sim_area(const struct sim *sim, uint32_t triangle);
double sim_rest_area(const struct sim *sim, uint32_t triangle);

/* A triangle's sides from its first corner to the second and to the third, as they are. */
static inline void sim_sides(const struct sim *sim, uint32_t triangle, double second[3], double third[3])
{
    const uint32_t *p = sim->triangle_point[triangle];
    vec3_sub(sim->position[p[1]], sim->position[p[0]], second);
    vec3_sub(sim->position[p[2]], sim->position[p[0]], third);
}

/* Shear modulus times thickness of a balloon's skin, force over length: of springs that of a lattice of them,
 * sqrt(3)/4 k (Seung & Nelson, Phys. Rev. A 38 (1988) 1005). */
double sim_stiffness(const struct sim *sim, const struct sim_balloon *balloon);

/* Joins the active triangles that share an edge, in sim->piece. O(triangles). */
void sim_find_pieces(struct sim *sim);

/* Of an active triangle, after sim_find_pieces(): an edge of its piece, the same for all of
 * the piece's triangles. */
uint32_t sim_piece_of(struct sim *sim, uint32_t triangle);

#endif
