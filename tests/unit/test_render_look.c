/* Skins look as lit, as shiny and as opaque as they are told. */
#include "cards.h"
#include "render/overlay.h"
#include "sphere.h"

/* Its inside, which no light can reach within, was black there. Seen from outside it is as bright as the
 * outside was, by a fifth: light falls on it the same. */
static void thick_latex_that_is_inside_out_is_lit(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    struct render_skin skin = {
        .mesh = &mesh, .rest_opacity = 0.999f, .rest_shininess = 0, .colour = {0.01f, 0.3f, 0.05f}};
    struct render_view view = square_view();
    view.style = RENDER_LATEX;
    struct image outside = drawn(&view, &skin, 1);
    for (uint32_t t = 0; t < mesh.triangle_count; t++) {
        const uint32_t second = mesh.triangle[t][1];
        mesh.triangle[t][1] = mesh.triangle[t][2];
        mesh.triangle[t][2] = second;
    }
    for (uint32_t p = 0; p < mesh.point_count; p++)
        for (int i = 0; i < 3; i++)
            mesh.normal[p][i] = -mesh.normal[p][i];
    struct image inside = drawn(&view, &skin, 1);
    const double wanted = linear(pixel(&outside, 100, 100)[1]);
    assert_near(linear(pixel(&inside, 100, 100)[1]), wanted, 0.2 * wanted);
    image_clear(&outside);
    image_clear(&inside);
    sphere_free(&mesh);
}

/* Where the inside mirrors the key light, below the middle, orange skin lets hardly any blue of it out: it
 * was pink there where blue alone counted as turned outside. Some steps of 255 more are the room behind. */
static void light_within_has_the_colour_of_the_skin(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    float stretch[2 * 40 * 40];
    for (uint32_t t = 0; t < mesh.triangle_count; t++)
        stretch[t] = 4;
    const struct render_skin skin = {.mesh = &mesh,
                                     .stretch = stretch,
                                     .rest_opacity = 0.97f,
                                     .rest_shininess = 12,
                                     .colour = {1, 0.17f, 0.007f}};
    struct render_view view = square_view();
    view.style = RENDER_LATEX;
    struct image image = drawn(&view, &skin, 1);
    int most = 0;
    for (int y = 105; y < 135; y++)
        for (int x = 100; x < 122; x++)
            most = pixel(&image, x, y)[2] > most ? pixel(&image, x, y)[2] : most;
    assert_true(most <= pixel(&image, 90, 120)[2] + 10);
    image_clear(&image);
    sphere_free(&mesh);
}

/* White skin is not paled further, and straight on its path is its thickness. Three values rounded to 1/255
 * of sRGB, whose slope is at most 2.4 / 1.055: 1.5 x 0.5 / 255 x 2.3. */
static void opacity_one_half_blends_half_of_what_lies_behind(void **state)
{
    (void)state;
    struct cards grey = {0}, cards = {0};
    add_card(&grey, -2, -2, 2, 2, -1);
    add_card(&cards, -1, -1, 1, 1, 0);
    struct render_skin skins[2] = {skin_of(&grey, 0.1f, 0.1f, 0.1f), skin_of(&cards, 1, 1, 1)};
    struct render_view view = square_view();
    struct image behind = drawn(&view, skins, 1), opaque = drawn(&view, skins, 2);
    cards.opacity[0] = cards.opacity[1] = 0.5f;
    struct image half = drawn(&view, skins, 2);
    for (int c = 0; c < 3; c++) {
        double wanted = (linear(pixel(&behind, 100, 100)[c]) + linear(pixel(&opaque, 100, 100)[c])) / 2;
        assert_near(linear(pixel(&half, 100, 100)[c]), wanted, 0.007);
    }
    assert_true(pixel(&opaque, 100, 100)[0] > pixel(&behind, 100, 100)[0] + 100);
    cards.opacity[0] = cards.opacity[1] = 0;
    struct image clear = drawn(&view, skins, 2);
    assert_same_picture(&clear, &behind);
    image_clear(&behind);
    image_clear(&opaque);
    image_clear(&half);
    image_clear(&clear);
}

