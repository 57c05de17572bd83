/* What order and samples cost in a picture: every dial has a row, and rows err as their dials say. */
#include "balloon.h"
#include "sim/price_picture.h"
#include "support/slowdown.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A thin skin that swells for a moment: each ray meets its front and its back. */
#define SWELLING                                                                                \
    SETTINGS("balloons[0].point_mass=1", "balloons[0].pressure=4", "balloons[0].threshold=100", \
             "balloons[0].opacity=0.6", "time.end=0.4", "view.size=[320,120]")

static enum status measure(const char *const *settings, const struct pricing_options *options,
                           struct price_pictures *pictures, struct error *err)
{
    struct balloon b;
    open_balloon(&b, 3, settings);
    const enum status status = price_pictures_measure(&b.scene, &b.mesh, 0.2, options, pictures, err);
    close_balloon(&b);
    return status;
}

static const struct price_picture *row_of(const struct price_pictures *pictures, int order, int samples)
{
    for (size_t i = 0; i < pictures->count; i++)
        if (pictures->rows[i].order == order && pictures->rows[i].samples == samples)
            return &pictures->rows[i];
    fail_msg("no row of %s with %d samples", scene_order_names[order], samples);
    return NULL;
}

static struct price_pictures swelling; /* measured once */

static int measure_swelling(void **state)
{
    (void)state;
    struct error err = {0};
    assert_ok(measure(SWELLING, &(struct pricing_options){0}, &swelling, &err), &err);
    return 0;
}

static void every_order_has_a_row_for_each_number_of_samples(void **state)
{
    (void)state;
    assert_string_equal(swelling.reason, "");
    assert_int_equal(swelling.count, 16);
    assert_near(swelling.time, 0.2, 1e-9);
    for (int order = SCENE_ORDER_NONE; order <= SCENE_ORDER_LIST; order++)
        for (int samples = 1; samples <= 4; samples++) {
            const struct price_picture *row = row_of(&swelling, order, samples);
            assert_true(row->seconds > 0 && isfinite(row->seconds));
            assert_true(row->mean >= 0 && row->mean <= row->worst && row->worst <= 255);
        }
}

static void lists_with_most_samples_are_the_reference(void **state)
{
    (void)state;
    const struct price_picture *row = row_of(&swelling, SCENE_ORDER_LIST, 4);
    assert_true(row->mean == 0 && row->worst == 0 && row->best);
    for (size_t i = 0; i < swelling.count; i++)
        assert_true(&swelling.rows[i] == row || swelling.rows[i].mean > 0);
}

/* Half floats round differently on the two ways, by 2^-11 a layer: after the tone curve, whose slope in sRGB
 * is below 2 where skin is, two layers are less than 0.5 of 255 apart, which rounds to 1, and seldom. */
static void peeling_agrees_with_lists(void **state)
{
    (void)state;
    const struct price_picture *row = row_of(&swelling, SCENE_ORDER_PEEL, 4);
    assert_true(row->worst <= 1);
    assert_true(row->mean < 0.05);
}

/* The back wall of a closed skin over its front one is another picture; sorted, a convex one's triangles are
 * in order but for slivers at its rim. */
static void no_order_is_worse_than_sorting(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples++)
        assert_true(row_of(&swelling, SCENE_ORDER_NONE, samples)->mean >
                    5 * row_of(&swelling, SCENE_ORDER_SORT, samples)->mean);
}

static void more_samples_come_nearer(void **state)
{
    (void)state;
    for (int samples = 2; samples <= 4; samples++) {
        assert_true(row_of(&swelling, SCENE_ORDER_LIST, samples)->mean <
                    row_of(&swelling, SCENE_ORDER_LIST, samples - 1)->mean);
        assert_true(row_of(&swelling, SCENE_ORDER_SORT, samples)->mean <
                    row_of(&swelling, SCENE_ORDER_SORT, samples - 1)->mean);
    }
}

static void the_scenes_own_dials_are_told(void **state)
{
    (void)state;
    assert_int_equal(swelling.own_order, SCENE_ORDER_SORT);
    assert_int_equal(swelling.own_samples, 1);
    assert_int_equal(swelling.size[0], 320);
    assert_int_equal(swelling.size[1], 120);
}

static void what_cannot_be_drawn_is_a_reason_and_no_error(void **state)
{
    (void)state;
    struct price_pictures pictures;
    struct error err = {0};
    assert_ok(measure(SETTINGS("view.camera=[1e-300,0,0]"), &(struct pricing_options){0}, &pictures, &err),
              &err);
    assert_int_equal(pictures.count, 0);
    assert_non_null(strstr(pictures.reason, "up"));
}

/* How often it has been asked, and may be. */
struct patience {
    int asked, most;
};

static bool while_it_lasts(void *context, double done)
{
    struct patience *p = context;
    assert_true(done >= 0 && done <= 1);
    return ++p->asked < p->most;
}

/* In the steps before the first picture, and in the pictures. */
static void it_ends_when_it_is_told_to(void **state)
{
    (void)state;
    struct price_pictures pictures;
    struct error err = {0};
    struct patience short_one = {0, 3}, long_one = {0, 12};
    const struct pricing_options in_steps = {.go_on = while_it_lasts, .context = &short_one},
                                 in_pictures = {.go_on = while_it_lasts, .context = &long_one};
    assert_int_equal(measure(SWELLING, &in_steps, &pictures, &err), STATUS_INTERRUPTED);
    assert_int_equal(short_one.asked, 3);
    assert_true(pictures.time < 0.19);
    assert_int_equal(measure(SWELLING, &in_pictures, &pictures, &err), STATUS_INTERRUPTED);
    assert_int_equal(long_one.asked, 12);
    assert_true(pictures.count > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_order_has_a_row_for_each_number_of_samples),
        cmocka_unit_test(lists_with_most_samples_are_the_reference),
        cmocka_unit_test(peeling_agrees_with_lists),
        cmocka_unit_test(no_order_is_worse_than_sorting),
        cmocka_unit_test(more_samples_come_nearer),
        cmocka_unit_test(the_scenes_own_dials_are_told),
        cmocka_unit_test(what_cannot_be_drawn_is_a_reason_and_no_error),
        cmocka_unit_test(it_ends_when_it_is_told_to),
    };
    if (slowdown() > 1) {
        printf("1..0 # SKIP pictures that take long are not priced\n");
        return 0;
    }
    return cmocka_run_group_tests(tests, measure_swelling, NULL);
}
