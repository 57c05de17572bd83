/* The corner line of the sculpting window: what the next click or key does. */
#include "check.h"
#include "sculpt/window_app.h"

static struct app app;

/* What it says; good until the next call. */
static const char *line(void)
{
    static struct render_text texts[WINDOW_TEXTS_MAX];
    assert_int_equal(app_texts(&app, texts), 1);
    return texts[0].text;
}

static void it_names_what_the_tool_does(void **state)
{
    (void)state;
    app = (struct app){.open = true, .view = {.width = 960, .height = 720}};
    assert_memory_equal(line(), "chip sphere  brush ", 19);
    app.session.fill = true;
    assert_memory_equal(line(), "fill sphere  brush ", 19);
    app.session.tool = TOOL_SANDPAPER; /* takes away, whether chips or fillings were chosen */
    assert_memory_equal(line(), "sandpaper  brush ", 17);
    app.session.tool = TOOL_HEAT;
    assert_memory_equal(line(), "heat  brush ", 12);
}

/* A click carves nothing then. */
static void beside_a_balloon_it_names_the_way_back(void **state)
{
    (void)state;
    app = (struct app){.open = true, .view = {.width = 960, .height = 720}, .preview = true};
    assert_string_equal(line(), "the balloon   p  back to the sculpture   i  inflate it   F1 help");
    app.balloon.inflated = true;
    assert_string_equal(line(),
                        "the balloon, blown up   p  back to the sculpture   i  back to rest   F1 help");
}

static void nothing_covers_the_list_of_keys(void **state)
{
    (void)state;
    static const int sizes[][2] = {{960, 720}, {960, 500},  {800, 600},  {640, 480}, {400, 300},
                                   {480, 320}, {1900, 250}, {1280, 200}, {500, 900}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int shown = 0; shown < 4; shown++) {
            struct render_text texts[WINDOW_TEXTS_MAX];
            app = (struct app){.open = true, .view = {.width = sizes[i][0], .height = sizes[i][1]}};
            app.hints.help = true;
            if (shown & 1)
                hints_say(&app.hints,
                          "mirror.vox: a file that is not there cannot be opened by anybody, and so it "
                          "was not: the sculpture is what it was before");
            if (shown & 2)
                app.view.stereo = RENDER_PARALLEL;
            const size_t count = app_texts(&app, texts);
            assert_true(count > 0 && strstr(texts[count - 1].text, "this help"));
            int bottom[3] = {0}, width;
            for (size_t k = 0; k < count; k++) {
                render_text_size(&texts[k], &width, &bottom[k]);
                bottom[k] += texts[k].y;
            }
            for (size_t k = 0; k < count; k++)
                for (size_t l = 0; l < k; l++)
                    if (texts[k].y < bottom[l] && texts[l].y < bottom[k])
                        fail_msg("%d x %d, %d: %.20s at %d to %d, %.20s at %d to %d", sizes[i][0],
                                 sizes[i][1], shown, texts[k].text, texts[k].y, bottom[k], texts[l].text,
                                 texts[l].y, bottom[l]);
            assert_true(bottom[count - 1] <= sizes[i][1]);
        }
}

/* F1 leads through its pages, of which each lies within the picture, and then hides it. */
static void the_list_of_keys_is_whole_in_small_pictures(void **state)
{
    (void)state;
    static const int sizes[][2] = {{960, 720}, {640, 240}, {300, 300}, {1280, 200}, {320, 160}, {160, 120}};
    static const char *const keys[] = {"shift+middle", "sandpaper", "ctrl+z", "heat", "export", "home"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int pages = 0, found[6] = {0};
        app = (struct app){.open = true, .view = {.width = sizes[i][0], .height = sizes[i][1]}};
        for (hints_key(&app.hints, WINDOW_F1); app.hints.help; hints_key(&app.hints, WINDOW_F1)) {
            struct render_text texts[WINDOW_TEXTS_MAX];
            int width, height;
            const struct render_text *last = &texts[app_texts(&app, texts) - 1];
            render_text_size(last, &width, &height);
            assert_true(last->x + width <= sizes[i][0] && last->y + height <= sizes[i][1]);
            assert_non_null(strstr(last->text, "this help"));
            for (int k = 0; k < 6; k++)
                found[k] += strstr(last->text, keys[k]) != NULL;
            assert_true(pages++ < 20);
        }
        for (int k = 0; k < 6; k++)
            assert_true(found[k] > 0);
        assert_int_equal(pages > 1, i > 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_names_what_the_tool_does),
        cmocka_unit_test(nothing_covers_the_list_of_keys),
        cmocka_unit_test(the_list_of_keys_is_whole_in_small_pictures),
        cmocka_unit_test(beside_a_balloon_it_names_the_way_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