static void smooth_edges_change_outlines_only(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    struct image plain = drawn(&view, &skin, 1);
    view.outlines = RENDER_SAMPLED;
    struct image smooth = drawn(&view, &skin, 1);
    int changed = 0;
    for (int y = 0; y < 200; y++)
        for (int x = 0; x < 200; x++) {
            int difference = abs(pixel(&plain, x, y)[1] - pixel(&smooth, x, y)[1]);
            double radius = hypot(x - 99.5, y - 99.5) / 50;
            changed += difference > 20;
            assert_true(difference <= 2 || fabs(radius - 1) < 0.05);
        }
    assert_true(changed > 100); /* the outline is 314 pixels long */
    image_clear(&plain);
    image_clear(&smooth);
    sphere_free(&mesh);
}

static void both_sides_of_a_skin_are_lit_alike(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 1, 1, 0);
    double normal[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    struct render_skin skin = skin_of(&cards, 1, 1, 1);
    struct render_view view = square_view();
    struct image flat = drawn(&view, &skin, 1);
    cards.mesh.normal = normal;
    struct image front = drawn(&view, &skin, 1);
    for (int t = 0; t < 2; t++) {
        uint32_t second = cards.triangle[t][1];
        cards.triangle[t][1] = cards.triangle[t][2];
        cards.triangle[t][2] = second;
    }
    for (int p = 0; p < 4; p++)
        normal[p][2] = -1;
    struct image back = drawn(&view, &skin, 1);
    assert_same_picture(&front, &flat);
    assert_same_picture(&back, &front);
    image_clear(&flat);
    image_clear(&front);
    image_clear(&back);
}

/* Turned away from the key light, to the right and down, white skin has the fill's and the room's: .12 x .916
 * + .10 + .20 x .25 = .26 (shaders_studio.h). Rounded as above. */
static void what_is_opaque_passes_no_light_from_behind(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 1, 1, 0);
    const double away[3] = {0.7, -0.5, 0.51};
    double normal[4][3];
    for (int p = 0; p < 4; p++)
        memcpy(normal[p], away, sizeof away);
    cards.mesh.normal = normal;
    struct render_skin skin = skin_of(&cards, 1, 1, 1);
    struct render_view view = square_view();
    struct image image = drawn(&view, &skin, 1);
    assert_near(linear(pixel(&image, 100, 100)[0]), 0.26, 0.007);
    image_clear(&image);
}

static void points_without_a_normal_take_the_facets(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 1, 1, 0);
    double normal[4][3] = {{0, 0, 0}, {NAN, 0, 1}, {0, 0, 1}, {0, INFINITY, 0}};
    struct render_skin skin = skin_of(&cards, 1, 1, 1);
    struct render_view view = square_view();
    struct image flat = drawn(&view, &skin, 1);
    cards.mesh.normal = normal;
    struct image mended = drawn(&view, &skin, 1);
    assert_same_picture(&mended, &flat);
    image_clear(&flat);
    image_clear(&mended);
}

static int brightest(const struct image *image)
{
    int most = 0;
    for (int i = 0; i < image->width * image->height; i++)
        most = image->rgb[3 * i + 1] > most ? image->rgb[3 * i + 1] : most;
    return most;
}

static void shinier_skin_has_a_stronger_highlight(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    float *shininess = calloc(mesh.triangle_count, sizeof *shininess);
    struct render_skin skin = {.mesh = &mesh, .shininess = shininess, .colour = {0.5f, 0, 0}};
    struct render_view view = square_view();
    view.camera.field_of_view_deg = 8; /* the sphere fills the picture: no backdrop in sight */
    const float exponents[] = {0, 5, 20, 100};
    int before = -6; /* none at all is 0 */
    for (int i = 0; i < 4; i++) {
        for (uint32_t t = 0; t < mesh.triangle_count; t++)
            shininess[t] = exponents[i];
        struct image image = drawn(&view, &skin, 1);
        assert_true(brightest(&image) > before + 5);
        before = brightest(&image);
        image_clear(&image);
    }
    free(shininess);
    sphere_free(&mesh);
}

