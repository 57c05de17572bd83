/*
 * The equation that every implicit method here comes down to: velocities v with
 *
 *     v = V + c a(X + c v, v, S + c r)
 *
 * where a is the acceleration and r the rate of the scalars, at positions X + c v and scalars S + c r.
 * Newton's method with exact derivatives; each of its linear systems is solved to a fixed part of its
 * right-hand side (Dembo, Eisenstat and Steihaug, SIAM J. Numer. Anal. 19 (1982) 400), and the scalars
 * follow, without derivatives of theirs. It has converged when what is left is a millionth of the first
 * correction, which is what the step changed: far below the error of the step. A step whose equation it
 * does not solve, or that turns an edge back to front, is taken in halves, and halves of halves; none is
 * accepted that was not solved.
 */
#ifndef SIM_IMPLICIT_H
#define SIM_IMPLICIT_H

#include "sim/solver.h"

/* What is where in sim->scratch. */
enum {
    IMPLICIT_BASE_POSITION,
    IMPLICIT_BASE_VELOCITY, /* with S in its scalars */
    IMPLICIT_START_POSITION,
    IMPLICIT_START_VELOCITY, /* of the step, or of the part of it that is being taken; with its scalars */
    IMPLICIT_WHOLE_POSITION,
    IMPLICIT_WHOLE_VELOCITY, /* of the step, where it is taken in parts; likewise */
    IMPLICIT_RHS,
    IMPLICIT_CHANGE,
    IMPLICIT_VECTORS
};

/* An implicit integrator's sim->method, its open and its close. Error: STATUS_NO_MEMORY. */
struct implicit {
    struct solver solver;
    uint64_t in_parts;        /* steps that had no solution over their whole length, so far */
    uint64_t iterations_most; /* of the solver, in all: where steps are given up as too dear; 0: nowhere */
    bool *turned;             /* [part_count] whether an edge has */
    double worst;             /* residual over mass of the point whose equation was furthest from solved, */
    uint32_t worst_point;     /* when it was given up last */
    bool is_linear;           /* that was because a linear system was not solved */
    bool told;                /* that steps are taken in parts */
};
enum status implicit_open(struct sim *sim, struct error *err);
void implicit_close(struct sim *sim);

/* Solves the equation from a first guess in sim->velocity, and leaves the solution in sim->position, velocity
 * and scalar. False: none was found from there. */
bool implicit_solve(struct sim *sim, double c);

/* Newton's correction of velocities for the right-hand side in IMPLICIT_RHS, into IMPLICIT_CHANGE:
 * what solver_solve() finds, which was prepared for c. Nothing where the right-hand side is no more
 * than rounding of places: that of a stiff skin at rest is noise, which no solver makes smaller.
 * False: it is not solved. */
bool implicit_correct(struct sim *sim, double c, double tolerance);

/* y = (1 + w) y - w (the start of the step), of positions, velocities and scalars alike;
 * for midpoints and BDF2. */
void implicit_extrapolate(struct sim *sim, double w);

/* Sets X, V, S to the present position, velocity and scalars, plus `ahead` times their rates of change
 * at the present forces. */
void implicit_base(struct sim *sim, double ahead);

/* Takes a step of dt by take(), which moves the state from where it is over h, or returns false; what it does
 * not get over is halved, down to 1/GUARD_PARTS_MAX of dt. Errors: STATUS_DIVERGED, with the time and
 * the point that is furthest from a solution; STATUS_INTERRUPTED between two parts, by sim->goes_on, the
 * state as before the step. */
enum status implicit_step(struct sim *sim, double dt, bool (*take)(struct sim *sim, double h),
                          struct error *err);

#endif
