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

void app_scale_colour(const struct app *app, double part, float colour[3])
{
    (void)app;
    colour[0] = colour[1] = colour[2] = (float)(0.4 * (1 + part));
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

static const char long_line[] =
    "at 0.1234 s: balloons[0]: fracture: cannot tear further here, where more than "
    "64 triangles meet in one point: it ends";

/* How many of the written texts have this in them; *last is the last such text. */
static int count_texts(struct app *app, const char *words, struct render_text *last)
{
    static struct render_text texts[WINDOW_TEXTS_MAX];
    const size_t written = app_texts(app, texts);
    int count = 0;
    for (size_t i = 0; i < written; i++)
        if (strstr(texts[i].text, words)) {
            *last = texts[i];
            count++;
        }
    return count;
}

/* Those before the window read the last three for eight seconds in which time goes on, not while the keys are
 * shown in their place, and not what is later than the state that is shown. */
static void what_the_run_tells_is_on_the_picture(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct app app = {.panel = true};
    struct render_text text;
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    eye = (struct panel_box){0, 0, 800, 600};
    for (int n = 0; n < 4; n++) {
        char line[64];
        snprintf(line, sizeof line, "at %d s: balloons[0]: gas: news %d", n, n);
        app_hear(&app, n, line);
        app_pass_news(&app, 1);
    }
    assert_int_equal(count_texts(&app, "news 3", &text), 1);
    assert_non_null(strstr(text.text, "news 1"));
    assert_null(strstr(text.text, "news 0"));
    app_pass_news(&app, 5.5); /* the first of them is 8.5 s old */
    assert_int_equal(count_texts(&app, "news 1", &text), 0);
    app.hints.help = true;
    assert_int_equal(count_texts(&app, "news 3", &text), 0);
    app_pass_news(&app, 100);
    app.hints.help = false;
    assert_int_equal(count_texts(&app, "news 3", &text), 1);
    b.sim.time = 2.5;
    app_forget_news(&app);
    assert_int_equal(count_texts(&app, "news 3", &text), 0);
    assert_int_equal(count_texts(&app, "news 2", &text), 1);
    free(app.boxes.items);
    live_close(&app.live);
    close_balloon(&b);
}

/* What a key did is no longer said eight seconds later; what went wrong stays. */
static void messages_go_by_and_complaints_stay(void **state)
{
    (void)state;
    struct app app = {.message_left = 8};
    hints_say(&app.hints, "stereo: one eye");
    app_pass_news(&app, 7.5);
    assert_string_equal(app.hints.message, "stereo: one eye");
    app_pass_news(&app, 1);
    assert_string_equal(app.hints.message, "");
    hints_say(&app.hints, "dog-1.png: No space left on device");
    app_pass_news(&app, 100);
    assert_string_equal(app.hints.message, "dog-1.png: No space left on device");
}

/* At rest the terms of a law of rubber leave their last bits, of either sign: they are shown as nothing; what
 * is stretched by a hundred-thousandth is not. */
static void at_rest_there_is_no_energy(void **state)
{
    (void)state;
#define RUBBER "balloons[0].membrane.shear_modulus=37", "balloons[0].membrane.thickness=.45"
    static const char *const skins[][3] = {
        {"balloons[0].point_mass=1", "balloons[0].spring=37", "balloons[0].damping=2"},
        {RUBBER, "balloons[0].membrane.law=neo-hookean"},
        {RUBBER, "balloons[0].membrane.law=mooney-rivlin"},
        {RUBBER, "balloons[0].membrane.law=gent"}};
    struct error err = {0};
    struct render_text text;
    eye = (struct panel_box){0, 0, 800, 600};
    for (size_t i = 0; i < sizeof skins / sizeof *skins; i++) {
        struct balloon b;
        struct app app = {.panel = true, .stale = true};
        open_balloon(&b, 4,
                     SETTINGS(skins[i][0], skins[i][1], skins[i][2], "balloons[0].radius=45",
                              "balloons[0].pressure=0"));
        assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
        app.rounding = app_find_rounding(&b.sim);
        app.live.paused = true;
        app.live.rate = 400; /* of before the pause */
        assert_int_equal(count_texts(&app, "steps/s", &text), 0);
        assert_int_equal(count_texts(&app, "energy 0 moving + 0 in the skin", &text), 1);
        assert_int_equal(count_texts(&app, "e-", &text), 0);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                b.sim.position[p][k] *= 1 + 1e-5;
        app.stale = true;
        assert_int_equal(count_texts(&app, "energy 0 moving + 0 in the skin", &text), 0);
        live_close(&app.live);
        close_balloon(&b);
    }
}

/* In the smallest pictures in place of what is told of the state, and so is what a key did. */
static void news_have_room_in_small_pictures(void **state)
{
    (void)state;
    static const int sizes[][2] = {{320, 140}, {200, 120}, {480, 70}, {160, 150}};
    struct balloon b;
    struct error err = {0};
    struct app app = {.panel = true};
    struct render_text text;
    int width, height;
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    app_hear(&app, 0, "at 1.25 s: balloons[0]: fracture: the skin tears");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        eye = (struct panel_box){0, 0, sizes[i][0], sizes[i][1]};
        hints_say(&app.hints, "");
        assert_int_equal(count_texts(&app, "tears", &text), 1);
        render_text_size(&text, &width, &height);
        assert_true(text.x + width <= eye.width && text.y + height <= eye.height);
        assert_int_equal(count_texts(&app, "0.000 s", &text), 1);
        hints_say(&app.hints, "dog-1.png saved");
        assert_int_equal(count_texts(&app, "saved", &text), 1);
        render_text_size(&text, &width, &height);
        assert_true(text.x + width <= eye.width && text.y + height <= eye.height);
    }
    live_close(&app.live);
    close_balloon(&b);
}

