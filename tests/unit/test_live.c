/* The simulation under the hand: the clock, the dials, the past, what pricks and pulls. */
#include "balloon.h"
#include "common/vec3.h"
#include "sim/effect_gas.h"
#include "sim/ledger.h"
#include "sim/live.h"

enum { MEMORY = 64 << 20 };

static struct live live;

static void open_live(struct balloon *b, const char *const *changes, size_t memory)
{
    struct error err = {0};
    open_balloon(b, 2, changes);
    assert_ok(live_open(&live, &b->sim, memory, &err), &err);
}

static void close_live(struct balloon *b)
{
    live_close(&live);
    close_balloon(b);
}

static void run_for(double seconds, double budget)
{
    struct error err = {0};
    assert_ok(live_run(&live, seconds, budget, &err), &err);
}

static void live_steps(int count)
{
    struct error err = {0};
    while (count--)
        assert_ok(live_step(&live, &err), &err);
}

static void it_follows_the_clock_at_its_pace(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler"), MEMORY);
    for (int i = 0; i < 10; i++)
        run_for(0.06, 10);
    assert_near(b.sim.time, 0.6, 0.025); /* a step at most is still owed */
    assert_near(live.speed, 1, 0.025 / 0.5 + 1e-9);
    live_turn(&live, LIVE_PACE, 0.5);
    const double before = b.sim.time;
    for (int i = 0; i < 10; i++)
        run_for(0.06, 10);
    assert_near(b.sim.time - before, 0.3, 0.025);
    close_live(&b);
}

static void what_does_not_get_done_in_time_is_not_made_up_for(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler"), MEMORY);
    run_for(0.5, 0);
    assert_int_equal(b.sim.steps, 1);
    run_for(0.5, 0);
    assert_int_equal(b.sim.steps, 2);
    assert_true(live.speed < 0.2); /* and says so: 0.05 s of 1 s */
    run_for(0.001, 10);
    assert_int_equal(b.sim.steps, 2);
    close_live(&b);
}

static void paused_it_takes_single_steps_only(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler"), MEMORY);
    live.paused = true;
    run_for(1, 10);
    assert_int_equal(b.sim.steps, 0);
    live_steps(1);
    assert_int_equal(b.sim.steps, 1);
    assert_true(live.paused);
    close_live(&b);
}

static void slow_motion_runs_at_the_films_pace(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("view.rate=2500", "view.playback=25"), MEMORY);
    assert_near(live.pace, 0.01, 1e-15);
    close_live(&b);
}

static void dials_turn_between_steps_within_the_scenes_range(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler", "time.guard=off", "balloons[0].spring=20"),
              MEMORY);
    live_steps(2);
    live_turn(&live, LIVE_PRESSURE, 3);
    live_turn(&live, LIVE_STEP, 0.01);
    live_turn(&live, LIVE_SPRINGS, 2);
    assert_near(live_value(&live, LIVE_PRESSURE), 3, 0);
    assert_near(live_value(&live, LIVE_STEP), 0.01, 0);
    assert_near(b.sim.current_spring_const[5], 40, 0);
    live_steps(1);
    assert_near(b.sim.time, 0.06, 1e-15);
    live_turn(&live, LIVE_STEP, -1);
    assert_near(live_value(&live, LIVE_STEP), 1e-9, 0);
    live_turn(&live, LIVE_SPRINGS, 1e99);
    assert_near(live_value(&live, LIVE_SPRINGS), 1e6, 0);
    close_live(&b);
}

