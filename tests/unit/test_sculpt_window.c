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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_names_what_the_tool_does),
        cmocka_unit_test(beside_a_balloon_it_names_the_way_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
