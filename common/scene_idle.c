/*
 * What a scene says and nothing goes by: springs beside a membrane, the size of a sphere. It contradicts
 * nothing, and a scene on which one tries this and that is full of it, so it is no error; but whoever turns
 * such a key and sees nothing change should know why. What says no more than what is so anyway is left in
 * peace: no pressure, or one on areas, beside gas. A row of the table says when which keys are idle, for
 * what the file and --set have written and for what the schedule changes.
 */
#include "common/scene_checks.h"
#include "common/scene_fields.h"

#include <string.h>

/* `number` is that of the balloon, or of the item in its list. */
typedef bool idle_when(const struct scene *scene, size_t number);

static bool is_method(const struct scene *scene, const char *const names[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(scene_integrator_names[scene->time.integrator], names[i]))
            return true;
    return false;
}

static bool method_keeps_a_tolerance(const struct scene *scene, size_t number)
{
    static const char *const names[] = {"rk-adaptive", "cvode-adams", "cvode-bdf"};
    (void)number;
    return is_method(scene, names, sizeof names / sizeof names[0]);
}

static bool method_keeps_the_step(const struct scene *scene, size_t number)
{
    static const char *const names[] = {"auto"};
    return !is_method(scene, names, 1) && !method_keeps_a_tolerance(scene, number);
}

/* What moves beside the points, all have to follow (struct effect). */
static bool has_more_than_points(const struct scene_balloon *b)
{
    return b->tube.on || (b->string.on && b->string.weight > 0) ||
           (b->viscosity.on && b->viscosity.ratio > 0);
}

static bool method_asks_no_guard(const struct scene *scene, size_t number)
{
    bool more = false;
    for (size_t i = 0; i < scene->balloon_count; i++)
        more |= has_more_than_points(&scene->balloons[i]);
    return method_keeps_a_tolerance(scene, number) && !more;
}

static bool view_is_mono(const struct scene *scene, size_t number)
{
    (void)number;
    return scene->view.stereo == SCENE_MONO;
}

static bool view_has_no_halves(const struct scene *scene, size_t number)
{
    (void)number;
    return scene->view.squeezed && scene->view.stereo != SCENE_PARALLEL &&
           scene->view.stereo != SCENE_CROSSED && scene->view.stereo != SCENE_OVER_UNDER;
}

static bool skin_is_membrane(const struct scene *scene, size_t number)
{
    return scene->balloons[number].membrane.on;
}

static bool law_is_not(const struct scene *scene, size_t number, int law)
{
    return scene->balloons[number].membrane.law != law;
}

static bool law_is_not_mooney(const struct scene *scene, size_t number)
{
    return law_is_not(scene, number, SCENE_MOONEY_RIVLIN);
}

static bool law_is_not_gent(const struct scene *scene, size_t number)
{
    return law_is_not(scene, number, SCENE_GENT);
}

static bool law_is_not_ogden(const struct scene *scene, size_t number)
{
    return law_is_not(scene, number, SCENE_OGDEN);
}

static bool skin_tears(const struct scene *scene, size_t number)
{
    const struct scene_fracture *fracture = &scene->balloons[number].fracture;
    return fracture->on && fracture->mode == SCENE_FRACTURE_TEAR;
}

static bool skin_breaks_as_in_the_paper(const struct scene *scene, size_t number)
{
    return !skin_tears(scene, number);
}

static bool skin_is_even(const struct scene *scene, size_t number)
{
    return skin_tears(scene, number) && scene->balloons[number].fracture.weakness == 0;
}

static bool dashpots_have_no_springs(const struct scene *scene, size_t number)
{
    return scene->balloons[number].viscosity.ratio == 0;
}

static bool skin_bends_freely(const struct scene *scene, size_t number)
{
    return scene->balloons[number].bending.stiffness == 0;
}

static bool gas_presses_on_no_points(const struct scene *scene, size_t number)
{
    return scene->balloons[number].gas.on && scene->balloons[number].pressure_on == SCENE_ON_POINTS;
}

static bool nothing_pumps(const struct scene *scene, size_t number)
{
    for (size_t i = 0; i < scene->schedule_count; i++)
        if (scene_changes(&scene->schedule[i], "pump", number))
            return false;
    return scene->balloons[number].gas.pump <= 0;
}

