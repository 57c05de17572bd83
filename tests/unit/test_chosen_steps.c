/* Methods that choose their own steps, where something is held, hangs on a string, or happens at a time of
 * its own. */
#include "moving.h"

static const char *const methods[] = {"rk-adaptive", "cvode-adams", "cvode-bdf"};

/* That the method takes to the end of a second. */
static uint64_t steps_of(const char *method, const char *const *settings)
{
    struct balloon b;
    char integrator[64];
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    const char *all[16] = {integrator, "time.end=1", "time.step=0.05", "time.tolerance=1e-6",
                           "balloons[0].threshold=50"};
    for (int i = 0; settings[i]; i++)
        all[5 + i] = settings[i];
    open_balloon(&b, 2, all);
    run_to_end(&b);
    const uint64_t steps = b.sim.steps;
    close_balloon(&b);
    return steps;
}

/* What pins hold stands still as it is, and no method begins anew for it: 2556 steps, where 68 do. */
static void what_is_held_asks_for_no_more_steps(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const uint64_t free = steps_of(methods[i], SETTINGS("gravity.acceleration=[0, -10, 0]")),
                       held = steps_of(methods[i], SETTINGS("gravity.acceleration=[0, -10, 0]",
                                                            "balloons[0].pins.reach=20"));
        print_message("# %s: %d steps, with pins %d\n", methods[i], (int)free, (int)held);
        assert_true(held < 2 * free);
    }
}

/* A weight right below hangs at 0 sideways, and where it is to a rounding asks for nothing: 635 steps of
 * rk-adaptive, where 72 do. */
static void a_weight_right_below_asks_for_no_more_steps_than_one_askew(void **state)
{
    (void)state;
    static const char *const askew[] = {"balloons[0].string.to=[0, -2, 0]",
                                        "balloons[0].string.to=[0.5, -2, 0.3]"};
    for (int i = 0; i < 3; i++) {
        uint64_t steps[2];
        for (int k = 0; k < 2; k++)
            steps[k] = steps_of(methods[i],
                                SETTINGS("gravity.acceleration=[0, -10, 0]", askew[k],
                                         "balloons[0].string.weight=10", "balloons[0].string.stiffness=200",
                                         "balloons[0].string.damping=3", "balloons[0].string.slack=0.9"));
        print_message("# %s: %d steps, askew %d\n", methods[i], (int)steps[0], (int)steps[1]);
        assert_true(steps[0] < 2 * steps[1]);
    }
}

/* What a scene has happen at a time of its own happens then: a step ends there. */
static void steps_end_where_something_lets_go_or_opens(void **state)
{
    (void)state;
    static const char *const happens[][4] = {
        {"balloons[0].pins.until=0.1234567", "balloons[0].pins.reach=20"},
        {"balloons[0].rip.at=0.1234567", "balloons[0].rip.length=0.5"},
        {"balloons[0].gas.neck_at=0.1234567", "balloons[0].gas.neck=100", "balloons[0].gas.ambient=10",
         "balloons[0].gas.fill=1.5"}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            struct balloon b;
            char integrator[64];
            snprintf(integrator, sizeof integrator, "time.integrator=%s", methods[i]);
            const char *all[8] = {integrator, "time.step=0.05", "time.end=0.3"};
            for (int j = 0; j < 4 && happens[k][j]; j++)
                all[3 + j] = happens[k][j];
            open_balloon(&b, 2, all);
            int met = 0;
            while (!sim_at_end(&b.sim)) {
                steps(&b, 1);
                met += b.sim.time == 0.1234567;
            }
            assert_int_equal(met, 1);
            close_balloon(&b);
        }
}

/* Lengths four times and masses 32 times as large: it is the same balloon, to the step. What a pump has
 * brought is nothing at first, and was counted in units of whatever the scene's are. */
static void units_ask_for_no_other_steps(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const uint64_t small = steps_of(methods[i],
                                        SETTINGS("balloons[0].gas.ambient=15", "balloons[0].gas.fill=1.5",
                                                 "balloons[0].gas.pump=-0.4")),
                       large = steps_of(methods[i],
                                        SETTINGS("balloons[0].gas.ambient=120", "balloons[0].gas.fill=1.5",
                                                 "balloons[0].gas.pump=-0.4", "balloons[0].gas.density=0.6",
                                                 "balloons[0].radius=180", "balloons[0].point_mass=3.52",
                                                 "balloons[0].spring=640", "balloons[0].damping=32"));
        print_message("# %s: %d and %d steps\n", methods[i], (int)small, (int)large);
        assert_int_equal(small, large);
    }
}

