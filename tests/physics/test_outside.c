/* What acts on a balloon from outside: gravity, the lift of light gas, drag, strings and pins. */
#include "common/vec3.h"
#include "sim/effect_gas.h"
#include "sim/effect_string.h"
#include "sim/guard.h"
#include "sim/jacobian.h"
#include "sim/live_hand.h"
#include "unit/books.h"

/* A balloon that nothing inflates and nothing breaks. */
#define QUIET(...) \
    SETTINGS("balloons[0].pressure=0", "balloons[0].threshold=1e6", "time.guard=off", __VA_ARGS__)

static void mean_of(const struct balloon *b, double (*rows)[4], double mean[3])
{
    for (int i = 0; i < 3; i++) {
        mean[i] = 0;
        for (uint32_t p = 0; p < b->sim.point_count; p++)
            mean[i] += rows[p][i] / b->sim.point_count;
    }
}

/* Verlet's parabola is exact: g t^2/2, to the rounding of 100 steps of sums of 162 springs' forces. */
static void what_falls_falls_by_half_g_t_squared(void **state)
{
    (void)state;
    struct balloon b;
    double mean[3];
    open_balloon(&b, 2,
                 QUIET("time.integrator=verlet", "time.step=0.01", "gravity.acceleration=[1.0, -9.81, 0.5]"));
    steps(&b, 100);
    mean_of(&b, b.sim.position, mean);
    assert_near(mean[0], 0.5, 1e-11);
    assert_near(mean[1], -9.81 / 2, 1e-11);
    assert_near(mean[2], 0.25, 1e-11);
    close_balloon(&b);
}

/* Archimedes: the whole force is (air - gas) V g upwards, whatever the shape, and the weight of the skin
 * against it; to the rounding of pressures of 20 on areas of some 100. */
static void light_gas_lifts_by_the_weight_of_the_air_less_its_own(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].gas.ambient=10", "balloons[0].gas.fill=3", "balloons[0].spring=0",
                          "balloons[0].gas.density=0.0002", "gravity.air_density=0.0012",
                          "gravity.acceleration=[0.0, -9.81, 0.0]", "balloons[0].position=[500, 70, 0]"));
    double force[3] = {0}, mass = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++) /* out of round */
        b.sim.position[p][1] += 0.3 * b.sim.position[p][2] + 4 * sin(p);
    sim_forces(&b.sim);
    const double volume = gas_look(&b.sim, &b.sim.balloons[0]).volume,
                 rest = 3 * 0.0002 * (gas_look(&b.sim, &b.sim.balloons[0]).amount / 30);
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        mass += b.sim.mass[p];
        for (int i = 0; i < 3; i++)
            force[i] += b.sim.force[p][i];
    }
    assert_near(force[1], 9.81 * (0.0012 * volume - rest - mass), 1e-8);
    assert_near(force[0], 0, 1e-8);
    assert_near(force[2], 0, 1e-8);
    close_balloon(&b);
}

/* A stiff sphere falls until drag holds its weight: M g = r C/2 v^2 sum A |n_y|^3, which here is taken from
 * the mesh, so only springs that give can differ: its shape, by g m/k of a radius, 1e-5, and the last of the
 * approach, exp(-2 g t/v) of v: below 1e-6 from t = 7 v/g on. */
static void what_falls_in_air_reaches_its_terminal_speed(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 QUIET("time.integrator=rk4", "time.step=0.005", "gravity.acceleration=[0.0, -9.81, 0.0]",
                       "drag.air_density=0.01", "balloons[0].spring=2000"));
    double area = 0, mass = 0, mean[3];
    for (uint32_t t = 0; t < b.sim.triangle_count; t++) {
        const uint32_t *p = b.sim.triangle_point[t];
        double u[3], v[3];
        for (int i = 0; i < 3; i++) {
            u[i] = b.sim.position[p[1]][i] - b.sim.position[p[0]][i];
            v[i] = b.sim.position[p[2]][i] - b.sim.position[p[0]][i];
        }
        const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        area += pow(fabs(n[1]), 3) / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    }
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        mass += b.sim.mass[p];
    assert_near(area, M_PI * 45 * 45,
                0.05 * area); /* the cross-section of a sphere, as fine as this one is */
    const double speed = sqrt(2 * mass * 9.81 / (0.01 * 0.47 * area));
    while (b.sim.time < 7 * speed / 9.81)
        steps(&b, 1);
    mean_of(&b, b.sim.velocity, mean);
    print_message("# terminal speed %.6g of %.6g\n", -mean[1], speed);
    assert_near(-mean[1], speed, 1e-3 * speed);
    close_balloon(&b);
}

/* It is carried along until it is as fast as the wind: from rest, dv/dt = c (w - v)^2, w - v = w/(1 + c w t)
 * with the c of the fall above. */
