/* Sculptures of cubes, lines and text show where they are. */
#include "check.h"
#include "render/orbit.h"
#include "render/overlay.h"
#include "render/solid.h"

static struct render *renderer;

/* From (0, 0, 10): x and y in -2 .. 2 are the 200 x 200 pixels of the plane z = 0. */
static struct render_view square_view(void)
{
    return (struct render_view){.width = 200,
                                .height = 200,
                                .camera = {.eye = {0, 0, 10},
                                           .up = {0, 1, 0},
                                           .field_of_view_deg = 2 * atan(0.2) * 180 / M_PI,
                                           .eye_distance = 1,
                                           .screen_distance = 10}};
}

static struct image drawn(const struct render_view *view, const struct render_scene *scene)
{
    struct error err;
    struct image image = {0};
    assert_ok(render_draw_scene(renderer, view, scene, &image, &err), &err);
    return image;
}

static const unsigned char *pixel(const struct image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static bool is_red(const unsigned char *rgb)
{
    return rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2];
}

static bool is_green(const unsigned char *rgb)
{
    return rgb[1] > 2 * rgb[0] && rgb[1] > 2 * rgb[2];
}

/* Ten cells are a unit: cells 0 .. 40 are -2 .. 2 in x and y, and end at z = 0. */
static struct render_solid *new_solid(void)
{
    struct error err;
    struct render_solid *solid;
    assert_ok(render_solid_new(renderer, (const double[3]){-2, -2, -4}, 0.1, &solid, &err), &err);
    return solid;
}

static struct render_face square(int side, int x, int y, int z, int size)
{
    return (struct render_face){.corner = {(uint16_t)x, (uint16_t)y, (uint16_t)z},
                                .size = {(uint16_t)size, (uint16_t)size},
                                .side = (uint8_t)side,
                                .colour = {200, 10, 10}};
}

/* The six faces of a cube. */
static void set_cube(struct render_solid *solid, uint64_t key, int x, int y, int z, int size)
{
    struct error err;
    struct render_face faces[6];
    for (int side = 0; side < 6; side++) {
        int at[3] = {x, y, z};
        at[side / 2] += side & 1 ? size : 0;
        faces[side] = square(side, at[0], at[1], at[2], size);
    }
    assert_ok(render_solid_set(solid, key, faces, 6, &err), &err);
}

static void test_a_face_covers_exactly_its_pixels(void **state)
{
    (void)state;
    struct error err;
    struct render_solid *solid = new_solid();
    const struct render_face face = square(5, 10, 20, 40, 10); /* pixels 50 .. 99 across, 50 .. 99 down */
    assert_ok(render_solid_set(solid, 7, &face, 1, &err), &err);
    struct render_view view = square_view();
    struct image image = drawn(&view, &(struct render_scene){.solid = solid});
    for (int y = 0; y < 200; y++)
        for (int x = 0; x < 200; x++)
            assert_int_equal(is_red(pixel(&image, x, y)), x >= 50 && x < 100 && y >= 50 && y < 100);
    image_clear(&image);
    render_solid_free(solid);
}

/* Every ray that meets a cube meets it from any side: none of its faces is left out or turned round. */
static void test_a_cube_is_closed_from_all_sides(void **state)
{
    (void)state;
    struct render_solid *solid = new_solid();
    set_cube(solid, 0, 15, 15, 35, 10); /* the cube between -0.5 and 0.5 */
    for (int azimuth = 0; azimuth < 360; azimuth += 40)
        for (int elevation = -90; elevation <= 90; elevation += 45) {
            struct orbit orbit = {
                .distance = 4, .azimuth_deg = azimuth, .elevation_deg = elevation, .field_of_view_deg = 30};
            struct render_view view = {.width = 60, .height = 60};
            orbit_camera(&orbit, &view.camera);
            struct image image = drawn(&view, &(struct render_scene){.solid = solid});
            /* the ball within the cube: radius 0.5 seen from 4, in pixels of 4 tan(15)/30: 13.9 */
            for (int y = 0; y < 60; y++)
                for (int x = 0; x < 60; x++)
                    if (hypot(x - 29.5, y - 29.5) < 13.5)
                        assert_true(is_red(pixel(&image, x, y)));
            image_clear(&image);
        }
    render_solid_free(solid);
}

