/* The methods that move the points: what they keep, what they remember and forget, and when they stop. */
#include "moving.h"
#include "sim/ledger.h"

static double energy(struct balloon *b)
{
    const struct sim_measures m = sim_measure(&b->sim);
    return m.kinetic_energy + m.elastic_energy;
}

/* Over 4 thousand steps without damping or pressure a symplectic method's energy wavers, but does not drift,
 * which would double its worst error from the first half to the second. */
static void symplectic_methods_keep_the_energy(void **state)
{
    (void)state;
    static const char *const quiet[] = {"balloons[0].damping=0", "balloons[0].pressure=0",
                                        "balloons[0].threshold=100", "time.end=1e6", NULL};
    for (size_t k = 0; integrators[k]; k++) {
        if (!(integrators[k]->flags & INTEGRATOR_SYMPLECTIC))
            continue;
        struct balloon b;
        open_moving(&b, quiet, integrators[k]->name, "time.step=0.02");
        const double whole = energy(&b);
        double worst[2] = {0};
        for (int i = 0; i < 200; i++) {
            steps(&b, 20);
            worst[i / 100] = fmax(worst[i / 100], fabs(energy(&b) / whole - 1));
        }
        assert_true(worst[1] <= 1.5 * worst[0] + 1e-12);
        close_balloon(&b);
    }
}

/* How far the ledger is out of balance at the end, over the kinetic energy: the error of scalars that are
 * integrated along. Keeping it changes no bit of the state. */
static double imbalance(const char *integrator, const char *also)
{
    struct error err = {0};
    struct balloon b, alone;
    open_moving(&b, MOVING_DAMPED, integrator, also);
    open_moving(&alone, MOVING_DAMPED, integrator, also);
    assert_ok(ledger_open(&b.sim, &err), &err);
    run_to_end(&b);
    run_to_end(&alone);
    assert_true(sim_hash(&b.sim) == sim_hash(&alone.sim));
    const struct sim_measures m = sim_measure(&b.sim);
    const double error = fabs(ledger_balance(&b.sim, &m).error) / m.kinetic_energy;
    close_balloon(&b);
    close_balloon(&alone);
    return error;
}

static void scalars_are_integrated_along_with_the_same_order(void **state)
{
    (void)state;
    for (size_t k = 0; integrators[k]; k++) {
        const char *name = integrators[k]->name;
        if (!strcmp(name, "auto")) /* whatever it chooses is in the list */
            continue;
        if (integrators[k]->flags & INTEGRATOR_ADAPTIVE) {
            assert_true(imbalance(name, "time.tolerance=1e-7") < 1e-4); /* energies are squares of speeds */
            continue;
        }
        const double rough = imbalance(name, "time.step=0.008"), fine = imbalance(name, "time.step=0.004");
        assert_true(fine < 1e-11 || log2(rough / fine) > integrators[k]->order - 0.5);
    }
}

/* Copies all blocks of `from` into those of `to`: what a checkpoint does. */
static void put_back(struct sim *to, struct sim *from)
{
    size_t count, same;
    const struct sim_block *a = sim_blocks(to, &count), *b = sim_blocks(from, &same);
    assert_int_equal(same, count);
    for (size_t i = 0; i < count; i++)
        if (a[i].size > 0)
            memcpy(a[i].data, b[i].data, a[i].size);
}

/* Into a sim that has just been opened, and into one that went astray meanwhile; before and
 * after something broke. */
