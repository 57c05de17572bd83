/* How long runs can be compared, and how much of that there is time for. */
#include "common/scene_fields.h"
#include "sim/accuracy_plan.h"
#include "sim/guard.h"

#include <math.h>
#include <string.h>

/* Until the schedule changes the step: from there on steps of the ladder would all be the same. */
static double same_step_until(const struct scene *scene)
{
    double until = INFINITY;
    for (size_t i = 0; i < scene->schedule_count; i++)
        for (size_t k = 0; k < scene->schedule[i].change_count; k++)
            if (!strcmp(scene->schedule[i].change[k].field->key, "step"))
                until = fmin(until, scene->schedule[i].at);
    return until;
}

/* Steps until one edge in a hundred has let go, or the end, or until there is no time
 * left, which is no error. */
static enum status watch(struct accuracy_run *run, struct accuracy_plan *plan, struct error *err)
{
    struct accuracy_table *table = plan->table;
    struct error slow = {0};
    enum status status = STATUS_OK;
    while (!status && !sim_at_end(&run->sim) && !isfinite(table->burst)) {
        status = accuracy_step(run, &plan->subject, &slow);
        if (run->sim.broken && !isfinite(table->first_break))
            table->first_break = run->sim.time;
        if (run->sim.broken > run->sim.edge_count / 100)
            table->burst = run->sim.time;
    }
    if (status && status != STATUS_RESOURCE) {
        *err = slow;
        return status;
    }
    if (run->sim.steps == 0)
        return error_set(err, STATUS_INPUT, "time.end = %g is over before a step of time.step = %g",
                         run->scene.time.end, run->scene.time.step);
    return STATUS_OK;
}

enum status accuracy_find_reach(struct accuracy_plan *plan, struct error *err)
{
    const struct accuracy_dials dials = accuracy_first_dials(plan->subject.scene);
    struct accuracy_table *table = plan->table;
    struct accuracy_run run;
    table->first_break = table->burst = INFINITY;
    enum status status = accuracy_open(&run, &plan->subject, &dials, err);
    run.limit = ACCURACY_FIRST_SHARE * plan->subject.options->seconds;
    if (!status)
        status = watch(&run, plan, err);
    if (status) {
        accuracy_close(&run);
        return status == STATUS_INTERRUPTED ? status : error_prefix(err, "--accuracy-cost, the first run");
    }
    plan->evaluation = run.seconds / (double)run.evaluations;
    plan->reach = run.sim.time;
    table->met = run.sim.met;
    const char *reason = sim_at_end(&run.sim) ? "the end" : "what there is time for";
    if (isfinite(table->first_break)) {
        plan->reach = 0.9 * table->first_break; /* other methods break a little earlier */
        reason = "before the first edge lets go";
    }
    if (plan->reach > same_step_until(plan->subject.scene)) {
        plan->reach = same_step_until(plan->subject.scene);
        reason = "before the schedule changes the step";
    }
    snprintf(table->span_reason, sizeof table->span_reason, "%s", reason);
    table->burst_end = isfinite(table->burst) ? fmin(3 * table->burst, plan->subject.scene->time.end)
                                              : INFINITY;
    accuracy_close(&run);
    return STATUS_OK;
}

/* Four times as many steps must fit into what one row may take, at six evaluations each; and whole
 * numbers of steps twice, four times and eight times as long must fit in between two of the times, as far
 * as there are that many. */
void accuracy_set_span(struct accuracy_plan *plan)
{
    struct accuracy_table *table = plan->table;
    const double step = plan->subject.scene->time.step,
                 row = ACCURACY_LADDERS_SHARE * plan->subject.options->seconds / (double)plan->methods / 2;
    const double wanted = floor(plan->reach / ACCURACY_TIMES / step * (1 + 1e-9)),
                 possible = floor(row / (4 * 6 * plan->evaluation * ACCURACY_TIMES));
    if (possible < wanted)
        snprintf(table->span_reason, sizeof table->span_reason, "what there is time for");
    plan->quarter = (uint32_t)fmin(fmin(wanted, fmax(possible, 1)), 1e6);
    for (uint32_t coarse = 8; coarse > 1; coarse /= 2)
        if (plan->quarter >= 2 * coarse) {
            plan->quarter -= plan->quarter % coarse;
            break;
        }
    table->longest_step = plan->quarter ? plan->quarter * step : plan->reach / ACCURACY_TIMES;
    plan->step = table->step = plan->quarter ? step : table->longest_step;
    table->span = ACCURACY_TIMES * table->longest_step;
    if (table->span < plan->reach * (1 - 1e-9) && !strcmp(table->span_reason, "the end"))
        snprintf(table->span_reason, sizeof table->span_reason, "in whole steps, before the end");
    for (int i = 0; i < ACCURACY_TIMES; i++)
        plan->subject.time[i] = (i + 1) * table->longest_step;
}
