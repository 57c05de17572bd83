/* What a scene says and nothing goes by is told; what something goes by is not. */
#include "check.h"
#include "common/scene.h"

#include <string.h>
#include <unistd.h>

static char path[] = "/tmp/balloon-idle-XXXXXX";
static char told[4096];

static void remember(const char *text, void *context)
{
    (void)context;
    strncat(told, text, sizeof told - strlen(told) - 2);
    strcat(told, "\n");
}

/* Reads a scene, sets keys (NULL-terminated; NULL: none), and returns all that is told, a line each. */
static const char *told_of(const char *text, const char *const *sets)
{
    struct error err = {0};
    struct scene scene = {0};
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    assert_ok(scene_load(path, &scene, &err), &err);
    for (; sets && *sets; sets++)
        assert_ok(scene_set(&scene, *sets, &err), &err);
    assert_ok(scene_check(&scene, &err), &err);
    *told = '\0';
    scene_tell_idle(&scene, remember, NULL);
    scene_clear(&scene);
    return told;
}

#define BALLOON(keys) "balloons = ( { mesh = \"a.ply\"; " keys " } );\n"
#define MEMBRANE      "membrane = { thickness = 1; }; "
#define GAS           "gas = { ambient = 6; }; "

/* A scene in which a key is idle, what is told of it, and what makes somebody go by it. */
static const struct {
    const char *text, *message, *heeded_by[4];
} cases[] = {
    {"time = { tolerance = 1e-4; integrator = \"rk4\"; };\n" BALLOON(""),
     "time: tolerance does nothing: this",
     {"time.integrator=auto", "time.integrator=rk-adaptive"}},
    {"time = { guard = \"refuse\"; integrator = \"cvode-bdf\"; };\n" BALLOON(""),
     "time: guard does nothing: this integrator chooses its own",
     {"time.integrator=auto", "balloons[0].string.weight=1", "balloons[0].viscosity.ratio=1"}},
    {"view = { eye_distance = 0.1; stereo = \"mono\"; };\n" BALLOON(""),
     "view: eye_distance does nothing",
     {"view.stereo=left"}},
    {"view = { squeezed = \"yes\"; stereo = \"red-cyan\"; };\n" BALLOON(""),
     "view: squeezed does nothing",
     {"view.stereo=over-under"}},
    {BALLOON(MEMBRANE "point_mass = 1;"), "balloons[0]: point_mass does nothing: a membrane gives", {NULL}},
    {BALLOON(MEMBRANE "spring = 3; stiffness = \"cotangent\"; spring_factor = 2; damping = 1;"),
     "balloons[0]: spring, stiffness, spring_factor, damping do nothing: a membrane stands in",
     {NULL}},
    {BALLOON("fracture = { }; threshold = 3; threshold_of = \"edge\";"),
     "balloons[0]: threshold_of, threshold do nothing: a skin that tears",
     {"balloons[0].fracture.mode=paper"}},
    {BALLOON(GAS "pressure_on = \"points\";"), "balloons[0]: pressure_on does nothing: gas", {NULL}},
    {BALLOON("viscosity = { ratio = 0; time = 2; };"),
     "balloons[0].viscosity: time does nothing",
     {"balloons[0].viscosity.ratio=1"}},
    {BALLOON("membrane = { thickness = 1; mooney_ratio = 0.1; };"),
     "balloons[0].membrane: mooney_ratio does nothing",
     {"balloons[0].membrane.law=mooney-rivlin"}},
    {BALLOON("membrane = { thickness = 1; gent_limit = 10; };"),
     "balloons[0].membrane: gent_limit does nothing: only law = \"gent\"",
     {"balloons[0].membrane.law=gent"}},
    {BALLOON("membrane = { thickness = 1; ogden = ( (1, 2) ); };"),
     "balloons[0].membrane: ogden does nothing",
     {"balloons[0].membrane.law=ogden"}},
    {BALLOON("bending = { stiffness = 0; damping = 1; rest = \"flat\"; };"),
     "balloons[0].bending: rest, damping do nothing",
     {"balloons[0].bending.stiffness=1"}},
    {BALLOON("gas = { ambient = 6; pump_until = 3; };"),
     "balloons[0].gas: pump_until does nothing",
     {"balloons[0].gas.pump=1", "schedule[0].pump=1"}},
    {BALLOON("gas = { ambient = 6; neck_at = 3; neck_place = [1, 0, 0]; };"),
     "balloons[0].gas: neck_at, neck_place do nothing: there is no neck",
     {"balloons[0].gas.neck=1"}},
    {"gravity = { air_density = 1; };\n" BALLOON("pressure = 0;"),
     "gravity: air_density does nothing",
     {"balloons[0].gas.ambient=6"}},
    {"drag = { air_density = 0; coefficient = 1; wind = [1, 0, 0]; };\n" BALLOON(""),
     "drag: coefficient, wind do nothing",
     {"drag.air_density=1"}},
    {"drag = { coefficient = 0; wind = [1, 0, 0]; };\n" BALLOON(""),
     "drag: wind does nothing",
     {"drag.coefficient=1"}},
    {"obstacles = ( { size = [1, 1, 1]; } );\n" BALLOON(""),
     "obstacles[0]: size does nothing",
     {"obstacles[0].shape=box"}},
    {"obstacles = ( { shape = \"box\"; radius = 1; } );\n" BALLOON(""),
     "obstacles[0]: radius does nothing",
     {"obstacles[0].shape=sphere"}},
    {BALLOON("fracture = { mode = \"paper\"; strength = 2; seed = 3; reserve = 9; };"),
     "balloons[0].fracture: strength, seed, reserve do nothing: mode = \"paper\"",
     {"balloons[0].fracture.mode=tear"}},
    {BALLOON("fracture = { weakness = 0; seed = 3; };"),
     "balloons[0].fracture: seed does nothing",
     {"balloons[0].fracture.weakness=0.1"}},
    {BALLOON("") "schedule = ( { at = 1; } );",
     "schedule[0]: at does nothing: the entry has no key",
     {"schedule[0].pressure=1"}},
    {BALLOON("") "schedule = ( { at = 1; balloon = 0; step = 0.1; } );",
     "schedule[0]: balloon does nothing: all balloons",
     {"schedule[0].pressure=1"}},
    {BALLOON(MEMBRANE) "schedule = ( { at = 1; damping = 2; } );",
     "schedule[0]: damping does nothing: a membrane",
     {"balloons[1].mesh=b.ply"}},
    {BALLOON("fracture = { };") "schedule = ( { at = 1; balloon = 0; threshold = 2; } );",
     "schedule[0]: threshold does nothing: a skin that tears",
     {"schedule[0].balloon=-1"}},
};

