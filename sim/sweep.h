/*
 * One sweep over the points: what a method does with a point's force follows while it is still in the core's
 * cache, and looks over the state on the way, so that a step goes through memory once.
 *
 *     static void kick(struct sim *sim, uint32_t begin, uint32_t end, double dt, struct sim_seen *seen) ...
 *     sim_forces_then(sim, &(struct sim_move){kick, dt});       forces at the current state; then kick, once for each point
 *
 * The results are those of sim_forces() and a loop over all points after it, to the bit: a chunk's points are
 * moved when all that reads their old places is done (parts.h), those that other parts read too when all
 * parts are done, and all of them at the end where something else adds to the forces.
 */
#ifndef SIM_SWEEP_H
#define SIM_SWEEP_H

#include "sim/rows.h"
#include "sim/sim.h"

/* What a part's sweep has seen; a line of the cache each. */
struct sim_seen {
    _Alignas(64) row
        energy;  /* twice the kinetic energy, by coordinate; not a number where a place or a speed is none */
    double over; /* the most by which an edge was longer than it may be, when forces were worked out */
    /* Of what slips or is viscous: the largest pull or push of a spring then, and the
     * largest spring constant. */
    double hardest, stiffest;
    double moved; /* the square of the farthest that a point has moved since */
};

/* What a method does with points once their forces are complete: the points from begin to end, on any worker,
 * each once. It calls sweep_see() for each. */
struct sim_move {
    void (*points)(struct sim *sim, uint32_t begin, uint32_t end, double dt, struct sim_seen *seen);
    double dt;
};

/* A point as it is now: its mass, place and speed; and where it was when the forces were worked out. */
static inline void sweep_see(struct sim_seen *seen, double mass, const row *position, const row *velocity,
                             const row *before)
{
    const row moved = *position - *before;
    const double squared = moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2];
    seen->energy += mass * *velocity * *velocity + 0 * *position;
    seen->moved = squared > seen->moved ? squared : seen->moved;
}

/* sim_forces(), and then the move. */
void sim_forces_then(struct sim *sim, struct sim_move *move);

/* For sim_forces_then(): before a part's forces; then a chunk's points, but for those that other parts need
 * where they are; then these; or all of a part's at once. */
void sweep_begin(struct sim *sim, const struct sim_part *part);
void sweep_chunk(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                 const struct sim_move *move);
void sweep_border(struct sim *sim, const struct sim_part *part, void *move);
void sweep_part(struct sim *sim, const struct sim_part *part, void *move);

/* Whether the sweep can be told of points that obstacles or contact push on their way from sim->before; tells
 * it of one, which is where it is now: each worker with the number of a part of its own. They only take
 * energy. */
bool sweep_sees_pushes(const struct sim *sim);
void sweep_see_pushed(struct sim *sim, size_t part, uint32_t point);

/* Where this step ended with a sweep and nothing has moved a point since that it was not told of: whether no
 * edge can be longer than it may be, and the kinetic energy to round-off, or what it was before the pushes;
 * else false, and INFINITY. */
bool sweep_saw_none_overlong(const struct sim *sim);
double sweep_saw_energy(const struct sim *sim);

/* Likewise: the most that a spring of the balloon pulls or pushes with now, where that
 * was watched; or INFINITY. */
double sweep_saw_hardest(const struct sim *sim, const struct sim_balloon *balloon);

/* Likewise: the farthest that a point has moved in this step, or INFINITY where that is not known. */
double sweep_saw_farthest(const struct sim *sim);

#endif