static void a_state_that_is_put_back_goes_on_to_the_same_bits(void **state)
{
    (void)state;
    static const char *const settings[] = {"balloons[0].pressure=12", "balloons[0].threshold=1.1",
                                           "time.end=0.6", NULL};
    for (size_t k = 0; integrators[k]; k++) {
        struct balloon whole, astray;
        open_moving(&whole, settings, integrators[k]->name, "time.step=0.01");
        open_moving(&astray, settings, integrators[k]->name, "time.step=0.01");
        for (int turn = 0; !sim_at_end(&whole.sim); turn++) {
            struct balloon fresh;
            steps(&whole, 9);
            open_balloon(&fresh, 2, SETTINGS("balloons[0].pressure=12"));
            sim_clear(&fresh.sim);
            struct error err = {0};
            assert_ok(sim_open(&fresh.sim, &whole.scene, &whole.mesh, 1, &err), &err);
            put_back(&fresh.sim, &whole.sim);
            put_back(&astray.sim, &whole.sim);
            steps(&astray, 1 + turn % 7);
            put_back(&astray.sim, &whole.sim);
            steps(&whole, 7);
            steps(&fresh, 7);
            steps(&astray, 7);
            assert_true(sim_hash(&fresh.sim) == sim_hash(&whole.sim));
            assert_memory_equal(astray.sim.position, whole.sim.position,
                                whole.sim.point_count * sizeof *whole.sim.position);
            close_balloon(&fresh);
        }
        assert_true(whole.sim.broken > 0);
        close_balloon(&whole);
        close_balloon(&astray);
    }
}

static void any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    static const unsigned workers[] = {1, 3, 7};
    struct error err = {0};
    for (size_t k = 0; integrators[k]; k++) {
        struct balloon b;
        uint64_t hash[3];
        /* it bursts on the way */
        open_moving(&b, SETTINGS("balloons[0].pressure=12", "balloons[0].threshold=1.1", "time.end=0.4"),
                    integrators[k]->name, "time.step=0.02");
        for (int w = 0; w < 3; w++) {
            struct sim sim;
            assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers[w], &err), &err);
            while (!sim_at_end(&sim))
                assert_ok(sim_step(&sim, &err), &err);
            assert_true(sim.broken > 0);
            hash[w] = sim_hash(&sim);
            assert_true(hash[w] == hash[0]);
            sim_clear(&sim);
        }
        close_balloon(&b);
    }
}

/* A state in the middle of a step, and what a fine run says of that moment: fourth
 * order, as far as a step is. */
static void a_look_inside_a_step_sees_what_was_there_and_disturbs_nothing(void **state)
{
    (void)state;
    for (size_t k = 0; integrators[k]; k++) {
        if (!integrators[k]->look)
            continue;
        struct balloon looked, alone, fine;
        open_moving(&looked, MOVING_DAMPED, integrators[k]->name, "time.tolerance=1e-7");
        open_moving(&alone, MOVING_DAMPED, integrators[k]->name, "time.tolerance=1e-7");
        open_moving(&fine, MOVING_DAMPED, "rk4", "time.step=0.0005");
        for (double frame = 0; !sim_at_end(&looked.sim);) {
            steps(&looked, 1);
            steps(&alone, 1);
            for (; frame <= looked.sim.time && frame < 0.4; frame = fine.sim.time) {
                sim_look(&looked.sim, frame);
                assert_near(looked.sim.time, frame, 0);
                assert_true(difference(&looked, &fine) < 1e-6); /* ten times the tolerance */
                sim_look_end(&looked.sim);
                steps(&fine, 7);
            }
            assert_true(sim_hash(&looked.sim) == sim_hash(&alone.sim));
        }
        assert_near(looked.sim.time, 0.4, 0);
        close_balloon(&looked);
        close_balloon(&alone);
        close_balloon(&fine);
    }
}

static void what_breaks_at_the_end_of_a_step_is_whole_inside_it(void **state)
{
    (void)state;
    struct balloon b;
    open_moving(&b, SETTINGS("balloons[0].pressure=12", "balloons[0].threshold=1.1"), "rk-adaptive",
                "time.step=0.01");
    double before = 0;
    while (!b.sim.broken && !sim_at_end(&b.sim)) {
        before = b.sim.time;
        steps(&b, 1);
    }
    sim_look(&b.sim, (before + b.sim.time) / 2);
    assert_int_equal(sim_measure(&b.sim).edges_active, b.sim.edge_count);
    sim_look_end(&b.sim);
    assert_int_equal(sim_measure(&b.sim).edges_active, b.sim.edge_count - b.sim.broken);
    close_balloon(&b);
}

