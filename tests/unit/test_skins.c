/* A simulation as a picture has it: its floor, its normals, what is there beside its balloons. */
#include "balloon.h"
#include "common/vec3.h"
#include "sim/skins.h"

/* In radii below the middle at rest, once all points have moved up by `up` radii and
 * are `swollen` as large. */
static double depth_of_floor(const char *const *settings, double up, double swollen)
{
    struct error err;
    struct balloon b;
    struct skins skins;
    struct render_view view = {0};
    double ball[4];
    open_balloon(&b, 3, settings);
    ball[3] = skins_ball(&b.sim, ball);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] = ball[i] + swollen * (b.sim.position[p][i] - ball[i]) +
                                   (i == 1) * up * ball[3];
    assert_ok(skins_init(&skins, &b.sim, &err), &err);
    skins_update(&skins);
    skins_floor(&skins, ball, &view);
    assert_true(view.floor);
    skins_clear(&skins);
    close_balloon(&b);
    return (ball[1] - view.floor_height) / ball[3];
}

/* The lowest of an icosphere's points is on the ball. */
static void skin_stands_on_the_floor_while_it_swells(void **state)
{
    (void)state;
    const char *const *plain = SETTINGS("balloons[0].pressure=0");
    assert_near(depth_of_floor(plain, 0, 1), 1, 1e-9);
    assert_near(depth_of_floor(plain, 0, 1.4), 1.4, 1e-9);
    assert_near(depth_of_floor(plain, 0.3, 1), 0.7, 1e-9);
}

static void the_floor_does_not_follow_what_flies_away(void **state)
{
    (void)state;
    const char *const *plain = SETTINGS("balloons[0].pressure=0");
    assert_near(depth_of_floor(plain, 5, 1), 0.6, 1e-9);
    assert_near(depth_of_floor(plain, -5, 1), 1.8, 1e-9);
}

/* Its middle at rest is at 0. */
static void level_ground_is_the_floor_and_a_slope_is_not(void **state)
{
    (void)state;
    const char *const *level = SETTINGS("balloons[0].radius=10", "ground.height=-25");
    const char *const *slope = SETTINGS("balloons[0].radius=10", "ground.height=-25",
                                        "ground.normal=[1,2,0]");
    assert_near(depth_of_floor(level, 0, 1), 2.5, 1e-9);
    assert_near(depth_of_floor(level, 5, 1), 2.5, 1e-9);
    assert_near(depth_of_floor(slope, 0, 1), 1, 1e-9);
}

/* The weight, a fifth of a radius long, hung below the floor and its shadow. It may rise, and fall again. */
static void weights_and_ends_of_strings_are_above_the_floor(void **state)
{
    (void)state;
    const char *const *held = SETTINGS("balloons[0].string.to=[0, -3, 0]");
    const char *const *weight = SETTINGS("balloons[0].string.to=[0, -3, 0]", "balloons[0].string.weight=5");
    const char *const *above = SETTINGS("balloons[0].string.to=[0, 3, 0]");
    assert_near(depth_of_floor(held, 0, 1), 3, 1e-9);
    assert_near(depth_of_floor(weight, 0, 1), 3.2, 1e-9);
    assert_near(depth_of_floor(weight, 5, 1), 3.2, 1e-9);
    assert_near(depth_of_floor(above, 0, 1), 1, 1e-9);
}

static void assert_line(const struct render_line *line, const double from[3], const double to[3])
{
    for (int i = 0; i < 3; i++) {
        assert_near(line->from[i], from[i], 1e-9);
        assert_near(line->to[i], to[i], 1e-9);
    }
}

/* Their triangles are as irregular as they come: all points were moved along the sphere by up to a third of
 * an edge. Sums of the triangles' own normals would be off by some degrees, which kinks the edges of
 * highlights. */
static void points_of_a_sphere_have_its_normals(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    struct skins skins;
    open_balloon(&b, 3, SETTINGS("balloons[0].radius=45"));
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        double *x = b.sim.position[p];
        for (int i = 0; i < 3; i++)
            x[i] += b.sim.balloons[0].mean_rest_length / 3 * sin(37.0 * p + 11 * i);
        const double length = vec3_length(x);
        for (int i = 0; i < 3; i++)
            x[i] *= 45 / length;
    }
    assert_ok(skins_init(&skins, &b.sim, &err), &err);
    skins_update(&skins);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++) /* round-off of sums of a few terms that partly cancel */
            assert_near(skins.normal[p][i], b.sim.position[p][i] / 45, 1e-12);
    skins_clear(&skins);
    close_balloon(&b);
}

static void a_point_without_triangles_has_no_normal(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    struct skins skins;
    open_balloon(&b, 0, SETTINGS("balloons[0].radius=45"));
    for (uint32_t t = 0; t < b.sim.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (b.sim.triangle_point[t][k] == 0)
                b.sim.triangle_active[t] = 0;
    assert_ok(skins_init(&skins, &b.sim, &err), &err);
    skins_update(&skins);
    assert_near(vec3_length(skins.normal[0]), 0, 0);
    assert_near(vec3_length(skins.normal[1]), 1, 1e-15);
    skins_clear(&skins);
    close_balloon(&b);
}

/* A string from the skin to its weight, a needle from its time on where it is then, a box's twelve edges. */
static void what_is_there_beside_balloons_is_drawn_as_lines(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    struct skins skins;
    const struct render_view view = {.width = 600, .height = 600};
    open_balloon(&b, 1,
                 SETTINGS("balloons[0].radius=10", "balloons[0].pressure=0", "balloons[0].string.weight=1",
                          "needles[0].from=[0,0,50]", "needles[0].velocity=[0,0,-10]", "needles[0].at=0.5",
                          "obstacles[0].shape=box", "obstacles[0].place=[40,0,0]",
                          "obstacles[0].size=[2,4,6]", "time.integrator=verlet", "time.step=0.1"));
    assert_ok(skins_init(&skins, &b.sim, &err), &err);
    struct render_scene scene = skins_scene(&skins, &view);
    assert_int_equal(scene.line_count, 2 + 12);
    assert_line(&scene.lines[0], (double[3]){0, -10, 0}, (double[3]){0, -20, 0});
    assert_line(&scene.lines[1], (double[3]){0, -20, 0}, (double[3]){0, -22, 0});
    double lower[3] = {INFINITY, INFINITY, INFINITY}, length = 0;
    for (size_t i = 2; i < scene.line_count; i++) {
        length += vec3_distance(scene.lines[i].from, scene.lines[i].to);
        for (int k = 0; k < 3; k++)
            lower[k] = fmin(lower[k], scene.lines[i].from[k]);
    }
    assert_near(length, 4 * (2 + 4 + 6), 1e-12);
    assert_true(lower[0] == 39 && lower[1] == -2 && lower[2] == -3);
    steps(&b, 8);
    scene = skins_scene(&skins, &view);
    assert_int_equal(scene.line_count, 3 + 12);
    assert_line(&scene.lines[2], (double[3]){0, 0, 47}, (double[3]){0, 0, 55});
    skins_clear(&skins);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skin_stands_on_the_floor_while_it_swells),
        cmocka_unit_test(the_floor_does_not_follow_what_flies_away),
        cmocka_unit_test(level_ground_is_the_floor_and_a_slope_is_not),
        cmocka_unit_test(weights_and_ends_of_strings_are_above_the_floor),
        cmocka_unit_test(points_of_a_sphere_have_its_normals),
        cmocka_unit_test(a_point_without_triangles_has_no_normal),
        cmocka_unit_test(what_is_there_beside_balloons_is_drawn_as_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
