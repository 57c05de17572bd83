/* What a scene includes is read as if it stood there; what is wrong is named with its own file and line. */
#include "check.h"
#include "common/scene.h"

#include <string.h>
#include <unistd.h>

static char path[] = "/tmp/balloon-include-XXXXXX";
static char inner[sizeof path + 8];

static void write_text(const char *to, const char *text)
{
    FILE *file = fopen(to, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* Loads a scene whose "@@" is the line that includes the inner text. */
static enum status load(const char *text, const char *inner_text, struct scene *scene, struct error *err)
{
    char whole[512], *at = strstr(text, "@@");
    snprintf(whole, sizeof whole, "%.*s@include \"%s\"%s", (int)(at - text), text, strrchr(inner, '/') + 1,
             at + 2);
    write_text(path, whole);
    write_text(inner, inner_text);
    return scene_load(path, scene, err);
}

static void whole_numbers_stand_beside_others_in_it(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("balloons = ( { mesh = \"a.ply\";\n @@\n radius = 3; } );",
                   "colour = [0, 1, 0.5];\nmembrane = { ogden = [[1, 2.5]]; thickness = 1; };", &scene, &err),
              &err);
    assert_near(scene.balloons[0].colour[1], 1, 0);
    assert_near(scene.balloons[0].membrane.ogden.row[0][1], 2.5, 0);
    assert_near(scene.balloons[0].radius, 3, 0);
    assert_true(scene.balloons[0].membrane.on);
    scene_clear(&scene);
}

static void what_is_wrong_in_it_is_named_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *inner, *file, *message;
    } cases[] = {
        {"@@", "\n\ntime = { end = 4294967297; };", inner, ":3: 4294967297: a whole number"},
        {"\n@@", "time = { \n step = -1; };", inner, ":2: step is -1"},
        {"\n@@", "time = {\n stop = 1; };", inner, ":2: unknown key `stop`"},
        {"\n@@", "\nview = { camera = [0, 1 2]; };", inner, ":2: syntax error; a `,` is missing before `2`"},
        {"\n@@", "\n\nview = {\n camera = [0 ; }", inner, "or the `]` that closes the `[` of line 4"},
        {"\n  @@ time = { };\nview = { stop = 1; };", "\n\n", path, ":3: unknown key `stop`"},
        {"time = { end = 1; };\n\n@@", "time = { end = 2; };", inner, ":1: duplicate setting name"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error err = {0};
        struct scene scene = {0};
        assert_refused(load(cases[i].text, cases[i].inner, &scene, &err), STATUS_INPUT, cases[i].message,
                       &err);
        assert_memory_equal(err.text, cases[i].file, strlen(cases[i].file));
        assert_int_equal(err.text[strlen(cases[i].file)], ':');
    }
}

/* Where a block begins that a later message is about. */
static void an_included_block_has_no_line_in_the_scene(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("\n@@\nneedles = ( { from = [9, 9, 9]; } );", "\nobstacles = ( { } );\n", &scene, &err),
              &err);
    assert_int_equal(scene.obstacles[0].line, 0);
    assert_int_equal(scene.needles[0].line, 3);
    scene_clear(&scene);
}

static void words_in_comments_and_quotes_include_nothing(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("/*\n@include \"nothing.cfg\"\n*/ # @include \"nothing.cfg\"\n@@", "time = { end = 3; };",
                   &scene, &err),
              &err);
    assert_near(scene.time.end, 3, 0);
    scene_clear(&scene);
}

static void what_cannot_be_included_is_told(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_refused(load("@@", "\n@include \"/nowhere/at.cfg\"", &scene, &err), STATUS_FILE,
                   ":2: cannot include a file: /nowhere/at.cfg: cannot open", &err);
    char itself[64];
    snprintf(itself, sizeof itself, "@include \"%s\"", inner);
    assert_refused(load("@@", itself, &scene, &err), STATUS_INPUT, ":1: files include one another", &err);
}

static void names_may_be_long(void **state)
{
    (void)state;
    enum { FOLDERS = 900 };
    struct error err = {0};
    struct scene scene = {0};
    char text[2 * FOLDERS + sizeof inner + 128] = "@include \"/tmp/";
    for (int i = 0; i < FOLDERS; i++)
        strcat(text, "./");
    strcat(strcat(text, strrchr(inner, '/') + 1), "\"\n");
    write_text(inner, "time = { end = 3; };");
    write_text(path, strcat(text, "balloons = ( { mesh = \"a.ply\"; } );"));
    assert_ok(scene_load(path, &scene, &err), &err);
    assert_near(scene.time.end, 3, 0);
    scene_clear(&scene);
}

int main(void)
{
    close(mkstemp(path));
    snprintf(inner, sizeof inner, "%s.inner", path);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers_stand_beside_others_in_it),
        cmocka_unit_test(what_is_wrong_in_it_is_named_with_its_line),
        cmocka_unit_test(an_included_block_has_no_line_in_the_scene),
        cmocka_unit_test(words_in_comments_and_quotes_include_nothing),
        cmocka_unit_test(what_cannot_be_included_is_told),
        cmocka_unit_test(names_may_be_long),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    unlink(inner);
    return failed;
}
