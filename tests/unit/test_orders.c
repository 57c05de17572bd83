/* The order of every method that moves the points, by halving, and by the conditions on its coefficients. */
#include "moving.h"
#include "sim/rkn4.h"
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

/* A tenth of the tolerance, a tenth of the error, within a factor of 4 from decade to decade: local errors of
 * fifth order are kept at the tolerance by steps whose number grows by 10^(1/5). */
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
            print_message("# %s, %s: error %.2g in %d steps, %d forces\n", integrators[k]->name, tolerance,
                          error, (int)b.sim.steps, (int)b.sim.evaluations);
            assert_true(error < 10 * pow(10, -i));
            assert_true(i == 4 || (last / error > 2.5 && last / error < 40));
            last = error;
            close_balloon(&b);
        }
    }
    close_balloon(&reference);
}

/* Every order condition up to the fifth order (Butcher 1963: 17 trees), each the product of
 * what hangs on the root. */
static void tree(const struct runge_kutta *method, const char **shape, double *value)
{
    /* "[" opens a node, "]" closes it: value[i] becomes the product over its branches
     * of sum_j a_ij branch_j. */
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

/* The conditions of fourth order for x'' = f(x) (Nystroem; Hairer, Norsett & Wanner, Solving Ordinary
 * Differential Equations I, II.14), with the kicks b at the times c, and a_ij = b_j (c_i - c_j). */
static void the_kicks_and_drifts_of_rkn4_meet_all_order_conditions(void **state)
{
    (void)state;
    const double *b = rkn4_kick;
    double c[RKN4_KICKS] = {0}, sum[7] = {0};
    for (int i = 1; i < RKN4_KICKS; i++)
        c[i] = c[i - 1] + rkn4_drift[i];
    for (int i = 0; i < RKN4_KICKS; i++) {
        double a = 0, ac = 0;
        for (int j = 0; j < i; j++) {
            a += b[j] * (c[i] - c[j]);
            ac += b[j] * (c[i] - c[j]) * c[j];
        }
        const double term[] = {1, c[i], c[i] * c[i], a, c[i] * c[i] * c[i], c[i] * a, ac};
        for (int k = 0; k < 7; k++)
            sum[k] += b[i] * term[k];
    }
    static const double wanted[] = {1, 1.0 / 2, 1.0 / 3, 1.0 / 6, 1.0 / 4, 1.0 / 8, 1.0 / 24};
    for (int k = 0; k < 7; k++)
        assert_near(sum[k], wanted[k], 1e-14); /* 15 printed digits */
    assert_near(c[RKN4_KICKS - 1], 1, 1e-15);
}

/* The limit that the table states is where an oscillator's half trace leaves [-1, 1]. */
static double half_trace_of_rkn4(double z)
{
    double x[2] = {1, 0}, v[2] = {0, 1};
    for (int k = 0; k < RKN4_KICKS; k++)
        for (int i = 0; i < 2; i++) {
            x[i] += rkn4_drift[k] * z * v[i];
            v[i] -= rkn4_kick[k] * z * x[i];
        }
    return (x[0] + v[1]) / 2;
}

/* What a decay at the rate z becomes in a step: each kick the classic Runge-Kutta
 * method's fourth-order series. */
static double decay_of_rkn4(double z)
{
    double product = 1;
    for (int k = 0; k < RKN4_KICKS; k++) {
        const double y = -rkn4_kick[k] * z;
        product *= 1 + y * (1 + y / 2 * (1 + y / 3 * (1 + y / 4)));
    }
    return product;
}

static void the_stated_limits_of_rkn4_and_rk4_are_where_they_lose_stability(void **state)
{
    (void)state;
    const struct integrator *rkn4 = integrator_find("rkn4"), *rk4 = integrator_find("rk4");
    for (double part = 0.001; part < 1; part += 0.001) {
        assert_true(fabs(half_trace_of_rkn4(part * rkn4->oscillation_limit)) <= 1 + 1e-12);
        assert_true(fabs(decay_of_rkn4(part * rkn4->decay_limit)) <= 1);
    }
    assert_true(fabs(half_trace_of_rkn4(1.001 * rkn4->oscillation_limit)) > 1);
    assert_true(fabs(decay_of_rkn4(1.001 * rkn4->decay_limit)) > 1);

    /* |1 + z + z^2/2 + z^3/6 + z^4/24| = 1 at z = i y, y^2 = 8, and at the negative real root */
    assert_near(rk4->oscillation_limit, sqrt(8), 1e-5);
    const double z = rk4->decay_limit;
    assert_near(1 - z * (1 - z / 2 * (1 - z / 3 * (1 - z / 4))), 1, 1e-5);
}

/* What rkn4 does to an oscillator in one step of dt w = z is off by z^5 at most: its coefficients meet every
 * condition that a linear force can test. */
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
        cmocka_unit_test(the_kicks_and_drifts_of_rkn4_meet_all_order_conditions),
        cmocka_unit_test(the_stated_limits_of_rkn4_and_rk4_are_where_they_lose_stability),
        cmocka_unit_test(a_step_of_rkn4_is_off_by_the_fifth_power),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
