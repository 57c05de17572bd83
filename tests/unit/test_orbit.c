/* The camera that a hand leads, and the rays under its pointer. */
#include "check.h"
#include "render/orbit.h"

static const double tolerance = 1e-12; /* a few roundings of numbers about 1 */

static void assert_vector(const double value[3], double x, double y, double z)
{
    assert_near(value[0], x, tolerance);
    assert_near(value[1], y, tolerance);
    assert_near(value[2], z, tolerance);
}

static struct render_view view_from(const struct orbit *orbit, int width, int height)
{
    struct render_view view = {.width = width, .height = height};
    orbit_camera(orbit, &view.camera);
    return view;
}

/* Two units from the origin, whose plane is seen 4 high: from -2 to 2. */
static struct orbit plain_orbit(void)
{
    return (struct orbit){.distance = 2, .field_of_view_deg = 90};
}

static void test_standard_sides_look_from_where_they_say(void **state)
{
    static const double eye[6][3] = {{0, 0, 2}, {0, 0, -2}, {2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}};
    static const double up[6][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    (void)state;
    for (int side = 0; side < 6; side++) {
        struct orbit orbit = plain_orbit();
        orbit_look(&orbit, (enum orbit_side)side);
        struct render_view view = view_from(&orbit, 100, 100);
        assert_vector(view.camera.eye, eye[side][0], eye[side][1], eye[side][2]);
        assert_vector(view.camera.up, up[side][0], up[side][1], up[side][2]);
    }
}

static void test_dragging_to_the_right_turns_the_front_to_the_right(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    orbit_turn(&orbit, 180, 0); /* a right angle: the eye goes round to the left */
    struct render_view view = view_from(&orbit, 100, 100);
    assert_vector(view.camera.eye, -2, 0, 0);
    orbit_turn(&orbit, 0, 1000); /* down: seen from above, and never over the top */
    view = view_from(&orbit, 100, 100);
    assert_vector(view.camera.eye, 0, 2, 0);
    double origin[3], direction[3];
    assert_true(orbit_ray(&view, 50, 50, origin, direction));
    assert_vector(direction, 0, -1, 0);
}

static void test_panning_keeps_the_point_under_the_pointer(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    struct render_view view = view_from(&orbit, 200, 100);
    orbit_pan(&orbit, &view, 25, 10); /* 100 pixels are 4 units */
    assert_vector(orbit.target, -1, 0.4, 0);
    view = view_from(&orbit, 200, 100);
    double origin[3], direction[3];
    assert_true(orbit_ray(&view, 125, 60, origin, direction)); /* where the origin is now */
    for (int i = 0; i < 3; i++)
        assert_near(origin[i] + direction[i] * 2 / -direction[2], 0, tolerance);
}

static void test_zoom_steps_are_tenths_and_undo_each_other(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    orbit_zoom(&orbit, 1);
    assert_near(orbit.distance, 1.8, tolerance);
    orbit_zoom(&orbit, -1);
    assert_near(orbit.distance, 2, tolerance);
    orbit_zoom(&orbit, 1e9);
    assert_true(orbit.distance > 0);
}

static void test_framing_puts_the_enclosing_ball_into_the_narrower_side(void **state)
{
    (void)state;
    const double low[3] = {1, 1, 1}, high[3] = {3, 3, 3}, radius = sqrt(3);
    struct orbit orbit = plain_orbit();
    struct render_view view = view_from(&orbit, 400, 100);
    orbit_frame(&orbit, &view, low, high);
    assert_vector(orbit.target, 2, 2, 2);
    assert_near(orbit.distance, radius * sqrt(2), tolerance); /* its tangent leaves the eye at 45 degrees */
    view.width = 50;
    orbit_frame(&orbit, &view, low, high);
    assert_near(orbit.distance, radius * sqrt(5), tolerance); /* whose tangent is 1/2 */
    orbit_frame(&orbit, &view, high, high);
    assert_near(orbit.distance, radius * sqrt(5), tolerance);
}

static void test_a_ray_goes_through_its_pixel(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    struct render_view view = view_from(&orbit, 200, 100);
    double origin[3], direction[3];
    assert_true(orbit_ray(&view, 0, 0, origin, direction)); /* the corner: 4 to the left, 2 up, 2 ahead */
    assert_vector(origin, 0, 0, 2);
    assert_vector(direction, -4 / sqrt(24), 2 / sqrt(24), -2 / sqrt(24));
    view.width = 0;
    assert_false(orbit_ray(&view, 0, 0, origin, direction));
}

/* Both pictures show the screen plane at the same place: there the rays of both eyes meet. */
static void test_in_stereo_the_ray_starts_at_the_eye_that_owns_the_pixel(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    struct render_view view = view_from(&orbit, 200, 100);
    view.camera.eye_distance = 0.5;
    for (int crossed = 0; crossed < 2; crossed++) {
        view.stereo = crossed ? RENDER_CROSSED : RENDER_PARALLEL;
        for (int half = 0; half < 2; half++) {
            double origin[3], direction[3];
            assert_true(orbit_ray(&view, 100 * half + 75, 25, origin, direction));
            assert_vector(origin, half == crossed ? -0.25 : 0.25, 0, 2);
            for (int i = 0; i < 3; i++)
                assert_near(origin[i] + direction[i] * 2 / -direction[2], i < 2 ? 1 : 0, tolerance);
        }
    }
}

/* The upper half is the left eye's, and each half has all that the other shows. */
static void test_over_under_the_halves_are_divided_by_height(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    struct render_view view = view_from(&orbit, 100, 200);
    view.camera.eye_distance = 0.5;
    view.stereo = RENDER_OVER_UNDER;
    for (int half = 0; half < 2; half++) {
        double origin[3], direction[3];
        assert_true(orbit_ray(&view, 75, 100 * half + 25, origin, direction));
        assert_vector(origin, half ? 0.25 : -0.25, 0, 2);
        for (int i = 0; i < 3; i++)
            assert_near(origin[i] + direction[i] * 2 / -direction[2], i < 2 ? 1 : 0, tolerance);
    }
}

static void test_where_both_eyes_see_every_pixel_the_ray_starts_between_them(void **state)
{
    static const enum render_stereo mixed[] = {RENDER_RED_CYAN, RENDER_INTERLACED, RENDER_QUAD};
    (void)state;
    for (size_t i = 0; i < sizeof mixed / sizeof *mixed; i++) {
        struct orbit orbit = plain_orbit();
        struct render_view view = view_from(&orbit, 100, 100);
        view.camera.eye_distance = 0.5;
        view.stereo = mixed[i];
        for (int row = 0; row < 2; row++) {
            double origin[3], direction[3];
            assert_true(orbit_ray(&view, 50, 50 + row, origin, direction));
            assert_vector(origin, 0, 0, 2);
            assert_near(direction[0], 0, tolerance);
        }
    }
}

/* Of an odd size the halves leave a column or row over. */
static void test_a_place_in_one_half_is_the_same_in_the_other(void **state)
{
    static const struct {
        enum render_stereo stereo;
        int size[2], place[2];
    } wanted[] = {{RENDER_MONO, {201, 101}, {150, 80}},       {RENDER_PARALLEL, {100, 101}, {50, 80}},
                  {RENDER_CROSSED, {100, 101}, {50, 80}},     {RENDER_OVER_UNDER, {201, 50}, {150, 30}},
                  {RENDER_RED_CYAN, {201, 101}, {150, 80}},   {RENDER_QUAD, {201, 101}, {150, 80}},
                  {RENDER_INTERLACED, {201, 101}, {150, 80}}, {RENDER_LEFT, {201, 101}, {150, 80}}};
    (void)state;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const struct render_view view = {.width = 201, .height = 101, .stereo = wanted[i].stereo};
        int size[2], place[2] = {150, 80};
        orbit_eye_size(&view, size);
        orbit_eye_place(&view, place);
        assert_memory_equal(size, wanted[i].size, sizeof size);
        assert_memory_equal(place, wanted[i].place, sizeof place);
    }
}