/* Where gas makes the pressure: past what the scene would pump, and back with the past. */
static void the_first_dial_turns_the_pump_where_there_is_gas(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b,
              SETTINGS("balloons[0].gas.ambient=0.01", "balloons[0].gas.pump=1",
                       "balloons[0].gas.pump_until=1", "time.integrator=symplectic-euler", "view.rate=40"),
              MEMORY);
    const double first = gas_look(&b.sim, b.sim.balloons).amount;
    assert_string_equal(live_name(&live, LIVE_PRESSURE), "pump");
    assert_near(live_value(&live, LIVE_PRESSURE), 1, 0);
    live_steps(1);
    live_turn(&live, LIVE_PRESSURE, 2);
    live_steps(1);
    assert_near(gas_look(&b.sim, b.sim.balloons).amount, 1.05 * first, 1e-12 * first);
    live_show(&live, 1);
    assert_near(live_value(&live, LIVE_PRESSURE), 1, 0);
    live_steps(1);
    assert_near(gas_look(&b.sim, b.sim.balloons).amount, first, 1e-12 * first);
    close_live(&b);
}

/* Every kind of method: those that remember steps must remember the same ones again. */
static void a_membrane_has_no_springs_to_be_turned(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("balloons[0].spring=20"), MEMORY);
    assert_true(live_has_springs(&live));
    close_live(&b);
    open_live(&b, SETTINGS("balloons[0].membrane.thickness=0.45"), MEMORY);
    assert_false(live_has_springs(&live));
    close_live(&b);
}

static void a_frame_of_the_past_is_followed_by_the_same_future(void **state)
{
    (void)state;
    static const char *const methods[] = {"time.integrator=symplectic-euler",
                                          "time.integrator=verlet",
                                          "time.integrator=rk-adaptive",
                                          "time.integrator=bdf2",
                                          "time.integrator=xpbd",
                                          "time.integrator=auto",
                                          "time.integrator=implicit-midpoint"};
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
        struct balloon b;
        open_live(&b, SETTINGS(methods[m], "balloons[0].threshold=1.2", "time.tolerance=1e-3"), MEMORY);
        while (live.past.count < 12)
            live_steps(1);
        const uint64_t steps = b.sim.steps, middle = 6;
        while (live.past.count < 24)
            live_steps(1);
        const uint64_t last = sim_hash(&b.sim);
        const uint64_t end = b.sim.steps;
        assert_true(end > steps);
        live_show(&live, middle);
        assert_true(live.paused);
        assert_near(b.sim.time, live.past.items[middle].marks.time, 0);
        live_show(&live, live.past.count - 1);
        assert_true(sim_hash(&b.sim) == last);
        live_show(&live, middle);
        assert_int_equal(live.past.count, 24); /* what came later is still there, */
        live_steps(1);
        assert_true(live.past.count < 24); /* until another step is taken */
        while (b.sim.steps < end)
            live_steps(1);
        assert_true(sim_hash(&b.sim) == last);
        assert_int_equal(live.past.count, 24);
        close_live(&b);
    }
}

static void the_past_keeps_its_start_and_its_end_within_its_memory(void **state)
{
    (void)state;
    struct balloon b;
    const size_t memory = 400000;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler"), memory);
    const uint64_t start = sim_hash(&b.sim);
    live_steps(200);
    assert_true(live.past.bytes <= memory);
    assert_true(live.past.count > 4 && live.past.count < 200);
    for (size_t i = 1; i < live.past.count; i++)
        assert_true(live.past.items[i].marks.time > live.past.items[i - 1].marks.time);
    assert_near(live.past.items[live.past.count - 1].marks.time, b.sim.time, 0);
    live_show(&live, 0);
    assert_true(sim_hash(&b.sim) == start);
    close_live(&b);
}

static void the_past_is_a_minute_of_film(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler", "view.playback=1", "view.rate=3"), MEMORY);
    live_steps(3000);
    assert_int_equal(live.past.count, 60);
    close_live(&b);
}

static void what_does_not_change_is_kept_once(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler"), MEMORY);
    const size_t first = live.past.bytes;
    live_steps(1);
    const size_t vectors = 2 * b.sim.point_count * sizeof *b.sim.position;
    assert_true(live.past.bytes - first < vectors + 4096);
    close_live(&b);
}

