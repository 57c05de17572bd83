/*
 * The embedded Runge-Kutta pair RK5(4)7M of Dormand & Prince, J. Comp. Appl. Math. 6 (1980) 19: steps of
 * fifth order, an estimate of their error, and states inside a step to fourth order without another force.
 *
 * A step is accepted when the estimate is within the tolerance: RMS over the points, of positions in mean
 * radii and of velocities in mean radii times the rate at which the balloon breathes (weights.h). The next
 * step's length follows from this error and the last one (a PI controller: Gustafsson, ACM TOMS 17 (1991)
 * 533; constants of Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.4 and IV.2).
 * The worst of the scalars counts as well, by its size or by what would come of it in the time of a breath at
 * its rate, or as a point does where it is a body's, or by what fills a balloon where it records what came
 * into that, or by the mean edge where it is what a spring gave way, but not those that only record for the
 * ledger. What flows between balloons sets a longest step (guard.h).
 *
 * The last stage of a step is the first of the next. It is evaluated anew where that may not hold: after
 * something broke, and when the state is not the one that the last step left.
 */
#include "sim/guard.h"
#include "sim/methods.h"
#include "sim/runge_kutta.h"
#include "sim/vectors.h"
#include "sim/weights.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct runge_kutta *const pair = &runge_kutta_dormand_prince;
enum { STAGES = 7, LAST = STAGES - 1 };

/* Fifth order's weights less fourth order's. */
static const double error_weights[STAGES] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                             -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/* What the state inside a step needs beyond its ends (Hairer, Norsett & Wanner, the constants of DOPRI5). */
static const double inside_weights[STAGES] = {-12715105075.0 / 11282082432,  0,
                                              87487479700.0 / 32700410799,   -10690763975.0 / 1880347072,
                                              701980252875.0 / 199316789632, -1453857185.0 / 822651844,
                                              69997945.0 / 29380423};

struct adaptive {
    struct {
        double next;       /* s: the step to try; 0: none has been taken */
        double last_error; /* of the last accepted step, in tolerances */
    } control;
    double taken;           /* s: the last accepted step */
    uint32_t scalars;       /* that steps are chosen by, and forces may depend on */
    uint64_t last_stage_of; /* number of the step whose last stage is at hand; 0: none */
};

static enum status open(struct sim *sim, struct error *err)
{
    struct adaptive *adaptive = sim->method = calloc(1, sizeof *adaptive);
    if (!adaptive)
        return error_no_memory(err, "the method");
    adaptive->scalars = sim->scalar_count;
    return weights_open(sim, err);
}

static void close(struct sim *sim)
{
    free(sim->method);
}

static size_t blocks(struct sim *sim, struct sim_block *list)
{
    struct adaptive *adaptive = sim->method;
    list[0] = (struct sim_block){"step control", &adaptive->control, sizeof adaptive->control};
    return 1;
}

static bool same_rows(const struct sim *sim, double (*a)[4], double (*b)[4])
{
    return !memcmp(a, b, sim->point_count * sizeof *a);
}

/* k_0: the last stage of the last step, where that is it. */
static void first_stage(struct sim *sim, const struct adaptive *adaptive)
{
    const bool known = !sim->changed && adaptive->last_stage_of == sim->steps && sim->steps > 0 &&
                       same_rows(sim, sim->scratch[LAST], sim->velocity);
    runge_kutta_begin(sim, pair);
    if (!known) {
        runge_kutta_stage(sim, pair, 0, 0);
        return;
    }
    vector_copy(sim, sim->scratch[0], sim->scratch[LAST]);
    vector_copy(sim, sim->scratch[STAGES], sim->scratch[STAGES + LAST]);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar_scratch[0][i] = sim->scalar_scratch[LAST][i];
}

/* A first step over which neither place nor speed moves by more than a hundredth of its measure. */
static double first_step(struct sim *sim, double longest)
{
    const double tolerance = sim->scene->time.tolerance;
    const double rate = tolerance * weights_norm(sim, sim->scratch[0], sim->scratch[STAGES], tolerance);
    return fmin(longest, rate > 0 ? 0.01 / rate : INFINITY);
}

/* Of the worst of them. */
static double error_of_scalars(const struct sim *sim, double dt)
{
    const struct adaptive *adaptive = sim->method;
    double worst = 0, breathing = 0;
    for (size_t i = 0; i < sim->balloon_count; i++)
        breathing = fmax(breathing, sim->balloons[i].breathing_rate);
    for (uint32_t i = 0; i < adaptive->scalars; i++) {
        double error = 0, rate = 0;
        for (int k = 0; k < STAGES; k++) {
            error += dt * error_weights[k] * sim->scalar_scratch[k][i];
            rate = fmax(rate, fabs(sim->scalar_scratch[k][i]));
        }
        const double body = weights_of_body(sim, i), own = fmax(fabs(sim->scalar[i]), rate / breathing),
                     size = body > 0 ? body : fmax(own, weights_of_growing(sim, i));
        const double part = fabs(error) / size;
        if (error != 0 && !(part <= worst)) /* no number is the worst */
            worst = part;
    }
    return worst / sim->scene->time.tolerance;
}

