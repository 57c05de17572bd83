/* Ground, spheres, boxes and needles: nothing ends a step inside, friction holds and slides at its angle,
 * needles find the skin. */
#include "../unit/balloon.h"
#include "common/random.h"
#include "common/vec3.h"
#include "sim/fracture.h"
#include "sim/obstacles.h"
#include "sim/sweep.h"

static const struct obstacle
    ball = {.kind = OBSTACLE_SPHERE, .place = {1, 2, 3}, .radius = 2, .friction = 0.3},
    box = {.kind = OBSTACLE_BOX, .place = {-2, 1, 3}, .half = {1, 2, 1.5}, .friction = 0.3},
    floor_of_all = {.kind = OBSTACLE_PLANE, .normal = {0, 1, 0}, .friction = 0.3};

static double random_in(uint64_t *random, double most)
{
    return (2 * random_unit(random) - 1) * most;
}

/* 100 radii in one step, thousands of ways, three obstacles of which two overlap: none ends inside. */
static void test_no_way_ends_inside(void **state)
{
    (void)state;
    struct obstacle items[] = {ball, box, floor_of_all};
    const struct obstacles all = {.items = items, .count = 3, .margin = 1e-9};
    uint64_t random = 7;
    int met = 0;
    for (int i = 0; i < 100000; i++) {
        double from[3], x[3], v[3];
        bool inside = false;
        for (int k = 0; k < 3; k++) {
            from[k] = random_in(&random, 8) + (k == 1 ? 8 : 0);
            v[k] = x[k] = from[k] + random_in(&random, i % 2 ? 400 : 4);
        }
        for (size_t k = 0; k < all.count; k++)
            inside |= obstacle_holds(&items[k], from);
        if (inside)
            continue;
        met += obstacles_turn(&all, from, x, v);
        for (size_t k = 0; k < all.count; k++)
            assert_false(obstacle_holds(&items[k], x));
    }
    assert_true(met > 10000);
}

/* A mass on a slope of 30 degrees, moved by v += g dt, x += v dt. It sticks while the friction is above tan
 * 30 = .577; below, it slides with g (sin a - mu cos a), of which each step adds exactly that times dt. */