static void wind_carries_it_along(void **state)
{
    (void)state;
    struct balloon b;
    double mean[3];
    open_balloon(&b, 3,
                 QUIET("time.integrator=rk4", "time.step=0.005", "drag.air_density=0.01",
                       "drag.wind=[30, 0, 0]", "balloons[0].spring=2000"));
    steps(&b, 200);
    mean_of(&b, b.sim.velocity, mean);
    const double c = 0.01 * 0.47 / 2 * M_PI * 45 * 45 / (0.11 * b.sim.point_count);
    assert_near(30 - mean[0], 30 / (1 + c * 30 * 1), 0.02 * mean[0]); /* the cross-section within 2 % */
    assert_near(mean[1], 0, 1e-3);
    close_balloon(&b);
}

/* Air and skin share a point's force: which comes first must not depend on how points are shared out. A
 * sphere of several chunks (parts.c), whose neighbours are far from each other in the tables, goes through
 * springs, through arms that xpbd adds, and is pressed by area. */
static void wind_is_the_same_to_the_bit_on_any_number_of_workers(void **state)
{
    (void)state;
    static const char *const more[] = {"time.integrator=symplectic-euler", "time.integrator=xpbd",
                                       "balloons[0].pressure_on=areas"};
    for (int m = 0; m < 3; m++) {
        struct balloon b;
        struct error err = {0};
        open_balloon(&b, 4,
                     SETTINGS(more[m], "balloons[0].viscosity.ratio=0.5", "balloons[0].pressure=0.1",
                              "drag.air_density=0.01", "drag.wind=[30, 0, 5]"));
        for (unsigned workers = 2; workers <= 3; workers++) {
            struct sim sim = {0};
            assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers, &err), &err);
            while (b.sim.steps < 4)
                steps(&b, 1);
            while (sim.steps < 4)
                assert_ok(sim_step(&sim, &err), &err);
            assert_int_equal(sim_hash(&sim), sim_hash(&b.sim));
            sim_clear(&sim);
        }
        close_balloon(&b);
    }
}

/* Pinned at the top, pulled down: what is held stays to the bit until it is let go. */
static void pins_hold_until_they_let_go(void **state)
{
    (void)state;
    static const char *const methods[] = {"symplectic-euler", "rk4", "backward-euler", "xpbd"};
    for (int m = 0; m < 4; m++) {
        struct balloon b;
        char method[64];
        snprintf(method, sizeof method, "time.integrator=%s", methods[m]);
        open_balloon(&b, 2,
                     QUIET(method, "time.step=0.01", "gravity.acceleration=[0.0, -9.81, 0.0]",
                           "balloons[0].pins.place=[0.0, 1.0, 0.0]", "balloons[0].pins.reach=20",
                           "balloons[0].pins.until=0.5"));
        uint32_t held = 0, top = 0;
        double rest[4];
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            top = b.sim.position[p][1] > b.sim.position[top][1] ? p : top;
        memcpy(rest, b.sim.position[top], sizeof rest);
        steps(&b, 49);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            held += b.sim.velocity[p][0] == 0 && b.sim.velocity[p][1] == 0;
        assert_true(held > 3 && held < 20);
        assert_memory_equal(rest, b.sim.position[top], sizeof rest);
        steps(&b, 20);
        assert_true(b.sim.position[top][1] < rest[1] && b.sim.news_count == 1);
        close_balloon(&b);
    }
}

/* Neither its force nor what that changes by: a skin that is all held feels nothing of it. */
static void the_hand_does_not_move_what_pins_hold(void **state)
{
    (void)state;
    struct balloon b;
    struct hand hand;
    struct hand_hit hit;
    struct error err = {0};
    open_balloon(&b, 2, QUIET("balloons[0].pins.reach=180"));
    double(*change)[4] = calloc(b.sim.point_count, sizeof *change);
    assert_ok(hand_open(&hand, &b.sim, &err), &err);
    assert_true(hand_find(&b.sim, (const double[3]){1, 2, 500}, (const double[3]){0, 0, -1}, &hit));
    hand_take(&hand, &b.sim, &hit);
    hand_move(&hand, &b.sim, (const double[3]){hit.place[0], hit.place[1], hit.place[2] + 20});
    sim_forces(&b.sim);
    assert_ok(sim_jacobian_open(&b.sim, &err), &err);
    sim_linearise(&b.sim);
    sim_force_product(&b.sim, 1, b.sim.position, 1, b.sim.position, change);
    sim_jacobian_close(&b.sim);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        assert_true(vec3_length(b.sim.force[p]) == 0 && vec3_length(change[p]) == 0);
    free(change);
    hand_close(&hand, &b.sim);
    close_balloon(&b);
}