static bool gas_has_no_neck(const struct scene *scene, size_t number)
{
    return scene->balloons[number].gas.neck == 0;
}

static bool no_gas_floats(const struct scene *scene, size_t number)
{
    (void)number;
    return !scene_has_gas(scene);
}

static bool air_is_empty(const struct scene *scene, size_t number)
{
    (void)number;
    return scene->drag.air_density == 0;
}

static bool air_slips_by(const struct scene *scene, size_t number)
{
    return scene->drag.coefficient == 0 && !air_is_empty(scene, number);
}

static bool is_sphere(const struct scene *scene, size_t number)
{
    return scene->obstacles[number].shape == SCENE_SPHERE;
}

static bool is_box(const struct scene *scene, size_t number)
{
    return scene->obstacles[number].shape == SCENE_BOX;
}

static bool entry_changes_nothing(const struct scene *scene, size_t number)
{
    return scene->schedule[number].change_count == 0;
}

static bool entry_changes_the_step_alone(const struct scene *scene, size_t number)
{
    const struct scene_schedule *entry = &scene->schedule[number];
    return entry->change_count == 1 && !strcmp(entry->change[0].field->key, "step");
}

static const struct rule {
    const char *block, *keys;
    idle_when *idle;
    const char *because;
} rules[] = {
    {"time", "tolerance", method_keeps_the_step,
     "this integrator takes the steps that it is told; \"auto\", \"rk-adaptive\" and CVODE's go by it"},
    {"time", "guard", method_asks_no_guard, "this integrator chooses its own steps, by tolerance"},
    {"view", "eye_distance", view_is_mono, "stereo = \"mono\" has one eye"},
    {"view", "squeezed", view_has_no_halves,
     "only halves, of stereo = \"parallel\", \"crossed\" or \"over-under\", are squeezed"},
    {"balloons", "point_mass mass_by", skin_is_membrane,
     "a membrane gives the points its own mass, by its density"},
    {"balloons", "spring spring_factor damping stiffness", skin_is_membrane,
     "a membrane stands in for the springs"},
    {"balloons", "threshold threshold_of", skin_tears, "a skin that tears goes by its fracture's strength"},
    {"balloons", "pressure_on", gas_presses_on_no_points, "gas presses on areas"},
    {"viscosity", "time", dashpots_have_no_springs, "a ratio of 0 leaves no second spring"},
    {"membrane", "mooney_ratio", law_is_not_mooney, "only law = \"mooney-rivlin\" goes by it"},
    {"membrane", "gent_limit", law_is_not_gent, "only law = \"gent\" goes by it"},
    {"membrane", "ogden", law_is_not_ogden, "only law = \"ogden\" goes by it"},
    {"bending", "rest damping", skin_bends_freely, "a stiffness of 0 is none"},
    {"gas", "pump_until", nothing_pumps, "no pump fills the balloon; give pump"},
    {"gas", "neck_at neck_place", gas_has_no_neck, "there is no neck; give neck, its area"},
    {"gravity", "air_density", no_gas_floats, "only gas rises in it, and no balloon has gas"},
    {"drag", "coefficient wind", air_is_empty, "an air_density of 0 is no air"},
    {"drag", "air_density wind", air_slips_by, "a coefficient of 0 is no drag"},
    {"obstacles", "size", is_sphere, "a sphere goes by its radius"},
    {"obstacles", "radius", is_box, "a box goes by its size"},
    {"fracture", "strength toughness weakness seed tip_speed branching spacing smallest reserve",
     skin_breaks_as_in_the_paper, "mode = \"paper\" goes by the balloon's threshold"},
    {"fracture", "seed", skin_is_even, "a weakness of 0 is alike everywhere"},
    {"schedule", "at balloon", entry_changes_nothing, "the entry has no key that changes then"},
    {"schedule", "balloon", entry_changes_the_step_alone, "all balloons take the same steps"},
};

static bool has_word(const char *words, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = words; (at = strstr(at, word)); at += length)
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    return false;
}

/* A block that a rule is about: of the scene, of the list's item, or of the balloon with that number. */
struct place {
    const struct scene_block *block;
    size_t count;
    bool in_balloon;
};

