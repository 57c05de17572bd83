/*
 * The hand: where a ray meets the skin, and fingers that hold a patch of it and pull.
 *
 *     struct hand_hit hit;
 *     if (hand_find(&sim, origin, direction, &hit)) ...
 *     if (hand_open(&hand, &sim, err)) ...               room for a grip
 *     hand_take(&hand, &sim, &hit);                      from here on it pulls in every step
 *     hand_move(&hand, &sim, place);                          where the hit should be
 *     hand_let_go(&hand, &sim);
 *     hand_close(&hand, &sim);
 *
 * A grip is a spring from each point of the patch to where that point would be if it had followed the hand,
 * weaker towards the patch's edge, so that no triangle is drawn out to a spike: an effect on the forces like
 * any other, with its share of the guard's bound, that is only entered while something is held.
 */
#ifndef SIM_LIVE_HAND_H
#define SIM_LIVE_HAND_H

#include "sim/sim.h"

struct hand_hit {
    uint32_t triangle;
    double distance; /* along the ray, in units of its direction's length */
    double place[3];
};

/* One held point. */
struct hand_finger {
    uint32_t point;
    double stiffness; /* of its spring */
    double place[3];  /* where it was when it was taken */
};

struct hand {
    struct hand_finger *finger; /* [count] */
    uint32_t count, capacity;
    double from[3], by[3]; /* where the hit was, and how far the hand has moved since */
    uint32_t triangle;     /* that was hit */
};

/* The nearest active triangle that the ray meets, from either side. False: none. */
bool hand_find(const struct sim *sim, const double origin[3], const double direction[3],
               struct hand_hit *hit);

/* Error: STATUS_NO_MEMORY. One hand a sim; it is no part of the sim's state. */
enum status hand_open(struct hand *hand, struct sim *sim, struct error *err);
void hand_close(struct hand *hand, struct sim *sim);

void hand_take(struct hand *hand, struct sim *sim, const struct hand_hit *hit);
void hand_move(struct hand *hand, struct sim *sim, const double place[3]);
void hand_let_go(struct hand *hand, struct sim *sim); /* whether it holds or not */

/* What the grip's springs hold: while the hand rests, the work that it does in a step is what they lose. */
double hand_energy(const struct hand *hand, const struct sim *sim);

#endif