/* From where it is to where it passes below what holds it, in s; the way in between by a straight line. */
static double until_below(struct balloon *b)
{
    double skin[3], end[3], last, now = 0;
    do {
        last = now;
        steps(b, 1);
        string_ends(&b->sim, b->sim.balloons, skin, end);
        now = end[0] - skin[0];
    } while (last * now >= 0);
    return b->sim.time - b->sim.step * now / (now - last);
}

/* Half a period is pi sqrt(l/g) (1 + a^2/16 + 11 a^4/3072) at an angle a; l as the weight stretches it, by
 * 5e-5 of it, which a^2/4 = 1 % more in the mean of a swing changes by less than the 1e-5 that are asked. */
static void a_weight_swings_as_a_pendulum_does(void **state)
{
    (void)state;
    struct balloon b;
    double skin[3], end[3];
    open_balloon(&b, 2,
                 QUIET("time.integrator=rk4", "time.step=0.025", "gravity.acceleration=[0,-10,0]",
                       "balloons[0].pins.reach=180", "balloons[0].string.place=[0,-1,0]",
                       "balloons[0].string.reach=0", "balloons[0].string.to=[0.2,-2,0]",
                       "balloons[0].string.stiffness=2e5", "balloons[0].string.damping=0",
                       "balloons[0].string.weight=50"));
    string_ends(&b.sim, b.sim.balloons, skin, end);
    const double length = vec3_distance(skin, end) + 50 * 10 / 2e5,
                 a2 = pow(atan2(end[0] - skin[0], skin[1] - end[1]), 2);
    const double half = M_PI * sqrt(length / 10) * (1 + a2 / 16 + 11 * a2 * a2 / 3072);
    const double first = until_below(&b);
    assert_near(until_below(&b) - first, half, 1e-5 * half);
    close_balloon(&b);
}

/* A balloon on a string in the wind of its own weight: it hangs from the string's end with the tension M g,
 * the string longer by M g/k: after the swinging has died down by damping, to a thousandth. */
static void it_hangs_on_its_string(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 QUIET("time.integrator=rk4", "time.step=0.005", "gravity.acceleration=[0.0, -9.81, 0.0]",
                       "balloons[0].string.place=[0.0, 1.0, 0.0]", "balloons[0].string.to=[0.0, 2.0, 0.0]",
                       "balloons[0].string.stiffness=50", "balloons[0].string.reach=25",
                       "balloons[0].string.damping=20", "balloons[0].spring=500", "balloons[0].damping=2"));
    double mass = 0, top = 0;
    uint32_t count = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        mass += b.sim.mass[p];
        if (atan2(hypot(b.sim.position[p][0], b.sim.position[p][2]), b.sim.position[p][1]) <= 25 * M_PI / 180)
            count++;
    }
    uint32_t patch[64], n = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        if (atan2(hypot(b.sim.position[p][0], b.sim.position[p][2]), b.sim.position[p][1]) <= 25 * M_PI / 180)
            patch[n++] = p;
    for (uint32_t i = 0; i < n; i++)
        top -= b.sim.position[patch[i]][1] / count;
    steps(&b, 4000);
    for (uint32_t i = 0; i < n; i++)
        top += b.sim.position[patch[i]][1] / count;
    assert_near(-top, mass * 9.81 / 50, 0.01 * mass * 9.81 / 50);
    close_balloon(&b);
}

/* While it hangs slack a string pulls at nothing, and steps are as long as without it; before it is taut
 * they are as short as it asks; and when it is slack again nearly as long as before: the bound's own search
 * for the stiffest motion begins at that of the string. */
static void a_slack_string_asks_for_no_shorter_steps(void **state)
{
    (void)state;
    struct balloon b, free;
    const char *const fall = "gravity.acceleration=[0.0, -9.81, 0.0]", *const guard = "time.guard=substep",
                      *const method = "time.integrator=symplectic-euler";
    open_balloon(&free, 2, QUIET(method, guard, fall));
    open_balloon(&b, 2,
                 QUIET(method, guard, fall, "balloons[0].string.place=[0.0, 1.0, 0.0]",
                       "balloons[0].string.to=[0.0, 2.0, 0.0]", "balloons[0].string.slack=3",
                       "balloons[0].string.stiffness=1e4", "balloons[0].string.damping=0"));
    const double end[3] = {0, 90, 0}, whole = guard_stable_step(&free.sim);
    uint32_t top = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        top = b.sim.position[p][1] > b.sim.position[top][1] ? p : top;
    const double length = 3 * vec3_distance(b.sim.position[top], end);
    assert_true(guard_stable_step(&b.sim) == whole);
    for (int i = 0; i < 1000 && vec3_distance(b.sim.position[top], end) < length; i++)
        steps(&b, 1);
    assert_true(vec3_distance(b.sim.position[top], end) > length);
    assert_true(guard_stable_step(&b.sim) < whole / 3);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        b.sim.position[p][1] += length / 2;
    steps(&b, 1);
    assert_true(guard_stable_step(&b.sim) > 0.8 * whole);
    close_balloon(&free);
    close_balloon(&b);
}

