/* The order of every method that moves the points, by halving, and by the conditions on its coefficients. */
#include "moving.h"
#include "sim/runge_kutta.h"

static double error_against(const struct balloon *reference, const char *const *settings,
                            const char *integrator, const char *also)
{
    struct balloon b;
    open_moving(&b, settings, integrator, also);
    run_to_end(&b);
    const double error = difference(&b, reference);
    close_balloon(&b);
    return error;
}

/* Fixed steps: four steps of one size and its halves, thrice. */
static void check_order(const char *const *settings, const struct balloon *reference, const char *name)
{
    static const char *const step[] = {"time.step=0.008", "time.step=0.004", "time.step=0.002",
                                       "time.step=0.001"};
    const struct integrator *method = integrator_find(name);
    double last = 0;
    for (int i = 0; i < 4; i++) {
        const double error = error_against(reference, settings, name, step[i]);
        if (i > 0 && error > 1e-12) /* below, rounding in 400 steps */
            assert_near(log2(last / error), method->order, 0.2);
        last = error;
    }
}

/* The reference: 3200 steps of a method of another family than the one that is looked at. */
static void every_fixed_step_has_its_order(const char *const *settings)
{
    static const char *const names[] = {"symplectic-euler", "explicit-euler", "verlet", "rk4", "rkn4"};
    struct balloon rk4, rkn4;
    open_moving(&rk4, settings, "rk4", "time.step=0.000125");
    open_moving(&rkn4, settings, "rkn4", "time.step=0.00025");
    run_to_end(&rk4);
    run_to_end(&rkn4);
    assert_true(difference(&rk4, &rkn4) < 1e-11);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        check_order(settings, strcmp(names[i], "rk4") ? &rk4 : &rkn4, names[i]);
    close_balloon(&rk4);
    close_balloon(&rkn4);
}

static void each_fixed_step_method_has_its_order_under_pressure(void **state)
{
    (void)state;
    every_fixed_step_has_its_order(MOVING_UNDAMPED);
}

static void and_with_damping(void **state)
{
    (void)state;
    every_fixed_step_has_its_order(MOVING_DAMPED);
}

/* A tenth of the tolerance, a tenth of the error, within a factor of 4 from decade to decade: local errors of fifth order are
 * kept at the tolerance by steps whose number grows by 10^(1/5). */
static void the_adaptive_methods_error_is_proportional_to_their_tolerance(void **state)
{
    (void)state;
    struct balloon reference;
    open_moving(&reference, MOVING_DAMPED, "rk4", "time.step=0.000125");
    run_to_end(&reference);
    for (size_t k = 0; integrators[k]; k++) {
        double last = 0;
        for (int i = 4; i <= 8 && integrators[k]->flags & INTEGRATOR_ADAPTIVE; i++) {
            struct balloon b;
            char tolerance[32];
            snprintf(tolerance, sizeof tolerance, "time.tolerance=1e-%d", i);
            open_moving(&b, MOVING_DAMPED, integrators[k]->name, tolerance);
            b.sim.whole_step = b.sim.step = 1; /* no limit but its own */
            run_to_end(&b);
            const double error = difference(&b, &reference);
            print_message("%s, %s: error %.2g in %d steps, %d forces\n", integrators[k]->name, tolerance,
                          error, (int)b.sim.steps, (int)b.sim.evaluations);
            assert_true(error < 10 * pow(10, -i));
            assert_true(i == 4 || (last / error > 2.5 && last / error < 40));
            last = error;
            close_balloon(&b);
        }
    }
    close_balloon(&reference);
}

/* Every order condition up to the fifth order (Butcher 1963: 17 trees), each the product of what hangs on the root. */
static void tree(const struct runge_kutta *method, const char **shape, double *value)
{
    /* "[" opens a node, "]" closes it: value[i] becomes the product over its branches of sum_j a_ij branch_j. */
    double branch[RUNGE_KUTTA_STAGES_MAX];
    for (int i = 0; i < method->stages; i++)
        value[i] = 1;
    for (++*shape; **shape == '[';) {
        tree(method, shape, branch);
        for (int i = 0; i < method->stages; i++) {
            double sum = 0;
            for (int j = 0; j < method->stages; j++)
                sum += method->a[i][j] * branch[j];
            value[i] *= sum;
        }
    }
    ++*shape;
}

/* The product of the sizes of all subtrees: gamma, so that sum b value = 1/gamma. */
static double density(const char **shape, int *size)
{
    double product = 1;
    *size = 1;
    for (++*shape; **shape == '[';) {
        int part;
        product *= density(shape, &part);
        *size += part;
    }
    ++*shape;
    return product * *size;
}

static void the_tableaux_meet_all_order_conditions(void **state)
{
    (void)state;
    static const char *const trees[] = {"[]",         "[[]]",       "[[][]]",     "[[[]]]",     "[[][][]]",
                                        "[[[]][]]",   "[[[][]]]",   "[[[[]]]]",   "[[][][][]]", "[[[]][][]]",
                                        "[[[][]][]]", "[[[[]]][]]", "[[[]][[]]]", "[[[][][]]]", "[[[[]][]]]",
                                        "[[[[][]]]]", "[[[[[]]]]]"};
    const struct runge_kutta *methods[] = {&runge_kutta_classic, &runge_kutta_dormand_prince};
    for (int m = 0; m < 2; m++)
        for (int t = 0; t < (m == 0 ? 8 : 17); t++) {
            double value[RUNGE_KUTTA_STAGES_MAX], sum = 0;
            int size;
            const char *shape = trees[t], *again = trees[t];
            tree(methods[m], &shape, value);
            for (int i = 0; i < methods[m]->stages; i++)
                sum += methods[m]->weights[i] * value[i];
            assert_near(sum, 1 / density(&again, &size), 1e-14); /* terms up to 12, 7 of them */
        }
}

/* What rkn4 does to an oscillator in one step of dt w = z is off by z^5 at most: its coefficients meet every condition that a
 * linear force can test. */
static void a_step_of_rkn4_is_off_by_the_fifth_power(void **state)
{
    (void)state;
    double last = 0;
    for (int i = 0; i < 3; i++) {
        char step[32];
        snprintf(step, sizeof step, "time.step=%g", 0.02 / (1 << i));
        struct balloon rough, fine;
        open_moving(&rough, MOVING_UNDAMPED, "rkn4", step);
        open_moving(&fine, MOVING_UNDAMPED, "rk4", "time.step=0.0005");
        steps(&rough, 1);
        steps(&fine, 40 >> i);
        const double error = difference(&rough, &fine);
        if (i > 0)
            assert_near(log2(last / error), 5, 0.3);
        last = error;
        close_balloon(&rough);
        close_balloon(&fine);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_fixed_step_method_has_its_order_under_pressure),
        cmocka_unit_test(and_with_damping),
        cmocka_unit_test(the_adaptive_methods_error_is_proportional_to_their_tolerance),
        cmocka_unit_test(the_tableaux_meet_all_order_conditions),
        cmocka_unit_test(a_step_of_rkn4_is_off_by_the_fifth_power),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
