/* Both eyes see each point where their places in the scene say, in every way to show two pictures. */
#include "renderer.h"

/* Seen from (0, 0, 10), 4 units high at the origin, which lies in the screen plane; eyes 1 apart. */
static struct render_view view_of(enum render_stereo stereo, bool squeezed)
{
    return (struct render_view){.width = 240,
                                .height = 160,
                                .stereo = stereo,
                                .squeezed = squeezed,
                                .order = RENDER_SORT,
                                .camera = front_camera()};
}

/* A red square around a point. */
static struct image drawn_square(const struct render_view *view, double x, double y, double z)
{
    const double r = 0.15;
    double position[4][3] = {{x - r, y - r, z}, {x + r, y - r, z}, {x + r, y + r, z}, {x - r, y + r, z}};
    uint32_t triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const struct mesh mesh = {
        .point_count = 4, .position = position, .triangle_count = 2, .triangle = triangle};
    const struct render_skin skin = {.mesh = &mesh, .colour = {1, 0, 0}};
    return drawn(view, &skin, 1);
}

/* The middle of what is red in a part of the picture; what is green there has none of it. */
static void red_middle(const struct image *image, int left, int top, int width, int height, double middle[2])
{
    double sum[2] = {0}, weight = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const unsigned char *rgb = image->rgb + 3 * ((top + y) * image->width + left + x);
            const double red = fmax(linear(rgb[0]) - linear(rgb[1]) - 0.02, 0);
            sum[0] += red * (x + 0.5);
            sum[1] += red * (y + 0.5);
            weight += red;
        }
    assert_true(weight > 0);
    middle[0] = sum[0] / weight;
    middle[1] = sum[1] / weight;
}

/* Where the left and the right eye's pictures lie: x, y, width, height from above. */
static const struct layout {
    enum render_stereo stereo;
    bool squeezed;
    int left[4], right[4];
} layouts[] = {
    {RENDER_PARALLEL, false, {0, 0, 120, 160}, {120, 0, 120, 160}},
    {RENDER_PARALLEL, true, {0, 0, 120, 160}, {120, 0, 120, 160}},
    {RENDER_CROSSED, false, {120, 0, 120, 160}, {0, 0, 120, 160}},
    {RENDER_OVER_UNDER, false, {0, 0, 240, 80}, {0, 80, 240, 80}},
    {RENDER_OVER_UNDER, true, {0, 0, 240, 80}, {0, 80, 240, 80}},
};

/* Parallax at distance d from eyes that are e apart, the screen at s: x on the screen shifts by e (d - s) / d
 * between the left and the right eye. A squeezed or plain half spans 4 units of height times its proportions.
 * Edges are known to an eighth of a pixel by sixteen samples each, and weights differ a little as the eyes
 * see other light in the square. */
static void parallax_is_that_of_the_eyes_and_never_vertical(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        const struct layout *layout = &layouts[i];
        struct render_view view = view_of(layout->stereo, layout->squeezed);
        view.samples = 4;
        const int *l = layout->left, *r = layout->right;
        const double wide = 4.0 * (layout->squeezed ? 240.0 / 160 : (double)l[2] / l[3]);
        for (int z = -3; z <= 3; z++) {
            const double at[3] = {0.3, 0.5, z};
            struct image image = drawn_square(&view, at[0], at[1], at[2]);
            double left[2], right[2];
            red_middle(&image, l[0], l[1], l[2], l[3], left);
            red_middle(&image, r[0], r[1], r[2], r[3], right);
            const double depth = 10 - z, shift = (depth - 10) / depth * l[2] / wide;
            assert_near(right[0] - left[0], shift, 0.5);
            assert_near(right[1], left[1], 0.05);
            assert_near((left[0] + right[0]) / 2, l[2] / 2.0 + at[0] * 10 / depth * l[2] / wide, 0.5);
            assert_near(left[1], l[3] / 2.0 - at[1] * 10 / depth * l[3] / 4, 0.5);
            if (z == 0)
                assert_near(right[0], left[0], 0.05);
            image_clear(&image);
        }
    }
}

