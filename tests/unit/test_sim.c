/* Around the step: what a scene sets up, its effects, its schedule, its looks, and runs as a whole. */
#include "balloon.h"
#include "common/vec3.h"
#include "sim/material.h"

static void the_scene_decides_size_place_and_mass(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(
        &b, 2,
        SETTINGS("balloons[0].radius=30", "balloons[0].position=[1, 2, 3]", "balloons[0].point_mass=4"));
    const double centre[3] = {1, 2, 3};
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        assert_near(vec3_distance(b.sim.position[p], centre), 30, 1e-12);
    assert_near(b.sim.mass[0], 4, 0);
    struct sim_measures m = sim_measure(&b.sim);
    assert_near(m.mean_radius, 30, 1e-12);
    assert_near(m.volume, mesh_volume(&b.mesh) * 27000, 1e-9);
    assert_near(m.area, mesh_area(&b.mesh) * 900, 1e-9);
    assert_int_equal(m.pieces, 1);
    assert_near(m.largest_piece_area, m.area, 1e-9);
    close_balloon(&b);
}

static void springs_by_height_follow_the_profile(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(
        &b, 3,
        SETTINGS("balloons[0].spring_by_height.profile=((0, 3), (0.5, 1), (1, 2))", "balloons[0].spring=20"));
    for (uint32_t e = 0; e < b.sim.edge_count; e++) {
        const uint32_t *p = b.sim.edge_point[e];
        double y = (b.sim.position[p[0]][1] + b.sim.position[p[1]][1]) / 2 / 45;
        assert_near(b.sim.current_spring_const[e], 20 * (y < 0 ? 1 - 2 * y : 1 + y), 0.1);
    }
    close_balloon(&b);

    /* "This gives the balloon the realistic behavior of expanding in the middle more
     * than at the top or bottom" */
    open_balloon(&b, 3,
                 SETTINGS("balloons[0].spring_by_height.profile=((0, 3), (0.5, 1), (1, 3))",
                          "balloons[0].pressure=2", "balloons[0].spring=5"));
    steps(&b, 400);          /* at rest again */
    double stretch[2] = {0}; /* mean of the edges near the middle, and near the ends */
    int count[2] = {0};
    for (uint32_t e = 0; e < b.sim.edge_count; e++) {
        const double height = fabs(b.mesh.position[b.sim.edge_point[e][0]][1]);
        if (height > 0.3 && height < 0.8)
            continue;
        stretch[height > 0.5] += sim_edge_length(&b.sim, e) / b.sim.rest_length[e];
        count[height > 0.5]++;
    }
    assert_true(stretch[0] / count[0] - 1 > 1.5 * (stretch[1] / count[1] - 1));
    close_balloon(&b);
}

static void a_rip_opens_at_its_time_and_place(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 SETTINGS("balloons[0].rip.at=0.09", "balloons[0].rip.place=[0, 0, 1]",
                          "balloons[0].pressure=0", "balloons[0].rip.direction=[0, 1, 0]",
                          "balloons[0].rip.length=1"));
    steps(&b, 3);
    assert_int_equal(b.sim.broken, 0);
    steps(&b, 1); /* t = 0.1 */
    assert_true(b.sim.broken > 5);
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        if (!b.sim.edge_active[e]) {
            const double *x = b.sim.position[b.sim.edge_point[e][0]];
            assert_true(x[2] > 0 && fabs(x[0]) < 8 &&
                        fabs(x[1]) < 45 * sin(0.5) + 8); /* an edge is up to 7.4 long */
        }
    const uint32_t cut = b.sim.broken;
    steps(&b, 10);
    assert_int_equal(b.sim.broken, cut); /* once */
    close_balloon(&b);
}

