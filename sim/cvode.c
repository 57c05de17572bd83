/*
 * SUNDIALS CVODE (Hindmarsh et al., ACM TOMS 31 (2005) 363): multistep methods that choose step and order.
 * cvode-adams, up to order 12 by fixed-point iteration, for what moves freely; cvode-bdf, up to order 5 by
 * Newton with matrix-free GMRES, for stiff springs: Jacobian products are the exact ones (jacobian.h),
 * preconditioned by points.
 *
 * The vector is all positions, all velocities, then the scalars of the state. Its norm is that of weights.h,
 * so the tolerance means what it means to rk-adaptive; scalars count by their own size at the start, those
 * that begin at nothing by what weights.h measures them in, or not at all; each of a body's counts as all
 * points together. Scalars that only record are integrated afterwards by Gauss's rule over the interpolant,
 * three forces a step, so that the run does not notice them.
 *
 * What the library remembers cannot be saved. So a run of it starts anew at every event, and after RUN_STEPS
 * steps; the blocks hold the state at its start, and a state that was restored is reached again by repeating
 * the steps since then, bit by bit.
 */
#include "sim/cvode_solver.h"
#include "sim/guard.h"
#include "sim/ledger.h"
#include "sim/methods.h"
#include "sim/vectors.h"
#include "sim/weights.h"

#include <cvode/cvode.h>
#include <float.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>

/* A restart costs some 20 short steps: a few in a hundred. */
enum { RUN_STEPS = 1000 };
enum { START_POSITION, START_VELOCITY }; /* in sim->scratch; the rest is the solver's */

struct run {
    uint64_t number, taken; /* of this run of the library, and the steps it has made */
    double start, due;      /* s: when it began; where it must stop */
};

struct cvode {
    struct run run; /* of the state at hand; a block */
    struct run at;  /* what the library's memory stands for */
    uint64_t runs;  /* the largest number that was given */
    double time;    /* s since the run began */
    uint32_t scalars;
    SUNContext context;
    void *memory;
    N_Vector y, inside;
    struct cvode_solver *solver;
    char message[160];
};

static double (*velocities(const struct sim *sim, N_Vector y))[4]
{
    return cvode_rows(y) + sim->point_count;
}

struct cvode_solver *cvode_solver_of(const struct sim *sim)
{
    return ((const struct cvode *)sim->method)->solver;
}

static double *scalars(const struct sim *sim, N_Vector y)
{
    return NV_DATA_S(y) + 8 * (size_t)sim->point_count;
}

static void load(struct sim *sim, N_Vector y)
{
    const struct cvode *cvode = sim->method;
    cvode_load_points(sim, y);
    for (uint32_t i = 0; i < cvode->scalars; i++)
        sim->scalar[i] = scalars(sim, y)[i];
}

/* y' = (v, f/m, rate). Forces that are no numbers ask for a shorter step. */
static int derivative(realtype t, N_Vector y, N_Vector rate, void *context)
{
    (void)t;
    struct sim *sim = context;
    const struct cvode *cvode = sim->method;
    load(sim, y);
    sim_forces(sim);
    vector_copy(sim, cvode_rows(rate), sim->velocity);
    vector_over_mass(sim, velocities(sim, rate), sim->force);
    for (uint32_t i = 0; i < cvode->scalars; i++)
        scalars(sim, rate)[i] = sim->scalar_rate[i];
    return isfinite(vector_dot(sim, sim->force, sim->force)) ? 0 : 1;
}

/* The library divides the sum of squares by all numbers of a row and takes the root. */
static int weights(N_Vector y, N_Vector weight, void *context)
{
    const struct sim *sim = context;
    const struct cvode *cvode = sim->method;
    const double length = (double)NV_LENGTH_S(y), tolerance = sim->scene->time.tolerance;
    double(*x)[4] = cvode_rows(weight), (*v)[4] = velocities(sim, weight);
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct sim_balloon *b = &sim->balloons[i];
        const double place = sqrt(length / sim->point_count) / (tolerance * b->radius);
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            for (int k = 0; k < 4; k++) {
                x[p][k] = place;
                v[p][k] = place / b->breathing_rate;
            }
    }
    for (uint32_t i = 0; i < cvode->scalars; i++) {
        const double body = weights_of_body(sim, i),
                     size = fmax(fabs(sim->scalar_scratch[START_POSITION][i]), weights_of_growing(sim, i));
        scalars(sim, weight)[i] = body > 0   ? sqrt(length) / (tolerance * body)
                                  : size > 0 ? 1 / (tolerance * size)
                                             : DBL_MIN;
    }
    return 0;
}

static void keep_message(int code, const char *module, const char *function, char *text, void *context)
{
    (void)code, (void)module, (void)function;
    struct cvode *cvode = context;
    snprintf(cvode->message, sizeof cvode->message, "%s", text);
}

