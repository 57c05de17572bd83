/*
 * How the rule's files work together: fracture.c says when, cracks.c how tips run, slits.c cuts,
 * pieces.c knows what falls off.
 *
 * A ring are the triangles around a point, against the clock; spoke i is the edge between
 * triangles i - 1 and i.
 */
#ifndef SIM_CRACKS_H
#define SIM_CRACKS_H

#include "sim/fracture.h"

struct ring {
    struct fan fan[FAN_MAX];
    struct membrane_state state[FAN_MAX];
    int count;
    bool closed; /* the point is not on a rim */
};

/* false, which is told: it has more than FAN_MAX triangles. */
bool crack_take_ring(struct sim *sim, const struct sim_balloon *balloon, uint32_t point, struct ring *ring);

/* The point at a spoke's far end; the mean nominal stress across it, over the shear modulus. */
uint32_t crack_spoke_end(const struct sim *sim, const struct ring *ring, int spoke);
double crack_spoke_stress(const struct sim *sim, const struct ring *ring, uint32_t point, int spoke);

/* Where a point is at rest; the unit vector from one to another there, and their distance. */
double *crack_rest(const struct sim_balloon *balloon, uint32_t point);
double crack_rest_direction(const struct sim_balloon *balloon, uint32_t from, uint32_t to,
                            double direction[3]);

/* Whether a spoke can be cut so that a point of a rim keeps `least` triangles to either side, one at the far
 * end if that lies on a rim too, and no piece falls off that is too small. */
bool crack_may_cut(struct sim *sim, struct sim_balloon *balloon, const struct ring *ring, int spoke,
                   int least);

/* Cuts a spoke of a ring that was taken since the last cut; its end becomes a tip that goes on from `tip`, or
 * one that starts here (NULL), unless it lay on a rim. */
void crack_run_along(struct sim *sim, struct sim_balloon *balloon, const struct ring *ring, int spoke,
                     const struct crack_tip *tip);

/* Cuts across a triangle that is stretched past all bearing; false: it has no corner on a rim, or
 * nothing there may be cut. */
bool fracture_snap(struct sim *sim, struct sim_balloon *balloon, uint32_t triangle);

bool fracture_is_rim(const struct sim *sim, const struct sim_balloon *balloon, uint32_t point);

/* Whether what a cut of the side between two points of a rim would leave is worth it: 4 triangles, and
 * its share of the skin. */
bool fracture_leaves_pieces(struct sim *sim, struct sim_balloon *balloon, uint32_t triangle, int side);

/* How many triangles would fall off if the side were cut between two points of a rim (the smaller
 * part, by count); they are fracture->list. 0: the skin would still hang together. O(that
 * number). Then, once it is cut: */
uint32_t fracture_falls_off(struct sim *sim, struct sim_balloon *balloon, uint32_t triangle, int side);
void fracture_let_fall(struct sim *sim, struct sim_balloon *balloon, uint32_t count);
void fracture_tell_gas(struct sim *sim, struct sim_balloon *balloon);

#endif
