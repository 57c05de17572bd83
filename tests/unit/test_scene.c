/* A scene says what it means, or is refused with its line and what would be right. */
#include "check.h"
#include "common/scene.h"
#include "common/scene_fields.h"
#include "common/scene_syntax.h"

#include <unistd.h>

static char path[] = "/tmp/balloon-scene-XXXXXX";

static void write_scene(const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* Loads and checks this text. */
static enum status load(const char *text, struct scene *scene, struct error *err)
{
    write_scene(text);
    enum status status = scene_load(path, scene, err);
    if (!status)
        status = scene_check(scene, err);
    if (status)
        scene_clear(scene);
    return status;
}

static void a_scene_with_one_mesh_has_the_papers_settings(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("balloons = ( { mesh = \"fox.ply\"; } );", &scene, &err), &err);
    assert_string_equal(scene.balloons[0].mesh, "/tmp/fox.ply"); /* beside the scene file */
    assert_near(scene.balloons[0].spring, 20, 0);
    assert_near(scene.balloons[0].damping, 1, 0);
    assert_near(scene.balloons[0].pressure, 10, 0);
    assert_near(scene.balloons[0].threshold, 2, 0);
    assert_near(scene.time.step, 0.025, 0);
    assert_false(scene.balloons[0].rip.on);
    assert_false(scene.balloons[0].spring_by_height.on);
    scene_clear(&scene);

    assert_ok(scene_from_mesh("fox.ply", &scene, &err), &err);
    assert_ok(scene_check(&scene, &err), &err);
    assert_string_equal(scene.balloons[0].mesh, "fox.ply");
    assert_near(scene.balloons[0].pressure, 10, 0);
    scene_clear(&scene);
}

static void every_kind_of_value_is_read(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(
        load(
            "time = { step = 1; end = 2.5; integrator = \"explicit-euler\"; };\n"
            "view = { size = [640, 400]; camera = (0, 1, 2.5); stereo = \"crossed\"; };\n"
            "balloons = ( { mesh = \"/a.ply\"; spring_by_height = { profile = ( (0, 2), (1.0, 1.5) ); }; },\n"
            "             { mesh = \"b.stl\"; rip = { at = 1.5; length = 2; }; } );\n"
            "schedule = ( { at = 2.0; pressure = 12; balloon = 1; }, { at = 1; step = 0.5; } );\n",
            &scene, &err),
        &err);
    assert_near(scene.time.step, 1, 0); /* a whole number is a number */
    assert_string_equal(scene_integrator_names[scene.time.integrator], "explicit-euler");
    assert_int_equal(scene.view.size[1], 400);
    assert_int_equal(scene.view.stereo, SCENE_CROSSED);
    assert_near(scene.view.camera[2], 2.5, 0);
    assert_int_equal(scene.balloon_count, 2);
    assert_string_equal(scene.balloons[0].mesh, "/a.ply");
    assert_true(scene.balloons[0].spring_by_height.on);
    assert_near(scene_profile_at(&scene.balloons[0].spring_by_height.profile, 0.5), 1.75, 1e-15);
    assert_true(scene.balloons[1].rip.on);
    assert_near(scene.balloons[1].rip.length, 2, 0);
    assert_int_equal(scene.schedule_count, 2); /* in the order of time */
    assert_near(scene.schedule[0].at, 1, 0);
    assert_string_equal(scene.schedule[1].change[0].field->key, "pressure");
    assert_int_equal(scene.schedule[1].balloon, 1);
    scene_clear(&scene);
}