/* Shorter than the way between two edges it crosses none. */
static void a_rip_that_cuts_nothing_says_so(void **state)
{
    (void)state;
    static const char *const lengths[] = {"balloons[0].rip.length=1e-6", "balloons[0].rip.length=0"},
                             *const modes[] = {"balloons[0].fracture.mode=paper",
                                               "balloons[0].fracture.mode=tear"};
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_balloon(&b, 2, SETTINGS(lengths[i], modes[i], "balloons[0].pressure=0"));
        steps(&b, 2);
        assert_int_equal(b.sim.broken, 0);
        assert_int_equal(b.sim.news_count, 1);
        assert_string_equal(b.sim.news[0].effect, "rip");
        close_balloon(&b);
    }
}

static void a_rip_waits_for_its_stretch(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, SETTINGS("balloons[0].rip.stretch=1.1", "balloons[0].pressure=6"));
    while (!b.sim.broken && b.sim.steps < 100)
        steps(&b, 1);
    const double stretch = sim_measure(&b.sim).mean_radius / 45;
    assert_true(stretch >= 1.1 && stretch < 1.15); /* a step adds up to .04 here */
    close_balloon(&b);
}

static void the_schedule_changes_step_and_pressure_between_steps(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 SETTINGS("balloons[0].pressure=2", "schedule[0].at=0.05", "schedule[0].pressure=3",
                          "schedule[0].step=0.01", "schedule[1].at=0.07", "schedule[1].spring_factor=2"));
    steps(&b, 2); /* t = 0.05 */
    assert_near(b.sim.settings[0].pressure, 2, 0);
    steps(&b, 1);
    assert_near(b.sim.settings[0].pressure, 3, 0);
    assert_near(b.sim.time, 0.06, 1e-15);
    assert_near(b.sim.current_spring_const[0], 20, 0);
    steps(&b, 2);
    assert_near(b.sim.current_spring_const[0], 40, 0);
    assert_near(b.sim.time, 0.08, 1e-15);
    close_balloon(&b);
}

static void two_runs_are_equal_to_the_bit_and_a_hash_tells_states_apart(void **state)
{
    (void)state;
    struct balloon a, b;
    open_balloon(&a, 3, SETTINGS("balloons[0].pressure=10"));
    open_balloon(&b, 3, SETTINGS("balloons[0].pressure=10"));
    steps(&a, 60);
    steps(&b, 60);
    assert_true(sim_hash(&a.sim) == sim_hash(&b.sim));
    b.sim.position[3][1] = nextafter(b.sim.position[3][1], 1e9);
    assert_true(sim_hash(&a.sim) != sim_hash(&b.sim));
    close_balloon(&a);
    close_balloon(&b);
}

static void any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    static const unsigned workers[] = {2, 3, 7, 16};
    struct error err = {0};
    struct balloon one;
    open_balloon(&one, 3, SETTINGS("balloons[0].pressure=10", "balloons[0].threshold=1.2"));
    steps(&one, 60);
    assert_true(one.sim.broken > 0);
    for (size_t i = 0; i < sizeof workers / sizeof workers[0]; i++) {
        struct sim sim;
        assert_ok(sim_open(&sim, &one.scene, &one.mesh, workers[i], &err), &err);
        for (int step = 0; step < 60; step++)
            assert_ok(sim_step(&sim, &err), &err);
        assert_true(sim_hash(&sim) == sim_hash(&one.sim));
        sim_clear(&sim);
    }
    close_balloon(&one);
}

static void several_balloons_move_as_each_would_alone(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon alone;
    open_balloon(&alone, 2, SETTINGS("balloons[0].pressure=9"));
    steps(&alone, 50);

    struct scene_balloon pair[2] = {alone.scene.balloons[0], alone.scene.balloons[0]};
    pair[0].pressure = 3;
    struct scene scene = alone.scene;
    scene.balloons = pair;
    scene.balloon_count = 2;
    struct mesh meshes[2] = {alone.mesh, alone.mesh};
    struct sim sim;
    assert_ok(sim_open(&sim, &scene, meshes, 1, &err), &err);
    for (int i = 0; i < 50; i++)
        assert_ok(sim_step(&sim, &err), &err);
    assert_memory_equal(sim.position + alone.sim.point_count, alone.sim.position,
                        alone.sim.point_count * sizeof *sim.position);
    sim_clear(&sim);
    close_balloon(&alone);
}