static void a_restart_is_as_at_the_start(void **state)
{
    (void)state;
    struct balloon b;
    open_live(&b, SETTINGS("time.integrator=auto"), MEMORY);
    const uint64_t start = sim_hash(&b.sim);
    live_steps(10);
    live_turn(&live, LIVE_PRESSURE, 30);
    live_turn(&live, LIVE_SPRINGS, 3);
    live_restart(&live);
    assert_true(sim_hash(&b.sim) == start);
    assert_false(live.paused);
    assert_near(live_value(&live, LIVE_PRESSURE), 10, 0);
    close_live(&b);
}

static const double from_front[3] = {0, 0, 500}, backwards[3] = {0, 0, -1};

static void a_ray_finds_the_nearer_wall_or_none(void **state)
{
    (void)state;
    struct balloon b;
    struct hand_hit hit;
    const double beside[3] = {100, 0, 500}, aside[3] = {0.01, 0.02, 500};
    open_live(&b, SETTINGS("balloons[0].radius=45"), MEMORY);
    assert_true(hand_find(&b.sim, aside, backwards, &hit));
    /* a facet of the icosphere sags below the sphere by up to 1 - cos(circumradius), 0.16 there */
    assert_true(hit.place[2] <= 45 && hit.place[2] > 45 * 0.95);
    assert_near(hit.distance, 500 - hit.place[2], 1e-9);
    assert_false(hand_find(&b.sim, beside, backwards, &hit));
    assert_false(hand_find(&b.sim, from_front, (const double[3]){0, 0, 1}, &hit));
    b.sim.triangle_active[hit.triangle] = 0;
    assert_true(hand_find(&b.sim, aside, backwards, &hit));
    assert_true(hit.place[2] < 0); /* through the hole */
    close_live(&b);
}

static void a_prick_makes_a_hole_where_it_hits(void **state)
{
    (void)state;
    struct balloon b;
    struct hand_hit hit;
    open_live(&b, SETTINGS("balloons[0].pressure=2"), MEMORY);
    assert_true(hand_find(&b.sim, (const double[3]){1, 2, 500}, backwards, &hit));
    live_prick(&live, &hit);
    assert_int_equal(b.sim.broken, 3);
    assert_int_equal(b.sim.triangle_active[hit.triangle], 0);
    live_steps(1);
    assert_int_equal(sim_measure(&b.sim).triangles_active, b.sim.triangle_count - 1);
    close_live(&b);
}

static void a_pull_moves_the_skin_towards_the_hand_until_it_lets_go(void **state)
{
    (void)state;
    static const char *const methods[] = {"time.integrator=symplectic-euler", "time.integrator=bdf2"};
    for (size_t m = 0; m < 2; m++) {
        struct balloon b;
        struct hand_hit hit;
        open_live(&b, SETTINGS(methods[m], "balloons[0].pressure=0", "time.step=0.01"), MEMORY);
        assert_true(hand_find(&b.sim, (const double[3]){1, 2, 500}, backwards, &hit));
        const uint32_t p = b.sim.triangle_point[hit.triangle][0];
        const double z = b.sim.position[p][2];
        hand_take(&live.hand, &b.sim, &hit);
        live_steps(1);
        assert_near(b.sim.position[p][2], z, 1e-9); /* a hand that does not move pulls at nothing */
        hand_move(&live.hand, &b.sim, (const double[3]){hit.place[0], hit.place[1], hit.place[2] + 20});
        live_steps(60);
        assert_true(sim_measure(&b.sim).max_stretch > 1.1);
        assert_true(b.sim.position[p][2] > z + 4);
        hand_let_go(&live.hand, &b.sim);
        assert_null(b.sim.hand);
        live_steps(2000);
        assert_int_equal(b.sim.broken, 0);
        assert_true(sim_measure(&b.sim).max_stretch <
                    1.05); /* dampers brought it to rest, but for its drift */
        close_live(&b);
    }
}

static double strongest_finger(const char *const *changes)
{
    struct balloon b;
    struct hand_hit hit;
    open_live(&b, changes, MEMORY);
    assert_true(hand_find(&b.sim, (const double[3]){1, 2, 500}, backwards, &hit));
    hand_take(&live.hand, &b.sim, &hit);
    double most = 0;
    for (uint32_t f = 0; f < live.hand.count; f++)
        most = fmax(most, live.hand.finger[f].stiffness);
    close_live(&b);
    return most;
}