/* The library begins at the run's start. */
static int begin(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    vector_copy(sim, cvode_rows(cvode->y), sim->scratch[START_POSITION]);
    vector_copy(sim, velocities(sim, cvode->y), sim->scratch[START_VELOCITY]);
    for (uint32_t i = 0; i < cvode->scalars; i++)
        scalars(sim, cvode->y)[i] = sim->scalar_scratch[START_POSITION][i];
    cvode->time = 0;
    cvode->at = cvode->run;
    cvode->at.taken = 0;
    const double stop = cvode->run.due - cvode->run.start;
    int code = CVodeReInit(cvode->memory, 0, cvode->y);
    if (code >= 0)
        code = CVodeSetMaxStep(cvode->memory, sim->step);
    return code < 0 ? code : CVodeSetStopTime(cvode->memory, isfinite(stop) ? stop : 1e300);
}

static int step(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    const int code = CVode(cvode->memory, sim->step, cvode->y, &cvode->time, CV_ONE_STEP);
    if (code >= 0)
        cvode->at.taken++;
    return code;
}

/* A new run from the state at hand. */
static int begin_anew(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    vector_copy(sim, sim->scratch[START_POSITION], sim->position);
    vector_copy(sim, sim->scratch[START_VELOCITY], sim->velocity);
    for (uint32_t i = 0; i < cvode->scalars; i++)
        sim->scalar_scratch[START_POSITION][i] = sim->scalar[i];
    if (cvode->runs < cvode->run.number)
        cvode->runs = cvode->run.number;
    cvode->run = (struct run){++cvode->runs, 0, sim->time, sim->due};
    return begin(sim);
}

static bool is_at_hand(const struct sim *sim)
{
    const struct cvode *cvode = sim->method;
    const size_t rows = sim->point_count * sizeof *sim->position;
    return !memcmp(cvode_rows(cvode->y), sim->position, rows) &&
           !memcmp(velocities(sim, cvode->y), sim->velocity, rows);
}

/* A state that was restored: the steps of its run up to it. The state at hand waits in `inside`. */
static int repeat(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    vector_copy(sim, cvode_rows(cvode->inside), sim->position);
    vector_copy(sim, velocities(sim, cvode->inside), sim->velocity);
    for (uint32_t i = 0; i < cvode->scalars; i++)
        scalars(sim, cvode->inside)[i] = sim->scalar[i];
    int code = begin(sim);
    while (code >= 0 && cvode->at.taken < cvode->run.taken)
        code = step(sim);
    load(sim, cvode->inside);
    return code;
}

/* Brings the library to the state at hand. */
static int prepare(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    const struct run *run = &cvode->run;
    const bool goes_on = run->taken > 0 && run->taken < RUN_STEPS && !sim->changed && run->due == sim->due;
    const bool restored = run->number != cvode->at.number || run->taken != cvode->at.taken;
    int code = 0;
    if (goes_on && restored)
        code = repeat(sim);
    if (code < 0)
        return code;
    return goes_on && is_at_hand(sim) ? 0 : begin_anew(sim);
}

/* Those that only record, as they were at the last step's start, go on until `back` s before its end, by
 * three points of Gauss (order 6). */
static void record_until(struct sim *sim, double back)
{
    static const double node[3] = {-0.77459666924148338, 0, 0.77459666924148338}, /* sqrt(3/5) */
        weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    struct cvode *cvode = sim->method;
    const double span = sim->taken - back;
    for (int k = 0; k < 3 && cvode->scalars < sim->scalar_count; k++) {
        if (CVodeGetDky(cvode->memory, cvode->time - back - span * (1 - node[k]) / 2, 0, cvode->inside))
            continue;
        load(sim, cvode->inside);
        ledger_forces(sim);
        for (uint32_t i = cvode->scalars; i < sim->scalar_count; i++)
            sim->scalar[i] += weight[k] * span * sim->scalar_rate[i];
    }
}

static void record(struct sim *sim)
{
    const struct cvode *cvode = sim->method;
    for (uint32_t i = cvode->scalars; i < sim->scalar_count; i++)
        sim->scalar_scratch[START_VELOCITY][i] = sim->scalar[i];
    record_until(sim, 0);
}

static void look(struct sim *sim, double back)
{
    const struct cvode *cvode = sim->method;
    for (uint32_t i = cvode->scalars; i < sim->scalar_count; i++)
        sim->scalar[i] = sim->scalar_scratch[START_VELOCITY][i];
    record_until(sim, back);
    if (CVodeGetDky(cvode->memory, cvode->time - back, 0, cvode->inside) == 0)
        load(sim, cvode->inside);
}

