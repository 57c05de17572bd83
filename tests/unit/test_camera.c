/* Cameras see what they should, and both eyes agree where they should. */
#include "check.h"
#include "common/random.h"
#include "common/vec3.h"
#include "render/camera.h"

/* A projection is ten float operations of size one or so: 1e-5 is generous to their round-off, and less than
 * a hundredth of a pixel. */
static const double tolerance = 1e-5;

static struct render_view a_view(enum render_stereo stereo)
{
    return (struct render_view){.width = 1280,
                                .height = 480,
                                .stereo = stereo,
                                .camera = {.eye = {3, 2, 10},
                                           .target = {0, 0.5, 0},
                                           .up = {0, 1, 0},
                                           .field_of_view_deg = 35,
                                           .eye_distance = 0.4,
                                           .screen_distance = 8}};
}

/* Where a scene point appears in an eye's picture: -1 .. 1 from left to right and from below to above. */
static void project(const struct render_view *view, const struct camera_eye *eye, const double point[3],
                    double seen[2])
{
    struct camera_space space;
    double at[3];
    float m[16];
    camera_space_of(&view->camera, &space);
    camera_to_space(&space, point, at);
    camera_projection(eye, 0.01, 100, m);
    double clip[4];
    for (int i = 0; i < 4; i++)
        clip[i] = m[i] * at[0] + m[4 + i] * at[1] + m[8 + i] * at[2] + m[12 + i];
    seen[0] = clip[0] / clip[3];
    seen[1] = clip[1] / clip[3];
}

/* A point `distance` before the eyes, `right` and `above` of the line of sight. */
static void point_before(const struct render_view *view, double right, double above, double distance,
                         double point[3])
{
    struct camera_space space;
    camera_space_of(&view->camera, &space);
    for (int i = 0; i < 3; i++)
        point[i] = space.origin[i] + right * space.axis[0][i] + above * space.axis[1][i] -
                   distance * space.axis[2][i];
}

static void right_is_right_and_up_is_up(void **state)
{
    (void)state;
    struct render_view view = a_view(RENDER_MONO);
    struct camera_eye eyes[2];
    double point[3], seen[2];
    assert_int_equal(camera_eyes(&view, eyes), 1);
    project(&view, &eyes[0], view.camera.target, seen);
    assert_near(seen[0], 0, tolerance);
    assert_near(seen[1], 0, tolerance);
    double half_height = tan(17.5 * M_PI / 180);
    point_before(&view, 7 * half_height * 1280 / 480, 7 * half_height, 7, point);
    project(&view, &eyes[0], point, seen);
    assert_near(seen[0], 1, tolerance);
    assert_near(seen[1], 1, tolerance);
}

static void points_in_the_screen_plane_have_no_parallax(void **state)
{
    (void)state;
    struct render_view view = a_view(RENDER_PARALLEL);
    struct camera_eye eyes[2];
    uint64_t dice = 1;
    assert_int_equal(camera_eyes(&view, eyes), 2);
    for (int i = 0; i < 100; i++) {
        double point[3], left[2], right[2];
        point_before(&view, 4 * random_unit(&dice) - 2, 4 * random_unit(&dice) - 2, 8, point);
        project(&view, &eyes[0], point, left);
        project(&view, &eyes[1], point, right);
        assert_near(left[0], right[0], tolerance);
    }
}

static void no_point_has_vertical_parallax(void **state)
{
    (void)state;
    struct render_view view = a_view(RENDER_PARALLEL);
    struct camera_eye eyes[2];
    uint64_t dice = 2;
    camera_eyes(&view, eyes);
    for (int i = 0; i < 100; i++) {
        double point[3], left[2], right[2];
        point_before(&view, 6 * random_unit(&dice) - 3, 6 * random_unit(&dice) - 3,
                     2 + 30 * random_unit(&dice), point);
        project(&view, &eyes[0], point, left);
        project(&view, &eyes[1], point, right);
        assert_near(left[1], right[1], tolerance);
    }
}

/* Similar triangles: at distance d the eyes' lines are e (d - s) / s apart, seen in a window 2 d w wide. */
static void parallax_follows_the_distance_from_the_screen_plane(void **state)
{
    (void)state;
    struct render_view view = a_view(RENDER_PARALLEL);
    struct camera_eye eyes[2];
    camera_eyes(&view, eyes);
    double half_width = tan(17.5 * M_PI / 180) * 640 / 480;
    for (double distance = 2; distance < 40; distance *= 1.7) {
        double point[3], left[2], right[2];
        point_before(&view, 0.3, -0.2, distance, point);
        project(&view, &eyes[0], point, left);
        project(&view, &eyes[1], point, right);
        double expected = 0.4 * (distance - 8) / 8 / (distance * half_width);
        assert_near(right[0] - left[0], expected, tolerance);
    }
}