static void nothing_covers_anything_in_any_layout(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 480}, {640, 480}, {480, 420}, {500, 500}, {1000, 250},
                                   {960, 210},  {420, 300}, {320, 240}, {800, 600}, {400, 700},
                                   {200, 150},  {100, 150}, {160, 100}, {320, 140}, {400, 120},
                                   {1500, 200}, {3000, 90}, {200, 300}, {100, 600}, {120, 90}};
    struct balloon b;
    struct error err = {0};
    struct app app = {0};
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    snprintf(app.hints.message, sizeof app.hints.message,
             "stereo: side by side, for a viewer or parallel eyes");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int shown = 0; shown < 16; shown++) {
            struct panel_box ground[16];
            eye = (struct panel_box){0, 0, sizes[i][0], sizes[i][1]};
            app.panel = shown & 1;
            app.stretch_colours = shown & 2;
            app.hints.help = shown & 4;
            app.news.count = 0;
            for (int n = 0; n < 3 && shown & 8; n++)
                app_hear(&app, n, long_line);
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

/* F1 leads through its pages, of which each lies within the picture, and then hides it. */
static void the_list_of_keys_is_whole_in_small_pictures(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 480}, {640, 320}, {640, 120}, {320, 160}, {160, 120}};
    static const char *const keys[] = {"prick", "one step", "page up", "wires", "movie", "quit"};
    struct balloon b;
    struct error err = {0};
    struct app app = {0};
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int pages = 0, found[6] = {0};
        eye = (struct panel_box){0, 0, sizes[i][0], sizes[i][1]};
        for (hints_key(&app.hints, WINDOW_F1); app.hints.help; hints_key(&app.hints, WINDOW_F1)) {
            struct render_text text;
            int width, height;
            assert_int_equal(count_texts(&app, "this help", &text), 1);
            render_text_size(&text, &width, &height);
            assert_true(text.x + width <= eye.width && text.y + height <= eye.height);
            for (int k = 0; k < 6; k++)
                found[k] += strstr(text.text, keys[k]) != NULL;
            assert_true(pages++ < 20);
        }
        for (int k = 0; k < 6; k++)
            assert_true(found[k] > 0);
        assert_int_equal(pages > 1, i > 1);
    }
    live_close(&app.live);
    close_balloon(&b);
}

/* Half of a window of 400 x 300 is narrow: a knob beyond its border could not be taken. */
static void sliders_end_within_an_eyes_picture(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct app app = {.panel = true};
    open_balloon(&b, 2, SETTINGS("time.integrator=symplectic-euler"));
    assert_ok(live_open(&app.live, &b.sim, 64 << 20, &err), &err);
    for (int width = 160; width < 700; width += 10) {
        eye = (struct panel_box){0, 0, width, 300};
        for (int dial = 0; dial < LIVE_DIALS; dial++) {
            enum live_dial found = LIVE_DIALS;
            const struct panel_box track = app_slider(&app, (enum live_dial)dial);
            const int end = track.x + track.width;
            assert_true(track.width > 0 && end <= width - 8);
            assert_int_equal(app_find_slider(&app, end, track.y, &found), DRAG_DIAL);
            assert_int_equal(found, dial);
        }
        assert_true(app_make_boxes(&app));
        for (size_t i = 0; i < app.boxes.count; i++)
            assert_true(app.boxes.items[i].x + app.boxes.items[i].width <= width);
    }
    free(app.boxes.items);
    live_close(&app.live);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_the_run_tells_is_on_the_picture),
                                       cmocka_unit_test(messages_go_by_and_complaints_stay),
                                       cmocka_unit_test(at_rest_there_is_no_energy),
                                       cmocka_unit_test(the_list_of_keys_is_whole_in_small_pictures),
                                       cmocka_unit_test(sliders_end_within_an_eyes_picture),
                                       cmocka_unit_test(news_have_room_in_small_pictures),
                                       cmocka_unit_test(nothing_covers_anything_in_any_layout)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
