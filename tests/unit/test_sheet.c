/* The contact sheet: which moments it shows, and how they are laid out and labelled. */
#include "pictures.h"
#include "render/sheet.h"

/* Grey pictures: still for 500, then brighter by 2 with each of 100. */
static void a_sheet_shows_what_changes_evenly(void **state)
{
    (void)state;
    struct error err;
    struct sheet sheet = {0};
    struct image image = a_picture(64, 48), out = {0};
    for (int n = 0; n < 600; n++) {
        memset(image.rgb, n < 500 ? 0 : 2 * (n - 499), 3 * 64 * 48);
        assert_ok(sheet_add(&sheet, &image, n, &err), &err);
        assert_true(sheet.count <= SHEET_KEPT);
    }
    int chosen[SHEET_MOMENTS];
    assert_int_equal(sheet_choose(&sheet, chosen), 12);
    assert_true(sheet.moments[chosen[0]].time == 0);
    assert_true(sheet.moments[chosen[11]].time == 599);
    for (int k = 1; k < 12;
         k++) /* one of the kept steps is 100 / 24 pictures at most: half of that is the error */
        assert_near(sheet.moments[chosen[k]].time, 499 + k * 100 / 11.0, 2.5);
    assert_ok(sheet_draw(&sheet, &out, &err), &err);
    assert_int_equal(out.width, 4 * 64 + 5 * 6);
    assert_int_equal(out.height, 3 * 48 + 4 * 6);
    assert_int_equal(out.rgb[0], 255);
    assert_int_equal(out.rgb[3 * (6 * out.width + 6)], 0);
    assert_int_equal(out.rgb[3 * ((6 + 48 + 6 + 48 + 6) * out.width + out.width - 7)], 200);
    image_clear(&image);
    image_clear(&out);
    sheet_clear(&sheet);
}

/* A burst: 400 pictures that swell for 40, break for 30, of which they tell the count, and then are debris
 * that flies out of sight for 330 and changes far more in the picture, while a last fiftieth breaks. */
static void most_moments_of_a_burst_are_of_what_breaks(void **state)
{
    (void)state;
    struct error err;
    struct sheet sheet = {.counted = "edges broken", .counted_one = "edge broken"};
    struct image image = a_picture(300, 200), out = {0};
    int chosen[SHEET_MOMENTS], breaking = 0, debris = 0;
    for (int n = 0; n < 400; n++) {
        const int grey = n < 40 ? n / 2 : n < 70 ? n - 20 : 50 + n % 7 * 20;
        memset(image.rgb, grey, 3 * 300 * 200);
        sheet.count_now = n <= 40 ? 0 : n < 70 ? 50 * (n - 40) : 1500 + 0.1 * (n - 70);
        assert_ok(sheet_add(&sheet, &image, n, &err), &err);
    }
    assert_int_equal(sheet_choose(&sheet, chosen), 12);
    for (int k = 0; k < 12; k++) {
        breaking += sheet.moments[chosen[k]].time > 40 && sheet.moments[chosen[k]].time <= 70;
        debris += sheet.moments[chosen[k]].time > 70;
    }
    assert_int_equal(sheet.moments[chosen[0]].time, 0);
    assert_int_equal(sheet.moments[chosen[11]].time, 399);
    assert_in_range(breaking, 7, 9);
    assert_in_range(debris, 2, 4);
    /* The captions, of white tiles: the last has the count beside its time, the first has none. */
    for (int k = 0; k < sheet.count; k++)
        memset(sheet.moments[k].image.rgb, 255, 3 * 300 * 200);
    assert_ok(sheet_draw(&sheet, &out, &err), &err);
    int dark[2] = {0};
    for (int tile = 0; tile < 2; tile++)
        for (int y = 180; y < 200; y++)
            for (int x = 80; x < 300; x++)
                dark[tile] += out.rgb[3 * ((size_t)(6 + tile * 2 * 206 + y) * (size_t)out.width +
                                           (size_t)(6 + tile * 3 * 306 + x))] < 100;
    assert_int_equal(dark[0], 0);
    assert_true(dark[1] > 100);
    image_clear(&image);
    image_clear(&out);
    sheet_clear(&sheet);
}

/* The right end of the writing on the first tile of a sheet of white pictures of this size; -1 where it is
 * beyond the tile. */
static int caption_end(int width, int height, double count)
{
    struct error err;
    struct sheet sheet = {.counted = "edges broken", .counted_one = "edge broken"};
    struct image image = a_picture(width, height), out = {0};
    memset(image.rgb, 255, 3 * (size_t)width * (size_t)height);
    sheet.count_now = count;
    for (int n = 0; n < 2; n++)
        assert_ok(sheet_add(&sheet, &image, 1.5 * n, &err), &err);
    assert_ok(sheet_draw(&sheet, &out, &err), &err);
    const int tile = sheet.moments[0].image.width;
    int end = 0;
    for (size_t i = 0; i < (size_t)out.width * (size_t)out.height; i++) {
        const int x = (int)(i % (size_t)out.width) - 6; /* from the tile's left border */
        if (out.rgb[3 * i] < 250 && x < tile)
            end = x > end ? x : end;
        if (out.rgb[3 * i] < 250 && x >= tile && x < tile + 6)
            end = tile + 6;
    }
    image_clear(&image);
    image_clear(&out);
    sheet_clear(&sheet);
    return end < tile ? end : -1;
}