/* The error's estimate over the tolerance. Takes the place of k_1, which no result needs any more. */
static double error_of(struct sim *sim, double dt)
{
    struct vector_term terms[STAGES];
    for (int part = 0; part < 2; part++) {
        for (int i = 0; i < STAGES; i++)
            terms[i] = (struct vector_term){dt * error_weights[i], sim->scratch[part * STAGES + i]};
        vector_combine(sim, sim->scratch[part * STAGES + 1], NULL, terms, STAGES);
    }
    const double points = weights_norm(sim, sim->scratch[1], sim->scratch[STAGES + 1],
                                       sim->scene->time.tolerance);
    const double scalars = error_of_scalars(sim, dt);
    return isnan(points) || scalars <= points ? points : scalars;
}

/* How much longer the next step may be, after an error of `error` tolerances. */
static double growth(double error, double last_error)
{
    const double factor = 0.9 * pow(error, -0.7 / 5) * pow(last_error, 0.4 / 5);
    return fmin(5, fmax(0.2, factor)); /* an error of 0 gives infinity: 5 */
}

/* The state stays as it was before the step. */
static enum status refuse(struct sim *sim, double dt, struct error *err)
{
    vector_return_to(sim, 2 * STAGES);
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): no step down to %.2g s keeps time.tolerance = %g; the forces "
        "are without bounds, or the tolerance is below what numbers of 16 digits can give here",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, dt, sim->scene->time.tolerance);
}

/* Steps shorter and shorter until one is within the tolerance. */
static enum status advance(struct sim *sim, double longest, struct error *err)
{
    struct adaptive *adaptive = sim->method;
    double allowed;
    const enum status status = guard_longest_step(sim, &allowed, err);
    if (status)
        return status;
    first_stage(sim, adaptive);
    if (!(adaptive->control.next > 0)) {
        adaptive->control.next = first_step(sim, longest);
        adaptive->control.last_error = 1;
    }
    /* Before a change or the end, two equal steps rather than a long and a very short one. */
    const double next = fmin(adaptive->control.next, allowed);
    const bool near = longest < sim->step;
    double dt = next >= longest ? longest : near && next > longest / 2 ? longest / 2 : next;
    bool refused = false;
    for (;;) {
        for (int i = 1; i < STAGES; i++)
            runge_kutta_stage(sim, pair, i, dt); /* the last one leaves the new state */
        const double error = error_of(sim, dt);
        if (error <= 1) {
            const double factor = growth(error, adaptive->control.last_error);
            const double grown = dt * (refused ? fmin(1, factor) : factor);
            adaptive->control.next = dt < next && !refused ? fmax(next, grown) : grown;
            adaptive->control.last_error = fmax(error, 1e-4);
            break;
        }
        /* beyond a factor of 10 the error's power law says nothing; no number at all is beyond everything */
        dt *= error < 1e5 ? fmax(0.2, 0.9 * pow(error, -1.0 / 5)) : 0.1;
        refused = true;
        if (!(dt > 8 * DBL_EPSILON * (sim->time + longest)))
            return refuse(sim, dt, err);
    }
    sim->taken = adaptive->taken = dt;
    adaptive->last_stage_of = sim->steps + 1;
    return STATUS_OK;
}

/* With s from 0 to 1 over the step, y(s) = y_0 + dt sum w_i(s) k_i: Shampine's interpolant in the form of
 * Hairer, Norsett & Wanner II.6, its differences written out for each k_i. */
static void look(struct sim *sim, double back)
{
    const struct adaptive *adaptive = sim->method;
    const double s = 1 - back / adaptive->taken;
    double weights[STAGES];
    for (int i = 0; i < STAGES; i++) {
        const double all = pair->weights[i], first = i == 0, last = i == LAST;
        weights[i] =
            s * (all + (1 - s) * (first - all + s * (2 * all - first - last + (1 - s) * inside_weights[i])));
    }
    runge_kutta_state(sim, pair, weights, adaptive->taken);
}

const struct integrator integrator_rk_adaptive = {.name = "rk-adaptive",
                                                  .order = 5,
                                                  .flags = INTEGRATOR_ADAPTIVE,
                                                  .vectors = RUNGE_KUTTA_VECTORS(STAGES),
                                                  .oscillation_limit = INFINITY,
                                                  .decay_limit = INFINITY,
                                                  .open = open,
                                                  .close = close,
                                                  .advance = advance,
                                                  .blocks = blocks,
                                                  .look = look,
                                                  .source = "Dormand & Prince 1980, RK5(4)7M"};