static void what_is_wrong_is_named_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"balloons = ( { mesh = \"a.ply\";\n presure = 10.0; } );",
         ":2: unknown key `presure` in balloons (did you mean `pressure`?)"},
        {"tim = { step = 1; };", ":1: unknown key `tim` (did you mean `time`?)"},
        {"pressure = 3;", ":1: unknown key `pressure` (did you mean `balloons[0].pressure`?)"},
        {"balloons = ( { mesh = \"a.ply\"; integrator = \"rk4\"; } );",
         ":1: unknown key `integrator` in balloons (did you mean `time.integrator`?)"},
        {"fill = 2;", ":1: unknown key `fill` (did you mean `balloons[0].gas.fill`?)"},
        {"presure = 2;", ":1: unknown key `presure` (did you mean `balloons[0].pressure`?)"},
        {"balloons = ( { mesh = \"a.ply\";\n grvity = { }; } );",
         ":2: unknown key `grvity` in balloons (did you mean `gravity`?)"},
        {"balloons = ( { mesh = \"a.ply\"; friction = 1; } );",
         ":1: unknown key `friction` in balloons (did you mean `ground.friction`?)"},
        {"balloons = ( { mesh = \"a.ply\"; gas = { moles = 1; }; } );", ":1: unknown key `moles` in gas; "},
        {"memebrane = { };", ":1: unknown key `memebrane` (did you mean `balloons[0].membrane`?)"},
        {"time = { step = \"fast\"; };", ":1: step must be a number in s"},
        {"time = {\n\n step = 0; };", ":3: step is 0; it must be from 1e-09 to 1e+06 s"},
        {"time = { step = -1.0; };", ":1: step is -1"},
        {"time = { step = 3000000000L; };", ":1: step is 3000000000;"},
        {"balloons = ( { mesh = \"a.ply\"; } );\nschedule = ( { at = 1; balloon = 0.5; } );",
         ":2: balloon is 0.5; it must be a whole number"},
        {"time = { step = 1e300; };", ":1: step is 1e+300"},
        {"time = { integrator = \"euler\"; };", "it must be one of \"symplectic-euler\", \"explicit-euler\""},
        {"time = 3;", ":1: time must be a block"},
        {"view = { size = [640]; };", ":1: size must be 2 numbers"},
        {"view = { size = (640.5, 480); };", ":1: size is 640.5; it must be a whole number"},
        {"view = { camera = [0, 1, \"2.5\"]; };",
         ":1: mismatched element type in array; write [0, 1, 2.5], numbers alone"},
        {"view = { camera = [0, 1, 2.5); };", ":1: syntax error; `)` comes before the `]`"},
        {"view = {\n camera = [0,\n 1, 2.5];\n rate = 0; };", ":4: rate is 0"},
        {"balloons = { mesh = \"a.ply\"; };", ":1: balloons must be a list"},
        {"balloons = ( { mesh = 3; } );", ":1: mesh must be a name in quotes"},
        {"balloons = ( { } );", "balloons[0] has no mesh"},
        {"time = { };", "has no balloon"},
        {"balloons = ( { mesh = \"a.ply\"; spring_by_height = { }; } );", "give profile"},
        {"balloons = ( { mesh = \"a.ply\"; spring_by_height = { profile = ( (1, 1), (1, 2) ); }; } );",
         "must rise"},
        {"balloons = ( { mesh = \"a.ply\"; rip = { place = [0, 1, 0]; direction = [0, 2, 0]; }; } );",
         "two different directions"},
        {"balloons = ( { mesh = \"a.ply\"; } );\nschedule = ( { at = 1; spring = 2; } );",
         ":2: spring cannot change"},
        {"balloons = ( { mesh = \"a.ply\"; } );\nschedule = ( { at = 1; pump = 1; } );",
         "schedule[0] turns its pump, but there is no gas"},
        {"balloons = ( { mesh = \"a.ply\"; } );\nschedule = ( { at = 1; balloon = 1; } );",
         ":2: schedule[0].balloon is 1, but the balloons are 0 to 0"},
        {"time = { step = nan; };", ":1: syntax error"},
        {"time = { step = 1 ", ":1: syntax error"},
        {"time = { step = 1; step = 2; };", ":1: duplicate setting name"},
        {"", "has no balloon"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error err = {0};
        struct scene scene = {0};
        assert_refused(load(cases[i].text, &scene, &err), STATUS_INPUT, cases[i].message, &err);
        assert_null(scene.balloons);
    }
}

