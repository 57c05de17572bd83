/* The table of what accuracy costs: every method is in it, and its errors fall with its order. */
#include "balloon.h"
#include "sim/accuracy.h"
#include "support/slowdown.h"

#include <math.h>
#include <string.h>

/* A small balloon that swells and swings: nothing breaks but where a test wants it. */
#define CALM                                                                                    \
    SETTINGS("balloons[0].point_mass=1", "balloons[0].pressure=4", "balloons[0].threshold=100", \
             "time.end=0.8", "time.guard=off")
#define BURSTING                                                                                  \
    SETTINGS("balloons[0].point_mass=1", "balloons[0].threshold=1.2", "balloons[0].pressure=200", \
             "time.end=6", "time.guard=off")

static enum status measure(const char *const *settings, const struct pricing_options *options,
                           struct accuracy_table *table, struct error *err)
{
    struct balloon b;
    open_balloon(&b, 1, settings);
    const enum status status = accuracy_measure(&b.scene, &b.mesh, options, table, err);
    close_balloon(&b);
    return status;
}

static size_t rows_of(const struct accuracy_table *table, const struct integrator *method, size_t *first)
{
    size_t count = 0;
    for (size_t i = 0; i < table->count; i++)
        if (table->rows[i].method == method && count++ == 0)
            *first = i;
    return count;
}

/* By halving, where the coarser step is stable and not so coarse that higher terms count: from an error of
 * 1e-3 on. Rounding in 1e4 steps and the references' distance stay below a hundredth of 1e-9. */
static void check_ladder(const struct accuracy_row *row, size_t count)
{
    const bool tolerant = row->method->flags & INTEGRATOR_ADAPTIVE || row->method->choose;
    for (size_t i = 1; i < count; i++) {
        assert_true(row[i].steps >= row[i - 1].steps || tolerant);
        if (tolerant || row[i - 1].error > 1e-3 || row[i].error < 1e-9)
            continue;
        assert_true(row[i].error < row[i - 1].error);
        assert_near(row[i].order, row->method->order, 0.35);
    }
}

static void every_method_is_there_and_errors_fall_with_its_order(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    assert_ok(measure(CALM, &(struct pricing_options){.seconds = 10 * slowdown()}, &table, &err), &err);
    size_t methods = 0;
    for (; integrators[methods]; methods++) {
        size_t first = 0;
        const size_t count = rows_of(&table, integrators[methods], &first);
        bool failed = false;
        for (size_t i = 0; i < table.failure_count; i++)
            failed |= table.failures[i].method == integrators[methods];
        print_message("%s: %d rows%s\n", integrators[methods]->name, (int)count, failed ? ", failures" : "");
        assert_true(count > 0 || failed);
        if (count > 0)
            check_ladder(&table.rows[first], count);
    }
    assert_true(methods <= ACCURACY_FAILURES_MAX);
    assert_true(methods * ACCURACY_LADDER_ROWS <= ACCURACY_ROWS_MAX);
    assert_true(isinf(table.first_break));
    assert_near(table.span, 0.8, 1e-12); /* 32 steps: four times eight */
}

static void references_agree_ten_times_better_than_the_best_row(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    assert_ok(measure(CALM, &(struct pricing_options){.seconds = 2 * slowdown()}, &table, &err), &err);
    for (size_t i = 0; i < table.count; i++)
        assert_true(table.rows[i].error >= 10 * table.agreement);
    assert_true(table.agreement < 1e-10);
    const struct integrator *fastest = NULL;
    const double rough = accuracy_fastest(&table, 1e-2, &fastest),
                 fine = accuracy_fastest(&table, 1e-7, &fastest);
    assert_true(rough <= fine && isfinite(fine) && fastest && !fastest->choose);
    assert_true(isinf(accuracy_fastest(&table, 1e-15, &fastest)));
}

/* From Euler's method at one tolerance to Verlet's at the next the error falls by no order: 10.8 was one.
 * And a span of whole steps, which four times eight do not fill, says that it ends before the end. */
static void auto_has_no_order_where_it_takes_another_method(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    assert_ok(measure(SETTINGS("balloons[0].pressure=4", "balloons[0].threshold=50", "time.step=0.025",
                               "time.end=1"),
                      &(struct pricing_options){.seconds = 2 * slowdown()}, &table, &err),
              &err);
    size_t first = 0, others = 0;
    const size_t count = rows_of(&table, integrator_find("auto"), &first);
    for (const struct accuracy_row *row = &table.rows[first] + 1; row < &table.rows[first] + count; row++)
        if (strncmp(row->chose, row[-1].chose, strcspn(row->chose, ",") + 1) != 0) {
            assert_true(isnan(row->order));
            others++;
        }
    assert_true(others > 0);
    assert_near(table.span, 0.8, 1e-12);
    assert_string_equal(table.span_reason, "in whole steps, before the end");
}