static struct place place_of(const struct scene *scene, const char *name)
{
    const struct scene_block *own = scene_find_block("", name);
    if (!own)
        return (struct place){scene_find_block("balloons", name), scene->balloon_count, true};
    if (!own->list)
        return (struct place){own, 1, false};
    const size_t count = *(const size_t *)((const char *)scene + scene_find_list(own)->count);
    return (struct place){own, count, false};
}

static const void *target_of(const struct scene *scene, const struct place *place, size_t number)
{
    if (place->in_balloon)
        return (const char *)&scene->balloons[number] + place->block->offset;
    if (place->block->list)
        return scene_list_item(scene, scene_find_list(place->block), number);
    return (const char *)scene + place->block->offset;
}

struct telling {
    const struct scene *scene;
    void (*say)(const char *text, void *context);
    void *context;
};

/* line: as in struct scene_written. */
static void tell(const struct telling *t, int line, const char *path, const char *keys, bool many,
                 const char *because)
{
    char text[512], at[16] = "";
    if (line > 0)
        snprintf(at, sizeof at, ":%d", line);
    snprintf(text, sizeof text, "%s%s: %s: %s %s nothing: %s", t->scene->path, at, path, keys,
             many ? "do" : "does", because);
    t->say(text, t->context);
}

static void write_path(const struct place *place, size_t number, char *path, size_t size)
{
    const char *name = place->block->name;
    if (place->in_balloon)
        snprintf(path, size, "balloons[%zu].%s", number, name);
    else if (place->block->list)
        snprintf(path, size, "%s[%zu]", name, number);
    else
        snprintf(path, size, "%s", name);
}

/* Of the rule's keys those that somebody wrote, together. */
static void tell_written(const struct telling *t, const struct rule *rule, const struct place *place,
                         size_t number)
{
    const void *target = target_of(t->scene, place, number);
    char keys[256] = "", path[64];
    int first = 0, count = 0;
    for (size_t i = 0; i < place->block->field_count; i++) {
        const struct scene_field *field = &place->block->fields[i];
        const int line = scene_line_of(place->block, target, field);
        if (!line || !has_word(rule->keys, field->key))
            continue;
        const size_t used = strlen(keys);
        snprintf(keys + used, sizeof keys - used, "%s%s", count ? ", " : "", field->key);
        first = first > 0 && (line < 0 || line > first) ? first : line;
        count++;
    }
    write_path(place, number, path, sizeof path);
    if (count)
        tell(t, first, path, keys, count > 1, rule->because);
}

/* The rule by which a key that the schedule changes is idle in this balloon; NULL: there is none. */
static const struct rule *rule_for(const struct scene *scene, const struct scene_field *field, size_t number)
{
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        const struct place place = place_of(scene, rules[i].block);
        if (scene_find_field(place.block, field->key) == field && has_word(rules[i].keys, field->key) &&
            rules[i].idle(scene, number))
            return &rules[i];
    }
    return NULL;
}

/* A change is idle that is so in each of the balloons that it is for. */
static void tell_change(const struct telling *t, const struct scene_schedule *entry, size_t number,
                        const struct scene_field *field)
{
    const struct rule *rule = NULL;
    char path[64];
    if (!strcmp(field->key, "step"))
        return;
    for (size_t b = 0; b < t->scene->balloon_count; b++)
        if (scene_changes(entry, field->key, b) && !(rule = rule_for(t->scene, field, b)))
            return;
    snprintf(path, sizeof path, "schedule[%zu]", number);
    if (rule)
        tell(t, (int)entry->line, path, field->key, false, rule->because);
}

void scene_tell_idle(const struct scene *scene, void (*say)(const char *text, void *context), void *context)
{
    const struct telling t = {scene, say, context};
    for (size_t r = 0; r < sizeof rules / sizeof rules[0]; r++) {
        const struct place place = place_of(scene, rules[r].block);
        for (size_t i = 0; i < place.count; i++)
            if (rules[r].idle(scene, i))
                tell_written(&t, &rules[r], &place, i);
    }
    for (size_t i = 0; i < scene->schedule_count; i++)
        for (size_t k = 0; k < scene->schedule[i].change_count; k++)
            tell_change(&t, &scene->schedule[i], i, scene->schedule[i].change[k].field);
}
