/*
 * The inner loops of a step, parts 1 to 4 of the paper's section 3.5 (forces.c), compiled once for each precision and each
 * set of instructions. All tables of one precision give the same bits: sums are written out in their order, and nothing is
 * contracted.
 */
#ifndef SIM_KERNELS_H
#define SIM_KERNELS_H

#include "sim/sim.h"

/* Each sets or adds to rows of its part's points, chunk by chunk, and reads whatever it needs. */
struct sim_kernels {
    void (*clear_points)(struct sim *sim, const struct sim_chunk *chunk);
    void (*coming_forces)(struct sim *sim, const struct sim_part *part); /* of edges of lower parts */
    void (*edge_forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    void (*coming_normals)(struct sim *sim, const struct sim_part *part); /* of triangles of lower parts */
    void (*triangle_normals)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    void (*pressure_forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    /* How many of the active edges that begin in this part are longer than the threshold. */
    uint32_t (*count_overlong)(const struct sim *sim, const struct sim_part *part);
};

/* The table for this machine. */
const struct sim_kernels *kernels_find(void);

#endif