static double slide(double friction, int steps, double dt)
{
    const double angle = acos(-1) / 6, g = 10;
    struct obstacle slope = {
        .kind = OBSTACLE_PLANE, .normal = {sin(angle), cos(angle), 0}, .friction = friction};
    const struct obstacles all = {.items = &slope, .count = 1, .margin = 1e-9};
    double from[3] = {0, 1e-9, 0}, x[3], v[3] = {0};
    for (int i = 0; i < steps; i++) {
        v[1] -= g * dt;
        for (int k = 0; k < 3; k++)
            x[k] = from[k] + v[k] * dt;
        obstacles_turn(&all, from, x, v);
        memcpy(from, x, sizeof from);
    }
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

static void test_friction_sticks_and_slides_at_the_right_angle(void **state)
{
    (void)state;
    const double tangent = 1 / sqrt(3);
    assert_near(slide(tangent * 1.001, 1000, 0.01), 0, 1e-9);
    for (double part = 0; part < 1; part += 0.25) { /* after 10 s */
        const double expected = 10 * 10 * (0.5 - part * tangent * sqrt(3) / 2);
        assert_near(slide(part * tangent, 1000, 0.01), expected, 1e-6 * expected);
    }
}

/* A way right through a ball ends in front of it. */
static void test_no_way_passes_through(void **state)
{
    (void)state;
    struct obstacle items[] = {ball, box};
    for (size_t i = 0; i < 2; i++) {
        const struct obstacles all = {.items = &items[i], .count = 1, .margin = 1e-9};
        const double *place = items[i].place;
        double from[3] = {place[0] - 50, place[1] + 0.1, place[2] + 0.1},
               x[3] = {place[0] + 50, place[1], place[2]}, v[3] = {1, 0, 0};
        assert_true(obstacles_turn(&all, from, x, v));
        assert_true(x[0] < place[0]);
        assert_false(obstacle_holds(&items[i], x));
    }
}

static void test_bounce_throws_back_what_came(void **state)
{
    (void)state;
    struct obstacle hard = floor_of_all;
    hard.bounce = 0.5;
    hard.friction = 0;
    const struct obstacles all = {.items = &hard, .count = 1, .margin = 1e-9};
    double from[3] = {0, 1, 0}, x[3] = {0, -1, 0}, v[3] = {3, -2, 0};
    assert_true(obstacles_turn(&all, from, x, v));
    assert_near(v[0], 3, 0);
    assert_near(v[1], 1, 1e-15);
    assert_near(x[1], 0.5, 1e-8); /* the second half of its way, at half the speed */
}

/* A whole balloon is thrown at the ground, a ball and a box at 100 radii a second. */
static void test_a_balloon_at_100_radii_a_second_enters_nothing(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 SETTINGS("ground.height=-80", "obstacles[0].place=[0,-60,0]", "obstacles[0].radius=10",
                          "obstacles[1].shape=box", "obstacles[1].place=[40,-70,0]",
                          "balloons[0].threshold=1e9", "balloons[0].pressure=2", "time.guard=substep"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        b.sim.velocity[p][1] = -4500;
    for (int i = 0; i < 200; i++) {
        steps(&b, 1);
        for (size_t k = 0; k < b.sim.obstacles->count; k++)
            for (uint32_t p = 0; p < b.sim.point_count; p++)
                assert_false(obstacle_holds(&b.sim.obstacles->items[k], b.sim.position[p]));
    }
    close_balloon(&b);
}

static void test_far_ground_changes_no_bit(void **state)
{
    (void)state;
    struct balloon with, without;
    open_balloon(&with, 2, SETTINGS("ground.height=-1e5", "obstacles[0].place=[1e5,0,0]"));
    open_balloon(&without, 2, SETTINGS());
    steps(&with, 20);
    steps(&without, 20);
    assert_memory_equal(with.sim.position, without.sim.position,
                        with.sim.point_count * sizeof *with.sim.position);
    assert_null(without.sim.before);
    close_balloon(&with);
    close_balloon(&without);
}

/* Steps in which nothing can be met need not look; a balloon that falls from afar on a ball beside the ground
 * meets both as one that looks at each step does, to the bit. */
static void test_what_is_far_is_met_as_if_each_step_had_looked(void **state)
{
    (void)state;
    struct balloon b[2];
    uint32_t met = 0;
    for (int k = 0; k < 2; k++)
        open_balloon(&b[k], 2,
                     SETTINGS("ground.height=-70", "obstacles[0].place=[30,-62,0]", "obstacles[0].radius=5",
                              "gravity.acceleration=[0.0,-20.0,0.0]", "balloons[0].pressure=0",
                              "balloons[0].threshold=1e9", "time.guard=substep"));
    for (int i = 0; i < 150; i++) {
        b[1].sim.obstacles->room = 0;
        steps(&b[0], 1);
        steps(&b[1], 1);
        assert_true(i > 0 || b[0].sim.obstacles->room > 10);
        assert_memory_equal(b[0].sim.position, b[1].sim.position,
                            b[0].sim.point_count * sizeof *b[0].sim.position);
        met += b[0].sim.obstacles->found[0].touched > 0;
    }
    assert_true(met > 0);
    close_balloon(&b[0]);
    close_balloon(&b[1]);
}

/* The way of a balloon past each kind of obstacle, by boxes of places that it holds: never
 * nearer than the gap says. */
static void test_a_gap_is_no_wider_than_it_is(void **state)
{
    (void)state;
    const struct obstacle *all[] = {&ball, &box, &floor_of_all};
    uint64_t random = 4;
    int apart = 0;
    for (int i = 0; i < 20000; i++) {
        double span[2][4] = {{0}}, x[3];
        const struct obstacle *o = all[i % 3];
        for (int k = 0; k < 3; k++) {
            span[0][k] = random_in(&random, 8);
            span[1][k] = span[0][k] + 3 * random_unit(&random);
            x[k] = span[0][k] + random_unit(&random) * (span[1][k] - span[0][k]);
        }
        const double gap = obstacle_gap(o, span);
        apart += gap > 0;
        for (int k = 0; k < 3; k++) { /* moved by the gap, in any direction of the axes */
            double moved[3] = {x[0], x[1], x[2]};
            moved[k] += (i & 1 ? gap : -gap) * (gap > 0);
            assert_false(gap > 0 && obstacle_holds(o, moved));
        }
    }
    assert_true(apart > 5000);
}

static void test_a_needle_tears_the_skin_where_and_when_it_arrives(void **state)
{
    (void)state;
    struct balloon b; /* at rest, radius 45; the needle comes from 75 at 100 a second: .3 s */
    open_balloon(&b, 3,
                 SETTINGS("needles[0].from=[75,1,2]", "needles[0].velocity=[-100,0,0]",
                          "balloons[0].pressure=0", "time.step=0.01"));
    while (b.sim.broken == 0 && b.sim.time < 1)
        steps(&b, 1);
    assert_near(b.sim.time, 0.3,
                0.021); /* a step, and facets that lie within the sphere by up to a fiftieth of its radius */
    assert_int_equal(b.sim.broken, 3);
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        if (!b.sim.edge_active[e])
            assert_true(b.sim.position[b.sim.edge_point[e][0]][0] > 0.9 * 45);
    close_balloon(&b);
}

/* Skin that tears along cracks is slit where the needle meets it, and not where the step began, 18 before:
 * the points that the slit has made in its first step are within its half length, and an edge, of there. */
static void test_a_needle_slits_a_membrane_where_it_meets_it(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 SETTINGS("needles[0].from=[70,30,20]", "needles[0].velocity=[-2500,0,0]", "time.step=0.01",
                          "balloons[0].pressure=0", "balloons[0].membrane.thickness=0.45",
                          "balloons[0].fracture.mode=tear"));
    const uint32_t points = b.sim.balloons[0].point_end;
    while (b.sim.balloons[0].point_end == points && b.sim.time < 1)
        steps(&b, 1);
    const double met[3] = {sqrt(45 * 45 - 30 * 30 - 20 * 20), 30, 20};
    assert_true(b.sim.balloons[0].point_end > points);
    for (uint32_t p = points; p < b.sim.balloons[0].point_end; p++)
        assert_true(vec3_distance(b.sim.position[p], met) < 0.075 * 45 + b.sim.balloons[0].mean_rest_length);
    close_balloon(&b);
}

/* 200 in a step, through the whole balloon: on either side three edges let go, or skin is slit. */
static void test_a_needle_that_goes_right_through_in_a_step_tears_both_sides(void **state)
{
    (void)state;
    static const char *const modes[] = {"paper", "tear"};
    for (int i = 0; i < 2; i++) {
        char mode[64];
        struct balloon b;
        snprintf(mode, sizeof mode, "balloons[0].fracture.mode=%s", modes[i]);
        open_balloon(&b, 3,
                     SETTINGS("needles[0].from=[100,1,2]", "needles[0].velocity=[-20000,0,0]",
                              "time.step=0.01", "balloons[0].pressure=0", mode));
        const uint32_t points = b.sim.balloons[0].point_end;
        int cut[2] = {0};
        steps(&b, 1);
        for (uint32_t e = 0; e < b.sim.edge_count; e++)
            cut[b.sim.position[b.sim.edge_point[e][0]][0] > 0] += !b.sim.edge_active[e];
        for (uint32_t p = points; p < b.sim.balloons[0].point_end; p++)
            cut[b.sim.position[p][0] > 0]++;
        assert_true(cut[0] > 0 && cut[1] > 0);
        assert_true(i == 1 || (cut[0] == 3 && cut[1] == 3));
        close_balloon(&b);
    }
}

/* The second one is half-way between the origin and what the first has cut: new points have not come from
 * there. */
static void test_a_needle_meets_no_point_that_another_has_made(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 SETTINGS("balloons[0].position=[200,0,0]", "balloons[0].fracture.mode=tear",
                          "needles[0].from=[200,-46,0]", "needles[0].velocity=[0,300,0]",
                          "needles[1].from=[100,-22.5,0]", "time.step=0.01", "balloons[0].pressure=0"));
    steps(&b, 1);
    assert_true(b.sim.balloons[0].topology->now.points > 0);
    assert_int_equal(b.sim.balloons[0].fracture->now.births, 1);
    close_balloon(&b);
}

