/* Balloons that come to a violent end: pressure at once, vacuum, everything torn. What is left
 * flies as physics says. */
#include "hard.h"

/* sqrt(2 E) of a balloon at rest grows by no more than the pressures' push; symplectic Euler
 * keeps E to a factor of 2. */
static void ten_times_the_bursting_pressure_at_once(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 SETTINGS("time.guard=substep", "balloons[0].pressure=0", "schedule[0].at=0.1",
                          "schedule[0].pressure=100"));
    while (b.sim.time < 5) {
        steps(&b, 1);
        assert_true(energy_of(&b) <= 2 * reachable(&b, 100));
    }
    assert_finite(&b.sim);
    assert_true(b.sim.broken > b.sim.edge_count / 2);
    close_balloon(&b);
}

static void a_vacuum_drives_the_volume_through_zero(void **state)
{
    (void)state;
    struct balloon b;
    double smallest = INFINITY;
    open_balloon(&b, 2, HARD("balloons[0].pressure=-1000"));
    while (b.sim.time < 5) {
        steps(&b, 1);
        assert_true(energy_of(&b) <= 2 * reachable(&b, 1000));
        smallest = fmin(smallest, sim_measure(&b.sim).volume);
    }
    assert_finite(&b.sim);
    assert_true(smallest < 1e-2 * 4 / 3. * M_PI * 45 * 45 * 45);
    close_balloon(&b);
}

/* Every point in the same place: no edge has a direction, no triangle a normal, so nothing moves. */
static void a_volume_of_exactly_zero_is_at_rest(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HARD());
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        memset(b.sim.position[p], 0, sizeof *b.sim.position);
    guard_outdated(&b.sim);
    steps(&b, 100);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        assert_near(vec3_length(b.sim.position[p]), 0, 0);
    close_balloon(&b);
}

/* Nobody is left to push or pull: points fly on as they did, to the bit. */
static void everything_tears_in_one_step_and_flies_on(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HARD());
    steps(&b, 20);
    b.sim.settings[0].threshold_length = 0;
    steps(&b, 1);
    assert_int_equal(b.sim.broken, b.sim.edge_count);
    assert_int_equal(sim_measure(&b.sim).triangles_active, 0);
    double before[4];
    memcpy(before, b.sim.velocity[5], sizeof before);
    steps(&b, 100);
    assert_memory_equal(before, b.sim.velocity[5], sizeof before);
    assert_true(vec3_length(before) > 0);
    assert_finite(&b.sim);
    close_balloon(&b);
}

/* Torn to single triangles, and then without air: momentum stays, but for the rounding of
 * 1000 sums over 162 points. */
static void single_triangles_keep_mass_and_momentum(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("time.guard=substep", "balloons[0].pressure=250", "schedule[0].at=1",
                          "schedule[0].pressure=0"));
    while (b.sim.time < 1.1)
        steps(&b, 1);
    const struct sim_measures m = sim_measure(&b.sim);
    assert_true(m.pieces > 1 && m.triangles_active < b.sim.triangle_count / 2);
    double before[3], after[3], mass = 0;
    momentum_of(&b.sim, before);
    steps(&b, 1000);
    momentum_of(&b.sim, after);
    for (int i = 0; i < 3; i++)
        assert_near((after[i] - before[i]) / impulse_of(&b.sim), 0, 1e-12);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        mass += b.sim.mass[p];
    assert_near(mass, 0.11 * b.sim.point_count, 1e-12);
    close_balloon(&b);
}

/* All edges past the threshold let go at the end of the same step, whatever their number, so that a tie needs
 * no breaking: on the icosahedron, whose thirty edges are equal, all or none. Rounding makes their lengths
 * differ by some 1e-15, which is why the threshold is put where no length can come near it in a step. */
static void equal_edges_let_go_together(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0,
                 SETTINGS("time.guard=substep", "balloons[0].threshold=1.2", "balloons[0].pressure=600"));
    while (!b.sim.broken && b.sim.time < 10)
        steps(&b, 1);
    assert_int_equal(b.sim.broken, 30);
    close_balloon(&b);
}

/* A burst ends with as much of the skin whichever thread works on it, and twice the same to the bit. */
static void a_burst_in_substeps_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {2, 3, 7, 16};
    struct balloon one;
    struct error err = {0};
    open_balloon(&one, 3, SETTINGS("time.guard=substep", "time.step=0.1", "balloons[0].pressure=60"));
    steps(&one, 400);
    assert_true(one.sim.broken > 100);
    for (size_t i = 0; i < sizeof workers / sizeof workers[0]; i++) {
        struct sim sim;
        assert_ok(sim_open(&sim, &one.scene, &one.mesh, workers[i], &err), &err);
        for (int step = 0; step < 400; step++)
            assert_ok(sim_step(&sim, &err), &err);
        assert_true(sim_hash(&sim) == sim_hash(&one.sim));
        sim_clear(&sim);
    }
    close_balloon(&one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_times_the_bursting_pressure_at_once),
        cmocka_unit_test(a_vacuum_drives_the_volume_through_zero),
        cmocka_unit_test(a_volume_of_exactly_zero_is_at_rest),
        cmocka_unit_test(everything_tears_in_one_step_and_flies_on),
        cmocka_unit_test(single_triangles_keep_mass_and_momentum),
        cmocka_unit_test(equal_edges_let_go_together),
        cmocka_unit_test(a_burst_in_substeps_is_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
