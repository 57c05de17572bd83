/* What accuracy costs is told although a reference fails at the tightest tolerances: accuracy_go() is stood
 * in for. */
#include "balloon.h"
#include "sim/accuracy.h"
#include "sim/accuracy_run.h"
#include "support/slowdown.h"

static int failures;               /* that are still to come, of runs at a tolerance below 1e-10 */
static double passable = INFINITY; /* s: beyond it no method comes that chooses its steps */

enum status __wrap_accuracy_go(struct accuracy_run *run, const struct accuracy_subject *subject,
                               const struct accuracy_dials *dials, double budget,
                               struct accuracy_states *states, struct error *err);
enum status __real_accuracy_go(struct accuracy_run *run, const struct accuracy_subject *subject,
                               const struct accuracy_dials *dials, double budget,
                               struct accuracy_states *states, struct error *err);

/* As CVODE's corrector where contact's forces have corners. */
enum status __wrap_accuracy_go(struct accuracy_run *run, const struct accuracy_subject *subject,
                               const struct accuracy_dials *dials, double budget,
                               struct accuracy_states *states, struct error *err)
{
    if (failures > 0 && dials->tolerance < 1e-10) {
        failures--;
        return error_set(err, STATUS_DIVERGED, "the corrector convergence test failed");
    }
    if (dials->end > passable && dials->method->flags & INTEGRATOR_ADAPTIVE)
        return error_set(err, STATUS_RESOURCE, "would take more than 6 s");
    return __real_accuracy_go(run, subject, dials, budget, states, err);
}

static void measure(const char *const *settings, double seconds, struct accuracy_table *table)
{
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 1, settings);
    assert_ok(accuracy_measure(&b.scene, &b.mesh, &(struct pricing_options){.seconds = seconds * slowdown()},
                               table, &err),
              &err);
    close_balloon(&b);
}

static void a_looser_tolerance_is_tried_where_a_reference_diverges(void **state)
{
    (void)state;
    static struct accuracy_table table;
    failures = 4; /* of two methods, at 1e-12 and 1e-11 */
    measure(SETTINGS("balloons[0].point_mass=1", "balloons[0].pressure=4", "balloons[0].threshold=100",
                     "time.end=0.2", "time.guard=off"),
            1, &table);
    assert_int_equal(failures, 0);
    assert_non_null(strstr(table.reference[0], "time.tolerance=1e-10"));
}

/* As where springs slip at the ends of steps. */
static void a_shorter_span_is_tried_where_no_reference_comes_to_the_end(void **state)
{
    (void)state;
    static struct accuracy_table table;
    passable = 0.15;
    measure(SETTINGS("balloons[0].point_mass=1", "balloons[0].pressure=4", "balloons[0].threshold=100",
                     "time.end=0.4", "time.step=0.005", "time.guard=off"),
            10, &table);
    passable = INFINITY;
    assert_true(table.span <= 0.15 && table.agreement < 1e-5 && table.count > 0);
    assert_string_equal(table.span_reason, "for as long as references come on");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_looser_tolerance_is_tried_where_a_reference_diverges),
        cmocka_unit_test(a_shorter_span_is_tried_where_no_reference_comes_to_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