static void adaptive_steps_meet_the_schedule_and_the_end_exactly(void **state)
{
    (void)state;
    for (size_t k = 0; integrators[k]; k++) {
        if (!(integrators[k]->flags & INTEGRATOR_ADAPTIVE))
            continue;
        struct balloon b;
        open_moving(&b,
                    SETTINGS("balloons[0].pressure=2", "time.end=0.5", "schedule[0].at=0.1234567",
                             "schedule[0].pressure=3"),
                    integrators[k]->name, "time.step=0.05");
        bool met = false;
        while (!sim_at_end(&b.sim)) {
            steps(&b, 1);
            met |= b.sim.time == 0.1234567;
            assert_true(b.sim.taken <= 0.05 * (1 + 1e-9));
        }
        assert_true(met);
        assert_near(b.sim.time, 0.5, 0);
        close_balloon(&b);
    }
}

/* A method that remembers must not go on with what was true before an event: three steps at rest, and the
 * fourth, under pressure, is as a first one under pressure. */
static void after_an_event_nothing_remembered_is_used(void **state)
{
    (void)state;
    for (size_t k = 0; integrators[k]; k++) {
        struct balloon late, early;
        open_moving(&late,
                    SETTINGS("balloons[0].damping=0", "balloons[0].pressure=0", "time.end=0.004",
                             "schedule[0].at=0.003", "schedule[0].pressure=5"),
                    integrators[k]->name, "time.step=0.001");
        open_moving(&early, SETTINGS("balloons[0].damping=0", "balloons[0].pressure=5", "time.end=0.001"),
                    integrators[k]->name, "time.step=0.001");
        memset(late.sim.velocity, 0, late.sim.point_count * sizeof *late.sim.velocity);
        memset(early.sim.velocity, 0, early.sim.point_count * sizeof *early.sim.velocity);
        run_to_end(&late);
        run_to_end(&early);
        if (integrators[k]->flags & INTEGRATOR_ADAPTIVE)
            assert_true(difference(&late, &early) < 1e-9); /* it moves by 1e-6, to within the tolerance */
        else
            assert_memory_equal(late.sim.position, early.sim.position,
                                late.sim.point_count * sizeof *late.sim.position);
        close_balloon(&late);
        close_balloon(&early);
    }
}

static void a_tolerance_that_the_precision_cannot_give_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_moving(&b, SETTINGS("balloons[0].position=[9e5, 0, 0]", "balloons[0].radius=0.001"), "rk-adaptive",
                "time.tolerance=1e-2");
    sim_clear(&b.sim);
    assert_ok(scene_set(&b.scene, "time.tolerance=1e-7", &err), &err);
    assert_refused(sim_open(&b.sim, &b.scene, &b.mesh, 1, &err), STATUS_RANGE, "radii at best", &err);
    assert_refused(scene_set(&b.scene, "time.tolerance=0", &err), STATUS_INPUT, "1e-12", &err);
    close_balloon(&b);
}

static void an_unknown_integrator_gets_the_list(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_moving(&b, MOVING_DAMPED, "rk4", "time.step=0.01");
    enum status status = scene_set(&b.scene, "time.integrator=rk5", &err);
    assert_true(status != STATUS_OK);
    for (size_t i = 0; scene_integrator_names[i]; i++)
        assert_non_null(strstr(err.text, scene_integrator_names[i]));
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(symplectic_methods_keep_the_energy),
        cmocka_unit_test(scalars_are_integrated_along_with_the_same_order),
        cmocka_unit_test(a_state_that_is_put_back_goes_on_to_the_same_bits),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(a_look_inside_a_step_sees_what_was_there_and_disturbs_nothing),
        cmocka_unit_test(what_breaks_at_the_end_of_a_step_is_whole_inside_it),
        cmocka_unit_test(adaptive_steps_meet_the_schedule_and_the_end_exactly),
        cmocka_unit_test(after_an_event_nothing_remembered_is_used),
        cmocka_unit_test(a_tolerance_that_the_precision_cannot_give_is_refused),
        cmocka_unit_test(an_unknown_integrator_gets_the_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