/* In small and narrow pictures, as of films for telephones, the count is above the time, or left out. */
static void captions_stay_within_their_tiles(void **state)
{
    (void)state;
    static const int sizes[][2] = {{60, 400}, {100, 400}, {120, 90}, {135, 240}, {1080, 1920}, {16, 16}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        assert_true(caption_end(sizes[i][0], sizes[i][1], 1281) >= 0);
    assert_true(caption_end(120, 90, 1281) > 100);
    assert_int_equal(caption_end(300, 200, 2) - caption_end(300, 200, 1), 6); /* a letter: edges, edge */
}

/* All five pictures of what breaks and the one before are shown, and the others are far from each other. */
static void few_pictures_of_what_breaks_crowd_no_others(void **state)
{
    (void)state;
    struct error err;
    struct sheet sheet = {.counted = "edges broken", .counted_one = "edge broken"};
    struct image image = a_picture(30, 20);
    int chosen[SHEET_MOMENTS];
    for (int n = 0; n < 45; n++) {
        memset(image.rgb, 3 * n, 3 * 30 * 20);
        sheet.count_now = n < 40 ? 0 : 7 * (n - 39);
        assert_ok(sheet_add(&sheet, &image, n, &err), &err);
    }
    assert_int_equal(sheet_choose(&sheet, chosen), 12);
    for (int k = 1; k < 12; k++) {
        const double step = sheet.moments[chosen[k]].time - sheet.moments[chosen[k - 1]].time;
        if (k >= 7)
            assert_true(step == 1);
        else
            assert_true(step >= 3);
    }
    image_clear(&image);
    sheet_clear(&sheet);
}

static void a_still_run_is_spaced_evenly_in_time(void **state)
{
    (void)state;
    struct error err;
    struct sheet sheet = {0};
    struct image image = a_picture(64, 48);
    int chosen[SHEET_MOMENTS];
    for (int n = 0; n < 45; n++)
        assert_ok(sheet_add(&sheet, &image, n, &err), &err);
    assert_int_equal(sheet_choose(&sheet, chosen), 12);
    for (int k = 0; k < 12; k++)
        assert_near(chosen[k], 4 * k, 0.5);
    image_clear(&image);
    sheet_clear(&sheet);
}

/* A run of 14 s whose changes crowd at its start: no two labels are the same. */
static void times_are_written_so_that_each_is_told_from_the_next(void **state)
{
    (void)state;
    static const struct {
        double time[4];
        int decimals;
    } cases[] = {{{0, 0.2, 0.4, 14}, 1},   {{0, 0.125, 0.25, 14}, 1}, {{0, 0.0125, 2, 14}, 2},
                 {{0, 1, 2, 3}, 0},        {{0, 10, 40, 90}, 0},      {{5, 5, 5, 5}, 3},
                 {{0, 0.999999, 2, 3}, 1}, {{0, 1e-12, 1, 2}, 6}};
    const int chosen[] = {0, 1, 2, 3};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sheet sheet = {.count = 4};
        for (int k = 0; k < 4; k++)
            sheet.moments[k].time = cases[i].time[k];
        assert_int_equal(sheet_decimals(&sheet, chosen, 4), cases[i].decimals);
    }
}

static void a_sheet_of_few_large_pictures_shows_them_all_reduced(void **state)
{
    (void)state;
    struct error err;
    struct sheet sheet = {0};
    struct image image = a_picture(1920, 960), out = {0};
    assert_refused(sheet_draw(&sheet, &out, &err), STATUS_RANGE, "at least one", &err);
    memset(image.rgb, 77, 3 * 1920 * 960);
    for (int n = 0; n < 5; n++)
        assert_ok(sheet_add(&sheet, &image, n * 1e-5, &err), &err);
    assert_ok(sheet_draw(&sheet, &out, &err), &err);
    assert_int_equal(out.width, 4 * 480 + 5 * 6);
    assert_int_equal(out.height, 2 * 240 + 3 * 6);
    assert_int_equal(out.rgb[3 * (100 * out.width + 100)], 77);
    assert_int_equal(out.rgb[3 * (400 * out.width + 700)], 255); /* no sixth */
    image_clear(&image);
    image_clear(&out);
    sheet_clear(&sheet);
}

static void labels_are_cut_off_at_the_edges(void **state)
{
    (void)state;
    struct image image = a_picture(20, 20);
    label_draw(&image, -7, -3, 2, "-1.5e+07 s");
    label_draw(&image, 15, 15, 3, "88");
    image_clear(&image);
    image = a_picture(10, 10);
    memset(image.rgb, 255, 300);
    label_draw(&image, 2, 1, 1, "1"); /* its stem is three dots from the left */
    for (int y = 1; y < 8; y++)
        assert_true(image.rgb[3 * (10 * y + 4)] < 100);
    assert_int_equal(image.rgb[3 * (10 * 8 + 4)], 255);
    image_clear(&image);
}
int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sheet_shows_what_changes_evenly),
        cmocka_unit_test(most_moments_of_a_burst_are_of_what_breaks),
        cmocka_unit_test(captions_stay_within_their_tiles),
        cmocka_unit_test(few_pictures_of_what_breaks_crowd_no_others),
        cmocka_unit_test(a_still_run_is_spaced_evenly_in_time),
        cmocka_unit_test(times_are_written_so_that_each_is_told_from_the_next),
        cmocka_unit_test(a_sheet_of_few_large_pictures_shows_them_all_reduced),
        cmocka_unit_test(labels_are_cut_off_at_the_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
