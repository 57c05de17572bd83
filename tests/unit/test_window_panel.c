/* What lies over the live window's picture: nothing covers anything else, whatever the window's size. */
#include "balloon.h"
#include "sim/window_app.h"

static struct panel_box eye;

/* What the panels ask of the rest of the window. */
struct panel_box app_eye(const struct app *app)
{
    (void)app;
    return eye;
}

void app_turn(struct app *app, enum live_dial dial, double value)
{
    live_turn(&app->live, dial, value);
}

void app_show(struct app *app, double frame)
{
    app->live.shown = (size_t)frame;
}

void app_stretch_colour(const struct app *app, double stretch, float colour[3])
{
    (void)app;
    colour[0] = colour[1] = colour[2] = (float)(0.4 * stretch);
}

double app_stretch_most(const struct app *app)
{
    (void)app;
    return 2;
}

double app_seconds(void)
{
    return 0;
}

static bool overlap(const struct panel_box *a, const struct panel_box *b)
{
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

/* The dark ground of each panel, and each text that has one; returns how many. */
static size_t find_grounds(struct app *app, struct panel_box *ground, size_t most)
{
    struct render_text texts[WINDOW_TEXTS_MAX];
    size_t count = 0;
    assert_true(app_make_boxes(app));
    for (size_t i = 0; i < app->boxes.count; i++) {
        const struct render_box *box = &app->boxes.items[i];
        if (box->colour[0] < 0.1f && count < most)
            ground[count++] = (struct panel_box){box->x, box->y, box->width, box->height};
    }
    const size_t written = app_texts(app, texts);
    for (size_t i = 0; i < written && count < most; i++)
        if (texts[i].boxed) {
            int width, height;
            render_text_size(&texts[i], &width, &height);
            ground[count++] = (struct panel_box){texts[i].x, texts[i].y, width, height};
        }
    return count;
}

static void nothing_covers_anything_in_any_layout(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 480}, {640, 480}, {480, 420}, {500, 500}, {1000, 250},
                                   {960, 210},  {420, 300}, {320, 240}, {800, 600}, {400, 700}};
    struct balloon b;
    struct error err = {0};
    struct app app = {0};
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    snprintf(app.hints.message, sizeof app.hints.message,
             "stereo: side by side, for a viewer or parallel eyes");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int shown = 0; shown < 8; shown++) {
            struct panel_box ground[16];
            eye = (struct panel_box){0, 0, sizes[i][0], sizes[i][1]};
            app.panel = shown & 1;
            app.stretch_colours = shown & 2;
            app.hints.help = shown & 4;
            const size_t count = find_grounds(&app, ground, 16);
            assert_true(count > 0);
            for (size_t k = 0; k < count; k++)
                for (size_t l = 0; l < k; l++)
                    if (overlap(&ground[k], &ground[l]))
                        fail_msg("%d x %d, %d: %d,%d %d x %d on %d,%d %d x %d", eye.width, eye.height, shown,
                                 ground[k].x, ground[k].y, ground[k].width, ground[k].height, ground[l].x,
                                 ground[l].y, ground[l].width, ground[l].height);
        }
    free(app.boxes.items);
    live_close(&app.live);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_covers_anything_in_any_layout)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
