/*
 * The guard: what step is surely stable, known before each step, and what is done about a step
 * that is not (time.guard).
 *
 *     guard_open(sim, err)        once the tables are complete
 *     guard_step(sim, first, err) before each step: splits it, or refuses it
 *     guard_check(sim, err)       after it: the numbers are still those of a balloon
 *     guard_outdated(sim)         whenever masses, springs, dampers or pressures have been changed
 *
 * The bound. With M u'' + C u' + K u = 0 around the present state, a method with the limits w for dt times
 * the frequency of an oscillator and d for dt times the rate of a decay (struct integrator) is stable while
 *     (dt/d) u.C u + (dt/w)^2 u.K u <= u.M u   for every u,
 * which is exact for symplectic Euler (z^2 - (2 - c - k) z + (1 - c), c = dt C, k = dt^2 K, has both roots
 * within the circle while 2 c + k < 4) and sufficient for the others. The springs' K is at most k_s for
 * each edge, whatever its direction and its tension, and C at most k_d, so that the two are graph
 * Laplacians, and for any positive numbers x_p at the points (Collatz and Wielandt) their largest
 * eigenvalue is at most the largest of
 *     sum over the edges p-q of  weight (1 + x_q/x_p) / m_p.
 * x = 1 is Gershgorin's circle; a few power iterations bring it to the eigenvalue of the unsigned graph. It
 * needs no positions: nothing has to be done while nothing changes, and edges that let go only lower it.
 *
 * Pressure pushes along normals, which turn faster the smaller the triangles are: |dF/dx| is near P times
 * perimeter / area. But the push is never more than P, and over a displacement of s it changes by 2 P at
 * most. So it counts as 2 P/s, with s a tenth of the mean edge: triangles that are smaller may make a point
 * tremble, but by less than s.
 *
 * A method that no step keeps stable (w = 0: textbook Euler, which multiplies an oscillation by sqrt(1 + (dt
 * w)^2) in each step) gets steps over which that grows e-fold at most until time.end: dt K end/2 in the
 * place of the second term.
 */
#ifndef SIM_GUARD_H
#define SIM_GUARD_H

#include "sim/sim.h"

/* What each point's forces can change by: an effect adds its own (struct effect, bound). [point_count] */
struct guard_rows {
    double *stiffness; /* sums of |dF/dx| over all that the force on the point depends on */
    double *damping;   /* of |dF/dv| */
    double *push;      /* the largest force that can do work on the point out of nothing, as pressure does */
};

/* What asks for the shortest step of all that moves beside the points (struct effect, follow). */
struct guard_follow {
    double step; /* s: the longest that follows it; INFINITY: any does */
    const struct effect *effect;
    const struct sim_balloon *balloon;
};

/* A step may be split in no more parts than this, some million: by the guard, or by a method that solves
 * equations and finds no solution over longer ones, in halves of halves. */
enum { GUARD_PARTS_MAX = 1 << 20 };

enum status guard_open(struct sim *sim, struct error *err); /* STATUS_NO_MEMORY */
void guard_close(struct sim *sim);

/* Something that the bound depends on is no longer what it was: somebody changed it, which can have put in
 * any amount of energy; or the motion did, which puts in none. */
void guard_outdated(struct sim *sim);
void guard_bound_outdated(struct sim *sim);

/* A point has been cut in two: `like` is the one of which the bound knew. Looks at what holds the point now,
 * the edges in the list: by the x at hand nobody else's part of the bound has changed. Where that asks for a
 * shorter step than is taken, or for a much shorter one, all is looked at anew. */
void guard_cut(struct sim *sim, const struct sim_balloon *balloon, uint32_t point, uint32_t like,
               const uint32_t *edges, uint32_t edge_count);

/* The largest step that is surely stable as things are: INFINITY when any is, 0 when none is. */
double guard_stable_step(struct sim *sim);

/* What flows between balloons or hangs on strings asks of a step, by what the last bound took pressures for.
 * Nothing that the future depends on changes. */
struct guard_follow guard_following(const struct sim *sim);

/* In words: "steps up to 1e-06 follow what flows in ...". */
void guard_describe_follow(const struct sim *sim, const struct guard_follow *follow, char *text, size_t size);

/* The longest step that a method which chooses its own may try: it goes by how the points move, and sees
 * nothing of what moves beside them. INFINITY where nothing does, and with time.guard = "off".
 * Error: STATUS_DIVERGED when a step would be split in more than GUARD_PARTS_MAX. */
enum status guard_longest_step(struct sim *sim, double *longest, struct error *err);

/* At the `first` of the substeps of a step, chooses sim->substeps, and with it sim->step.
 * Error: STATUS_DIVERGED when the step is not surely stable and time.guard is "refuse", or
 * when no split would do. */
enum status guard_step(struct sim *sim, bool first, struct error *err);

/* Whether the next step could be begun, without a method's trials. What the schedule changes by now is
 * changed, and the step is split: sim_step() goes on from there.
 * Error: STATUS_DIVERGED where it is refused. */
enum status guard_may_step(struct sim *sim, struct error *err);

/* STATUS_DIVERGED, by sim_diverged(), once a place or a speed is not a number, or the points move with a
 * million times the energy that they can have. All they can have is what there was, and what pressure
 * adds: its power is at most sum P |v| <= sqrt(sum P^2/m) sqrt(2 T), so that sqrt(2 E) grows by sqrt(sum
 * P^2/m) dt in a step at most. Numbers that run away grow at every step and soon pass a million; a balloon
 * that bursts under too large a step stays far below (a few hundred, in the paper's most violent cases),
 * since its springs let go. */
enum status guard_check(struct sim *sim, struct error *err);

/* Into how many times as many parts a step would have to be split, where time.guard = "off" lets it go that
 * is larger than what is surely stable; 0: it is not. */
double guard_passed(const struct sim *sim);

/* In words: "time.step 0.25 is split in 14: steps up to 0.0182 are surely stable for symplectic-euler; the
 * dampers of balloons[0] ask for most of that". Of a step that needs no split: only what is stable. */
void guard_describe(struct sim *sim, char *text, size_t size);

/* What of all this the future depends on. Returns how many blocks. */
size_t guard_blocks(struct sim *sim, struct sim_block *blocks);

#endif