static void test_blocks_are_replaced_and_removed(void **state)
{
    (void)state;
    struct error err;
    struct render_solid *solid = new_solid();
    struct render_view view = square_view();
    const struct render_scene scene = {.solid = solid};
    for (uint64_t key = 0; key < 400; key++) {
        struct render_face face = square(5, (int)key % 20, (int)key / 20, 40, 1);
        assert_ok(render_solid_set(solid, key << 40 | 1, &face, 1, &err), &err);
    }
    for (uint64_t key = 0; key < 400; key += 2)
        render_solid_remove(solid, key << 40 | 1);
    render_solid_remove(solid, 12345);
    assert_int_equal(render_solid_faces(solid), 200);
    struct render_face moved = square(5, 30, 30, 40, 1);
    assert_ok(render_solid_set(solid, (uint64_t)1 << 40 | 1, &moved, 1, &err), &err);
    assert_int_equal(render_solid_faces(solid), 200);
    struct image image = drawn(&view, &scene);
    for (int key = 0; key < 400; key++)
        assert_int_equal(is_red(pixel(&image, key % 20 * 5 + 2, 197 - key / 20 * 5)), key & 1 && key != 1);
    assert_true(is_red(pixel(&image, 152, 47)));
    render_solid_remove_all(solid);
    assert_int_equal(render_solid_faces(solid), 0);
    image_clear(&image);
    image = drawn(&view, &scene);
    assert_false(is_red(pixel(&image, 152, 47)));
    image_clear(&image);
    render_solid_free(solid);
}

static void test_solid_and_skin_hide_each_other_by_depth(void **state)
{
    (void)state;
    double position[3][3] = {{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}};
    uint32_t triangle[1][3] = {{0, 1, 2}};
    const struct mesh mesh = {
        .position = position, .triangle = triangle, .point_count = 3, .triangle_count = 1};
    const struct render_skin skin = {.mesh = &mesh, .colour = {0.02f, 0.6f, 0.02f}};
    struct render_view view = square_view();
    struct render_solid *solid = new_solid();
    set_cube(solid, 0, 15, 15, 20, 10); /* behind the skin, from z = -2 to -1 */
    const struct render_scene scene = {.skins = &skin, .skin_count = 1, .solid = solid};
    struct image image = drawn(&view, &scene);
    assert_true(is_green(pixel(&image, 100, 100)));
    image_clear(&image);
    set_cube(solid, 0, 15, 15, 42, 10); /* before it */
    image = drawn(&view, &scene);
    assert_true(is_red(pixel(&image, 100, 100)));
    assert_true(is_green(pixel(&image, 100, 180)));
    image_clear(&image);
    render_solid_free(solid);
}

static void test_edges_of_cells_are_darker_where_cells_are_large(void **state)
{
    (void)state;
    struct error err;
    struct render_solid *solid;
    struct render_view view = square_view();
    assert_ok(render_solid_new(renderer, (const double[3]){-2, -2, -2}, 1, &solid, &err), &err);
    const struct render_face face = square(5, 0, 0, 2, 4); /* cells of 50 pixels */
    assert_ok(render_solid_set(solid, 0, &face, 1, &err), &err);
    struct image image = drawn(&view, &(struct render_scene){.solid = solid, .cell_edges = true});
    int middle = pixel(&image, 75, 75)[0], edge = pixel(&image, 100, 75)[0], other = pixel(&image, 75, 50)[0];
    assert_true(edge < 0.85 * middle);
    assert_true(other < 0.85 * middle);
    assert_int_equal(pixel(&image, 90, 60)[0], middle);
    image_clear(&image);
    render_solid_free(solid);
}

static void test_normals_light_faces_only_when_asked(void **state)
{
    (void)state;
    struct error err;
    struct render_solid *solid = new_solid();
    struct render_view view = square_view();
    struct render_face faces[2] = {square(5, 0, 0, 40, 20), square(5, 20, 0, 40, 20)};
    faces[0].normal[0] = -127; /* towards the key light */
    faces[1].normal[0] = 127;
    assert_ok(render_solid_set(solid, 0, faces, 2, &err), &err);
    struct render_scene scene = {.solid = solid};
    struct image image = drawn(&view, &scene);
    assert_int_equal(pixel(&image, 50, 150)[0], pixel(&image, 150, 150)[0]);
    image_clear(&image);
    scene.smooth_light = true;
    image = drawn(&view, &scene);
    assert_true(pixel(&image, 50, 150)[0] > pixel(&image, 150, 150)[0] + 20);
    image_clear(&image);
    render_solid_free(solid);
}

