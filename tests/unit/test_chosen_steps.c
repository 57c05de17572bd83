/* Methods that choose their own steps, where something is held, or hangs on a string. */
#include "moving.h"

static const char *const methods[] = {"rk-adaptive", "cvode-adams", "cvode-bdf"};

/* That the method takes to the end of a second. */
static uint64_t steps_of(const char *method, const char *const *settings)
{
    struct balloon b;
    char integrator[64];
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    const char *all[16] = {integrator, "time.end=1", "time.step=0.05", "time.tolerance=1e-6",
                           "balloons[0].threshold=50", "balloons[0].pressure=4"};
    for (int i = 0; settings[i]; i++)
        all[6 + i] = settings[i];
    open_balloon(&b, 2, all);
    run_to_end(&b);
    const uint64_t steps = b.sim.steps;
    close_balloon(&b);
    return steps;
}

/* What pins hold stands still as it is, and no method begins anew for it: 2192 steps, where 48 do. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_held_asks_for_no_more_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
