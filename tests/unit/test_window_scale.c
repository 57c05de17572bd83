/* The colours by stretch of the live window. */
#include "balloon.h"
#include "sim/window_app.h"

enum { PARTS = 20 };

/* Luminance of linear light (ITU-R BT.709). */
static double luminance(const float colour[3])
{
    return 0.2126 * (double)colour[0] + 0.7152 * (double)colour[1] + 0.0722 * (double)colour[2];
}

static void are_hues_where_each_eye_sees_all(void **state)
{
    (void)state;
    static const enum render_stereo layouts[] = {RENDER_MONO, RENDER_PARALLEL, RENDER_INTERLACED};
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        const struct app app = {.view = {.stereo = layouts[i]}};
        float slack[3], taut[3];
        app_scale_colour(&app, 0, slack);
        app_scale_colour(&app, 1, taut);
        assert_false(app_scale_is_grey(&app));
        assert_true(slack[2] > 4 * slack[0] && taut[0] > 4 * taut[2]); /* blue, red */
    }
}

/* Of hues one eye would see what the other does not. */
static void are_greys_that_rise_behind_red_and_cyan_glasses(void **state)
{
    (void)state;
    const struct app app = {.view = {.stereo = RENDER_RED_CYAN}};
    double before = 0;
    assert_true(app_scale_is_grey(&app));
    for (int i = 0; i <= PARTS; i++) {
        float colour[3];
        app_scale_colour(&app, (double)i / PARTS, colour);
        assert_true(colour[0] == colour[1] && colour[1] == colour[2]);
        assert_true(luminance(colour) > before && luminance(colour) < 1);
        before = luminance(colour);
    }
}

/* Where an edge lets go the scale ends, whichever rest length that is over. */
static void ends_where_edges_let_go(void **state)
{
    (void)state;
    static const char *const keys[] = {"balloons[0].threshold_of=mean", "balloons[0].threshold_of=edge"};
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_balloon(&b, 2, SETTINGS(keys[i], "balloons[0].threshold=2.5"));
        const struct app app = {.live = {.sim = &b.sim}};
        assert_near(app_stretch_most(&app), 2.5, 1e-12);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(are_hues_where_each_eye_sees_all),
        cmocka_unit_test(are_greys_that_rise_behind_red_and_cyan_glasses),
        cmocka_unit_test(ends_where_edges_let_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