static void a_key_that_nothing_goes_by_is_told_with_the_reason(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *text = told_of(cases[i].text, NULL);
        if (!strstr(text, cases[i].message) || strchr(text, '\n') != strrchr(text, '\n'))
            fail_msg("case %zu wants one line with `%s`, and got:\n%s", i, cases[i].message, text);
    }
}

/* A second balloon stands by, of the paper's kind, for a schedule of all. */
static void what_something_goes_by_is_not_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (const char *const *by = cases[i].heeded_by; *by; by++) {
            const char *const sets[] = {*by, "balloons[1].mesh=b.ply", NULL};
            const char *text = told_of(cases[i].text, sets);
            if (*text)
                fail_msg("case %zu with %s: nothing is idle, but told was:\n%s", i, *by, text);
        }
}

static void defaults_are_never_told(void **state)
{
    (void)state;
    assert_string_equal(
        told_of("time = { integrator = \"rk4\"; };\nview = { stereo = \"mono\"; };\n"
                "gravity = { }; drag = { air_density = 0; }; obstacles = ( { } );\n" //
                BALLOON("membrane = { thickness = 1; }; " GAS "fracture = { weakness = 0; };"),
                NULL),
        "");
}

static void what_says_how_things_are_anyway_is_not_told(void **state)
{
    (void)state;
    assert_string_equal(told_of("view = { squeezed = \"no\"; stereo = \"mono\"; };\n" //
                                BALLOON(GAS "pressure = 0; pressure_on = \"areas\";"),
                                NULL),
                        "");
}

static void the_line_is_that_of_the_first_key(void **state)
{
    (void)state;
    char wanted[200];
    snprintf(wanted, sizeof wanted,
             "%s:3: balloons[1]: spring, damping do nothing: a membrane stands in for the springs\n", path);
    const char *text =
        "balloons = ( { mesh = \"a.ply\"; spring = 3; },\n{ mesh = \"b.ply\"; membrane = { thickness = 1; };\n"
        "damping = 2;\nspring = 3; } );";
    assert_string_equal(told_of(text, NULL), wanted);
}

/* What --set wrote has no line; what it writes over no longer stands in the file. */
static void what_was_set_has_no_line(void **state)
{
    (void)state;
    const char *const sets[] = {"balloons[0].spring=4", NULL};
    char wanted[200];
    snprintf(wanted, sizeof wanted, "%s: balloons[0]: spring does nothing", path);
    assert_non_null(strstr(told_of("\n" BALLOON(MEMBRANE), sets), wanted));
    assert_non_null(strstr(told_of("\n" BALLOON(MEMBRANE "spring = 3;"), sets), wanted));
}

/* An included file's lines are not the scene's. */
static void what_was_included_has_no_line(void **state)
{
    (void)state;
    char inner[sizeof path + 8], text[200], wanted[200];
    snprintf(inner, sizeof inner, "%s.inner", path);
    FILE *file = fopen(inner, "w");
    assert_non_null(file);
    fputs("gravity = { air_density = 1; };\n", file);
    fclose(file);
    snprintf(text, sizeof text, "@include \"%s\"\n" BALLOON(""), strrchr(inner, '/') + 1);
    snprintf(wanted, sizeof wanted, "%s: gravity: air_density does nothing", path);
    assert_non_null(strstr(told_of(text, NULL), wanted));
    unlink(inner);
}

int main(void)
{
    close(mkstemp(path));
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_key_that_nothing_goes_by_is_told_with_the_reason),
        cmocka_unit_test(what_something_goes_by_is_not_told),
        cmocka_unit_test(defaults_are_never_told),
        cmocka_unit_test(what_says_how_things_are_anyway_is_not_told),
        cmocka_unit_test(the_line_is_that_of_the_first_key),
        cmocka_unit_test(what_was_set_has_no_line),
        cmocka_unit_test(what_was_included_has_no_line),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
