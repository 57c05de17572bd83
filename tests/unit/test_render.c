/* Pictures show what is there, where it is. */
#include "check.h"
#include "render/render.h"
#include "sphere.h"

static struct render *renderer;

/* Draws from (0, 0, 10), y up, 4 units high at the origin: x and y in -2 .. 2 in a square picture. */
static struct render_view square_view(void)
{
    return (struct render_view){.width = 200,
                                .height = 200,
                                .order = RENDER_SORT,
                                .camera = {.eye = {0, 0, 10},
                                           .up = {0, 1, 0},
                                           .field_of_view_deg = 2 * atan(0.2) * 180 / M_PI,
                                           .eye_distance = 1,
                                           .screen_distance = 10}};
}

static struct image drawn(const struct render_view *view, const struct render_skin *skins, size_t count)
{
    struct error err;
    struct image image = {0};
    assert_ok(render_draw(renderer, view, skins, count, &image, &err), &err);
    assert_int_equal(image.width, view->width);
    assert_int_equal(image.height, view->height);
    return image;
}

/* Rectangles that face the viewer: two triangles each, without normals. */
struct cards {
    struct mesh mesh;
    double position[16][3];
    uint32_t triangle[8][3];
    float opacity[8];
};

static void add_card(struct cards *cards, double left, double below, double right, double above, double z)
{
    uint32_t p = cards->mesh.point_count, t = cards->mesh.triangle_count;
    for (uint32_t k = 0; k < 4; k++) {
        const double at[3] = {k == 0 || k == 3 ? left : right, k < 2 ? below : above, z};
        memcpy(cards->position[p + k], at, sizeof at);
    }
    const uint32_t triangles[2][3] = {{p, p + 1, p + 2}, {p, p + 2, p + 3}};
    memcpy(cards->triangle[t], triangles, sizeof triangles);
    cards->opacity[t] = cards->opacity[t + 1] = 1;
    cards->mesh.point_count += 4;
    cards->mesh.triangle_count += 2;
    cards->mesh.position = cards->position;
    cards->mesh.triangle = cards->triangle;
}

static struct render_skin skin_of(const struct cards *cards, float red, float green, float blue)
{
    return (struct render_skin){
        .mesh = &cards->mesh, .opacity = cards->opacity, .colour = {red, green, blue}};
}

static const unsigned char *pixel(const struct image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static bool is_red(const unsigned char *rgb)
{
    return rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2];
}

static bool is_blue(const unsigned char *rgb)
{
    return rgb[2] > 2 * rgb[0] && rgb[2] > 2 * rgb[1];
}

/* sRGB's curve, IEC 61966-2-1, from 0 .. 255 to linear light 0 .. 1. */
static double linear(unsigned char value)
{
    double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static void assert_same_picture(const struct image *a, const struct image *b)
{
    assert_int_equal(a->width, b->width);
    assert_memory_equal(a->rgb, b->rgb, 3 * (size_t)a->width * (size_t)a->height);
}

/* The middle of all red pixels in columns from .. to; their number is returned. */
static int red_middle(const struct image *image, int from, int to, double middle[2])
{
    int count = 0;
    middle[0] = middle[1] = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = from; x < to; x++)
            if (is_red(pixel(image, x, y))) {
                middle[0] += x + 0.5;
                middle[1] += y + 0.5;
                count++;
            }
    middle[0] /= count;
    middle[1] /= count;
    return count;
}

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

static void smooth_edges_change_outlines_only(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    struct image plain = drawn(&view, &skin, 1);
    view.smooth_edges = true;
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

static void a_camera_inside_the_balloon_sees_its_wall(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(20, 20);
    struct render_skin skin = {.mesh = &mesh, .colour = {1, 0, 0}};
    struct render_view view = square_view();
    view.camera.eye[2] = 0.2;
    view.smooth_edges = true;
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
    view.floor = view.smooth_edges = true;
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
    for (int smooth = 0; smooth < 2; smooth++) {
        view.smooth_edges = smooth;
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

static int open_renderer(void **state)
{
    (void)state;
    struct error err;
    assert_ok(render_open(200, 200, &renderer, &err), &err);
    return 0;
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
        cmocka_unit_test(x_is_to_the_right_and_y_is_up),
        cmocka_unit_test(the_nearer_hides_the_farther_whichever_comes_first),
        cmocka_unit_test(opacity_one_half_blends_half_of_what_lies_behind),
        cmocka_unit_test(translucent_skins_are_drawn_back_to_front),
        cmocka_unit_test(an_opaque_skin_hides_translucent_ones_behind_it),
        cmocka_unit_test(inactive_triangles_are_not_drawn_nor_looked_at),
        cmocka_unit_test(near_things_are_crossed_and_the_screen_plane_agrees),
        cmocka_unit_test(crossed_pairs_are_parallel_ones_with_the_halves_swapped),
        cmocka_unit_test(smooth_edges_change_outlines_only),
        cmocka_unit_test(both_sides_of_a_skin_are_lit_alike),
        cmocka_unit_test(points_without_a_normal_take_the_facets),
        cmocka_unit_test(shinier_skin_has_a_stronger_highlight),
        cmocka_unit_test(opacity_is_smooth_unless_facets_are_wanted),
        cmocka_unit_test(pictures_are_srgb),
        cmocka_unit_test(a_floor_takes_a_shadow_and_none_is_seen_from_below),
        cmocka_unit_test(a_shadow_has_no_edge),
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
