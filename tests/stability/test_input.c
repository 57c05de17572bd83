/* What no number in a scene may do. Every parameter is asked for, by the table that the
 * parser itself goes by. */
#include "hard.h"

#include "common/scene_fields.h"

/* "balloons[0].rip.at" for a field of a block. */
static void path_of(const struct scene_block *block, const struct scene_field *field, char *path, size_t size)
{
    const char *index = block->list ? "[0]" : "";
    if (*block->parent)
        snprintf(path, size, "%s[0].%s%s.%s", block->parent, block->name, index, field->key);
    else
        snprintf(path, size, "%s%s.%s", block->name, index, field->key);
}

static bool is_number(const struct scene_field *field)
{
    return field->type == SCENE_NUMBER || field->type == SCENE_WHOLE;
}

static enum status set_to(const char *path, const char *value, struct error *err)
{
    struct scene scene = {0};
    char text[256];
    snprintf(text, sizeof text, "%s=%s", path, value);
    assert_ok(scene_from_mesh("m", &scene, err), err);
    enum status status = scene_set(&scene, text, err);
    scene_clear(&scene);
    return status;
}

/* Runs `check` on the path of every parameter that is a number or numbers. */
static void each_parameter(void (*check)(const struct scene_field *field, const char *path))
{
    for (size_t i = 0; i < scene_block_count; i++)
        for (size_t k = 0; k < scene_blocks[i].field_count; k++) {
            char path[128];
            path_of(&scene_blocks[i], &scene_blocks[i].fields[k], path, sizeof path);
            check(&scene_blocks[i].fields[k], path);
        }
}

static void refuses_no_numbers(const struct scene_field *field, const char *path)
{
    static const char *const values[] = {"nan", "inf", "-inf", "1e999", "-nan"};
    static const char *const vectors[] = {"[nan, 0.0, 0.0]", "[0.0, inf, 0.0]", "[0.0, 0.0, 1e999]",
                                          "( (nan, 1.0) )", "( (0.0, inf) )"};
    const bool one = is_number(field),
               many = field->type == SCENE_VECTOR || field->type == SCENE_SIZE || field->type == SCENE_PAIRS;
    for (int i = 0; i < 5 && (one || many); i++) {
        struct error err = {0};
        assert_refused(set_to(path, one ? values[i] : vectors[i], &err), STATUS_INPUT, field->key, &err);
    }
}

static void nan_and_inf_are_refused_in_every_parameter(void **state)
{
    (void)state;
    each_parameter(refuses_no_numbers);
}

static void holds_its_range(const struct scene_field *field, const char *path)
{
    if (!is_number(field))
        return;
    char value[64];
    struct error err = {0};
    const bool whole = field->type == SCENE_WHOLE;
    const double below = whole ? field->least - 1 : field->least - fabs(field->least) * 1e-6 - 1e-300,
                 above = whole ? field->most + 1 : field->most * (1 + 1e-6);
    snprintf(value, sizeof value, whole ? "%.0f" : "%.17e", below);
    assert_refused(set_to(path, value, &err), STATUS_INPUT, field->key, &err);
    snprintf(value, sizeof value, whole ? "%.0f" : "%.17e", above);
    assert_refused(set_to(path, value, &err), STATUS_INPUT, field->key, &err);
    snprintf(value, sizeof value, whole ? "%.0f" : "%.17e", field->least);
    assert_ok(set_to(path, value, &err), &err);
    snprintf(value, sizeof value, whole ? "%.0f" : "%.17e", field->most);
    assert_ok(set_to(path, value, &err), &err);
}

static void every_number_is_held_to_its_range(void **state)
{
    (void)state;
    each_parameter(holds_its_range);
}

static void masses_that_are_none_are_refused(void **state)
{
    (void)state;
    static const char *const masses[] = {"0", "1e-300", "-1", "-0.0"};
    for (int i = 0; i < 4; i++) {
        struct error err = {0};
        assert_refused(set_to("balloons[0].point_mass", masses[i], &err), STATUS_INPUT, "point_mass", &err);
    }
}

/* What a block cannot be without, whichever of its keys is tried. */
static const char *needed_by(const char *path)
{
    return strncmp(path, "balloons[0].membrane", 20) == 0 ? "balloons[0].membrane.thickness=0.4"
                                                          : "time.step=0.025";
}

/* A key that calls for a block which wants more, or puts the balloon into the ground, is
 * refused before anything runs. */
static bool is_refused(const char *needed, const char *change)
{
    struct error err = {0};
    struct scene scene = {0};
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    assert_ok(scene_set(&scene, needed, &err), &err);
    assert_ok(scene_set(&scene, change, &err), &err);
    struct mesh mesh = {0};
    struct sim sim = {0};
    shape_icosphere(0, &mesh);
    enum status status = scene_check(&scene, &err);
    if (!status)
        status = sim_open(&sim, &scene, &mesh, 1, &err);
    if (status)
        assert_refused(status, STATUS_INPUT, "sphere", &err);
    sim_clear(&sim);
    mesh_clear(&mesh);
    scene_clear(&scene);
    return status != STATUS_OK;
}

/* Either it runs without making energy, or it is refused or given up with a reason; never
 * a number that is none. */
static void survives_its_extremes(const struct scene_field *field, const char *path)
{
    if (field->type != SCENE_NUMBER || strncmp(path, "view", 4) == 0 || strncmp(path, "schedule", 8) == 0)
        return;
    for (int end = 0; end < 2; end++) {
        char change[128];
        snprintf(change, sizeof change, "%s=%.17e", path, end ? field->most : field->least);
        const char *needed = needed_by(path);
        if (is_refused(needed, change))
            continue;
        struct balloon b;
        struct error err = {0};
        enum status status = STATUS_OK;
        open_balloon(&b, 0, SETTINGS("time.guard=substep", needed, change));
        for (int i = 0; i < 50 && !status; i++)
            status = sim_step(&b.sim, &err);
        if (status)
            assert_refused(status, STATUS_DIVERGED, "steps up to", &err); /* would do */
        assert_finite(&b.sim);
        close_balloon(&b);
    }
}

static void either_end_of_every_range_can_be_run_or_is_refused_with_a_reason(void **state)
{
    (void)state;
    each_parameter(survives_its_extremes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nan_and_inf_are_refused_in_every_parameter),
        cmocka_unit_test(every_number_is_held_to_its_range),
        cmocka_unit_test(masses_that_are_none_are_refused),
        cmocka_unit_test(either_end_of_every_range_can_be_run_or_is_refused_with_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
