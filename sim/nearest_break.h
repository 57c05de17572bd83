/*
 * How near a balloon that stays whole came to breaking: for whoever waits for a burst that does not come.
 *
 *     struct nearest_break nearest = {0};
 *     nearest_break_look(sim, &nearest);      now and then
 *     if (nearest.share > 0) ...
 */
#ifndef SIM_NEAREST_BREAK_H
#define SIM_NEAREST_BREAK_H

#include "sim/sim.h"

/* Nothing, as long as nothing was stretched by a tenth, or what was bears a thousandfold. */
struct nearest_break {
    double share;   /* of what it bears, by stretch; 0: nothing */
    double time;    /* s */
    double stretch; /* of an edge; or equal both ways, where a skin that tears holds as much in the mean
                       around a place (fracture.h) */
    double most;    /* at which that edge lets go, or that place tears */
    size_t balloon;
    bool tears;
};

/* Looks at the state as it is, a pass over edges and triangles; keeps what is nearer than all that
 * *nearest has seen. Of skin that tears it knows what the rule last looked at. */
void nearest_break_look(const struct sim *sim, struct nearest_break *nearest);

#endif