/* Halves of opacity 1 and 0: with facets the border is a step, else it is a slope between the points. */
static void opacity_is_smooth_unless_facets_are_wanted(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1, 1, 1, 0);
    cards.opacity[1] = 0;
    double normal[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    cards.mesh.normal = normal;
    struct render_skin skin = skin_of(&cards, 1, 0, 0);
    struct render_view view = square_view();
    struct image behind = drawn(&view, NULL, 0), smooth = drawn(&view, &skin, 1);
    skin.facets = true;
    struct image facets = drawn(&view, &skin, 1);
    assert_memory_equal(pixel(&facets, 70, 75), pixel(&behind, 70, 75), 3); /* the upper left triangle */
    assert_true(is_red(pixel(&facets, 130, 125)));
    assert_memory_not_equal(pixel(&smooth, 70, 75), pixel(&behind, 70, 75), 3);
    image_clear(&behind);
    image_clear(&smooth);
    image_clear(&facets);
}

/* Light of 0.55 in the middle of the backdrop: 1.055 x 0.55^(1/2.4) - 0.055 of 255 is 195.6. */
static void pictures_are_srgb(void **state)
{
    (void)state;
    struct render_view view = square_view();
    struct image image = drawn(&view, NULL, 0);
    assert_near(pixel(&image, 100, 100)[0], 195.6, 1.5);
    image_clear(&image);
}

static void a_floor_takes_a_shadow_and_none_is_seen_from_below(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(20, 20);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    view.camera.eye[1] = 4;
    struct image without = drawn(&view, &skin, 1);
    view.floor = true;
    view.floor_height = -1.2;
    struct image with = drawn(&view, &skin, 1);
    /* (0, -1.2, 1) lies in front of the sphere: at tan = (-1.2 - 4 / 10 x ..) below its middle */
    assert_true(pixel(&with, 100, 160)[1] + 10 < pixel(&without, 100, 160)[1]);
    assert_memory_equal(pixel(&with, 100, 100), pixel(&without, 100, 100), 3);
    view.camera.eye[1] = -4;
    struct image below = drawn(&view, &skin, 1);
    view.floor = false;
    struct image below_without = drawn(&view, &skin, 1);
    assert_same_picture(&below, &below_without);
    image_clear(&without);
    image_clear(&with);
    image_clear(&below);
    image_clear(&below_without);
    sphere_free(&mesh);
}

/* Seen from just above the floor the shadow lies further away than the skin, and is whole all the same. */
static void a_shadow_has_no_edge(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(20, 20);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    view.camera.eye[1] = 2;
    view.floor = true;
    view.floor_height = -1.5;
    struct image image = drawn(&view, &skin, 1);
    int darkest = 255;
    for (int y = 152; y < 200; y++) /* below the sphere */
        for (int x = 0; x < 200; x++) {
            assert_near(pixel(&image, x, y)[1], pixel(&image, x, y - 1)[1], 4);
            darkest = pixel(&image, x, y)[1] < darkest ? pixel(&image, x, y)[1] : darkest;
        }
    for (int y = 1; y < 200; y++) /* beside it */
        assert_near(pixel(&image, 40, y)[1], pixel(&image, 40, y - 1)[1], 4);
    assert_true(darkest < 180);
    image_clear(&image);
    sphere_free(&mesh);
}

/* Two balloons far from each other: the floor between them is as it is without, and below one of them as if
 * it were alone. */
