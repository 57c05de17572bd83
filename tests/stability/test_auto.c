/* The method that chooses a method: as accurate as asked, no dearer than it must be,
 * and the same everywhere. */
#include "hard.h"
#include "sim/auto.h"
#include "sim/estimate.h"
#include "sim/integrators.h"
#include "sim/topology.h"

#define AUTO(...) HARD("time.integrator=auto", "balloons[0].pressure=4" __VA_OPT__(, ) __VA_ARGS__)

static void open_auto(struct balloon *b, const char *tolerance)
{
    open_balloon(b, 2, AUTO(tolerance));
}

/* RMS distance of the points after a second from where RK4 puts them in 25 times as many steps, in radii. */
static double error_after_a_second(const char *tolerance, uint64_t *evaluations)
{
    struct balloon b, reference;
    double sum = 0;
    open_auto(&b, tolerance);
    while (!sim_at_end(&b.sim) && b.sim.time < 1 - 1e-9)
        steps(&b, 1);
    *evaluations = b.sim.evaluations;
    open_balloon(&reference, 2, HARD("time.integrator=rk4", "balloons[0].pressure=4", "time.step=0.001"));
    steps(&reference, 1000);
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        double d[3];
        vec3_sub(b.sim.position[p], reference.sim.position[p], d);
        sum += vec3_dot(d, d);
    }
    sum /= b.sim.point_count;
    close_balloon(&b);
    close_balloon(&reference);
    return sqrt(sum) / 45;
}

/* Forty steps that each err by the tolerance at most err by forty times it, where errors do not grow by
 * themselves; damped as this balloon is, they do not. */
static void forty_steps_err_by_forty_tolerances_at_most(void **state)
{
    (void)state;
    static const char *const tolerances[] = {"time.tolerance=1e-3", "time.tolerance=1e-5",
                                             "time.tolerance=1e-8"};
    const double allowed[] = {40e-3, 40e-5, 40e-8};
    uint64_t work[3];
    for (int i = 0; i < 3; i++)
        assert_true(error_after_a_second(tolerances[i], &work[i]) < allowed[i]);
    assert_true(work[0] < work[2]);
}

/* Both runs of a trial were cut into the same parts where a whole step has no solution, and agreed to the
 * bit: the error was told to be 0, and so small that no other method had a chance. */
static void what_is_taken_in_parts_tells_no_error(void **state)
{
    (void)state;
    struct balloon b;
    char text[256];
    open_balloon(&b, 1,
                 SETTINGS("time.integrator=auto", "time.step=0.213", "time.guard=substep",
                          "time.tolerance=1e-6", "balloons[0].radius=10", "balloons[0].threshold=500",
                          "balloons[0].spring=3.374e6", "balloons[0].damping=2.81",
                          "balloons[0].point_mass=0.0556", "balloons[0].pressure=9130",
                          "balloons[0].pressure_on=areas"));
    steps(&b, 1);
    assert_true(auto_describe(&b.sim, &(uint64_t){0}, text, sizeof text));
    assert_null(strstr(text, "error 0 radii"));
    close_balloon(&b);
}

static void it_says_what_it_has_chosen_and_why(void **state)
{
    (void)state;
    struct balloon b;
    char text[256] = "";
    uint64_t choices = 0;
    open_auto(&b, "time.tolerance=1e-3");
    steps(&b, 1);
    assert_true(auto_describe(&b.sim, &choices, text, sizeof text));
    assert_non_null(strstr(text, "substep"));
    assert_non_null(strstr(text, "stiffness ratio"));
    assert_false(auto_describe(&b.sim, &choices, text, sizeof text)); /* nothing new */
    close_balloon(&b);

    open_balloon(&b, 2, HARD());
    choices = 0;
    steps(&b, 1);
    assert_false(auto_describe(&b.sim, &choices, text, sizeof text));
    close_balloon(&b);
}

