#include "sim/accuracy_plan.h"
#include "sim/auto.h"
#include "sim/guard.h"

#include <math.h>
#include <string.h>

/* Nobody asks for less, and rounding is near. */
static const double error_least = 1e-11;
/* Of the radius: such a run has nothing to do with the scene any more. */
static const double error_most = 0.1;

bool accuracy_goes_by_tolerance(const struct integrator *method)
{
    return method->flags & INTEGRATOR_ADAPTIVE || method->choose;
}

struct accuracy_dials accuracy_dials_of(const struct accuracy_plan *plan, const struct integrator *method,
                                        double dial)
{
    const struct scene_time *time = &plan->subject.scene->time;
    struct accuracy_dials dials = {method, dial, time->tolerance, plan->table->span, SCENE_GUARD_OFF, 0};
    if (!accuracy_goes_by_tolerance(method))
        return dials;
    dials.tolerance = dial;
    dials.step = method->choose ? plan->step : plan->table->longest_step;
    dials.guard = SCENE_GUARD_SUBSTEP;
    return dials;
}

/* One method's walk from coarse to fine. */
struct ladder {
    const struct integrator *method;
    double dial, left; /* s, of what it may take */
    double per_step;   /* s, by the last run */
    size_t first;      /* of its rows */
    bool over;
    struct accuracy_failure failure;
};

/* As --set takes it. */
static void set_setting(const struct accuracy_plan *plan, const struct ladder *ladder, char *text,
                        size_t size)
{
    if (ladder->method->flags & INTEGRATOR_ADAPTIVE)
        snprintf(text, size, "time.tolerance=%g time.step=%.10g", ladder->dial, plan->table->longest_step);
    else
        snprintf(text, size, ladder->method->choose ? "time.tolerance=%g" : "time.step=%.10g", ladder->dial);
}

/* A failure is a line of the table, with the first and the last setting that led to it. */
static void note_failure(const struct accuracy_plan *plan, struct ladder *ladder, const char *reason)
{
    struct accuracy_failure *failure = &ladder->failure;
    set_setting(plan, ladder, failure->last, sizeof failure->last);
    if (!failure->method)
        memcpy(failure->first, failure->last, sizeof failure->first);
    failure->method = ladder->method;
    const char *diverged = strstr(reason, "diverged at time");
    if (diverged) /* where and why is more than a line needs */
        snprintf(failure->reason, sizeof failure->reason, "%.*s", (int)strcspn(diverged, "(:;") - 1,
                 diverged);
    else
        snprintf(failure->reason, sizeof failure->reason, "%s", reason);
}

static double relative(double value, double reference)
{
    return reference != 0 ? fabs(value / reference - 1) : (double)NAN;
}

static void compare(const struct accuracy_plan *plan, const struct sim *sim,
                    const struct accuracy_states *states, struct accuracy_row *row)
{
    const struct accuracy_states *r = &plan->reference;
    row->error = accuracy_distance(sim, states, r);
    for (int i = 0; i < ACCURACY_TIMES; i++) {
        row->volume = fmax(row->volume, relative(states->volume[i], r->volume[i]));
        row->pressure = fmax(row->pressure, relative(states->pressure[i], r->pressure[i]));
        row->energy = fmax(row->energy, relative(states->energy[i], r->energy[i]));
    }
}

/* "verlet, 4 substeps", of what auto says. */
static void note_choice(const struct sim *sim, struct accuracy_row *row)
{
    char text[256] = "";
    uint64_t choices = 0;
    if (auto_describe(sim, &choices, text, sizeof text))
        snprintf(row->chose, sizeof row->chose, "%.*s", (int)strcspn(text, ":"), text);
}

/* The quickest of a few runs, where one is over in no time. */
static double best_seconds(struct accuracy_plan *plan, const struct accuracy_dials *dials,
                           struct accuracy_states *states, double seconds)
{
    enum { TIMES = 5 };
    const double enough = 0.03;
    double spent = seconds;
    for (int i = 1; i < TIMES && spent < enough; i++) {
        struct accuracy_run run;
        struct error ignored;
        if (accuracy_go(&run, &plan->subject, dials, INFINITY, states, &ignored))
            break;
        spent += run.seconds;
        seconds = fmin(seconds, run.seconds);
        accuracy_close(&run);
    }
    return seconds;
}

