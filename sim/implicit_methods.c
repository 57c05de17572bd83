/* Backward Euler, the implicit midpoint rule, and TR-BDF2: what of the step each of them puts into the
 * equation of implicit.h. */
#include "sim/bodies.h"
#include "sim/implicit.h"
#include "sim/jacobian.h"
#include "sim/methods.h"
#include "sim/vectors.h"

#include <math.h>

/* rhs = h (f + rhs), rhs being h K v. */
static void euler_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double h = *(double *)context;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            rhs[p][i] = h * (sim->force[p][i] + rhs[p][i]);
}

/* rhs = M (v0 - v) + h f: what is not solved yet. */
static void left_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double h = *(double *)context;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS], (*start)[4] = sim->scratch[IMPLICIT_START_VELOCITY];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            rhs[p][i] = sim->mass[p] * (start[p][i] - sim->velocity[p][i]) + h * sim->force[p][i];
}

/* Linearly implicit: (M - h D - h^2 K) dv = h (f + h K v), once. Where forces are so far from linear that
 * this solves less than half of the equation it stands for, Newton's method goes on from there. */
static bool take_backward_euler(struct sim *sim, double h)
{
    struct implicit *m = sim->method;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS], (*change)[4] = sim->scratch[IMPLICIT_CHANGE];
    implicit_base(sim, 0);
    sim_forces(sim);
    sim_linearise(sim);
    solver_prepare(sim, &m->solver, h * h, h);
    sim_force_product(sim, h, sim->velocity, 0, sim->velocity, rhs);
    sim_each_part(sim, euler_part, &h);
    const double all = solver_size(sim, &m->solver, rhs);
    if (!implicit_correct(sim, h, 1e-6))
        return false;
    vector_add(sim, sim->velocity, 1, change);
    vector_add(sim, sim->position, h, sim->velocity);
    sim_forces(sim);
    sim_each_part(sim, left_part, &h);
    if (!(solver_size(sim, &m->solver, rhs) <= all / 2))
        return implicit_solve(sim, h);
    sim_advance_scalars(sim, h);
    return true;
}

static enum status backward_euler(struct sim *sim, double dt, struct error *err)
{
    return implicit_step(sim, dt, take_backward_euler, err);
}

const struct integrator integrator_backward_euler = {
    .name = "backward-euler",
    .order = 1,
    .flags = INTEGRATOR_IMPLICIT,
    .vectors = IMPLICIT_VECTORS,
    .oscillation_limit = INFINITY,
    .decay_limit = INFINITY,
    .open = implicit_open,
    .close = implicit_close,
    .advance = backward_euler,
    .source = "Baraff and Witkin, SIGGRAPH 1998, 43: linearly implicit"};

/* The middle of the step by backward Euler over half of it, solved to the end; then as far again. */
static bool take_midpoint(struct sim *sim, double h)
{
    implicit_base(sim, 0);
    if (!implicit_solve(sim, h / 2))
        return false;
    implicit_extrapolate(sim, 1);
    return true;
}

static enum status implicit_midpoint(struct sim *sim, double dt, struct error *err)
{
    return implicit_step(sim, dt, take_midpoint, err);
}

const struct integrator integrator_implicit_midpoint = {
    .name = "implicit-midpoint",
    .order = 2,
    .flags = INTEGRATOR_IMPLICIT | INTEGRATOR_SYMPLECTIC,
    .vectors = IMPLICIT_VECTORS,
    .oscillation_limit = INFINITY,
    .decay_limit = INFINITY,
    .open = implicit_open,
    .close = implicit_close,
    .advance = implicit_midpoint,
    .source = "Hairer, Lubich and Wanner, Geometric Numerical Integration, II.1 and VI.4"};

/*
 * A trapezoid over g h, g = 2 - sqrt 2, then BDF2 over its two ends and the step's:
 *     x1 = w x_g - (w - 1) x0 + g/2 h v1,    w = 1 / (g (2 - g)) = (1 + sqrt 2) / 2
 * Both equations have the same c = g h/2. As good as BDF2 and damping what is stiff as fully, but it needs
 * nothing from earlier steps: it keeps its order when an edge breaks or the step changes.
 */
static bool take_tr_bdf2(struct sim *sim, double h)
{
    const double c = (1 - sqrt(0.5)) * h;
    sim_forces(sim);
    implicit_base(sim, c);
    if (!implicit_solve(sim, c))
        return false;
    implicit_extrapolate(sim, (sqrt(2.0) - 1) / 2);
    implicit_base(sim, 0);
    return implicit_solve(sim, c);
}

static enum status bdf2(struct sim *sim, double dt, struct error *err)
{
    return implicit_step(sim, dt, take_tr_bdf2, err);
}

const struct integrator integrator_bdf2 = {
    .name = "bdf2",
    .order = 2,
    .flags = INTEGRATOR_IMPLICIT,
    .vectors = IMPLICIT_VECTORS,
    .oscillation_limit = INFINITY,
    .decay_limit = INFINITY,
    .open = implicit_open,
    .close = implicit_close,
    .advance = bdf2,
    .source = "TR-BDF2: Bank et al., IEEE Trans. Electron Devices 32 (1985) 1992; Hosea and Shampine, Appl. "
              "Numer. Math. 20 (1996) 21"};
