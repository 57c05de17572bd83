/* Pictures show what is there, where it is. */
#include "cards.h"
#include "sphere.h"

static void x_is_to_the_right_and_y_is_up(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, 0.5, 1, 1.5, 1.5, 0); /* x 125 .. 175, y 25 .. 50 from the top */
    struct render_skin skin = skin_of(&cards, 1, 0, 0);
    struct render_view view = square_view();
    struct image image = drawn(&view, &skin, 1);
    double middle[2];
    assert_int_equal(red_middle(&image, 0, 200, middle), 50 * 25);
    assert_near(middle[0], 150, 1e-9);
    assert_near(middle[1], 37.5, 1e-9);
    image_clear(&image);
}

static void the_nearer_hides_the_farther_whichever_comes_first(void **state)
{
    (void)state;
    struct cards red = {0}, blue = {0};
    add_card(&red, -1, -1, 1, 1, 0.5);
    add_card(&blue, -1, -1, 1, 1, -0.5);
    struct render_skin skins[2] = {skin_of(&red, 1, 0, 0), skin_of(&blue, 0, 0, 1)};
    struct render_skin swapped[2] = {skins[1], skins[0]};
    struct render_view view = square_view();
    struct image one = drawn(&view, skins, 2), other = drawn(&view, swapped, 2);
    assert_true(is_red(pixel(&one, 100, 100)));
    assert_same_picture(&one, &other);
    image_clear(&one);
    image_clear(&other);
}

static void translucent_skins_are_drawn_back_to_front(void **state)
{
    (void)state;
    struct cards red = {0}, blue = {0};
    add_card(&red, -1, -1, 1, 1, 0.5);
    add_card(&blue, -1, -1, 1, 1, -0.5);
    red.opacity[0] = red.opacity[1] = blue.opacity[0] = blue.opacity[1] = 0.9f;
    struct render_skin right[2] = {skin_of(&blue, 0, 0, 1), skin_of(&red, 1, 0, 0)};
    struct render_skin wrong[2] = {right[1], right[0]};
    struct render_view view = square_view();
    struct image one = drawn(&view, right, 2), other = drawn(&view, wrong, 2);
    assert_same_picture(&one, &other);
    assert_true(is_red(pixel(&one, 100, 100)));
    view.order = RENDER_NONE;
    struct image unsorted = drawn(&view, wrong, 2);
    assert_true(is_blue(pixel(&unsorted, 100, 100)));
    image_clear(&one);
    image_clear(&other);
    image_clear(&unsorted);
}

static void an_opaque_skin_hides_translucent_ones_behind_it(void **state)
{
    (void)state;
    struct cards red = {0}, blue = {0};
    add_card(&red, -1, -1, 1, 1, 0.5);
    add_card(&blue, -1, -1, 1, 1, -0.5);
    struct render_view view = square_view();
    struct render_skin skins[2] = {skin_of(&red, 1, 0, 0), skin_of(&blue, 0, 0, 1)};
    blue.opacity[0] = blue.opacity[1] = 0.5f;
    struct image both = drawn(&view, skins, 2), alone = drawn(&view, skins, 1);
    assert_same_picture(&both, &alone);
    image_clear(&both);
    image_clear(&alone);
}

static void inactive_triangles_are_not_drawn_nor_looked_at(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 0, 1, 0);
    add_card(&cards, 0.1, -1, 1, 1, 0);
    const unsigned char active[] = {1, 1, 0, 0};
    struct render_skin skin = skin_of(&cards, 1, 0, 0);
    skin.active = active;
    struct render_view view = square_view();
    cards.position[4][0] = NAN; /* of the second card only */
    cards.triangle[3][2] = 4000000000u;
    struct image image = drawn(&view, &skin, 1);
    double middle[2];
    assert_int_equal(red_middle(&image, 0, 200, middle), 50 * 100);
    assert_near(middle[0], 75, 1e-9);
    image_clear(&image);
}