static void the_span_ends_before_the_first_break_and_ensembles_go_past_it(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    int ensembles = 0;
    assert_ok(measure(BURSTING, &(struct pricing_options){.seconds = 2 * slowdown()}, &table, &err), &err);
    assert_true(isfinite(table.first_break) && table.span < table.first_break);
    assert_true(table.burst_end > table.burst && table.burst >= table.first_break);
    for (size_t i = 0; i < table.count; i++) {
        const struct accuracy_burst *b = &table.rows[i].burst;
        if (b->members == 0)
            continue;
        ensembles++;
        assert_true(b->time.mean > table.span && b->time.spread >= 0);
        assert_true(b->pieces.mean >= 0 && b->largest.mean >= 0 && b->largest.mean <= 1);
    }
    assert_true(ensembles >= 3);
}

/* Whose pump stops: nothing that flows goes by the length of a step, as nothing else does. By a kink a
 * tighter tolerance makes few steps more, by which no order can be told. */
static void references_agree_on_gas_as_well(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    assert_ok(measure(SETTINGS("balloons[0].gas.ambient=10", "balloons[0].gas.pump=1.5",
                               "balloons[0].gas.pump_until=1.3", "balloons[0].threshold=100", "time.end=0.8",
                               "time.guard=off"),
                      &(struct pricing_options){.seconds = 20 * slowdown()}, &table, &err),
              &err);
    print_message("# %g up to %g s\n", table.agreement, table.span);
    assert_near(table.span, 0.8, 1e-12);
    assert_true(table.agreement < 1e-6);
    for (size_t i = 1; i < table.count; i++)
        assert_true(isnan(table.rows[i].order) ||
                    (double)table.rows[i].steps >= 1.1 * (double)table.rows[i - 1].steps);
    /* the gauge pressure p - pa is off by p/(p - pa) times as much as the volume, with p = N/V */
    for (size_t i = 0; i < table.count; i++)
        assert_true(table.rows[i].error < 1e-5 || table.rows[i].pressure > 2 * table.rows[i].volume);
}

/* As long as it only falls it presses with what rounding leaves, of which no error is a share. */
static void gas_that_does_not_press_has_no_error(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    assert_ok(measure(SETTINGS("balloons[0].gas.ambient=10", "balloons[0].pressure=0", "time.end=0.2",
                               "gravity.acceleration=[3,-9,1]"),
                      &(struct pricing_options){.seconds = 0.3 * slowdown()}, &table, &err),
              &err);
    assert_true(table.count > 0);
    for (size_t i = 0; i < table.count; i++)
        assert_true(isnan(table.rows[i].pressure));
}

static bool stop(void *context, double done)
{
    (void)done;
    return ++*(int *)context < 20;
}

static void it_ends_when_somebody_wants_it_to(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    int asked = 0;
    const struct pricing_options options = {.seconds = 3 * slowdown(), .go_on = stop, .context = &asked};
    assert_int_equal(measure(CALM, &options, &table, &err), STATUS_INTERRUPTED);
    assert_int_equal(asked, 20);
}

static bool never(const struct sim *sim)
{
    (void)sim;
    return false;
}

/* Trials of auto are long, and ask. */
static void it_ends_within_a_step_too(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    const struct pricing_options options = {.seconds = 3 * slowdown(), .goes_on = never};
    assert_refused(measure(CALM, &options, &table, &err), STATUS_INTERRUPTED, "no table was made", &err);
}

struct told {
    double last;
    int moves[2]; /* during the first run; while references are sought */
    bool back;
};

static bool note(void *context, double done)
{
    struct told *told = context;
    told->back |= done < told->last;
    if (done > told->last && done < 0.3)
        told->moves[done > 0.1]++;
    told->last = done;
    return true;
}

/* The first run is of 32 steps at the least, and the last reference's of some hundreds. */
static void progress_moves_within_a_run_and_never_goes_back(void **state)
{
    (void)state;
    static struct accuracy_table table;
    struct error err = {0};
    struct told told = {0};
    const struct pricing_options options = {.seconds = 10 * slowdown(), .go_on = note, .context = &told};
    assert_ok(measure(CALM, &options, &table, &err), &err);
    assert_false(told.back);
    assert_true(told.moves[0] >= 20 && told.moves[1] >= 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_is_there_and_errors_fall_with_its_order),
        cmocka_unit_test(references_agree_ten_times_better_than_the_best_row),
        cmocka_unit_test(auto_has_no_order_where_it_takes_another_method),
        cmocka_unit_test(the_span_ends_before_the_first_break_and_ensembles_go_past_it),
        cmocka_unit_test(references_agree_on_gas_as_well),
        cmocka_unit_test(gas_that_does_not_press_has_no_error),
        cmocka_unit_test(it_ends_when_somebody_wants_it_to),
        cmocka_unit_test(it_ends_within_a_step_too),
        cmocka_unit_test(progress_moves_within_a_run_and_never_goes_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