/* By which power of the steps' number the error fell; of a few steps more that would say nothing. */
static double order_between(const struct accuracy_row *coarse, const struct accuracy_row *fine)
{
    const double steps = (double)fine->steps / (double)coarse->steps;
    return steps >= 1.1 ? log(coarse->error / fine->error) / log(steps) : (double)NAN;
}

/* auto: whether it took the same method, in whatever many substeps. */
static bool choose_alike(const struct accuracy_row *a, const struct accuracy_row *b)
{
    const size_t name = strcspn(a->chose, ",");
    return name == strcspn(b->chose, ",") && !strncmp(a->chose, b->chose, name);
}

static void add_row(struct accuracy_plan *plan, struct ladder *ladder, struct accuracy_row *row)
{
    struct accuracy_table *table = plan->table;
    row->order = NAN;
    if (table->count > ladder->first && choose_alike(row - 1, row))
        row->order = order_between(row - 1, row);
    table->count++;
}

static enum status measure_row(struct accuracy_plan *plan, struct ladder *ladder,
                               struct accuracy_states *states, struct error *err)
{
    struct accuracy_table *table = plan->table;
    struct accuracy_row *row = &table->rows[table->count];
    const struct accuracy_dials dials = accuracy_dials_of(plan, ladder->method, ladder->dial);
    struct accuracy_run run;
    enum status status = accuracy_go(&run, &plan->subject, &dials, 2 * ladder->left, states, err);
    ladder->left -= run.seconds;
    if (status)
        return status;
    *row = (struct accuracy_row){.method = ladder->method,
                                 .dial = ladder->dial,
                                 .steps = run.sim.steps,
                                 .evaluations = run.evaluations,
                                 .linear_iterations = (double)run.products / 2,
                                 .volume = NAN,
                                 .pressure = NAN,
                                 .energy = NAN};
    set_setting(plan, ladder, row->setting, sizeof row->setting);
    compare(plan, &run.sim, states, row);
    note_choice(&run.sim, row);
    ladder->per_step = run.seconds / (double)run.sim.steps;
    accuracy_close(&run);
    if (row->error < fmax(10 * table->agreement, error_least)) {
        table->left_out++;
        ladder->over = true;
    } else if (row->error > error_most || isnan(row->error)) {
        char text[64];
        snprintf(text, sizeof text, "positions are off by %.2g radii", row->error);
        note_failure(plan, ladder, text);
    } else {
        row->seconds = best_seconds(plan, &dials, states, run.seconds);
        add_row(plan, ladder, row);
    }
    return STATUS_OK;
}

/* What the next run takes: in proportion to its steps, or, as tolerances go down, half as much again. */
static double prediction(const struct accuracy_plan *plan, const struct ladder *ladder)
{
    const struct accuracy_table *table = plan->table;
    if (!accuracy_goes_by_tolerance(ladder->method))
        return ladder->per_step * table->span / ladder->dial;
    return table->count > ladder->first ? 1.5 * table->rows[table->count - 1].seconds : 0;
}

/* One run, unless there is no time left for it. */
static enum status climb(struct accuracy_plan *plan, struct ladder *ladder, struct accuracy_states *states,
                         struct error *err)
{
    const bool is_empty = plan->table->count == ladder->first;
    if (prediction(plan, ladder) > ladder->left) {
        ladder->over = true;
        if (is_empty && !ladder->failure.method)
            note_failure(plan, ladder, "takes too long");
        else if (is_empty)
            strncat(ladder->failure.reason, "; what is finer takes too long",
                    sizeof ladder->failure.reason - strlen(ladder->failure.reason) - 1);
        return STATUS_OK;
    }
    enum status status = measure_row(plan, ladder, states, err);
    if (status == STATUS_OK || status == STATUS_INTERRUPTED || status == STATUS_NO_MEMORY)
        return status;
    ladder->over = status == STATUS_RESOURCE ||
                   status == STATUS_RANGE; /* not there, too slow, or too tight */
    if (!ladder->over || is_empty)
        note_failure(plan, ladder, err->text);
    return STATUS_OK;
}