static void test_faces_beyond_the_grid_are_refused(void **state)
{
    (void)state;
    struct error err;
    struct render_solid *solid = new_solid();
    struct render_face face = square(5, 65530, 0, 0, 6);
    assert_refused(render_solid_set(solid, 0, &face, 1, &err), STATUS_RANGE, "face 0", &err);
    face.side = 6;
    assert_refused(render_solid_set(solid, 0, &face, 1, &err), STATUS_RANGE, "side 6", &err);
    assert_int_equal(render_solid_faces(solid), 0);
    render_solid_free(solid);
    assert_refused(render_solid_new(renderer, (const double[3]){0, NAN, 0}, 1, &solid, &err), STATUS_RANGE,
                   "nan", &err);
}

static struct render_line line_at(double y, double z, bool on_top)
{
    return (struct render_line){.from = {-1, y, z},
                                .to = {1, y, z},
                                .colour = {0, 0.6f, 0},
                                .opacity = 1,
                                .width = 4,
                                .on_top = on_top};
}

static void test_lines_have_their_width_and_place(void **state)
{
    (void)state;
    struct render_view view = square_view();
    const struct render_line line = line_at(0, 0, false); /* the border of rows 99 and 100 */
    for (int outlines = RENDER_ROUGH; outlines <= RENDER_SAMPLED; outlines++) {
        view.outlines = (enum render_outlines)outlines;
        struct image image = drawn(&view, &(struct render_scene){.lines = &line, .line_count = 1});
        for (int y = 0; y < 200; y++)
            assert_int_equal(is_green(pixel(&image, 100, y)), y >= 98 && y < 102);
        assert_true(is_green(pixel(&image, 52, 100)) && is_green(pixel(&image, 147, 100)));
        assert_false(is_green(pixel(&image, 47, 100)) || is_green(pixel(&image, 152, 100)));
        image_clear(&image);
    }
}

static void test_lines_are_hidden_by_depth_unless_on_top(void **state)
{
    (void)state;
    struct render_view view = square_view();
    struct render_solid *solid = new_solid();
    set_cube(solid, 0, 10, 10, 20, 20); /* ends at z = 0 */
    const struct render_line lines[] = {line_at(0.5, -3, true), line_at(0, -3, false),
                                        line_at(-0.5, 0, false)};
    struct image image = drawn(&view,
                               &(struct render_scene){.solid = solid, .lines = lines, .line_count = 3});
    assert_true(is_red(pixel(&image, 100, 60)));
    assert_true(is_green(pixel(&image, 100, 100 - 19))); /* 25 pixels at z = 0, 19 at z = -3 */
    assert_true(is_red(pixel(&image, 100, 100)));
    assert_true(is_green(pixel(&image, 100, 125))); /* on the very surface */
    image_clear(&image);
    render_solid_free(solid);
}

static void test_a_line_past_the_eye_is_cut_not_mirrored(void **state)
{
    (void)state;
    struct render_view view = square_view();
    const struct render_line line = {
        .from = {0, -1, 0}, .to = {0, -1, 30}, .colour = {0, 0.6f, 0}, .opacity = 1, .width = 4};
    struct image image = drawn(&view, &(struct render_scene){.lines = &line, .line_count = 1});
    assert_true(is_green(pixel(&image, 100, 195)));
    for (int y = 0; y < 145; y++)
        assert_false(is_green(pixel(&image, 100, y)));
    image_clear(&image);
}

static void test_a_line_without_an_end_is_refused(void **state)
{
    (void)state;
    struct error err;
    struct image image = {0};
    struct render_view view = square_view();
    struct render_line lines[2] = {line_at(0, 0, false), line_at(NAN, 0, false)};
    const struct render_scene scene = {.lines = lines, .line_count = 2};
    assert_refused(render_draw_scene(renderer, &view, &scene, &image, &err), STATUS_RANGE, "line 1", &err);
}

/* 'L' has a stem down its left and a foot; '-' only its middle row. */
static void test_letters_stand_where_they_are_put(void **state)
{
    (void)state;
    struct render_view view = square_view();
    const struct render_text text = {.text = "L\n-", .x = 20, .y = 40, .scale = 2, .colour = {0, 0.6f, 0}};
    struct image image = drawn(&view, &(struct render_scene){.texts = &text, .text_count = 1});
    for (int row = 0; row < 7; row++)
        assert_true(is_green(pixel(&image, 21, 41 + 2 * row)));
    assert_true(is_green(pixel(&image, 29, 53)));
    assert_false(is_green(pixel(&image, 29, 41)));
    assert_false(is_green(pixel(&image, 19, 41)) || is_green(pixel(&image, 21, 39)));
    assert_true(is_green(pixel(&image, 25, 40 + 24 + 7)));
    image_clear(&image);
}

