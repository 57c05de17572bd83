/* How an edge and a triangle let go (paper 3.5, parts 2 and 3), with what they held booked as fracture's. */
#ifndef SIM_LET_GO_H
#define SIM_LET_GO_H

#include "sim/sim.h"

/* Makes one edge let go; for break_edges() and for effects. */
static inline void sim_break_edge(struct sim *sim, uint32_t edge)
{
    if (sim->ledger.on)
        sim->ledger.account.fracture += sim_spring_energy(sim, edge) + effects_edge_energy(sim, edge);
    sim->broken_length[edge] = sim_edge_length(sim, edge);
    sim->edge_active[edge] = 0;
    sim->edges_broke = sim->changed = true;
    sim->broken++;
}

/* Likewise an active triangle: what the skin held there is gone with it. */
static inline void sim_drop_triangle(struct sim *sim, uint32_t triangle)
{
    if (sim->ledger.on)
        sim->ledger.account.fracture += effects_triangle_energy(sim, triangle);
    sim->triangle_active[triangle] = 0;
}

#endif
