/*
 * The inner loops of a step, parts 1 to 4 of the paper's section 3.5 (forces.c), compiled once for
 * each set of instructions. All tables give the same bits: sums are written out in their order, and
 * nothing is contracted.
 */
#ifndef SIM_KERNELS_H
#define SIM_KERNELS_H

#include "sim/sim.h"

typedef bool edge_function(struct sim *sim, struct sim_balloon *balloon, uint32_t edge);

/* Each sets or adds to rows of its part's points, chunk by chunk, and reads whatever it needs. */
struct sim_kernels {
    void (*clear_points)(struct sim *sim, const struct sim_chunk *chunk);
    void (*coming_forces)(struct sim *sim, const struct sim_part *part); /* of edges of lower parts */
    void (*edge_forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    /* Also of triangles of lower parts, with the first chunk; and the air's resistance (effect_drag.c),
     * which it adds to forces. */
    void (*triangle_normals)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    void (*pressure_forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    /* The least by which an active edge that begins in this part is shorter than its threshold, less a
     * billionth of that, which is for rounding in many steps to come; INFINITY where there is none. */
    double (*edge_room)(const struct sim *sim, const struct sim_part *part);
    /* Where pressure acts on areas (areas.h): sums of twice the area vectors in place of the normals,
     * and what goes by them. */
    void (*triangle_areas)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    void (*push_areas)(struct sim *sim, const struct sim_part *part, double constant, const double *gradient);
    double (*sum_volume)(const struct sim *sim, uint32_t begin, uint32_t end,
                         const double *origin); /* 18 V */
    /* What viscous springs add to their springs (effect_viscosity.c), with those of lower parts, for methods
     * that move springs by themselves; edge_forces() has it in it. */
    void (*arm_forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    /* Calls it for the part's edges, in order, that may slip (effect_plasticity.c), and for some others;
     * for how many it was true. */
    uint32_t (*slip_edges)(struct sim *sim, const struct sim_part *part, edge_function *slip);
    /* The smallest and largest coordinates of points from begin to end - 1, at least one,
     * from sim->before to now. */
    void (*box_ways)(const struct sim *sim, uint32_t begin, uint32_t end, double box[2][4]);
};

/* Whether the skin's forces of chunk `next` must be there before kernels_press() comes to chunk `now`. Where
 * there is drag, the air's are added to them: on each point after all of the skin's, so that the sum is the
 * same however the points are shared out. */
static inline bool kernels_skin_is_due(const struct sim *sim, const struct sim_part *part,
                                       const struct sim_chunk *next, const struct sim_chunk *now)
{
    return next <= now ||
           (sim->drag && next < part->chunks + part->chunk_count && next->point_begin < now->clear_end);
}

/* Parts 3 and 4 for a chunk: what the pressure does, or what it will act on; and what bending
 * wants of the triangles. */
void kernels_press(const struct sim_kernels *k, struct sim *sim, const struct sim_part *part,
                   const struct sim_chunk *chunk);

/* The table for this machine. */
const struct sim_kernels *kernels_find(void);

#endif
