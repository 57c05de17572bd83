/*
 * Newton's equations of a BDF step with its coefficient g, (1 - g J) z = r, J = [0 1; K/m D/m]. The lower row
 * times m and the upper one put into it are
 *     (m - g D - g^2 K) z_v = m r_v + g K r_x,   z_x = r_x + g z_v,
 * and the preconditioner is the one that solver.h has for just that. What pins hold it leaves where it is, to
 * the bit: points that it moved by a rounding would be put back after the step, and a new run begun for it.
 */
#include "sim/cvode_solver.h"

#include "sim/jacobian.h"
#include "sim/pins.h"
#include "sim/solver.h"
#include "sim/vectors.h"

#include <cvode/cvode.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

struct cvode_solver {
    SUNNonlinearSolver fixed_point;
    SUNLinearSolver linear;
    struct solver points; /* for its preconditioner */
};

/* Of the vector's scalars the Jacobian knows nothing: rows of 0. */
static void scalars_of(const struct sim *sim, N_Vector from, double factor, N_Vector to)
{
    for (sunindextype i = 8 * (sunindextype)sim->point_count; i < NV_LENGTH_S(to); i++)
        NV_Ith_S(to, i) = factor * NV_Ith_S(from, i);
}

void cvode_load_points(struct sim *sim, N_Vector y)
{
    vector_copy(sim, sim->position, cvode_rows(y));
    vector_copy(sim, sim->velocity, cvode_rows(y) + sim->point_count);
}

static int linearise(realtype t, N_Vector y, N_Vector rate, void *context)
{
    (void)t, (void)rate;
    cvode_load_points(context, y);
    sim_linearise(context);
    return 0;
}

static int product(N_Vector v, N_Vector jv, realtype t, N_Vector y, N_Vector rate, void *context,
                   N_Vector spare)
{
    (void)t, (void)y, (void)rate, (void)spare;
    struct sim *sim = context;
    double(*dx)[4] = sim->scratch[CVODE_DX], (*dv)[4] = sim->scratch[CVODE_DV];
    vector_copy(sim, dx, cvode_rows(v)); /* whose rows may lie anywhere in memory */
    vector_copy(sim, dv, cvode_rows(v) + sim->point_count);
    sim_force_product(sim, 1, dx, 1, dv, sim->scratch[CVODE_DF]);
    vector_copy(sim, cvode_rows(jv), dv);
    vector_over_mass(sim, cvode_rows(jv) + sim->point_count, sim->scratch[CVODE_DF]);
    scalars_of(sim, v, 0, jv);
    return 0;
}

static int find_blocks(realtype t, N_Vector y, N_Vector rate, booleantype unchanged, booleantype *fresh,
                       realtype g, void *context)
{
    (void)unchanged;
    struct sim *sim = context;
    linearise(t, y, rate, sim);
    solver_prepare(sim, &cvode_solver_of(sim)->points, g * g, g);
    *fresh = SUNTRUE;
    return 0;
}

struct solve {
    double (*r)[4], (*z)[4]; /* [2 point_count] */
    double g;
};

/* The right-hand side: m r_v is added to g K r_x. */
static void right_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct solve s = *(struct solve *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            sim->scratch[CVODE_DF][p][i] += sim->mass[p] * s.r[sim->point_count + p][i];
}

static void result_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct solve s = *(struct solve *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++) {
            s.z[sim->point_count + p][i] = sim->scratch[CVODE_DV][p][i];
            s.z[p][i] = s.r[p][i] + s.g * sim->scratch[CVODE_DV][p][i];
        }
}

static int precondition(realtype t, N_Vector y, N_Vector rate, N_Vector r, N_Vector z, realtype g,
                        realtype delta, int left, void *context)
{
    (void)t, (void)y, (void)rate, (void)delta, (void)left;
    struct sim *sim = context;
    double(*dx)[4] = sim->scratch[CVODE_DX];
    vector_copy(sim, dx, cvode_rows(r));
    sim_force_product(sim, g, dx, 0, dx, sim->scratch[CVODE_DF]);
    struct solve solve = {cvode_rows(r), cvode_rows(z), g};
    sim_each_part(sim, right_part, &solve);
    solver_precondition(sim, &cvode_solver_of(sim)->points, sim->scratch[CVODE_DF], sim->scratch[CVODE_DV]);
    sim_each_part(sim, result_part, &solve);
    pins_hold(sim, solve.z);
    pins_hold(sim, solve.z + sim->point_count);
    scalars_of(sim, r, 1, z);
    return 0;
}

static bool open_newton(struct sim *sim, struct cvode_solver *solver, void *memory, N_Vector y,
                        SUNContext context)
{
    struct error err;
    solver->linear = SUNLinSol_SPGMR(y, SUN_PREC_LEFT, 20, context);
    return solver->linear && !solver_open(sim, &solver->points, &err) && !sim_jacobian_open(sim, &err) &&
           !CVodeSetLinearSolver(memory, solver->linear, NULL) &&
           !CVodeSetPreconditioner(memory, find_blocks, precondition) &&
           !CVodeSetJacTimes(memory, linearise, product);
}

bool cvode_solver_open(struct sim *sim, void *memory, N_Vector y, SUNContext context, bool newton,
                       struct cvode_solver **result)
{
    struct cvode_solver *solver = *result = calloc(1, sizeof *solver);
    if (!solver)
        return false;
    if (newton)
        return open_newton(sim, solver, memory, y, context);
    solver->fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
    return solver->fixed_point && !CVodeSetNonlinearSolver(memory, solver->fixed_point);
}

void cvode_solver_close(struct sim *sim, struct cvode_solver *solver)
{
    if (!solver)
        return;
    if (solver->linear)
        SUNLinSolFree(solver->linear);
    if (solver->fixed_point)
        SUNNonlinSolFree(solver->fixed_point);
    sim_jacobian_close(sim);
    solver_close(&solver->points);
    free(solver);
}