struct eyes {
    struct image left, right, both;
};

static struct eyes eyes_drawn(enum render_stereo stereo)
{
    const struct render_view left = view_of(RENDER_LEFT, false), right = view_of(RENDER_RIGHT, false),
                             both = view_of(stereo, false);
    return (struct eyes){drawn_square(&left, 0.3, 0.2, 2), drawn_square(&right, 0.3, 0.2, 2),
                         drawn_square(&both, 0.3, 0.2, 2)};
}

static void eyes_clear(struct eyes *eyes)
{
    image_clear(&eyes->left);
    image_clear(&eyes->right);
    image_clear(&eyes->both);
}

static void interlaced_rows_are_the_left_eyes_and_the_rights_in_turn(void **state)
{
    (void)state;
    struct eyes eyes = eyes_drawn(RENDER_INTERLACED);
    for (int y = 0; y < 160; y++) {
        const struct image *eye = y % 2 ? &eyes.right : &eyes.left;
        assert_memory_equal(eyes.both.rgb + 720 * y, eye->rgb + 720 * y, 720);
    }
    eyes_clear(&eyes);
}

/* Pictures hold light to 1/510 of sRGB's scale, at most 0.0045 of light there; sums of
 * several weigh up to 1.4. */
static void red_cyan_is_dubois_mixture_of_both(void **state)
{
    (void)state;
    static const double matrix[3][6] = {{.4561, .5005, .1764, -.0435, -.0879, -.0016},
                                        {-.0401, -.0378, -.0158, .3785, .7336, -.0185},
                                        {-.0152, -.0206, -.0055, -.0722, -.1130, 1.2264}};
    struct eyes eyes = eyes_drawn(RENDER_RED_CYAN);
    for (int p = 0; p < 240 * 160; p++)
        for (int row = 0; row < 3; row++) {
            double sum = 0;
            for (int i = 0; i < 3; i++)
                sum += matrix[row][i] * linear(eyes.left.rgb[3 * p + i]) +
                       matrix[row][3 + i] * linear(eyes.right.rgb[3 * p + i]);
            assert_near(linear(eyes.both.rgb[3 * p + row]), fmin(fmax(sum, 0), 1), 0.008);
        }
    eyes_clear(&eyes);
}

/* 2100 x 2100: two bands, the second of which begins on an odd row from above. */
static void bands_of_a_large_picture_keep_their_rows(void **state)
{
    (void)state;
    struct render_view view = view_of(RENDER_INTERLACED, false), left = view_of(RENDER_LEFT, false);
    view.width = view.height = left.width = left.height = 2100;
    struct image both = drawn_square(&view, 0, 0, 4), one = drawn_square(&left, 0, 0, 4);
    for (int y = 0; y < 2100; y += 2)
        assert_memory_equal(both.rgb + 6300 * y, one.rgb + 6300 * y, 6300);
    image_clear(&both);
    image_clear(&one);
}

static void what_cannot_be_halved_is_refused(void **state)
{
    (void)state;
    struct error err;
    struct image image = {0};
    struct render_view view = view_of(RENDER_OVER_UNDER, false);
    view.height = 161;
    assert_refused(render_draw(renderer, &view, NULL, 0, &image, &err), STATUS_RANGE, "161 high", &err);
    view.stereo = RENDER_CROSSED;
    assert_ok(render_draw(renderer, &view, NULL, 0, &image, &err), &err);
    image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallax_is_that_of_the_eyes_and_never_vertical),
        cmocka_unit_test(interlaced_rows_are_the_left_eyes_and_the_rights_in_turn),
        cmocka_unit_test(red_cyan_is_dubois_mixture_of_both),
        cmocka_unit_test(bands_of_a_large_picture_keep_their_rows),
        cmocka_unit_test(what_cannot_be_halved_is_refused),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