static void it_chooses_again_when_the_schedule_stiffens_the_springs(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, AUTO("schedule[0].at=0.1", "schedule[0].spring_factor=400"));
    steps(&b, 1);
    const uint32_t before = b.sim.substeps;
    while (b.sim.time < 0.2)
        steps(&b, 1);
    assert_true(b.sim.substeps > 3 * before);
    close_balloon(&b);
}

static void go_to_a_tenth_of_a_second(struct balloon *b)
{
    while (b->sim.time < 0.1)
        steps(b, 1);
}

/* So stiff that a motion goes astray within a step, however finely that is split: to find out took 2.9
 * million evaluations, seven times as many as it does. */
static void a_motion_that_no_split_resolves_is_given_up_soon(void **state)
{
    (void)state;
    struct balloon b;
    char text[256];
    open_balloon(&b, 1, AUTO("schedule[0].at=0.1", "schedule[0].spring_factor=1e6"));
    go_to_a_tenth_of_a_second(&b);
    disturb(&b, 8);
    const uint64_t before = b.sim.evaluations;
    steps(&b, 1);
    assert_true(b.sim.evaluations - before < 1000000);
    assert_true(auto_describe(&b.sim, &(uint64_t){0}, text, sizeof text));
    assert_non_null(strstr(text, "no method keeps time.tolerance"));
    assert_int_equal(b.sim.acting->evaluations, 1); /* the cheapest, since none is nearer than another */
    close_balloon(&b);
}

/* No error of the first two methods falls, in eight times the parts: that of others does, which keep the
 * tolerance in the end. */
static void a_motion_that_some_method_resolves_is_not_given_up(void **state)
{
    (void)state;
    struct balloon b;
    char text[256];
    open_balloon(&b, 2, AUTO("schedule[0].at=0.1", "schedule[0].spring_factor=1e4"));
    go_to_a_tenth_of_a_second(&b);
    disturb(&b, 8);
    steps(&b, 1);
    assert_true(auto_describe(&b.sim, &(uint64_t){0}, text, sizeof text));
    assert_null(strstr(text, "no method keeps time.tolerance"));
    close_balloon(&b);
}

/* The least that an implicit method may take is known beforehand, and not the most: bdf2's trial saw 6000
 * products through before the next method had its own, which took far fewer, and was chosen. */
static void a_trial_that_gets_dear_waits_for_the_others(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 AUTO("balloons[0].spring=2e3", "schedule[0].at=0.1", "schedule[0].spring_factor=1e6"));
    go_to_a_tenth_of_a_second(&b);
    const uint64_t before = b.sim.products;
    steps(&b, 1);
    assert_true(b.sim.products - before < 3000);
    assert_string_equal(b.sim.acting->name, "backward-euler");
    close_balloon(&b);
}

/* Work is counted, not timed: the choice cannot depend on who works, nor on what else the machine does. */
static void the_choice_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {2, 3, 7, 16};
    struct error err = {0};
    struct balloon one;
    open_balloon(&one, 2, SETTINGS("time.guard=substep", "time.integrator=auto", "balloons[0].pressure=250"));
    steps(&one, 100);
    assert_true(one.sim.broken > 10);
    for (size_t i = 0; i < sizeof workers / sizeof workers[0]; i++) {
        struct sim sim;
        assert_ok(sim_open(&sim, &one.scene, &one.mesh, workers[i], &err), &err);
        for (int step = 0; step < 100; step++)
            assert_ok(sim_step(&sim, &err), &err);
        assert_true(sim_hash(&sim) == sim_hash(&one.sim));
        sim_clear(&sim);
    }
    close_balloon(&one);
}

static int asked, asked_by_trials;

static bool count_questions(const struct sim *sim)
{
    asked++;
    asked_by_trials += sim->is_trying;
    return true;
}

/* For word of what takes so long. */
static void who_is_asked_in_a_trial_is_told_so(void **state)
{
    (void)state;
    struct balloon b;
    open_auto(&b, "time.tolerance=1e-3");
    b.sim.goes_on = count_questions;
    steps(&b, 1);
    assert_true(asked_by_trials > 0 && asked_by_trials < asked); /* the choice asks, too */
    assert_false(b.sim.is_trying);
    close_balloon(&b);
}