/* Which libconfig alone refuses. */
static void whole_numbers_stand_beside_others_in_rows(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("view = { camera = [0, /* ] */ 1, # ]\n 2.5]; target = [0.5, -1e1, 0x2]; };\n"
                   "balloons = ( { mesh = \"[1, 2.5]\"; colour = [1, .5, 0];\n"
                   " spring_by_height = { profile = [[0, 1.5], [1, 2]]; }; } );",
                   &scene, &err),
              &err);
    assert_near(scene.view.camera[2], 2.5, 0);
    assert_near(scene.view.target[1], -10, 0);
    assert_near(scene.balloons[0].colour[0], 1, 0);
    assert_near(scene.balloons[0].spring_by_height.profile.row[1][1], 2, 0);
    assert_string_equal(scene.balloons[0].mesh + strlen(scene.balloons[0].mesh) - 8, "[1, 2.5]");
    scene_clear(&scene);
}

/* In place of "syntax error" alone. */
static void slips_of_the_pen_are_named_with_what_would_be_right(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"time = { step = 3 cm; };", ":1: syntax error; `3 cm`: numbers stand without units"},
        {"time = { end = 3cm; };", "`3cm` is no number"},
        {"time = { step = 0,5; };", "`,5`: decimals stand behind a point"},
        {"view = { camera = 0, 1, 2.5; };", "several numbers in brackets: [0, 1, 2.5]"},
        {"view = { camera = {0, 1, 2.5}; };", "`{ 0`: numbers stand in brackets: [0, 1, 2.5]"},
        {"balloons = [ { mesh = \"a.ply\"; } ];", "blocks stand in parentheses: ( { ... }, { ... } )"},
        {"view = { # mono\n stereo = mono; };", ":2: syntax error; `mono` is no value"},
        {"time { step = 1; };", "`=` is missing behind `time`"},
        {"time = { step 1; };", "`=` is missing behind `step`"},
        {"time = { step = ; };", "nothing stands behind `step =`"},
        {"time = { step = 1;; };", "`;` stands where a key is wanted"},
        {"{ time = 1; }", "`{` has no name; write name = { ... }"},
        {"balloons = ( { mesh = \"a.ply\"; }\n\n { mesh = \"b.ply\"; } );",
         ":3: syntax error; a `,` is missing before `{`"},
        {"balloons = ( { mesh = \"a.ply\"; }, );", "nothing stands behind the last `,`"},
        {"balloons = ( mesh = \"a.ply\"; );", "a list is made of blocks: ( { mesh = ...; }, { ... } )"},
        {"view = { size = [640 480]; };", "a `,` is missing before `480`"},
        {"balloons = (\n{ mesh = \"a.ply\"; gas = { ambient = 6; };\n);",
         ":3: syntax error; `)` comes before the `}` that closes the `{` of line 2"},
        {"balloons = ( { mesh = \"a.ply\"; };",
         "`;` stands where a `,` is wanted, or the `)` that closes the `(` of line 1"},
        {"balloons = (\n { mesh = \"a.ply\"; }\n", ":1: syntax error; `(` is never closed; a `)` is missing"},
        {"time = { step = 1; }; };", "`}` closes nothing"},
        {"time = { step = 1; step = 2; };", "a key stands twice in its block"},
        {"time = { step = \"1\"; };", "step must be a number in s, without quotes"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error err = {0};
        struct scene scene = {0};
        assert_refused(load(cases[i].text, &scene, &err), STATUS_INPUT, cases[i].message, &err);
    }
}

/* Of the text alone: libconfig leaks the string behind which it gives up. */
static void slips_around_quotes_are_found(void **state)
{
    (void)state;
    struct scene_slip slip;
    assert_true(scene_find_slip("time = {\n\"step\" = 1; };", &slip));
    assert_int_equal(slip.line, 2);
    assert_string_equal(slip.text, "\"step\": the names of keys stand without quotes");
    assert_true(
        scene_find_slip("\nballoons = ( { mesh = \"a.ply; } );\nview = { stereo = \"mono\"; };", &slip));
    assert_int_equal(slip.line, 2);
    assert_string_equal(slip.text, "a quote is not closed in its line");
    assert_false(scene_find_slip("balloons = ( { mesh = \"a\" \"b\"; } ); # = (",
                                 &slip)); /* two pieces are one text */
}