static enum status advance(struct sim *sim, double longest, struct error *err)
{
    struct cvode *cvode = sim->method;
    double allowed; /* the library sees to that, and knows its longest step and where to stop */
    (void)longest;
    const enum status status = guard_longest_step(sim, &allowed, err);
    if (status)
        return status;
    cvode->message[0] = 0;
    int code = prepare(sim);
    const double before = cvode->time;
    if (code >= 0)
        code = step(sim);
    if (code < 0) {
        load(sim, cvode->y);
        return error_set(err, STATUS_DIVERGED,
                         "%s: diverged at time %g (step %llu): %s: %s (time.tolerance is %g)",
                         sim->scene->path, sim->time, (unsigned long long)sim->steps, sim->integrator->name,
                         cvode->message, sim->scene->time.tolerance);
    }
    cvode->run.taken = cvode->at.taken;
    sim->taken = code == CV_TSTOP_RETURN ? sim->due - sim->time : cvode->time - before;
    record(sim);
    load(sim, cvode->y);
    return STATUS_OK;
}

static size_t blocks(struct sim *sim, struct sim_block *list)
{
    struct cvode *cvode = sim->method;
    const size_t rows = sim->point_count * sizeof *sim->position;
    list[0] = (struct sim_block){"cvode's run", &cvode->run, sizeof cvode->run};
    list[1] = (struct sim_block){"position at its start", sim->scratch[START_POSITION], rows};
    list[2] = (struct sim_block){"velocity at its start", sim->scratch[START_VELOCITY], rows};
    list[3] = (struct sim_block){"scalars at its start", sim->scalar_scratch[START_POSITION],
                                 cvode->scalars * sizeof(double)};
    return 4;
}

static void close(struct sim *sim)
{
    struct cvode *cvode = sim->method;
    if (!cvode)
        return;
    if (cvode->memory)
        CVodeFree(&cvode->memory);
    cvode_solver_close(sim, cvode->solver);
    if (cvode->y)
        N_VDestroy(cvode->y);
    if (cvode->inside)
        N_VDestroy(cvode->inside);
    if (cvode->context)
        SUNContext_Free(&cvode->context);
    free(cvode);
}

/* Makes everything that a run needs; false when memory is not enough. */
static bool make(struct sim *sim, struct cvode *cvode, int method)
{
    if (SUNContext_Create(NULL, &cvode->context))
        return false;
    cvode->y = N_VNew_Serial(8 * (sunindextype)sim->point_count + cvode->scalars, cvode->context);
    cvode->inside = cvode->y ? N_VClone(cvode->y) : NULL;
    cvode->memory = CVodeCreate(method, cvode->context);
    if (!cvode->y || !cvode->inside || !cvode->memory)
        return false;
    N_VConst(0, cvode->y);
    CVodeSetErrHandlerFn(cvode->memory, keep_message, cvode);
    sim->bytes += (size_t)NV_LENGTH_S(cvode->y) * sizeof(double) *
                  12; /* with the library's own, on average */
    return !CVodeInit(cvode->memory, derivative, 0, cvode->y) && !CVodeSetUserData(cvode->memory, sim) &&
           !CVodeWFtolerances(cvode->memory, weights) &&
           cvode_solver_open(sim, cvode->memory, cvode->y, cvode->context, method == CV_BDF, &cvode->solver);
}

static enum status open_method(struct sim *sim, int method, struct error *err)
{
    struct cvode *cvode = sim->method = calloc(1, sizeof *cvode);
    if (!cvode)
        return error_no_memory(err, "the method");
    cvode->scalars = sim->scalar_count;
    return make(sim, cvode, method) ? weights_open(sim, err) : error_no_memory(err, "SUNDIALS CVODE");
}

static enum status open_adams(struct sim *sim, struct error *err)
{
    return open_method(sim, CV_ADAMS, err);
}

static enum status open_bdf(struct sim *sim, struct error *err)
{
    return open_method(sim, CV_BDF, err);
}

const struct integrator integrator_cvode_adams = {.name = "cvode-adams",
                                                  .order = 12,
                                                  .flags = INTEGRATOR_ADAPTIVE,
                                                  .vectors = CVODE_VECTORS,
                                                  .oscillation_limit = INFINITY,
                                                  .decay_limit = INFINITY,
                                                  .open = open_adams,
                                                  .close = close,
                                                  .advance = advance,
                                                  .blocks = blocks,
                                                  .look = look,
                                                  .source = "SUNDIALS CVODE, Adams-Moulton, fixed point"};

const struct integrator integrator_cvode_bdf = {.name = "cvode-bdf",
                                                .order = 5,
                                                .flags = INTEGRATOR_ADAPTIVE | INTEGRATOR_IMPLICIT,
                                                .vectors = CVODE_VECTORS,
                                                .oscillation_limit = INFINITY,
                                                .decay_limit = INFINITY,
                                                .open = open_bdf,
                                                .close = close,
                                                .advance = advance,
                                                .blocks = blocks,
                                                .look = look,
                                                .source = "SUNDIALS CVODE, BDF, Newton with GMRES"};
