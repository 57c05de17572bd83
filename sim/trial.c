#include "sim/trial.h"
#include "sim/implicit.h"
#include "sim/vectors.h"
#include "sim/weights.h"

#include <math.h>

/* What takes as long as how many evaluations of the forces, on one thread and 1280 to 20480 triangles: an
 * evaluation with the derivatives that an implicit method takes there (8.6 to 9.5 of springs with the paper's
 * pressure, 6 without; 4.9 to 7.8 of rubber with gas, 3.7 where it resists being bent, too), an iteration of
 * its linear solver (6.2 to 7.1, 3.1; 5.9 to 7.7, 8.2; 12 with drag and weight of air), and moving the points
 * over a step. */
static const double derivatives_work = 7.5, iteration_work = 6.7, move_work = 0.15;

/* The rows of sim->scratch, from the trial's first on. */
enum { STATE, COARSE = 2 };

/* The state as it was; whatever is remembered of other steps is not. */
static void put_back(struct sim *sim, int rows)
{
    vector_return_to(sim, rows + STATE);
    sim->changed = true;
}

/* False: the method gave up, or the trial had to. */
static bool advance_by(struct sim *sim, const struct integrator *method, uint32_t parts, uint32_t steps)
{
    struct error ignored = {0};
    const double dt = sim->whole_step / parts;
    for (uint64_t i = 0; i < (uint64_t)parts * steps; i++) {
        if (!sim_goes_on(sim) || method->advance(sim, dt, &ignored))
            return false;
        sim->changed = false;
    }
    return true;
}

static uint64_t iterations_of(const struct sim *sim, const struct integrator *method)
{
    return method->flags & INTEGRATOR_IMPLICIT ? ((const struct implicit *)sim->method)->solver.iterations
                                               : 0;
}

static uint64_t in_parts_of(const struct sim *sim, const struct integrator *method)
{
    return method->flags & INTEGRATOR_IMPLICIT ? ((const struct implicit *)sim->method)->in_parts : 0;
}

/* From here on an implicit method may take so many of the solver's iterations a step of the scene;
 * 0: as many as it wants. */
static void limit(struct sim *sim, const struct integrator *method, uint64_t iterations)
{
    if (!(method->flags & INTEGRATOR_IMPLICIT))
        return;
    struct implicit *m = sim->method;
    m->iterations_most = iterations ? m->solver.iterations + iterations : 0;
}

struct trial_result trial_run(struct sim *sim, const struct integrator *method, void *own, uint32_t parts,
                              uint32_t steps, double most, int rows)
{
    void *const before = sim->method;
    struct trial_result result = {.error = INFINITY};
    sim->method = own;
    vector_keep_state(sim, rows + STATE);
    sim->changed = true;
    const uint64_t evaluations = sim->evaluations, iterations = iterations_of(sim, method),
                   in_parts = in_parts_of(sim, method);
    const uint64_t iterations_most = (uint64_t)(most / iteration_work) * steps;
    limit(sim, method, iterations_most);
    bool good = advance_by(sim, method, parts, steps);
    const double each = method->flags & INTEGRATOR_IMPLICIT ? derivatives_work : 1;
    result.work = move_work * parts + (each * (double)(sim->evaluations - evaluations) +
                                       iteration_work * (double)(iterations_of(sim, method) - iterations)) /
                                          steps;
    result.too_dear = !good && result.work > most;
    result.in_parts = in_parts_of(sim, method) > in_parts;
    good &= !result.in_parts;
    if (good) {
        vector_copy(sim, sim->scratch[rows + COARSE], sim->position);
        put_back(sim, rows);
        limit(sim, method, 2 * iterations_most);
        good = advance_by(sim, method, 2 * parts, steps);
    }
    if (good) {
        const double error = weights_distance(sim, sim->scratch[rows + COARSE], sim->position) / steps /
                             (1 - ldexp(1, -method->order));
        result.error = isfinite(error) ? error : INFINITY;
    }
    put_back(sim, rows);
    limit(sim, method, 0);
    sim->method = before;
    return result;
}