static void crossed_pairs_swap_the_eyes_and_nothing_else(void **state)
{
    (void)state;
    struct render_view parallel = a_view(RENDER_PARALLEL), crossed = a_view(RENDER_CROSSED);
    struct camera_eye one[2], other[2];
    camera_eyes(&parallel, one);
    camera_eyes(&crossed, other);
    assert_true(one[0].offset < 0 && one[1].offset > 0);
    for (int i = 0; i < 2; i++) {
        assert_true(other[i].offset == one[1 - i].offset && other[i].shear == one[1 - i].shear);
        assert_int_equal(other[i].left, one[i].left);
        assert_int_equal(other[i].width, 640);
    }
}

/* How far from the middle a corner of the box is seen at most, over all eyes. */
static double widest_corner(const struct render_view *view, const double lower[3], const double upper[3])
{
    struct camera_eye eyes[2];
    double widest = 0;
    int count = camera_eyes(view, eyes);
    for (int e = 0; e < count; e++)
        for (int corner = 0; corner < 8; corner++) {
            double point[3], seen[2];
            for (int i = 0; i < 3; i++)
                point[i] = corner >> i & 1 ? upper[i] : lower[i];
            project(view, &eyes[e], point, seen);
            widest = fmax(widest, fmax(fabs(seen[0]), fabs(seen[1])));
        }
    return widest;
}

static void a_fitted_camera_sees_the_box_and_no_more_than_its_margin(void **state)
{
    (void)state;
    struct error err;
    uint64_t dice = 3;
    for (int trial = 0; trial < 300; trial++) {
        struct render_view view = {.width = 2 * (1 + (int)(1000 * random_unit(&dice))),
                                   .height = 1 + (int)(1000 * random_unit(&dice)),
                                   .stereo = trial % 3};
        double lower[3], upper[3], from[3];
        for (int i = 0; i < 3; i++) {
            lower[i] = 20 * random_unit(&dice) - 10;
            upper[i] = lower[i] + 0.1 + random_unit(&dice);
            from[i] = random_unit(&dice) - 0.5;
        }
        assert_ok(render_fit_camera(&view, lower, upper, from, 0.1, &err), &err);
        assert_ok(camera_check(&view, &err), &err);
        assert_near(widest_corner(&view, lower, upper), 0.9, tolerance);
    }
}

static void a_camera_can_be_fitted_from_straight_above_and_around_a_point(void **state)
{
    (void)state;
    struct error err;
    struct render_view view = {.width = 100, .height = 100, .stereo = RENDER_CROSSED};
    const double lower[3] = {1, 2, 3}, upper[3] = {2, 3, 4}, above[3] = {0, 5, 0}, below[3] = {0, -1e-9, 0};
    assert_ok(render_fit_camera(&view, lower, upper, above, 0, &err), &err);
    assert_ok(camera_check(&view, &err), &err);
    assert_true(view.camera.eye[1] > 3);
    assert_ok(render_fit_camera(&view, lower, lower, below, 0, &err), &err);
    assert_ok(camera_check(&view, &err), &err);
    assert_true(view.camera.eye[1] < 2);
}

static void nothing_to_look_at_is_refused(void **state)
{
    (void)state;
    struct error err;
    struct render_view view = {.width = 100, .height = 100};
    const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1}, from[3] = {0, 0, 1}, none[3] = {0, 0, 0};
    const double bad[3] = {0, NAN, 0}, vast[3] = {1e308, 1e308, 1e308};
    assert_refused(render_fit_camera(&view, upper, lower, from, 0, &err), STATUS_RANGE, "along axis 0", &err);
    assert_refused(render_fit_camera(&view, bad, upper, from, 0, &err), STATUS_RANGE, "along axis 1", &err);
    assert_refused(render_fit_camera(&view, lower, vast, from, 0, &err), STATUS_RANGE, "too large", &err);
    assert_refused(render_fit_camera(&view, lower, upper, none, 0, &err), STATUS_RANGE, "no length", &err);
    assert_refused(render_fit_camera(&view, lower, upper, bad, 0, &err), STATUS_RANGE, "no length", &err);
    assert_refused(render_fit_camera(&view, lower, upper, from, 1, &err), STATUS_RANGE, "margin", &err);
    assert_refused(render_fit_camera(&view, lower, upper, from, NAN, &err), STATUS_RANGE, "margin", &err);
}