static void test_skin_that_grows_into_a_needle_tears(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("needles[0].from=[0,0.3,47]", "balloons[0].threshold=100"));
    while (b.sim.broken == 0 && b.sim.time < 2)
        steps(&b, 1);
    assert_int_equal(b.sim.broken, 3);
    close_balloon(&b);
}

static void test_bad_surroundings_are_refused_with_a_reason(void **state)
{
    (void)state;
    struct scene scene = {0};
    struct mesh mesh = {0};
    struct sim sim = {0};
    struct error err = {0};
    shape_icosphere(2, &mesh);
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    assert_ok(scene_set(&scene, "needles[0].at=1", &err), &err);
    assert_refused(scene_check(&scene, &err), STATUS_INPUT, "needles[0] names no point", &err);
    assert_ok(scene_set(&scene, "needles[0].from=[0,0,99]", &err), &err);
    assert_ok(scene_set(&scene, "ground.normal=[0,0,0]", &err), &err);
    assert_refused(scene_check(&scene, &err), STATUS_INPUT, "no direction", &err);
    assert_ok(scene_set(&scene, "ground.normal=[0,1,0]", &err), &err);
    assert_ok(scene_set(&scene, "ground.height=-44", &err), &err);
    assert_ok(scene_check(&scene, &err), &err);
    assert_refused(sim_open(&sim, &scene, &mesh, 1, &err), STATUS_INPUT, "begins inside the ground", &err);
    mesh_clear(&mesh);
    scene_clear(&scene);
}