static void a_hand_is_as_strong_as_the_skin(void **state)
{
    (void)state;
    const double springs = strongest_finger(SETTINGS("balloons[0].spring=20"));
    assert_true(springs > 0);
    assert_near(strongest_finger(SETTINGS("balloons[0].spring=40")), 2 * springs, 1e-12 * springs);
    assert_near(strongest_finger(SETTINGS("balloons[0].membrane.thickness=0.5",
                                          "balloons[0].membrane.shear_modulus=80", "time.guard=substep")),
                2 * springs, 1e-12 * springs); /* 80 x 0.5 = 40, whatever the springs' default */
}

/* Velocity Verlet's energy error is of second order: a quarter at half the step. */
static void the_hands_work_is_accounted_for(void **state)
{
    (void)state;
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        struct balloon b;
        struct hand_hit hit;
        struct error err = {0};
        open_live(&b, SETTINGS("time.integrator=verlet", fine ? "time.step=0.001" : "time.step=0.002"),
                  MEMORY);
        assert_ok(ledger_open(&b.sim, &err), &err);
        assert_true(hand_find(&b.sim, (const double[3]){1, 2, 500}, backwards, &hit));
        hand_take(&live.hand, &b.sim, &hit);
        hand_move(&live.hand, &b.sim, (const double[3]){hit.place[0], hit.place[1], hit.place[2] + 20});
        live_steps(fine ? 400 : 200);
        const struct sim_measures measures = sim_measure(&b.sim);
        const struct ledger_balance balance = ledger_balance(&b.sim, &measures);
        assert_true(balance.user_work > 100);
        error[fine] = fabs(balance.error);
        close_live(&b);
    }
    assert_true(error[1] < 0.3 * error[0]);
}

static void a_guarded_step_is_split_finer_while_the_hand_pulls(void **state)
{
    (void)state;
    struct balloon b;
    struct hand_hit hit;
    open_live(&b, SETTINGS("time.integrator=symplectic-euler", "time.guard=substep", "balloons[0].damping=0"),
              MEMORY);
    live_steps(2);
    const double before = b.sim.step;
    assert_true(hand_find(&b.sim, (const double[3]){1, 2, 5000}, backwards, &hit));
    hand_take(&live.hand, &b.sim, &hit);
    for (uint32_t f = 0; f < live.hand.count; f++)
        live.hand.finger[f].stiffness *= 100;
    live_steps(2);
    assert_true(b.sim.step < before);
    close_live(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_follows_the_clock_at_its_pace),
        cmocka_unit_test(what_does_not_get_done_in_time_is_not_made_up_for),
        cmocka_unit_test(paused_it_takes_single_steps_only),
        cmocka_unit_test(slow_motion_runs_at_the_films_pace),
        cmocka_unit_test(dials_turn_between_steps_within_the_scenes_range),
        cmocka_unit_test(the_first_dial_turns_the_pump_where_there_is_gas),
        cmocka_unit_test(a_membrane_has_no_springs_to_be_turned),
        cmocka_unit_test(a_frame_of_the_past_is_followed_by_the_same_future),
        cmocka_unit_test(the_past_keeps_its_start_and_its_end_within_its_memory),
        cmocka_unit_test(the_past_is_a_minute_of_film),
        cmocka_unit_test(what_does_not_change_is_kept_once),
        cmocka_unit_test(a_restart_is_as_at_the_start),
        cmocka_unit_test(a_ray_finds_the_nearer_wall_or_none),
        cmocka_unit_test(a_prick_makes_a_hole_where_it_hits),
        cmocka_unit_test(a_pull_moves_the_skin_towards_the_hand_until_it_lets_go),
        cmocka_unit_test(a_hand_is_as_strong_as_the_skin),
        cmocka_unit_test(the_hands_work_is_accounted_for),
        cmocka_unit_test(a_guarded_step_is_split_finer_while_the_hand_pulls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