static void impossible_cameras_are_refused(void **state)
{
    (void)state;
    struct error err;
    struct render_view view = a_view(RENDER_PARALLEL);
    assert_ok(camera_check(&view, &err), &err);
#define REFUSED(change, part)       \
    view = a_view(RENDER_PARALLEL); \
    change;                         \
    assert_refused(camera_check(&view, &err), STATUS_RANGE, part, &err)
    REFUSED(view.camera.eye[1] = NAN, "not a finite number");
    REFUSED(view.camera.up[0] = INFINITY, "not a finite number");
    REFUSED(memcpy(view.camera.eye, view.camera.target, sizeof view.camera.eye), "sees nothing");
    REFUSED(memcpy(view.camera.up, ((double[]){6, 3, 20}), sizeof view.camera.up), "sees nothing");
    REFUSED(view.camera.up[1] = 0, "sees nothing");
    REFUSED(view.camera.field_of_view_deg = 0, "field of view is 0");
    REFUSED(view.camera.field_of_view_deg = NAN, "field of view");
    REFUSED(view.camera.field_of_view_deg = 180, "field of view is 180");
    REFUSED(view.camera.eye_distance = -1, "-1 apart");
    REFUSED(view.camera.screen_distance = 0, "screen plane is 0");
    REFUSED(view.width = 0, "0 x 480");
    REFUSED(view.height = 16385, "1280 x 16385");
    REFUSED(view.width = 641, "must be even");
#undef REFUSED
}

static void the_pixels_of_an_eye_hold_every_point_it_sees(void **state)
{
    (void)state;
    struct render_view view = a_view(RENDER_CROSSED);
    struct camera_eye eyes[2];
    uint64_t dice = 4;
    camera_eyes(&view, eyes);
    double unit = vec3_distance(view.camera.eye, view.camera.target);
    for (int trial = 0; trial < 200; trial++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, points[5][3];
        for (int p = 0; p < 5; p++) {
            const double tangent[2] = {0.5 * random_unit(&dice) - 0.4, 0.4 * random_unit(&dice) - 0.1};
            double distance = 5 + 10 * random_unit(&dice);
            point_before(&view, tangent[0] * distance, tangent[1] * distance, distance, points[p]);
            for (int i = 0; i < 2; i++) {
                low[i] = fmin(low[i], tangent[i]);
                high[i] = fmax(high[i], tangent[i]);
            }
        }
        for (int e = 0; e < 2; e++) {
            int box[4];
            camera_pixels(&eyes[e], low, high, 5 / unit, 15 / unit, box);
            for (int p = 0; p < 5; p++) {
                double seen[2];
                project(&view, &eyes[e], points[p], seen);
                double x = eyes[e].left + (seen[0] + 1) / 2 * 640, y = (seen[1] + 1) / 2 * 480;
                bool outside = fabs(seen[0]) > 1 || fabs(seen[1]) > 1;
                assert_true(outside || (x >= box[0] && x <= box[0] + box[2]));
                assert_true(outside || (y >= box[1] && y <= box[1] + box[3]));
            }
            assert_true(box[0] >= eyes[e].left && box[0] + box[2] <= eyes[e].left + 640);
            assert_true(box[1] >= 0 && box[1] + box[3] <= 480);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(right_is_right_and_up_is_up),
        cmocka_unit_test(points_in_the_screen_plane_have_no_parallax),
        cmocka_unit_test(no_point_has_vertical_parallax),
        cmocka_unit_test(parallax_follows_the_distance_from_the_screen_plane),
        cmocka_unit_test(crossed_pairs_swap_the_eyes_and_nothing_else),
        cmocka_unit_test(a_fitted_camera_sees_the_box_and_no_more_than_its_margin),
        cmocka_unit_test(a_camera_can_be_fitted_from_straight_above_and_around_a_point),
        cmocka_unit_test(nothing_to_look_at_is_refused),
        cmocka_unit_test(impossible_cameras_are_refused),
        cmocka_unit_test(the_pixels_of_an_eye_hold_every_point_it_sees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