static int answers; /* yes, before the first no */

static bool goes_on_for_a_while(const struct sim *sim)
{
    (void)sim;
    return answers-- > 0;
}

/* Whoever ends one and goes on later comes to the same bits: where an implicit method acted, the guard's
 * bound for the others had been made sharper once more. */
static void a_choice_that_is_ended_half_way_has_not_begun(void **state)
{
    (void)state;
    const char *const *changes = SETTINGS("time.guard=substep", "time.integrator=auto", "time.step=0.05",
                                          "balloons[0].pressure=0", "balloons[0].membrane.thickness=0.5",
                                          "balloons[0].membrane.viscosity=1e5", "balloons[0].gas.ambient=6",
                                          "balloons[0].gas.fill=1.5", "schedule[0].at=0.1",
                                          "schedule[0].pump=0.1");
    struct error err = {0};
    struct balloon b, whole;
    open_balloon(&b, 1, changes);
    open_balloon(&whole, 1, changes);
    steps(&b, 2);
    steps(&whole, 3);
    assert_true(b.sim.acting->flags & INTEGRATOR_IMPLICIT);
    answers = 2;
    b.sim.goes_on = goes_on_for_a_while;
    assert_refused(sim_step(&b.sim, &err), STATUS_INTERRUPTED, "interrupted", &err);
    b.sim.goes_on = NULL;
    steps(&b, 1);
    assert_true(sim_hash(&b.sim) == sim_hash(&whole.sim));
    close_balloon(&b);
    close_balloon(&whole);
}

/* Their trials take longer than the run's, since their tolerances are tighter. */
static void companions_of_an_estimate_can_be_ended_too(void **state)
{
    (void)state;
    struct balloon b;
    struct estimate *estimate;
    struct error err = {0};
    double error;
    open_auto(&b, "time.tolerance=1e-3");
    assert_ok(estimate_open(&b.sim, &b.mesh, 1, &estimate, &err), &err);
    steps(&b, 1);
    answers = 2;
    b.sim.goes_on = goes_on_for_a_while;
    assert_refused(estimate_compare(estimate, &b.sim, &error, &err), STATUS_INTERRUPTED, "interrupted", &err);
    estimate_close(estimate);
    close_balloon(&b);
}

/* With damping a step of rkn4 takes 28 forces: that it is no candidate is known without a trial, which would
 * take 84 at the least, as much as those of all others. */
static void a_choice_takes_no_more_than_a_few_steps(void **state)
{
    (void)state;
    struct balloon b;
    open_auto(&b, "time.tolerance=1e-9");
    steps(&b, 1);
    assert_string_equal(b.sim.acting->name, "rk4");
    assert_true(b.sim.evaluations < 150);
    close_balloon(&b);
}

/* What it chose, run by its own name in as many steps, moves the points to the same bits: the
 * trials leave nothing behind. */
static void trials_leave_no_trace(void **state)
{
    (void)state;
    struct balloon b, named;
    open_auto(&b, "time.tolerance=1e-3");
    steps(&b, 1);
    char name[64], step[64];
    snprintf(name, sizeof name, "time.integrator=%s", b.sim.acting->name);
    snprintf(step, sizeof step, "time.step=%.17g", b.sim.step);
    open_balloon(&named, 2, HARD(name, step, "balloons[0].pressure=4"));
    steps(&named, 1);
    for (int i = 0; i < 20; i++) {
        assert_memory_equal(b.sim.position, named.sim.position, b.sim.point_count * sizeof *b.sim.position);
        assert_memory_equal(b.sim.velocity, named.sim.velocity, b.sim.point_count * sizeof *b.sim.velocity);
        steps(&b, 1);
        steps(&named, 1);
    }
    close_balloon(&b);
    close_balloon(&named);
}

/* Points of a billionth of a unit: the guard would split the step further than it does, and equations of
 * the long step can take an implicit method millions of iterations. Trials give up where the guard does;
 * this one took minutes. */
