/* After the first break: what many runs do that differ by next to nothing at their start. */
#include "sim/accuracy_plan.h"

#include <math.h>

/* Sums over the members so far. */
struct sum {
    double values, squares;
};

static void add(struct sum *sum, double value)
{
    sum->values += value;
    sum->squares += value * value;
}

static struct accuracy_statistic statistic(const struct sum *sum, int count)
{
    const double mean = sum->values / count, square = sum->squares - count * mean * mean;
    return (struct accuracy_statistic){mean, sqrt(fmax(square, 0) / (count - 1))};
}

struct ensemble {
    struct sum time, pieces, largest;
    int count;
};

/* One run through the burst. */
static enum status go_through(struct accuracy_run *run, const struct accuracy_plan *plan,
                              struct ensemble *ensemble, struct error *err)
{
    struct sim *sim = &run->sim;
    double burst = plan->table->burst_end;
    enum status status = STATUS_OK;
    while (!status && !sim_at_end(sim)) {
        status = accuracy_step(run, &plan->subject, err);
        if (sim->broken > sim->edge_count / 100)
            burst = fmin(burst, sim->time);
    }
    if (status)
        return status;
    const struct sim_measures m = sim_measure(sim);
    add(&ensemble->time, burst);
    add(&ensemble->pieces, m.pieces);
    add(&ensemble->largest, m.area > 0 ? m.largest_piece_area / m.area : 0);
    ensemble->count++;
    return STATUS_OK;
}

/* As many members as there is time for; none, where there is none for the fewest that say anything, which the
 * first member shows. What a method cannot do it does not do in the table either. */
static enum status run_ensemble(struct accuracy_plan *plan, struct accuracy_row *row, struct error *err)
{
    double left = ACCURACY_BURSTS_SHARE * plan->subject.options->seconds / (double)plan->methods;
    struct ensemble ensemble = {0};
    enum status status = STATUS_OK;
    for (uint64_t member = 1; member <= ACCURACY_MEMBERS && left > 0 && !status; member++) {
        struct accuracy_run run;
        struct accuracy_dials dials = accuracy_dials_of(plan, row->method, row->dial);
        dials.end = plan->table->burst_end;
        dials.step = fmin(dials.step, plan->step); /* what breaks, breaks at the end of a step */
        dials.member = member;
        status = accuracy_open(&run, &plan->subject, &dials, err);
        run.limit = left / fmax(1, ACCURACY_MEMBERS_LEAST - ensemble.count);
        if (!status)
            status = go_through(&run, plan, &ensemble, err);
        left -= run.seconds;
        accuracy_close(&run);
    }
    if (status == STATUS_INTERRUPTED || status == STATUS_NO_MEMORY)
        return status;
    if (ensemble.count >= ACCURACY_MEMBERS_LEAST)
        row->burst = (struct accuracy_burst){ensemble.count, statistic(&ensemble.time, ensemble.count),
                                             statistic(&ensemble.pieces, ensemble.count),
                                             statistic(&ensemble.largest, ensemble.count)};
    return STATUS_OK;
}

/* The row of the scene's own step or tolerance; or else of the next finer one. */
static struct accuracy_row *row_of(struct accuracy_table *table, const struct integrator *method, double dial)
{
    struct accuracy_row *found = NULL;
    for (size_t i = 0; i < table->count && !found; i++)
        if (table->rows[i].method == method && table->rows[i].dial <= dial * (1 + 1e-9))
            found = &table->rows[i];
    return found;
}

enum status accuracy_find_bursts(struct accuracy_plan *plan, struct error *err)
{
    const struct scene_time *time = &plan->subject.scene->time;
    enum status status = STATUS_OK;
    if (!isfinite(plan->table->burst_end))
        return STATUS_OK;
    for (size_t i = 0; integrators[i] && !status; i++) {
        const bool tolerant = accuracy_goes_by_tolerance(integrators[i]);
        struct accuracy_row *row = row_of(plan->table, integrators[i],
                                          tolerant ? time->tolerance : plan->step);
        plan->subject.done = 0.8 + 0.2 * (double)i / (double)plan->methods;
        if (row)
            status = run_ensemble(plan, row, err);
    }
    return status;
}
