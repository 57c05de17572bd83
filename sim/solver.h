/*
 * Solves (M - a K - b D) x = rhs, M the masses, K and D the derivatives of the forces (jacobian.h): the
 * linear system of every implicit method. K is not symmetric where there is pressure, nor where dampers turn:
 * so BiCGSTAB (van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631), which keeps six vectors whatever it
 * takes, preconditioned by an incomplete factorisation (D + L) D^-1 (D + U): L and U the 3x3 blocks of the
 * system's springs and dampers off the diagonal, below and above, D such that the product has the system's
 * diagonal (DILU: Pommerell, 1992). What one stiff spring does to its two points is in it to the full. Points
 * are taken in groups of SOLVER_GROUP, as if nothing went between two groups: these are what threads share
 * out. (Smaller ones cost more iterations than threads gain: with stiffness contrasts up to fifty times as
 * many.) Equal to the bit for any number of threads. At equal error (tests/bench/bench_linear.c) GMRES takes
 * .65 to 1.9 of its time, exact factors by CHOLMOD 3 times and far more, conjugate gradients .4 to 1.4, and
 * only where there are neither pressure nor dampers.
 *
 *     struct solver solver = {0};
 *     if (solver_open(sim, &solver, err)) ...              with sim_jacobian_open()
 *     sim_linearise(sim);
 *     solver_prepare(sim, &solver, a, b);                  whenever it was linearised, or a or b change
 *     if (!solver_solve(sim, &solver, rhs, x, 1e-4)) ...   it has not converged
 *     solver_close(&solver);
 */
#ifndef SIM_SOLVER_H
#define SIM_SOLVER_H

#include "sim/sim.h"

enum { SOLVER_ROWS = 6, SOLVER_ITERATIONS_MAX = 400, SOLVER_GROUP = 32768 };

/* An edge, at its lower point. */
struct solver_link {
    uint32_t edge, upper;
};

struct solver {
    const struct solver_kernels *kernels;
    double (*inverse)[3][4];  /* [point_count] of the blocks of D, by columns; owned */
    struct solver_link *link; /* [edge_count] in the order of their lower points; owned */
    uint32_t *first_link;     /* [point_count + 1] of each point; owned */
    double (*coupling)[8];    /* [edge_count] of each link (solver_kernels.c); owned */
    size_t group_count;
    double (*rows[SOLVER_ROWS])[4]; /* [point_count] */
    double a, b;
    uint64_t iterations; /* since it was opened, each two products */
};

/* Errors: STATUS_NO_MEMORY; close it all the same. */
enum status solver_open(struct sim *sim, struct solver *solver, struct error *err);
void solver_close(struct solver *solver);

void solver_prepare(struct sim *sim, struct solver *solver, double a, double b);

/* Sets x to a solution, starting from 0; rhs is kept, and neither is the other. It is one when the residual,
 * after the preconditioner (so that it is in the units of x, and a heavy point counts like a light one), is
 * at most tolerance times that of x = 0. False: it is not, after SOLVER_ITERATIONS_MAX iterations or a
 * breakdown, and x is no use. */
bool solver_solve(struct sim *sim, struct solver *solver, double (*rhs)[4], double (*x)[4], double tolerance);

/* y = P x: a rough solution y for the right-hand side x, which may be the same rows. */
void solver_precondition(struct sim *sim, struct solver *solver, double (*x)[4], double (*y)[4]);

/* RMS over all points of what the preconditioner makes of x: about the solution's size for
 * the right-hand side x. */
double solver_size(struct sim *sim, struct solver *solver, double (*x)[4]);

#endif
