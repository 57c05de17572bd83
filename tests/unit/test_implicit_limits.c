/* Implicit methods where a step is too long to be solved as it is: they take it in parts, or refuse with the
 * reason. */
#include "implicit.h"

/* Pressure, stiffness, damping and step far beyond the paper's, one at a time and all together: each method
 * gets on with numbers that are finite and a balloon that bursts, or says why it does not. */
static void steps_beyond_reason_are_solved_or_refused(void **state)
{
    (void)state;
    static const char *const cases[][5] = {
        {"balloons[0].spring=200"},
        {"balloons[0].damping=10"},
        {"balloons[0].pressure=1000"},
        {"time.step=0.25"},
        {"time.step=0.25", "balloons[0].pressure=1000", "balloons[0].damping=10", "balloons[0].spring=200"},
        {"time.step=100"},
    };
    for (int m = 0; m < IMPLICIT_COUNT; m++)
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            struct balloon b;
            struct error err = {0};
            enum status status = STATUS_OK;
            open_with(&b, implicit_names[m], 0.025, SETTINGS("balloons[0].threshold=2"));
            close_balloon(&b);
            const char *all[8] = {"balloons[0].pressure=10"};
            memcpy(&all[1], cases[i], sizeof cases[i]);
            open_with(&b, implicit_names[m], 0.025, all);
            for (int k = 0; k < 5 && !status; k++)
                status = sim_step(&b.sim, &err);
            if (status)
                assert_refused(status, STATUS_DIVERGED, "diverged at time", &err);
            if (status)
                print_message("# %s, case %zu: %s\n", implicit_names[m], i, err.text);
            for (uint32_t p = 0; p < b.sim.point_count && !status; p++)
                assert_true(isfinite(b.sim.position[p][0] + b.sim.velocity[p][0]));
            close_balloon(&b);
        }
}

/* A skin so stiff (its fastest wave crosses an edge in some 1e-5 s) that over a 1024th of a step of 10 s no
 * equation is solved. Explicit methods have such a step split in up to a million parts: implicit ones
 * go as far, and say that they go on in parts. */
static void a_step_is_solved_in_as_many_parts_as_explicit_methods_would_get(void **state)
{
    (void)state;
    static const char *const names[] = {"backward-euler", "bdf2"};
    for (int m = 0; m < 2; m++) {
        struct balloon b;
        open_with(&b, names[m], 10,
                  SETTINGS("balloons[0].pressure=0", "balloons[0].membrane.thickness=0.45",
                           "balloons[0].membrane.shear_modulus=1e6", "balloons[0].gas.ambient=10",
                           "balloons[0].gas.pump=1.2"));
        steps(&b, 2);
        assert_int_equal(b.sim.news_count, 1);
        assert_string_equal(b.sim.news[0].effect, names[m]);
        close_balloon(&b);
    }
}

static void assert_same_state(const struct sim *a, const struct sim *b)
{
    assert_memory_equal(a->position, b->position, a->point_count * sizeof *a->position);
    assert_memory_equal(a->velocity, b->velocity, a->point_count * sizeof *a->velocity);
    assert_memory_equal(a->scalar, b->scalar, a->scalar_count * sizeof *a->scalar);
}

static int questions;

static bool until_the_second_question(const struct sim *sim)
{
    (void)sim;
    return ++questions < 2;
}

/* Whoever ends a step between two of its parts finds it as it began, and goes on later to the same bits. */
static void a_step_in_parts_that_is_ended_half_way_has_not_begun(void **state)
{
    (void)state;
    for (int m = 0; m < IMPLICIT_COUNT; m++) {
        struct balloon b, whole;
        struct error err = {0};
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", implicit_names[m]);
        const char *const *changes = SETTINGS(name, "time.step=1", "balloons[0].pressure=0",
                                              "balloons[0].threshold=1e300", "balloons[0].spring=1e4",
                                              "balloons[0].gas.ambient=10", "balloons[0].gas.fill=1e3",
                                              "balloons[0].gas.pump=10", "time.guard=off");
        open_balloon(&b, 1, changes);
        open_balloon(&whole, 1, changes);
        questions = 0;
        b.sim.goes_on = until_the_second_question;
        enum status status = sim_step(&b.sim, &err);
        for (; !status && whole.sim.steps < 5; status = sim_step(&b.sim, &err))
            steps(&whole, 1); /* until one is taken in parts */
        assert_refused(status, STATUS_INTERRUPTED, "interrupted", &err);
        assert_same_state(&b.sim, &whole.sim);
        b.sim.goes_on = NULL;
        steps(&b, 1);
        steps(&whole, 1);
        assert_true(sim_hash(&b.sim) == sim_hash(&whole.sim));
        close_balloon(&b);
        close_balloon(&whole);
    }
}

/* Most springs so stiff that even a million substeps were not enough. */
static void xpbd_says_what_step_it_can_take(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_with(&b, "xpbd", 1000, SETTINGS("balloons[0].pressure=10", "balloons[0].spring=1e6"));
    assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED, "a time.step of", &err);
    close_balloon(&b);
}

/* Forces that are no numbers have no solution: found out, not passed on. */
static void what_has_no_solution_is_refused_with_time_and_point(void **state)
{
    (void)state;
    for (int m = 0; m < 3; m++) {
        struct balloon b;
        struct error err = {0};
        open_with(&b, implicit_names[m], 0.1, SETTINGS("balloons[0].pressure=1"));
        b.sim.current_spring_const[7] = NAN;
        assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED, "finds no solution", &err);
        assert_non_null(strstr(err.text, implicit_names[m]));
        assert_non_null(strstr(err.text, "of balloons[0]"));
        close_balloon(&b);
    }
}

/* Where another method chose the one that fails, both are named. */
static void who_finds_no_solution_is_named_with_who_chose_it(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_with(&b, "bdf2", 0.1, SETTINGS("balloons[0].pressure=1"));
    b.sim.current_spring_const[7] = NAN;
    b.sim.integrator = integrator_find("auto");
    assert_refused(b.sim.acting->advance(&b.sim, 0.1, &err), STATUS_DIVERGED,
                   "bdf2 (chosen by auto) finds no solution", &err);
    b.sim.integrator = b.sim.acting; /* whose own is closed */
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_beyond_reason_are_solved_or_refused),
        cmocka_unit_test(a_step_is_solved_in_as_many_parts_as_explicit_methods_would_get),
        cmocka_unit_test(a_step_in_parts_that_is_ended_half_way_has_not_begun),
        cmocka_unit_test(xpbd_says_what_step_it_can_take),
        cmocka_unit_test(what_has_no_solution_is_refused_with_time_and_point),
        cmocka_unit_test(who_finds_no_solution_is_named_with_who_chose_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
