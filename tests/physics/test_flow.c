/* Gas that flows while points move, by each method: by the scene's laws, whatever the longest step is that a
 * method may choose, and to the order of one of fixed steps. */
#include "gas.h"

static const char *const methods[] = {"rk-adaptive", "cvode-adams", "cvode-bdf"};

/* Of the gas, over what fills the balloon, at these times. */
static void amounts(const char *method, const char *step, const char *const *settings, const double *times,
                    double *amount, int count)
{
    struct balloon b;
    struct error err = {0};
    char integrator[64], longest[64];
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    snprintf(longest, sizeof longest, "time.step=%s", step);
    const char *all[16] = {"balloons[0].gas.ambient=10",
                           "balloons[0].threshold=100",
                           "time.tolerance=1e-7",
                           "balloons[0].gas.density=0.001",
                           integrator,
                           longest};
    for (int i = 0; settings[i]; i++)
        all[6 + i] = settings[i];
    open_balloon(&b, 2, all);
    for (int i = 0; i < count; i++) {
        while (b.sim.time < times[i])
            assert_ok(sim_step(&b.sim, &err), &err);
        sim_look(&b.sim, times[i]);
        const struct gas_look now = look(&b);
        amount[i] = now.amount / (10 * 4.0 / 3 * M_PI * 45 * 45 * 45);
        sim_look_end(&b.sim);
    }
    close_balloon(&b);
}

/* 1.5 of a fill a second: halfway, shortly before the goal, and at it. What is wrong of a fill is about the
 * tolerance, or 1e-6 where states within a step are interpolated. */
static void a_pump_goes_on_at_its_rate_until_it_stops(void **state)
{
    (void)state;
    const double times[] = {0.1, 0.19, 0.3}, wanted[] = {1.15, 1.285, 1.303};
    for (int i = 0; i < 3; i++) {
        double amount[3], filling[1];
        amounts(methods[i], "0.4", SETTINGS("balloons[0].gas.pump=0"), times, filling, 1);
        amounts(methods[i], "0.4", SETTINGS("balloons[0].gas.pump=1.5", "balloons[0].gas.pump_until=1.303"),
                times, amount, 3);
        print_message("# %s: %.9f %.9f %.9f\n", methods[i], amount[0] / filling[0], amount[1] / filling[0],
                      amount[2] / filling[0]);
        for (int k = 0; k < 3; k++)
            assert_near(amount[k] / filling[0], wanted[k], 1e-5);
    }
}

/* Out of a neck, drawn out, and through the skin. */
static void what_leaves_does_not_ask_for_the_longest_step(void **state)
{
    (void)state;
    static const char *const leaving[] = {"balloons[0].gas.neck=100", "balloons[0].gas.pump=-4",
                                          "balloons[0].gas.leak=30000"};
    const double times[] = {0.1, 0.2, 0.6};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            double fine[3], coarse[3];
            const char *const *settings = SETTINGS(leaving[k], "balloons[0].gas.fill=1.5");
            amounts(methods[i], "0.001", settings, times, fine, 3);
            amounts(methods[i], "0.4", settings, times, coarse, 3);
            print_message("# %s, %s: %.9f %.9f %.9f, coarse %.9f %.9f %.9f\n", methods[i], leaving[k],
                          fine[0], fine[1], fine[2], coarse[0], coarse[1], coarse[2]);
            for (int t = 0; t < 3; t++)
                assert_near(coarse[t], fine[t], 1e-3);
        }
}

/* A stiff vessel with a wide neck: its pressure is soon that of the air, and what flows by a root of what is
 * left would ask for ever shorter steps: 1328, where 164 do. */
static void pressures_that_are_even_ask_for_no_short_steps(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].gas.ambient=10", "balloons[0].threshold=100",
                          "balloons[0].gas.fill=1.5", "balloons[0].gas.density=0.001",
                          "balloons[0].gas.neck=5000", "balloons[0].point_mass=1e9",
                          "time.integrator=rk-adaptive", "time.tolerance=1e-6"));
    while (b.sim.time < 4)
        assert_ok(sim_step(&b.sim, &err), &err);
    print_message("# %d steps\n", (int)b.sim.steps);
    assert_true(b.sim.steps < 300);
    assert_near(look(&b).gauge_pressure, 0, 1e-3);
    close_balloon(&b);
}

/* The mean radius after 0.2 s, with and without damping. */
static double radius_at_end(const char *method, const char *damping, int parts)
{
    struct balloon b;
    struct error err = {0};
    char integrator[64], step[64], damper[64];
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    snprintf(step, sizeof step, "time.step=%.17g", 0.2 / parts);
    snprintf(damper, sizeof damper, "balloons[0].damping=%s", damping);
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].gas.ambient=10", "balloons[0].threshold=100", "time.guard=off",
                          "balloons[0].gas.pump=1.5", "balloons[0].gas.leak=30000", integrator, step,
                          damper));
    for (int i = 0; i < parts; i++)
        assert_ok(sim_step(&b.sim, &err), &err);
    const double radius = sim_measure(&b.sim).mean_radius;
    close_balloon(&b);
    return radius;
}

/* Errors fall with the fourth power, where those of the first order fall by a half. */
static void fourth_order_holds_for_gas_that_is_pumped(void **state)
{
    (void)state;
    static const char *const fourth[] = {"rk4", "rkn4"}, *const damping[] = {"0", "1"};
    for (int m = 0; m < 2; m++)
        for (int d = 0; d < 2; d++) {
            const double exact = radius_at_end("rk4", damping[d], 256),
                         coarse = fabs(radius_at_end(fourth[m], damping[d], 16) - exact),
                         fine = fabs(radius_at_end(fourth[m], damping[d], 32) - exact);
            print_message("# %s, damping %s: %.3g, then %.3g\n", fourth[m], damping[d], coarse, fine);
            assert_near(log2(coarse / fine), 4, 0.5);
        }
}

/* In a step no more flows than half of what evens the pressures out. Where that holds anything back it is
 * told, once: out of a wide neck, into a half-empty balloon through it, through a thin skin. */
static void what_a_step_holds_back_is_told(void **state)
{
    (void)state;
    static const char *const flows[][2] = {
        {"balloons[0].gas.neck=2000", "balloons[0].gas.fill=1.5"},
        {"balloons[0].gas.neck=2000", "balloons[0].gas.fill=0.7"},
        {"balloons[0].gas.leak=1e6", "balloons[0].gas.fill=1.5"},
    };
    for (int i = 0; i < 6; i++) {
        struct balloon b;
        size_t told = 0;
        open_balloon(&b, 1,
                     SETTINGS("balloons[0].gas.ambient=10", "balloons[0].gas.density=1e-7",
                              "balloons[0].threshold=100", flows[i / 2][0], flows[i / 2][1],
                              i % 2 ? "time.step=0.0005" : "time.step=0.02"));
        steps(&b, 4);
        for (size_t k = 0; k < b.sim.news_count; k++)
            told += strstr(b.sim.news[k].text, "less flows than would") != NULL;
        assert_int_equal(told, i % 2 ? 0 : 1);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fourth_order_holds_for_gas_that_is_pumped),
        cmocka_unit_test(a_pump_goes_on_at_its_rate_until_it_stops),
        cmocka_unit_test(pressures_that_are_even_ask_for_no_short_steps),
        cmocka_unit_test(what_leaves_does_not_ask_for_the_longest_step),
        cmocka_unit_test(what_a_step_holds_back_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