/* The sweep is told of every turn (sweep.h), so that a balloon that lies on the ground needs no look at all
 * edges, nor at all speeds. */
static void test_no_turn_takes_a_point_further_than_the_sweep_knows(void **state)
{
    (void)state;
    struct balloon b;
    int told = 0;
    open_balloon(&b, 3,
                 SETTINGS("balloons[0].pressure=0", "gravity.acceleration=[0,-100,0]", "ground.height=-50",
                          "obstacles[0].shape=sphere", "obstacles[0].place=[20,-60,0]",
                          "obstacles[0].radius=12", "ground.friction=0.5"));
    for (int i = 0; i < 100; i++) {
        double farthest = 0;
        steps(&b, 1);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            farthest = fmax(farthest, vec3_distance(b.sim.position[p], b.sim.before[p]));
        assert_true(farthest <= (1 + 1e-12) * sweep_saw_farthest(&b.sim));
        if (b.sim.pushed)
            told += sweep_saw_none_overlong(&b.sim) && sweep_saw_energy(&b.sim) < INFINITY;
    }
    assert_true(told > 10);
    close_balloon(&b);
}

/* Steps that go by a tolerance know nothing of hits, which are settled at their ends. */
static void test_a_hit_is_told_once_where_a_tolerance_does_not_reach_it(void **state)
{
    (void)state;
    static const struct {
        const char *integrator, *rip;
        int times;
    } cases[] = {{"time.integrator=rk-adaptive", "balloons[0].rip.at=9", 1},
                 {"time.integrator=auto", "balloons[0].rip.at=9", 1},
                 {"time.integrator=rk4", "balloons[0].rip.at=9", 0},
                 {"time.integrator=rk-adaptive", "balloons[0].rip.at=0", 0}}; /* broken before */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct balloon b;
        int told = 0;
        double first = INFINITY;
        open_balloon(&b, 2,
                     SETTINGS(cases[i].integrator, cases[i].rip, "balloons[0].pressure=0",
                              "gravity.acceleration=[0,-100,0]", "ground.height=-50", "time.end=0.6"));
        while (!sim_at_end(&b.sim)) {
            steps(&b, 1);
            first = b.sim.pushed || b.sim.met < first ? fmin(first, b.sim.time) : first;
        }
        for (size_t k = 0; k < b.sim.news_count; k++)
            told += !strcmp(b.sim.news[k].effect, "ground") && b.sim.news[k].time == b.sim.met;
        assert_int_equal(told, cases[i].times);
        assert_near(b.sim.met, first, 0);
        assert_true(b.sim.met > 0.2 && b.sim.met < 0.4); /* 5 are fallen in sqrt(2 x 5/100) s = 0.316 s */
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_way_ends_inside),
        cmocka_unit_test(test_no_way_passes_through),
        cmocka_unit_test(test_friction_sticks_and_slides_at_the_right_angle),
        cmocka_unit_test(test_bounce_throws_back_what_came),
        cmocka_unit_test(test_a_balloon_at_100_radii_a_second_enters_nothing),
        cmocka_unit_test(test_far_ground_changes_no_bit),
        cmocka_unit_test(test_what_is_far_is_met_as_if_each_step_had_looked),
        cmocka_unit_test(test_no_turn_takes_a_point_further_than_the_sweep_knows),
        cmocka_unit_test(test_a_hit_is_told_once_where_a_tolerance_does_not_reach_it),
        cmocka_unit_test(test_a_gap_is_no_wider_than_it_is),
        cmocka_unit_test(test_a_needle_tears_the_skin_where_and_when_it_arrives),
        cmocka_unit_test(test_a_needle_slits_a_membrane_where_it_meets_it),
        cmocka_unit_test(test_a_needle_that_goes_right_through_in_a_step_tears_both_sides),
        cmocka_unit_test(test_a_needle_meets_no_point_that_another_has_made),
        cmocka_unit_test(test_skin_that_grows_into_a_needle_tears),
        cmocka_unit_test(test_bad_surroundings_are_refused_with_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