/* A card at the screen plane is in the same place for both eyes. One at distance 8 is e (8 - 10) / 10 / 8 =
 * -0.025 apart at distance 1, where a picture of 200 pixels is 0.4 wide: the right eye sees it 12.5 pixels
 * further to the left. */
static void near_things_are_crossed_and_the_screen_plane_agrees(void **state)
{
    (void)state;
    struct render_view view = square_view();
    view.width = 400;
    view.stereo = RENDER_PARALLEL;
    for (int near = 0; near < 2; near++) {
        struct cards cards = {0};
        add_card(&cards, 0, 0, 0.4, 0.4, near ? 2 : 0);
        struct render_skin skin = skin_of(&cards, 1, 0, 0);
        struct image image = drawn(&view, &skin, 1);
        double left[2], right[2];
        assert_true(red_middle(&image, 0, 200, left) > 100);
        assert_true(red_middle(&image, 200, 400, right) > 100);
        assert_near(right[0] - 200 - left[0], near ? -12.5 : 0, 0.5);
        assert_near(right[1], left[1], 1e-9);
        image_clear(&image);
    }
}

static void crossed_pairs_are_parallel_ones_with_the_halves_swapped(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(12, 16);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    view.width = 400;
    view.stereo = RENDER_PARALLEL;
    struct image parallel = drawn(&view, &skin, 1);
    view.stereo = RENDER_CROSSED;
    struct image crossed = drawn(&view, &skin, 1);
    for (int y = 0; y < 200; y++) {
        assert_memory_equal(pixel(&parallel, 0, y), pixel(&crossed, 200, y), 600);
        assert_memory_equal(pixel(&parallel, 200, y), pixel(&crossed, 0, y), 600);
    }
    image_clear(&parallel);
    image_clear(&crossed);
    sphere_free(&mesh);
}

static void a_camera_inside_the_balloon_sees_its_wall(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(20, 20);
    struct render_skin skin = {.mesh = &mesh, .colour = {1, 0, 0}};
    struct render_view view = square_view();
    view.camera.eye[2] = 0.2;
    view.outlines = RENDER_SAMPLED;
    struct image image = drawn(&view, &skin, 1);
    for (int i = 0; i < 200; i += 13)
        assert_true(is_red(pixel(&image, i, i)));
    image_clear(&image);
    sphere_free(&mesh);
}

static void what_flew_away_too_far_is_left_out(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 1, 1, 0);
    add_card(&cards, -1, -1, 1, 1, 1);
    cards.position[5][0] = 1e300;
    cards.position[6][2] = -1e200;
    struct render_skin skin = skin_of(&cards, 1, 0, 0);
    struct render_view view = square_view();
    struct image image = drawn(&view, &skin, 1);
    assert_true(is_red(pixel(&image, 100, 100)));
    assert_true(!is_red(pixel(&image, 10, 100)));
    image_clear(&image);
}

static void bad_elements_are_refused_by_name(void **state)
{
    (void)state;
    struct error err;
    struct image image = {0};
    struct render_view view = square_view();
    struct cards cards = {0}, good = {0};
    add_card(&good, 0, 0, 1, 1, 0);
    add_card(&cards, 0, 0, 1, 1, 0);
    struct render_skin skins[2] = {skin_of(&good, 1, 0, 0), skin_of(&cards, 1, 0, 0)};
    cards.position[3][1] = NAN;
    assert_refused(render_draw(renderer, &view, skins, 2, &image, &err), STATUS_RANGE,
                   "skin 1, point 3 of triangle 1 is at no finite place", &err);
    cards.position[3][1] = 1;
    cards.triangle[0][2] = 4;
    assert_refused(render_draw(renderer, &view, skins, 2, &image, &err), STATUS_RANGE,
                   "skin 1, triangle 0 has the corner 4, but there are 4 points", &err);
    cards.triangle[0][2] = 2;
    cards.opacity[1] = NAN;
    assert_refused(render_draw(renderer, &view, skins, 2, &image, &err), STATUS_RANGE,
                   "skin 1, triangle 1 has an opacity or shininess that is no number", &err);
    assert_null(image.rgb);
}