/* libconfig reads 4294967297 as 1. */
static void whole_numbers_that_would_be_cut_to_32_bits_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_refused(load("/* 4294967297 */ balloons =\n( { mesh = \"4294967297\"; radius = 4294967297; } );",
                        &scene, &err),
                   STATUS_INPUT, ":2: 4294967297: a whole number without a point goes to 2147483647", &err);
    assert_refused(load("time = { end = -99999999999999999999; };", &scene, &err), STATUS_INPUT,
                   "without a point", &err);
    assert_ok(load("balloons = ( { mesh = \"4294967297\"; radius = 0x10; } ); # 4294967297\n"
                   "time = { end = 300000000.0; step = 1L; };",
                   &scene, &err),
              &err);
    assert_near(scene.time.end, 3e8, 0);
    assert_refused(scene_set(&scene, "balloons[0].radius=4294967297", &err), STATUS_INPUT,
                   "4294967297: a whole number", &err);
    assert_refused(scene_set(&scene, "balloons[0].radius=0x100000001", &err), STATUS_INPUT,
                   "0x100000001: a whole number without a point goes to 2147483647; write it in decimals",
                   &err);
    scene_clear(&scene);
}

static void set_changes_any_key_by_its_path(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(load("balloons = ( { mesh = \"a.ply\"; } );\nschedule = ( { at = 1; } );", &scene, &err), &err);
    assert_ok(scene_set(&scene, "balloons[0].pressure=12", &err), &err);
    assert_ok(scene_set(&scene, "view.size=[100,50]", &err), &err);
    assert_ok(scene_set(&scene, "view.stereo=crossed", &err), &err);
    assert_ok(scene_set(&scene, "balloons[0].mesh=some where/b.ply", &err), &err);
    assert_ok(scene_set(&scene, "balloons[0].rip.at=3", &err), &err);
    assert_ok(scene_set(&scene, "schedule[0].step=0.5", &err), &err);
    assert_near(scene.balloons[0].pressure, 12, 0);
    assert_ok(scene_set(&scene, "view.camera=[0, 1, 2.5]", &err), &err);
    assert_int_equal(scene.view.size[0], 100);
    assert_near(scene.view.camera[2], 2.5, 0);
    assert_int_equal(scene.view.stereo, SCENE_CROSSED);
    assert_string_equal(scene.balloons[0].mesh, "some where/b.ply");
    assert_true(scene.balloons[0].rip.on);
    assert_near(scene.schedule[0].change[0].value, 0.5, 0);

    assert_refused(scene_set(&scene, "balloons[2].pressure=12", &err), STATUS_INPUT, "balloons has 1 entry;",
                   &err);
    assert_refused(scene_set(&scene, "balloons.pressure=12", &err), STATUS_INPUT, "balloons has 1 entry;",
                   &err);
    assert_refused(scene_set(&scene, "balloons[0].presure=12", &err), STATUS_INPUT, "did you mean `pressure`",
                   &err);
    assert_refused(scene_set(&scene, "time.step=0", &err), STATUS_INPUT, "--set: step is 0", &err);
    assert_refused(scene_set(&scene, "time.step=nan", &err), STATUS_INPUT, "step must be a number", &err);
    assert_refused(scene_set(&scene, "time.step", &err), STATUS_INPUT, "has no value", &err);
    assert_refused(scene_set(&scene, "time=1", &err), STATUS_INPUT, "is a block", &err);
    assert_refused(scene_set(&scene, "step=1", &err), STATUS_INPUT, "unknown key `step`", &err);
    assert_refused(scene_set(&scene, "time..step=1", &err), STATUS_INPUT, "is no key", &err);
    assert_refused(scene_set(&scene, "balloons[-1].pressure=1", &err), STATUS_INPUT, "is no key", &err);
    assert_refused(scene_set(&scene, "time[3].step=1", &err), STATUS_INPUT, "time is no list; leave out [3]",
                   &err);
    assert_refused(scene_set(&scene, "time.step[0]=1", &err), STATUS_INPUT, "step is no list; leave out [0]",
                   &err);
    assert_ok(scene_set(&scene, "schedule[1].balloon=1", &err), &err);
    assert_refused(scene_check(&scene, &err), STATUS_INPUT, ": schedule[1].balloon is 1", &err);
    assert_null(strstr(err.text, ":0:")); /* in no file, on no line */
    scene_clear(&scene);
}