static void a_trial_ends_where_the_guard_would(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 1,
                 HARD("time.integrator=auto", "time.step=1.6", "balloons[0].pressure=38",
                      "balloons[0].damping=0.24", "balloons[0].point_mass=1e-9"));
    assert_ok(sim_step(&b.sim, &err), &err);
    close_balloon(&b);
}

/* At a step thousands of times as long as an explicit method may take. */
static void stiff_skin_that_tears_is_given_to_an_implicit_method(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("time.guard=substep", "time.integrator=auto", "time.step=0.05", "time.end=3",
                          "balloons[0].pressure=0", "balloons[0].membrane.thickness=0.5",
                          "balloons[0].membrane.shear_modulus=20", "balloons[0].membrane.viscosity=1e5",
                          "balloons[0].gas.ambient=6", "balloons[0].fracture.mode=tear",
                          "balloons[0].rip.at=0.5"));
    steps(&b, 20);
    assert_true(b.sim.acting->flags & INTEGRATOR_IMPLICIT);
    char text[256];
    assert_true(auto_describe(&b.sim, &(uint64_t){0}, text, sizeof text));
    assert_non_null(
        strstr(text, " radii a step but for what swings faster than its steps, which it damps, "));
    assert_true(b.sim.broken + b.sim.balloons[0].topology->now.edges > 0);
    close_balloon(&b);
}

/* What the guard splits any step for is part of every method's price: one that is stable at any step took the
 * whole of it in its trial, and a hundred times its work in each of the parts. */
static void a_wide_tube_splits_steps_of_every_method(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    struct mesh meshes[2] = {0};
    struct sim sim = {0};
    static const char *const changes[] = {"balloons[1].mesh=sphere",   "balloons[0].gas.ambient=6",
                                          "balloons[1].gas.ambient=6", "balloons[1].gas.fill=1.2",
                                          "balloons[0].tube.to=1",     "balloons[0].tube.area=1e9",
                                          "time.integrator=auto",      "time.step=0.005",
                                          "time.guard=substep",        "balloons[1].position=[200, 0, 0]"};
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        assert_ok(scene_set(&scene, changes[i], &err), &err);
    for (int i = 0; i < 2; i++)
        shape_icosphere(0, &meshes[i]);
    assert_ok(sim_open(&sim, &scene, meshes, 1, &err), &err);
    const double parts = ceil(sim.whole_step / guard_following(&sim).step);
    assert_ok(sim_step(&sim, &err), &err);
    print_message("# %.0f parts for the tube; %s in %u\n", parts, sim.acting->name, sim.substeps);
    assert_true(parts > 100 && sim.wanted_substeps >= parts && sim.wanted_substeps < 8 * parts);
    sim_clear(&sim);
    for (int i = 0; i < 2; i++)
        mesh_clear(&meshes[i]);
    scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forty_steps_err_by_forty_tolerances_at_most),
        cmocka_unit_test(what_is_taken_in_parts_tells_no_error),
        cmocka_unit_test(it_says_what_it_has_chosen_and_why),
        cmocka_unit_test(it_chooses_again_when_the_schedule_stiffens_the_springs),
        cmocka_unit_test(a_motion_that_no_split_resolves_is_given_up_soon),
        cmocka_unit_test(a_motion_that_some_method_resolves_is_not_given_up),
        cmocka_unit_test(a_trial_that_gets_dear_waits_for_the_others),
        cmocka_unit_test(the_choice_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(who_is_asked_in_a_trial_is_told_so),
        cmocka_unit_test(a_choice_that_is_ended_half_way_has_not_begun),
        cmocka_unit_test(companions_of_an_estimate_can_be_ended_too),
        cmocka_unit_test(a_choice_takes_no_more_than_a_few_steps),
        cmocka_unit_test(trials_leave_no_trace),
        cmocka_unit_test(a_trial_ends_where_the_guard_would),
        cmocka_unit_test(stiff_skin_that_tears_is_given_to_an_implicit_method),
        cmocka_unit_test(a_wide_tube_splits_steps_of_every_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