static enum status walk(struct accuracy_plan *plan, const struct integrator *method,
                        struct accuracy_states *states, struct error *err)
{
    struct accuracy_table *table = plan->table;
    const bool tolerant = accuracy_goes_by_tolerance(method);
    const double evaluations = method->evaluations ? method->evaluations : 10;
    uint32_t coarse = 8;
    while (coarse > 1 && (plan->quarter == 0 || plan->quarter % coarse))
        coarse /= 2;
    struct ladder ladder = {.method = method,
                            .dial = tolerant ? 1e-2 : coarse * plan->step,
                            .left = ACCURACY_LADDERS_SHARE * plan->subject.options->seconds /
                                    (double)plan->methods,
                            .per_step = evaluations * plan->evaluation,
                            .first = table->count};
    const char *unsuited = accuracy_unsuited(plan->subject.scene, method);
    if (unsuited) {
        note_failure(plan, &ladder, unsuited);
        ladder.over = true;
    }
    enum status status = STATUS_OK;
    while (!status && !ladder.over && table->count < ladder.first + ACCURACY_LADDER_ROWS &&
           ladder.dial > 1e-13) {
        status = climb(plan, &ladder, states, err);
        ladder.dial /= tolerant ? 10 : 2;
    }
    if (ladder.failure.method)
        table->failures[table->failure_count++] = ladder.failure;
    return status;
}

static void find_best(struct accuracy_table *table)
{
    for (size_t i = 0; i < table->count; i++) {
        struct accuracy_row *row = &table->rows[i];
        row->best = !row->method->choose;
        for (size_t k = 0; k < table->count && row->best; k++) {
            const struct accuracy_row *other = &table->rows[k];
            if (!other->method->choose && other->error < row->error && other->seconds < row->seconds)
                row->best = false;
        }
    }
}

static enum status walk_all(struct accuracy_plan *plan, struct error *err)
{
    struct accuracy_states states = {0};
    enum status status = STATUS_OK;
    for (size_t i = 0; integrators[i] && !status; i++) {
        plan->subject.done = ACCURACY_REFERENCES_DONE + 0.5 * (double)i / (double)plan->methods;
        status = walk(plan, integrators[i], &states, err);
    }
    accuracy_states_close(&states);
    find_best(plan->table);
    return status;
}

/* The guard knows it for the method of a sim that is open. */
static enum status find_stable(struct accuracy_plan *plan, struct error *err)
{
    const struct scene_time *time = &plan->subject.scene->time;
    const struct accuracy_dials dials = {
        integrator_find("symplectic-euler"), time->step, time->tolerance, time->end, SCENE_GUARD_SUBSTEP, 0};
    struct accuracy_run run;
    enum status status = accuracy_open(&run, &plan->subject, &dials, err);
    if (!status)
        plan->stable = guard_stable_step(&run.sim);
    accuracy_close(&run);
    return status;
}

enum status accuracy_measure(const struct scene *scene, const struct mesh *meshes,
                             const struct pricing_options *options, struct accuracy_table *table,
                             struct error *err)
{
    *table = (struct accuracy_table){0};
    struct accuracy_plan plan = {.subject = {.scene = scene, .meshes = meshes, .options = options},
                                 .table = table};
    while (integrators[plan.methods])
        plan.methods++;
    enum status status = find_stable(&plan, err);
    plan.subject.part = ACCURACY_FIRST_DONE;
    if (!status)
        status = accuracy_find_reach(&plan, err);
    plan.subject.done = ACCURACY_FIRST_DONE;
    plan.subject.part = 0;
    if (!status) {
        accuracy_set_span(&plan);
        status = accuracy_find_reference(&plan, err);
    }
    if (!status)
        status = walk_all(&plan, err);
    if (!status)
        status = accuracy_find_bursts(&plan, err);
    accuracy_states_close(&plan.reference);
    return status;
}

/* A method's own seconds for an error, between the first two rows around it. */
static double seconds_for(const struct accuracy_table *table, const struct integrator *method, double error)
{
    double least = INFINITY;
    const struct accuracy_row *before = NULL;
    for (size_t i = 0; i < table->count; i++) {
        const struct accuracy_row *row = &table->rows[i];
        if (row->method != method || table->span / (double)row->steps > table->step * (1 + 1e-9))
            continue;
        if (row->error <= error && before && before->error > error) {
            const double part = log(before->error / error) / log(before->error / row->error);
            least = fmin(least, before->seconds * pow(row->seconds / before->seconds, part));
        } else if (row->error <= error) {
            least = fmin(least, row->seconds);
        }
        before = row;
    }
    return least;
}

double accuracy_fastest(const struct accuracy_table *table, double error, const struct integrator **method)
{
    double least = INFINITY;
    for (size_t i = 0; integrators[i]; i++) {
        const double seconds = integrators[i]->choose ? INFINITY : seconds_for(table, integrators[i], error);
        if (seconds < least) {
            least = seconds;
            *method = integrators[i];
        }
    }
    return least;
}