static void each_skin_has_a_shadow_of_its_own(void **state)
{
    (void)state;
    struct mesh meshes[2] = {sphere_new(20, 20), sphere_new(20, 20)};
    struct render_skin skins[2];
    for (int i = 0; i < 2; i++) {
        skins[i] = (struct render_skin){.mesh = &meshes[i], .colour = {0.7f, 0.1f, 0.1f}};
        for (uint32_t p = 0; p < meshes[i].point_count; p++) {
            for (int k = 0; k < 3; k++)
                meshes[i].position[p][k] *= 0.3;
            meshes[i].position[p][0] += i ? 1.5 : -1.5;
        }
    }
    struct render_view view = square_view();
    view.camera.eye[1] = 4;
    struct image without = drawn(&view, skins, 2);
    view.floor = true;
    view.floor_height = -0.35;
    struct image one = drawn(&view, skins, 1), both = drawn(&view, skins, 2);
    int darkest = 0;
    for (int y = 0; y < 200; y++)
        for (int x = 0; x < 200; x++) {
            const int light = pixel(&both, x, y)[1];
            if (abs(x - 100) < 20)
                assert_near(light, pixel(&without, x, y)[1], 1);
            if (x < 100)
                assert_near(light, pixel(&one, x, y)[1], 1);
            const int taken = pixel(&without, x, y)[1] - light;
            darkest = x > 120 && taken > darkest ? taken : darkest;
        }
    assert_true(darkest > 20);
    image_clear(&without);
    image_clear(&one);
    image_clear(&both);
    for (int i = 0; i < 2; i++)
        sphere_free(&meshes[i]);
}

/* How green the middle is of a picture of cards, the line before or behind them at z. */
static double green_of_a_line(const struct render_view *view, const struct render_skin *skins, size_t count,
                              double z)
{
    struct error err;
    struct image image = {0};
    const struct render_line line = {
        .from = {-1, 0, z}, .to = {1, 0, z}, .colour = {0, 0.6f, 0}, .opacity = 1, .width = 4};
    assert_ok(render_draw_scene(renderer, view,
                                &(struct render_scene){skins, count, .lines = &line, .line_count = 1}, &image,
                                &err),
              &err);
    const double green = linear(pixel(&image, 100, 100)[1]) - linear(pixel(&image, 100, 100)[0]);
    image_clear(&image);
    return green;
}

/* As strings, needles and walls are: whatever the order of the layers. */
static void a_line_behind_translucent_skin_is_seen_through_it(void **state)
{
    (void)state;
    struct cards near = {0}, far = {0};
    add_card(&near, -1, -1, 1, 1, 0.5);
    add_card(&far, -1, -1, 1, 1, -0.5);
    for (int i = 0; i < 2; i++)
        near.opacity[i] = far.opacity[i] = 0.7f;
    struct render_skin skins[2] = {skin_of(&near, 0.3f, 0.3f, 0.3f), skin_of(&far, 0.3f, 0.3f, 0.3f)};
    static const float stretch[2] = {4, 4};
    skins[0].stretch = skins[1].stretch = stretch;
    skins[0].rest_opacity = skins[1].rest_opacity = 0.7f;
    struct render_view view = square_view();
    for (int style = RENDER_PAPER; style <= RENDER_LATEX; style++)
        for (int order = RENDER_NONE; order <= RENDER_LIST; order++) {
            view.style = (enum render_style)style;
            view.order = (enum render_order)order;
            const double alone = green_of_a_line(&view, NULL, 0, 0);
            const double before = green_of_a_line(&view, skins, 2, 1),
                         behind = green_of_a_line(&view, skins, 2, -1);
            assert_near(before, alone, 0.02 * alone);
            assert_true(behind > 0.01 * alone && behind < 0.4 * alone);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opacity_one_half_blends_half_of_what_lies_behind),
        cmocka_unit_test(thick_latex_that_is_inside_out_is_lit),
        cmocka_unit_test(light_within_has_the_colour_of_the_skin),
        cmocka_unit_test(smooth_edges_change_outlines_only),
        cmocka_unit_test(both_sides_of_a_skin_are_lit_alike),
        cmocka_unit_test(what_is_opaque_passes_no_light_from_behind),
        cmocka_unit_test(points_without_a_normal_take_the_facets),
        cmocka_unit_test(shinier_skin_has_a_stronger_highlight),
        cmocka_unit_test(opacity_is_smooth_unless_facets_are_wanted),
        cmocka_unit_test(pictures_are_srgb),
        cmocka_unit_test(a_floor_takes_a_shadow_and_none_is_seen_from_below),
        cmocka_unit_test(a_shadow_has_no_edge),
        cmocka_unit_test(each_skin_has_a_shadow_of_its_own),
        cmocka_unit_test(a_line_behind_translucent_skin_is_seen_through_it),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
