/*
 * A balloon's skin as a membrane: incompressible rubber whose triangles resist being stretched, in place of
 * its springs (the scene's block `membrane`). Edges then only say when they are overlong.
 *
 * A triangle is stretched alike all over. With d1, d2 its sides from its first corner, r1, r2 the same at
 * rest in its plane, F = [d1 d2] [r1 r2]^-1 and C = F^T F has the squares of the principal stretches L1 >= L2
 * as eigenvalues; the thickness goes with L3 = 1/(L1 L2). An isotropic material is a function W(a, D) of a =
 * tr C = L1^2 + L2^2 and D = det C = (L1 L2)^2: the energy in a volume at rest (membrane_law.h). Its stress
 * is S = 2 dW/dC = 2 W_a I + 2 W_D cof C, and the force at corner i is sum_j K_ij d_j, K symmetric:
 *     K = -V [2 W_a M + 2 W_D det M cof G],    G_ij = d_i . d_j,  M = [r1 r2]^-1 [r1 r2]^-T,  V the volume at rest
 * (linear triangles of a membrane, for instance Bonet and Wood, Nonlinear Continuum Mechanics, 2008; W(a, D)
 * and M instead of F because it needs no frames).
 *
 * Wrinkles. A film cannot push. Where L2 < L1^-1/2, narrower than if it were pulled along L1 alone, it
 * wrinkles across, and holds what that pull holds: W(L1, L1^-1/2); where L1 < 1 as well, nothing (Pipkin, IMA
 * J. Appl. Math. 36, 1986). `compression` is the share of the unwrinkled energy that is kept all the same, so
 * that triangles do not vanish.
 *
 * Damping (`viscosity`, eta): S = eta dC/dt / tr C. It is that of Kelvin and Voigt, with a nominal stress eta
 * dL/dt under a stretch alike in both directions whatever L is, as a damper on an edge has: it takes energy
 * at the rate V eta |dC/dt|^2 / (2 tr C), never less than 0, and no turning is damped.
 */
#ifndef SIM_MEMBRANE_H
#define SIM_MEMBRANE_H

#include "sim/membrane_law.h"
#include "sim/sim.h"

/* What a balloon's membrane is made of; balloon->membrane, NULL where springs act. */
struct membrane {
    struct membrane_law law; /* energies over the shear modulus */
    double modulus;          /* mu, force/length^2 */
    double thickness;        /* at rest */
    double viscosity;        /* eta, force s/length^2 */
    /* [triangle_end - triangle_begin] [r1 r2]^-1 = ((b0, b1), (0, b2)) and mu x the triangle's
     * volume at rest. Owned. */
    double (*rest)[4];
    /* [edge_end - edge_begin] (cot + cot)/2 of the angles across at rest, not below 0. Owned. */
    double *edge_weight;
    double (*range)[2]; /* [part_count] largest a and least D by the last forces. Owned. */
    const struct membrane_kernels *kernels;
    double damping; /* the guard's dampers are edge_weight times this; its springs: settings */
};

/* A triangle as it is now. */
struct membrane_state {
    double energy;     /* W over mu: times mu x rest area x thickness it is what the triangle holds */
    double stretch[2]; /* principal, the larger first */
    /* Nominal, over mu: force on what is across at rest, by rest length and thickness; dW/dL. */
    double stress[2];
    /* Unit, of the larger stretch, in the triangle's plane as it is; 0 where the triangle is a line. */
    double direction[3];
};

/* `triangle` is a number in sim's tables, of a balloon that has a membrane. Reads positions
 * only: no forces are needed. */
void membrane_look(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle,
                   struct membrane_state *state);

/* W over mu of each of the balloon's triangles as they are, torn ones 0: energy is [triangle_end -
 * triangle_begin]. Shared out among the workers. */
void membrane_energies(struct sim *sim, const struct sim_balloon *balloon, double *energy);

/* Rest area of a triangle; the mass of each of its thirds is a third of area x thickness x density. */
double membrane_rest_area(const struct sim_balloon *balloon, uint32_t triangle);

/* Of a triangle's side from its corner `side` to the next, half the cotangent of the angle across at rest:
 * the triangle's share in the weight of that edge. For whoever cuts edges: edge_weight is the sum of both
 * sides' shares, not below 0. */
double membrane_edge_share(const struct sim_balloon *balloon, uint32_t triangle, int side);

/* mu x thickness x (area at rest of all triangles): what a balloon's energies are measured by. */
double membrane_scale(const struct sim_balloon *balloon);

/* The largest eigenvalue of d2W/dF2 (over mu) where a <= range[0] and D >= range[1]: a triangle's energy
 * is nowhere steeper, so that its forces change by at most this x mu x thickness x edge_weight along
 * each edge, as springs do. */
double membrane_stiffness(const struct membrane_law *law, const double range[2]);

/* Sets edge[e] of the part's own edges to a spring's and a damper's derivatives (jacobian_kernels.h) that
 * resist about as much as the membrane does there, never less than 0: for preconditioners. In a sheet of
 * equilateral triangles at rest they are as stiff along a line as the membrane. */
void membrane_stand_in(const struct sim *sim, const struct sim_part *part, double (*edge)[8]);

/* Energy held by all the balloon's active triangles, and what their damping takes a second; added up in an
 * order that does not depend on the number of workers. */
double membrane_elastic(struct sim *sim, const struct sim_balloon *balloon);
double membrane_dissipation(struct sim *sim, const struct sim_balloon *balloon);

/* Energy in one triangle, in the unit of force x length: what is lost when it goes. */
double membrane_triangle_energy(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle);

#endif