/* A limp balloon off the origin: through its skin seeps what rounding makes of no pressure, and the record of
 * that is nothing to go by: 6224 steps, where 20 do. */
static void a_limp_balloon_asks_for_no_short_steps(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const uint64_t count = steps_of(methods[i],
                                        SETTINGS("balloons[0].position=[1.1, 2.3, 0.7]",
                                                 "balloons[0].gas.ambient=15", "balloons[0].gas.leak=1"));
        print_message("# %s: %d steps\n", methods[i], (int)count);
        assert_true(count < 60);
    }
}

/* What springs have given way begins at nothing, of which an error was to be a share: steps of 1e-11 s were
 * taken for as long as anybody waited, since rounding of lengths alone is more. */
static void springs_that_begin_to_give_way_ask_for_no_short_steps(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 SETTINGS("time.integrator=rk-adaptive", "time.tolerance=1e-11", "time.step=0.01",
                          "time.end=0.1", "balloons[0].pressure=4", "balloons[0].damping=0.05",
                          "balloons[0].viscosity.ratio=10", "balloons[0].viscosity.time=0.1"));
    while (!sim_at_end(&b.sim) && b.sim.steps < 1000)
        steps(&b, 1);
    print_message("# %d steps to %g s\n", (int)b.sim.steps, b.sim.time);
    assert_true(sim_at_end(&b.sim));
    close_balloon(&b);
}

/* Likewise of CVODE, which begins anew at an event: 957 steps and 1076, where 62 and 103 do without one. */
static void nor_do_they_after_an_event(void **state)
{
    (void)state;
    for (int i = 1; i < 3; i++) {
        char integrator[64];
        struct balloon b;
        snprintf(integrator, sizeof integrator, "time.integrator=%s", methods[i]);
        open_balloon(&b, 1,
                     SETTINGS(integrator, "time.tolerance=1e-9", "time.step=0.01", "time.end=0.2",
                              "balloons[0].pressure=4", "balloons[0].damping=0.05",
                              "balloons[0].viscosity.ratio=10", "balloons[0].viscosity.time=0.1",
                              "schedule[0].at=0.001", "schedule[0].pressure=5"));
        run_to_end(&b);
        print_message("# %s: %d steps\n", methods[i], (int)b.sim.steps);
        assert_true(b.sim.steps < 300);
        close_balloon(&b);
    }
}

/* Gas and all: what had leaked in the last try was no number. */
static void what_no_step_can_follow_is_left_as_it_was(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct balloon b;
        struct error err = {0};
        char integrator[64];
        snprintf(integrator, sizeof integrator, "time.integrator=%s", methods[i]);
        open_balloon(&b, 1,
                     SETTINGS(integrator, "balloons[0].gas.ambient=15", "balloons[0].gas.fill=1.5",
                              "balloons[0].gas.leak=1"));
        steps(&b, 1);
        b.sim.position[0][0] = NAN;
        double scalar[8];
        assert_true(b.sim.scalar_count > 0 && b.sim.scalar_count <= 8);
        memcpy(scalar, b.sim.scalar, b.sim.scalar_count * sizeof *scalar);
        assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED, "diverged at time", &err);
        assert_memory_equal(b.sim.scalar, scalar, b.sim.scalar_count * sizeof *scalar);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_held_asks_for_no_more_steps),
        cmocka_unit_test(a_weight_right_below_asks_for_no_more_steps_than_one_askew),
        cmocka_unit_test(steps_end_where_something_lets_go_or_opens),
        cmocka_unit_test(a_limp_balloon_asks_for_no_short_steps),
        cmocka_unit_test(units_ask_for_no_other_steps),
        cmocka_unit_test(springs_that_begin_to_give_way_ask_for_no_short_steps),
        cmocka_unit_test(nor_do_they_after_an_event),
        cmocka_unit_test(what_no_step_can_follow_is_left_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
