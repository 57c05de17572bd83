/* Outlines whose steps are smoothed in the picture are nearly as good as those of several samples,
 * and nothing else changes. */
#include "cards.h"
#include "sphere.h"

/* The mean of the differences of all channels. */
static double mean_error(const struct image *image, const struct image *truth)
{
    const size_t count = 3 * (size_t)image->width * (size_t)image->height;
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += abs(image->rgb[i] - truth->rgb[i]);
    return sum / (double)count;
}

/* Against 4 x 4 samples. A pixel that an outline crosses is wrong by a quarter of its contrast on the mean
 * when it is all within or all without; were it right to an eighth, as one of four samples in a row can be,
 * half of that would be left: asked is less than 0.7. */
static void filtered_outlines_are_nearer_to_the_truth_than_rough_ones(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}, .rest_opacity = 0.9f};
    struct render_view view = square_view();
    for (int style = RENDER_PAPER; style <= RENDER_LATEX; style++) {
        double error[RENDER_SAMPLED + 1];
        view.style = (enum render_style)style;
        view.samples = RENDER_SAMPLES_MAX;
        struct image truth = drawn(&view, &skin, 1);
        view.samples = 1;
        for (int outlines = RENDER_ROUGH; outlines <= RENDER_SAMPLED; outlines++) {
            view.outlines = (enum render_outlines)outlines;
            struct image image = drawn(&view, &skin, 1);
            error[outlines] = mean_error(&image, &truth);
            image_clear(&image);
        }
        assert_true(error[RENDER_SAMPLED] < error[RENDER_FILTERED]);
        assert_true(error[RENDER_FILTERED] < 0.7 * error[RENDER_ROUGH]);
        image_clear(&truth);
    }
    sphere_free(&mesh);
}

/* Rows and columns of pixels cut nothing into steps, and corners stay sharp. */
static void upright_rectangles_stay_as_they_are(void **state)
{
    (void)state;
    struct cards cards = {0};
    add_card(&cards, -1, -1.4, 0.6, 1, 0);
    add_card(&cards, -0.2, -1.7, 1.3, 0.3, 0);
    struct render_skin skin = skin_of(&cards, 0.7f, 0.1f, 0.1f);
    struct render_view view = square_view();
    struct image rough = drawn(&view, &skin, 1);
    view.outlines = RENDER_FILTERED;
    struct image filtered = drawn(&view, &skin, 1);
    assert_same_picture(&filtered, &rough);
    image_clear(&rough);
    image_clear(&filtered);
}

/* Slanted skin reaches over the border of both pictures, at other heights in each. */
static void each_eyes_picture_is_filtered_alone(void **state)
{
    (void)state;
    double position[3][3] = {{-9, -3, -1}, {9, 1.2, 2}, {9, -3, 2}};
    uint32_t triangle[1][3] = {{0, 2, 1}};
    const struct mesh mesh = {
        .point_count = 3, .position = position, .triangle_count = 1, .triangle = triangle};
    const struct render_skin skin = {.mesh = &mesh, .colour = {0.7f, 0.1f, 0.1f}};
    struct render_view view = square_view();
    view.outlines = RENDER_FILTERED;
    view.stereo = RENDER_LEFT;
    struct image left = drawn(&view, &skin, 1);
    view.stereo = RENDER_PARALLEL;
    view.width *= 2;
    struct image both = drawn(&view, &skin, 1);
    image_clear(&both);
    both = drawn(&view, &skin, 1); /* over what the right eye saw of the picture before */
    for (int y = 0; y < view.height; y++)
        assert_memory_equal(pixel(&both, 0, y), pixel(&left, 0, y), 3 * (size_t)left.width);
    image_clear(&left);
    image_clear(&both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filtered_outlines_are_nearer_to_the_truth_than_rough_ones),
        cmocka_unit_test(upright_rectangles_stay_as_they_are),
        cmocka_unit_test(each_eyes_picture_is_filtered_alone),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