static void test_the_stereo_key_leads_through_every_layout_back_to_the_first(void **state)
{
    (void)state;
    for (int quad = 0; quad < 2; quad++) {
        const int layouts = quad ? RENDER_QUAD + 1 : RENDER_QUAD;
        for (int first = 0; first < layouts; first++) {
            struct orbit orbit = plain_orbit();
            struct render_view view = {.width = 100, .height = 100, .stereo = (enum render_stereo)first};
            for (int presses = 1; presses <= layouts; presses++) {
                assert_non_null(orbit_change_stereo(&orbit, &view, quad));
                assert_int_equal(view.stereo, (first + presses) % layouts);
            }
            assert_near(orbit.distance, 2, tolerance);
        }
    }
}

/* A half as wide as high where the whole was so: from twice as far. */
static void test_narrow_halves_are_seen_from_further_away(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    struct render_view view = {.width = 100, .height = 100, .stereo = RENDER_LEFT}; /* a scene's own */
    orbit_change_stereo(&orbit, &view, false);
    assert_int_equal(view.stereo, RENDER_MONO);
    assert_near(orbit.distance, 2, tolerance); /* it had the whole picture */
    orbit_change_stereo(&orbit, &view, false);
    assert_near(orbit.distance, 4, tolerance);
    view.stereo = RENDER_CROSSED;
    orbit_change_stereo(&orbit, &view, false); /* one over the other */
    assert_near(orbit.distance, 2, tolerance);
    view = (struct render_view){.width = 100, .height = 100, .squeezed = true};
    orbit_change_stereo(&orbit, &view, false);
    assert_near(orbit.distance, 2, tolerance); /* each has the whole's proportions */
}

static void test_number_keys_look_from_the_sides(void **state)
{
    (void)state;
    struct orbit orbit = plain_orbit();
    assert_true(orbit_key(&orbit, '3', true));
    struct render_view view = view_from(&orbit, 100, 100);
    assert_vector(view.camera.eye, -2, 0, 0);
    assert_false(orbit_key(&orbit, '2', false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_standard_sides_look_from_where_they_say),
        cmocka_unit_test(test_dragging_to_the_right_turns_the_front_to_the_right),
        cmocka_unit_test(test_panning_keeps_the_point_under_the_pointer),
        cmocka_unit_test(test_zoom_steps_are_tenths_and_undo_each_other),
        cmocka_unit_test(test_framing_puts_the_enclosing_ball_into_the_narrower_side),
        cmocka_unit_test(test_a_ray_goes_through_its_pixel),
        cmocka_unit_test(test_over_under_the_halves_are_divided_by_height),
        cmocka_unit_test(test_where_both_eyes_see_every_pixel_the_ray_starts_between_them),
        cmocka_unit_test(test_a_place_in_one_half_is_the_same_in_the_other),
        cmocka_unit_test(test_the_stereo_key_leads_through_every_layout_back_to_the_first),
        cmocka_unit_test(test_narrow_halves_are_seen_from_further_away),
        cmocka_unit_test(test_number_keys_look_from_the_sides),
        cmocka_unit_test(test_in_stereo_the_ray_starts_at_the_eye_that_owns_the_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