static void test_a_box_dims_what_is_behind_its_text(void **state)
{
    (void)state;
    int width, height;
    struct render_view view = square_view();
    const struct render_text text = {.text = "brush 12", .x = 20, .y = 40, .scale = 1, .boxed = true};
    render_text_size(&text, &width, &height);
    assert_int_equal(width, 8 * 6 - 1 + 8);
    assert_int_equal(height, 9 + 8);
    struct image image = drawn(&view, &(struct render_scene){.texts = &text, .text_count = 1});
    int behind = pixel(&image, 10, 41)[0];
    assert_true(pixel(&image, 20, 40)[0] < behind - 50);
    assert_true(pixel(&image, 19 + width, 39 + height)[0] < behind - 50);
    assert_true(pixel(&image, 20 + width, 40)[0] >= behind - 5);
    image_clear(&image);
}

static void test_a_box_covers_its_pixels_in_both_eyes_and_lies_below_text(void **state)
{
    (void)state;
    struct render_view view = square_view();
    view.stereo = RENDER_PARALLEL;
    const struct render_box box = {
        .x = 10, .y = 40, .width = 30, .height = 20, .colour = {0.6f, 0, 0}, .opacity = 1};
    const struct render_text text = {.text = "#", .x = 12, .y = 42, .scale = 2, .colour = {0, 0.6f, 0}};
    struct image image = drawn(
        &view, &(struct render_scene){.boxes = &box, .box_count = 1, .texts = &text, .text_count = 1});
    for (int left = 0; left <= 100; left += 100) {
        int red = 0, green = 0;
        for (int y = 40; y < 60; y++)
            for (int x = 10; x < 40; x++) {
                red += is_red(pixel(&image, left + x, y));
                green += is_green(pixel(&image, left + x, y));
            }
        assert_true(green > 20);
        assert_int_equal(red + green, 30 * 20);
        assert_false(is_red(pixel(&image, left + 9, 50)) || is_red(pixel(&image, left + 40, 50)));
        assert_false(is_red(pixel(&image, left + 20, 39)) || is_red(pixel(&image, left + 20, 60)));
    }
    image_clear(&image);
}

static void test_each_eye_carries_the_text(void **state)
{
    (void)state;
    struct render_view view = square_view();
    view.stereo = RENDER_PARALLEL;
    const struct render_text text = {.text = "L", .x = 20, .y = 40, .scale = 1, .colour = {0, 0.6f, 0}};
    struct image image = drawn(&view, &(struct render_scene){.texts = &text, .text_count = 1});
    assert_true(is_green(pixel(&image, 20, 43)) && is_green(pixel(&image, 120, 43)));
    image_clear(&image);
}

static int open_renderer(void **state)
{
    (void)state;
    struct error err;
    return render_open(200, 200, &renderer, &err) != STATUS_OK;
}

static int close_renderer(void **state)
{
    (void)state;
    render_close(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_face_covers_exactly_its_pixels),
        cmocka_unit_test(test_a_cube_is_closed_from_all_sides),
        cmocka_unit_test(test_blocks_are_replaced_and_removed),
        cmocka_unit_test(test_solid_and_skin_hide_each_other_by_depth),
        cmocka_unit_test(test_edges_of_cells_are_darker_where_cells_are_large),
        cmocka_unit_test(test_normals_light_faces_only_when_asked),
        cmocka_unit_test(test_faces_beyond_the_grid_are_refused),
        cmocka_unit_test(test_lines_have_their_width_and_place),
        cmocka_unit_test(test_lines_are_hidden_by_depth_unless_on_top),
        cmocka_unit_test(test_a_line_past_the_eye_is_cut_not_mirrored),
        cmocka_unit_test(test_a_line_without_an_end_is_refused),
        cmocka_unit_test(test_letters_stand_where_they_are_put),
        cmocka_unit_test(test_a_box_dims_what_is_behind_its_text),
        cmocka_unit_test(test_a_box_covers_its_pixels_in_both_eyes_and_lies_below_text),
        cmocka_unit_test(test_each_eye_carries_the_text),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