/* By --check and runs without pictures too: else it fails once the first picture is to be drawn. */
static void a_camera_in_its_target_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    assert_refused(
        load("balloons = ( { mesh = \"a.ply\"; } );\nview = {\n  camera = [0, 0, 0]; };", &scene, &err),
        STATUS_INPUT, ":3: view: the camera sees nothing", &err);
}

static void every_default_is_within_its_own_range(void **state)
{
    (void)state;
    for (size_t b = 0; b < scene_block_count; b++)
        for (size_t i = 0; i < scene_blocks[b].field_count; i++) {
            const struct scene_field *field = &scene_blocks[b].fields[i];
            if (field->type == SCENE_NUMBER || field->type == SCENE_WHOLE) {
                double standard = strtod(field->standard, NULL);
                assert_true(standard >= field->least && standard <= field->most);
            }
            assert_true(*field->meaning);
        }
}

static char *keys_of(const struct scene *scene)
{
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    scene_write_keys(scene, stream);
    assert_false(fclose(stream));
    return text;
}

/* Sets the key, and returns what differs then. */
static const char *difference(const char *assignment)
{
    static char text[256];
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(scene_from_mesh("fox.ply", &scene, &err), &err);
    char *was = keys_of(&scene);
    assert_ok(scene_set(&scene, assignment, &err), &err);
    char *is = keys_of(&scene);
    if (!scene_keys_differ(was, is, text, sizeof text))
        strcpy(text, "nothing");
    free(was);
    free(is);
    scene_clear(&scene);
    return text;
}

static void scenes_are_told_apart_by_the_keys_that_a_state_depends_on(void **state)
{
    (void)state;
    assert_string_equal(difference("balloons[0].pressure=10"), "nothing");
    assert_string_equal(difference("balloons[0].pressure=12.5"), "balloons[0].pressure is 12.5, and was 10");
    assert_string_equal(difference("time.step=0.1"),
                        "time.step is 0.10000000000000001, and was 0.025000000000000001");
    assert_string_equal(difference("balloons[0].position=[1, 2, 3]"),
                        "balloons[0].position is [1, 2, 3], and was [0, 0, 0]");
    assert_string_equal(difference("balloons[0].rip.at=1"), "balloons[0].rip.at is 1, and was not there");
    assert_string_equal(difference("balloons[0].spring_by_height.profile=((0, 1), (1, 2))"),
                        "balloons[0].spring_by_height.profile is [0, 1][1, 2], and was not there");
    assert_string_equal(difference("schedule[0].pressure=3"), "schedule[0].at is 0, and was not there");
    assert_string_equal(difference("view.camera=[0, 0, 5]"), "nothing");
    assert_string_equal(difference("view.stereo=mono"), "nothing");
    assert_string_equal(difference("time.end=20"), "nothing");
    assert_string_equal(difference("balloons[0].colour=[0, 0, 1]"), "nothing");
    assert_string_equal(difference("balloons[0].mesh=cat.ply"), "nothing");

    char text[64];
    assert_true(scene_keys_differ("a=1\nb=2\n", "a=1\n", text, sizeof text));
    assert_string_equal(text, "b was 2, and is not there any more");
    assert_true(scene_keys_differ("", "nonsense", text, sizeof text));
    assert_false(scene_keys_differ("a=1\nb=2\n", "b=2\na=1\n", text, sizeof text));
}

int main(void)
{
    close(mkstemp(path));
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_with_one_mesh_has_the_papers_settings),
        cmocka_unit_test(every_kind_of_value_is_read),
        cmocka_unit_test(what_is_wrong_is_named_with_its_line),
        cmocka_unit_test(whole_numbers_stand_beside_others_in_rows),
        cmocka_unit_test(slips_of_the_pen_are_named_with_what_would_be_right),
        cmocka_unit_test(slips_around_quotes_are_found),
        cmocka_unit_test(whole_numbers_that_would_be_cut_to_32_bits_are_refused),
        cmocka_unit_test(set_changes_any_key_by_its_path),
        cmocka_unit_test(a_camera_in_its_target_is_refused),
        cmocka_unit_test(every_default_is_within_its_own_range),
        cmocka_unit_test(scenes_are_told_apart_by_the_keys_that_a_state_depends_on),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