static void an_effect_that_is_off_has_no_hook(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=0"));
    for (int phase = 0; phase < EFFECT_PHASES; phase++) {
        assert_int_equal(b.sim.hook_count[phase], 0);
        assert_null(b.sim.hooks[phase]);
    }
    close_balloon(&b);
}

static void a_run_that_diverges_names_point_time_and_the_likely_cause(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS("time.step=1", "balloons[0].threshold=1e6", "balloons[0].spring=1e6"));
    /* the threshold is far; each step multiplies what is wrong by about 1e7, so that
     * 100 steps pass any double */
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        b.sim.settings[0].threshold_length = INFINITY;
    enum status status = STATUS_OK;
    for (int i = 0; i < 200 && !status; i++)
        status = sim_step(&b.sim, &err);
    assert_refused(status, STATUS_DIVERGED, "diverged at time", &err);
    assert_non_null(strstr(err.text, "of balloons[0] is at"));
    assert_non_null(strstr(err.text, "time.step 1 is too large: steps up to"));
    close_balloon(&b);
}

/* A skin that tears has room behind its points for those to come: whatever is there, a
 * point is named that is one. */
static void a_point_yet_to_come_is_not_what_diverged(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS("balloons[0].membrane.thickness=0.01", "balloons[0].fracture.strength=1.1"));
    assert_true(b.sim.balloons[0].point_end < b.sim.point_count);
    b.sim.velocity[b.sim.balloons[0].point_end][0] = INFINITY;
    b.sim.velocity[3][0] = 1;
    assert_refused(sim_diverged(&b.sim, INFINITY, &err), STATUS_DIVERGED, "point 3 of balloons[0]", &err);
    close_balloon(&b);
}

static void stretched_skin_is_clearer_and_shinier(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].pressure=0", "balloons[0].opacity=0.9", "balloons[0].shininess=10"));
    float *opacity = malloc(b.sim.triangle_count * sizeof *opacity);
    float *shininess = malloc(b.sim.triangle_count * sizeof *shininess);
    for (int twice = 0; twice < 2; twice++) {
        sim_material(&b.sim, opacity, shininess);
        /* at stretch L: 1 - 0.1^(1/L^2), and 10 L^4; floats */
        assert_near(opacity[3], twice ? 1 - pow(0.1, 0.25) : 0.9, 1e-6);
        assert_near(shininess[3], twice ? 160 : 10, 1e-4);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int i = 0; i < 3; i++)
                b.sim.position[p][i] *= 2;
    }
    free(opacity);
    free(shininess);
    close_balloon(&b);
}

static void the_scenes_integrators_are_the_simulators(void **state)
{
    (void)state;
    size_t count = 0;
    for (; scene_integrator_names[count]; count++)
        assert_non_null(integrator_find(scene_integrator_names[count]));
    assert_null(integrators[count]);
    assert_null(integrator_find("no such"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scene_decides_size_place_and_mass),
        cmocka_unit_test(springs_by_height_follow_the_profile),
        cmocka_unit_test(a_rip_opens_at_its_time_and_place),
        cmocka_unit_test(a_rip_that_cuts_nothing_says_so),
        cmocka_unit_test(a_rip_waits_for_its_stretch),
        cmocka_unit_test(the_schedule_changes_step_and_pressure_between_steps),
        cmocka_unit_test(two_runs_are_equal_to_the_bit_and_a_hash_tells_states_apart),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(several_balloons_move_as_each_would_alone),
        cmocka_unit_test(an_effect_that_is_off_has_no_hook),
        cmocka_unit_test(a_run_that_diverges_names_point_time_and_the_likely_cause),
        cmocka_unit_test(a_point_yet_to_come_is_not_what_diverged),
        cmocka_unit_test(stretched_skin_is_clearer_and_shinier),
        cmocka_unit_test(the_scenes_integrators_are_the_simulators),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