/* With a weight at the end, nothing outside but gravity acts: weight and balloon fall together by half g t^2,
 * taut or slack, to rounding. */
static void a_weight_and_its_balloon_fall_as_one(void **state)
{
    (void)state;
    struct balloon b;
    double mean[3], mass = 0;
    open_balloon(&b, 2,
                 QUIET("time.integrator=rk4", "time.step=0.002", "gravity.acceleration=[0.0, -9.81, 0.0]",
                       "balloons[0].string.slack=0.7", "balloons[0].string.weight=7",
                       "balloons[0].string.stiffness=300", "balloons[0].string.damping=0"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        mass += b.sim.mass[p];
    steps(&b, 500);
    mean_of(&b, b.sim.position, mean);
    const double centre = (mass * mean[1] + 7 * b.sim.scalar[1]) / (mass + 7);
    assert_near(centre, 7 * -90.0 / (mass + 7) - 9.81 / 2, 1e-9);
    close_balloon(&b);
}

/* The balance of energies with all of them at once falls with RK4's order (10 of 16 leaves room for the
 * next). A string goes slack only where it was never taut here: that kink would cost an order. */
static double balance_error(const char *step, double *scale)
{
    struct sim_measures end;
    const struct ledger_balance account = balance_of_run(
        SETTINGS("time.integrator=rk4", step, "time.guard=off", "balloons[0].threshold=100",
                 "gravity.acceleration=[0.0, -9.81, 0.0]", "gravity.air_density=0.001",
                 "drag.air_density=0.001", "drag.wind=[20, 0, 0]", "balloons[0].gas.ambient=10",
                 "balloons[0].gas.fill=2", "balloons[0].gas.density=0.0002", "balloons[0].string.slack=0.1",
                 "balloons[0].string.stiffness=20"),
        &end);
    *scale = end.kinetic_energy;
    return account.error;
}

static void the_balance_of_energies_holds(void **state)
{
    (void)state;
    double scale;
    const double coarse = balance_error("time.step=0.004", &scale),
                 fine = balance_error("time.step=0.002", &scale);
    print_message("# balance %.3g, %.3g of %.3g\n", coarse, fine, scale);
    assert_true(fabs(fine) < fabs(coarse) / 10 || fabs(fine) < 1e-11 * scale);
}

/* A pressure that is given works by p dV, whatever the skin does meanwhile: what the books have of it is that
 * to RK4's error, whose share is (step x 60/s)^4, 60/s the springs' fastest swing. */
static void a_given_pressure_works_by_p_dv(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("time.integrator=rk4", "time.step=0.001", "balloons[0].threshold=100",
                          "balloons[0].pressure_on=areas", "balloons[0].pressure=0.3"));
    open_books(&b);
    const double before = sim_measure(&b.sim).volume;
    steps(&b, 300);
    const double work = 0.3 * (sim_measure(&b.sim).volume - before);
    const struct ledger_balance account = balance(&b);
    assert_true(work > 1000);
    assert_near(account.pressure_work, work, 1e-5 * work);
    assert_near(account.error, 0, 1e-5 * work);
    close_balloon(&b);
}

/* It may be so stiff that a step goes wrong; no point of the skin need tell, since what is nowhere pulls at
 * nothing. */
static void test_a_weight_that_runs_away_ends_the_run(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS("balloons[0].string.weight=7", "balloons[0].pressure=0"));
    steps(&b, 1);
    b.sim.scalar[b.sim.scalar_count - 1] = INFINITY;
    assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED,
                   "the weight on the string of balloons[0] has run away", &err);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_falls_falls_by_half_g_t_squared),
        cmocka_unit_test(light_gas_lifts_by_the_weight_of_the_air_less_its_own),
        cmocka_unit_test(what_falls_in_air_reaches_its_terminal_speed),
        cmocka_unit_test(wind_carries_it_along),
        cmocka_unit_test(wind_is_the_same_to_the_bit_on_any_number_of_workers),
        cmocka_unit_test(pins_hold_until_they_let_go),
        cmocka_unit_test(the_hand_does_not_move_what_pins_hold),
        cmocka_unit_test(a_weight_swings_as_a_pendulum_does),
        cmocka_unit_test(it_hangs_on_its_string),
        cmocka_unit_test(a_slack_string_asks_for_no_shorter_steps),
        cmocka_unit_test(a_weight_and_its_balloon_fall_as_one),
        cmocka_unit_test(the_balance_of_energies_holds),
        cmocka_unit_test(a_given_pressure_works_by_p_dv),
        cmocka_unit_test(test_a_weight_that_runs_away_ends_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
