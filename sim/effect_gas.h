/*
 * The gas in a balloon (the scene's block `gas`): an amount that is sealed in, pressed out, pumped, or lost.
 *
 * Amounts N are counted as pressure x volume at the temperature of the air: n R T0, so that what fills a
 * volume V at ambient pressure pa is pa V. A state is N and an entropy s, both integrated with the
 * positions (sim->scalar):
 *     p = s (N/V)^g,    g = 1 and s = 1 at constant temperature, g = gamma where heat stays in.
 * Gas that leaves takes its heat with it and leaves s as it is; gas at T0 that comes in changes it by ds = g
 * s (1/(p V) - 1/N) dN, from the energy balance of an open vessel, d(p V)/(g - 1) = -p dV + g/(g - 1) dN (for
 * instance Shapiro, Compressible Fluid Flow I, chapter 2).
 *
 * V is signed, by the divergence theorem: sum x . A/9 over the points, A the sum of the area vectors of a
 * point's triangles; and the gauge pressure p - pa pushes with (p - pa) A/3, exactly its work's derivative.
 * Holes are closed by a fan about each rim's middle c: with the vector area S = sum x_a x x_b/2 over its
 * sides, in the skin's winding, the fan adds -S . c/3 to the volume, and |S| is the hole's area.
 *
 * What tells the gas about holes:
 *     balloon->rims = &rims;                        once, by whoever cuts the skin, which keeps them up to date
 *     gas_let_go(sim, balloon, points, count);      when a piece falls off: nothing presses on it any more
 */
#ifndef SIM_EFFECT_GAS_H
#define SIM_EFFECT_GAS_H

#include "sim/sim.h"

/* The rims of the holes of one balloon, as its triangles see them: side a-b of a triangle that has no
 * neighbour there. Those of pieces that have fallen off are not among them. Owned by whoever cuts the skin,
 * which lists them in sim_blocks(); read at each sim_forces(), also at trial states. */
struct gas_rims {
    /* [side_count] points a, b in the order of the triangle's corners. The sides may come in any order
     * that the state decides. */
    uint32_t (*side)[2];
    uint32_t *hole; /* [side_count] number of the hole, below hole_count */
    uint32_t side_count, hole_count;
};

/* More holes than this count as one with many rims. */
enum { GAS_HOLES_MAX = 64 };

/* The gas presses on these points no longer, and they bound its volume no longer.
 * Without gas nothing happens. */
void gas_let_go(struct sim *sim, struct sim_balloon *balloon, const uint32_t *points, uint32_t count);

/* What is in a balloon now. */
struct gas_look {
    double volume;
    double gauge_pressure; /* in its middle, over the air's beside it */
    double amount;         /* N */
    /* Of N, from outside, in all: what was pumped in less what got out by leak, neck and holes. */
    double brought;
    double hole_area; /* of tears and of an open neck */
};

/* All 0 for a balloon without gas. */
struct gas_look gas_look(struct sim *sim, const struct sim_balloon *balloon);

/* By which it presses now more than the air outside: the gas's own, or what the scene gives. */
static inline double gas_gauge_pressure(struct sim *sim, const struct sim_balloon *balloon)
{
    return balloon->gas ? gas_look(sim, balloon).gauge_pressure : balloon->now->pressure;
}

/* For tubes: streams `rate` of N, at `warmth` times the temperature of the air, into a balloon's gas (out of
 * it: below 0), as rates of sim->scalar. */
void gas_stream(struct sim *sim, const struct sim_balloon *balloon, double rate, double warmth);

/* Whether the amount of a balloon's gas may change. */
bool gas_flows(const struct sim_balloon *balloon);

/* What drives tubes. */
struct gas_drive {
    double pressure;
    double gauge; /* the size of what it is more than that of the air beside it; in a bound as that has it */
    double density;        /* mass over volume */
    double warmth;         /* the temperature over that of the air */
    double amount_of_mass; /* N over mass */
    /* By how much more N the pressure rises by one, at the same volume; INFINITY: into the air. */
    double capacity;
    /* The most of N that may flow out a second, times the pressure difference, so that an explicit step does
     * not overshoot where pressures are nearly even. */
    double to_even;
};

/* By the last sim_forces(); and as the guard's bound took it. */
struct gas_drive gas_drive(const struct sim *sim, const struct sim_balloon *balloon);
struct gas_drive gas_drive_in_bound(const struct sim *sim, const struct sim_balloon *balloon);

#endif