static void impossible_sizes_and_cameras_are_refused_and_a_single_pixel_is_not(void **state)
{
    (void)state;
    struct error err;
    struct render *none;
    struct image image = {0};
    struct render_view view = square_view();
    assert_refused(render_open(0, 10, &none, &err), STATUS_RANGE, "0 x 10", &err);
    assert_refused(render_open(10, 1000000, &none, &err), STATUS_RANGE, "10 x 1000000", &err);
    view.width = 16385;
    assert_refused(render_draw(renderer, &view, NULL, 0, &image, &err), STATUS_RANGE, "16385 x 200", &err);
    view.width = view.height = 1;
    assert_ok(render_draw(renderer, &view, NULL, 0, &image, &err), &err);
    view.camera.eye[0] = NAN;
    assert_refused(render_draw(renderer, &view, NULL, 0, &image, &err), STATUS_RANGE, "camera", &err);
    image_clear(&image);
}

static void an_empty_mesh_is_drawn_as_nothing(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    struct render_skin skin = {.mesh = &mesh, .colour = {1, 0, 0}};
    struct render_view view = square_view();
    view.floor = true;
    view.outlines = RENDER_SAMPLED;
    struct image image = drawn(&view, &skin, 1), without = drawn(&view, NULL, 0);
    assert_same_picture(&image, &without);
    image_clear(&image);
    image_clear(&without);
}

/* 4.4 million pixels, of which a band holds 4.2. */
static void large_pictures_have_no_seam(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -2, 1, 1, 0);
    struct render_skin skin = skin_of(&cards, 1, 0, 0);
    struct render_view view = square_view();
    view.width = view.height = 2100;
    for (int outlines = RENDER_ROUGH; outlines <= RENDER_SAMPLED; outlines++) {
        view.outlines = (enum render_outlines)outlines;
        struct image image = drawn(&view, &skin, 1);
        double middle[2];
        assert_int_equal(red_middle(&image, 0, 2100, middle), 1050 * 1575);
        assert_near(middle[0], 1050, 1e-9);
        assert_near(middle[1], 525 + 1575 / 2.0, 1e-9);
        image_clear(&image);
    }
}

static void two_renderers_live_side_by_side(void **state)
{
    (void)state;
    struct error err;
    struct render *second;
    struct mesh mesh = sphere_new(12, 16);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    struct image one = drawn(&view, &skin, 1), other = {0};
    assert_ok(render_open(50, 50, &second, &err), &err);
    assert_ok(render_draw(second, &view, &skin, 1, &other, &err), &err);
    assert_same_picture(&one, &other);
    render_close(second);
    image_clear(&one);
    one = drawn(&view, &skin, 1);
    assert_same_picture(&one, &other);
    image_clear(&one);
    image_clear(&other);
    sphere_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x_is_to_the_right_and_y_is_up),
        cmocka_unit_test(the_nearer_hides_the_farther_whichever_comes_first),
        cmocka_unit_test(translucent_skins_are_drawn_back_to_front),
        cmocka_unit_test(an_opaque_skin_hides_translucent_ones_behind_it),
        cmocka_unit_test(inactive_triangles_are_not_drawn_nor_looked_at),
        cmocka_unit_test(near_things_are_crossed_and_the_screen_plane_agrees),
        cmocka_unit_test(crossed_pairs_are_parallel_ones_with_the_halves_swapped),
        cmocka_unit_test(a_camera_inside_the_balloon_sees_its_wall),
        cmocka_unit_test(what_flew_away_too_far_is_left_out),
        cmocka_unit_test(bad_elements_are_refused_by_name),
        cmocka_unit_test(impossible_sizes_and_cameras_are_refused_and_a_single_pixel_is_not),
        cmocka_unit_test(an_empty_mesh_is_drawn_as_nothing),
        cmocka_unit_test(large_pictures_have_no_seam),
        cmocka_unit_test(two_renderers_live_side_by_side),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
