#include "common/scene_fields.h"
#include "common/scene.h"

#include <assert.h>
#include <stdint.h>
#include <string.h>

const char *const scene_integrator_names[] = {"symplectic-euler",
                                              "explicit-euler",
                                              "verlet",
                                              "rk4",
                                              "rkn4",
                                              "rk-adaptive",
                                              "backward-euler",
                                              "implicit-midpoint",
                                              "bdf2",
                                              "xpbd",
                                              "cvode-adams",
                                              "cvode-bdf",
                                              "auto",
                                              NULL};
const char *const scene_guard_names[] = {"substep", "refuse", "off", NULL};
const char *const scene_pressure_on_names[] = {"points", "areas", NULL};
const char *const scene_process_names[] = {"isothermal", "adiabatic", NULL};
const char *const scene_mode_names[] = {"tear", "paper", NULL};
const char *const scene_stereo_names[] = {"mono",     "parallel",   "crossed", "over-under",
                                          "red-cyan", "interlaced", "quad",    "left",
                                          "right",    "separate",   NULL};
const char *const scene_squeezed_names[] = {"no", "yes", NULL};
const char *const scene_shape_names[] = {"sphere", "box", NULL};
const char *const scene_style_names[] = {"latex", "paper", NULL};
const char *const scene_order_names[] = {"none", "sort", "peel", "list", NULL};
const char *const scene_mass_by_names[] = {"points", "areas", NULL};
const char *const scene_stiffness_names[] = {"uniform", "cotangent", NULL};
const char *const scene_threshold_of_names[] = {"mean", "edge", NULL};
const char *const scene_rest_names[] = {"as_meshed", "flat", NULL};
const char *const scene_law_names[] = {"neo-hookean", "mooney-rivlin", "gent", "ogden", NULL};

#define CHOICES_NUMBER(key) NULL
#define CHOICES_WHOLE(key)  NULL
#define CHOICES_TEXT(key)   NULL
#define CHOICES_VECTOR(key) NULL
#define CHOICES_SIZE(key)   NULL
#define CHOICES_PAIRS(key)  NULL
#define CHOICES_CHOICE(key) scene_##key##_names

#define ROW(owner, key, type, least, most, standard, unit, flags, meaning, source)           \
    {#key,    SCENE_##type, offsetof(struct owner, key), least, most, standard, unit, flags, \
     meaning, source,       CHOICES_##type(key)},
#define LIVE                      SCENE_LIVE
#define FREE                      SCENE_FREE

#define TIME_ROW(...)             ROW(scene_time, __VA_ARGS__)
#define VIEW_ROW(...)             ROW(scene_view, __VA_ARGS__)
#define BALLOON_ROW(...)          ROW(scene_balloon, __VA_ARGS__)
#define SPRING_BY_HEIGHT_ROW(...) ROW(scene_spring_by_height, __VA_ARGS__)
#define RIP_ROW(...)              ROW(scene_rip, __VA_ARGS__)
#define GAS_ROW(...)              ROW(scene_gas, __VA_ARGS__)
#define TUBE_ROW(...)             ROW(scene_tube, __VA_ARGS__)
#define PINS_ROW(...)             ROW(scene_pins, __VA_ARGS__)
#define STRING_ROW(...)           ROW(scene_string, __VA_ARGS__)
#define GRAVITY_ROW(...)          ROW(scene_gravity, __VA_ARGS__)
#define DRAG_ROW(...)             ROW(scene_drag, __VA_ARGS__)
#define GROUND_ROW(...)           ROW(scene_ground, __VA_ARGS__)
#define OBSTACLES_ROW(...)        ROW(scene_obstacles, __VA_ARGS__)
#define NEEDLES_ROW(...)          ROW(scene_needles, __VA_ARGS__)
#define CONTACT_ROW(...)          ROW(scene_contact, __VA_ARGS__)
#define MEMBRANE_ROW(...)         ROW(scene_membrane, __VA_ARGS__)
#define BENDING_ROW(...)          ROW(scene_bending, __VA_ARGS__)
#define VISCOSITY_ROW(...)        ROW(scene_viscosity, __VA_ARGS__)
#define PLASTICITY_ROW(...)       ROW(scene_plasticity, __VA_ARGS__)
#define FRACTURE_ROW(...)         ROW(scene_fracture, __VA_ARGS__)
#define SCHEDULE_ROW(...)         ROW(scene_schedule, __VA_ARGS__)

static const struct scene_field time_fields[] = {SCENE_TIME_FIELDS(TIME_ROW)};
static const struct scene_field view_fields[] = {SCENE_VIEW_FIELDS(VIEW_ROW)};
static const struct scene_field balloon_fields[] = {SCENE_BALLOON_FIELDS(BALLOON_ROW)};
static const struct scene_field spring_by_height_fields[] = {
    SCENE_SPRING_BY_HEIGHT_FIELDS(SPRING_BY_HEIGHT_ROW)};
static const struct scene_field rip_fields[] = {SCENE_RIP_FIELDS(RIP_ROW)};
static const struct scene_field ground_fields[] = {SCENE_GROUND_FIELDS(GROUND_ROW)};
static const struct scene_field obstacles_fields[] = {SCENE_OBSTACLES_FIELDS(OBSTACLES_ROW)};
static const struct scene_field needles_fields[] = {SCENE_NEEDLES_FIELDS(NEEDLES_ROW)};
static const struct scene_field contact_fields[] = {SCENE_CONTACT_FIELDS(CONTACT_ROW)};
static const struct scene_field gas_fields[] = {SCENE_GAS_FIELDS(GAS_ROW)};
static const struct scene_field tube_fields[] = {SCENE_TUBE_FIELDS(TUBE_ROW)};
static const struct scene_field pins_fields[] = {SCENE_PINS_FIELDS(PINS_ROW)};
static const struct scene_field string_fields[] = {SCENE_STRING_FIELDS(STRING_ROW)};
static const struct scene_field gravity_fields[] = {SCENE_GRAVITY_FIELDS(GRAVITY_ROW)};
static const struct scene_field drag_fields[] = {SCENE_DRAG_FIELDS(DRAG_ROW)};
static const struct scene_field membrane_fields[] = {SCENE_MEMBRANE_FIELDS(MEMBRANE_ROW)};
static const struct scene_field bending_fields[] = {SCENE_BENDING_FIELDS(BENDING_ROW)};
static const struct scene_field viscosity_fields[] = {SCENE_VISCOSITY_FIELDS(VISCOSITY_ROW)};
static const struct scene_field plasticity_fields[] = {SCENE_PLASTICITY_FIELDS(PLASTICITY_ROW)};
static const struct scene_field fracture_fields[] = {SCENE_FRACTURE_FIELDS(FRACTURE_ROW)};
static const struct scene_field schedule_fields[] = {SCENE_SCHEDULE_FIELDS(SCHEDULE_ROW)};

#define FIELDS(list)  list, sizeof(list) / sizeof(list)[0]
#define WRITTEN(name) offsetof(struct scene_##name, written)
#define CALLED(name)  offsetof(struct scene_##name, on), offsetof(struct scene_##name, line), WRITTEN(name)
#define EFFECT(name)  offsetof(struct scene_balloon, name), CALLED(name)
#define ALWAYS(name)  offsetof(struct scene, name), SIZE_MAX, SIZE_MAX, WRITTEN(name)
#define ITEM(name)    0, SIZE_MAX, offsetof(struct scene_##name, line), WRITTEN(name)

const struct scene_block scene_blocks[] = {
    {"time", "", false, FIELDS(time_fields), ALWAYS(time), "How time is cut into steps"},
    {"view", "", false, FIELDS(view_fields), ALWAYS(view), "How the pictures are taken"},
    {"balloons", "", true, FIELDS(balloon_fields), ITEM(balloon), "A list: one block { ... } a balloon"},
    {"spring_by_height", "balloons", false, FIELDS(spring_by_height_fields), EFFECT(spring_by_height),
     "Spring constants that vary with height, as the skin's thickness does"},
    {"rip", "balloons", false, FIELDS(rip_fields), EFFECT(rip), "An artificial rip"},
    {"viscosity", "balloons", false, FIELDS(viscosity_fields), EFFECT(viscosity),
     "Springs that relax: a second spring beside each, on a dashpot"},
    {"plasticity", "balloons", false, FIELDS(plasticity_fields), EFFECT(plasticity),
     "Springs that slip when they are pulled too hard, for good"},
    {"membrane", "balloons", false, FIELDS(membrane_fields), EFFECT(membrane),
     "The skin as a membrane of rubber, in place of springs"},
    {"bending", "balloons", false, FIELDS(bending_fields), EFFECT(bending), "The skin resists being bent"},
    {"gas", "balloons", false, FIELDS(gas_fields), EFFECT(gas),
     "What is sealed in, in place of a given pressure"},
    {"tube", "balloons", false, FIELDS(tube_fields), EFFECT(tube), "Joins the gas of two balloons"},
    {"pins", "balloons", false, FIELDS(pins_fields), EFFECT(pins), "Holds a patch of the skin where it is"},
    {"string", "balloons", false, FIELDS(string_fields), EFFECT(string),
     "Ties a place of the skin to another, or to a weight"},
    {"gravity", "", false, FIELDS(gravity_fields), offsetof(struct scene, gravity), CALLED(gravity),
     "Makes balloons fall, and light gas rise"},
    {"drag", "", false, FIELDS(drag_fields), offsetof(struct scene, drag), CALLED(drag),
     "The air resists what moves in it, or carries it along"},
    {"ground", "", false, FIELDS(ground_fields), offsetof(struct scene, ground), CALLED(ground),
     "A plane that skin cannot pass"},
    {"obstacles", "", true, FIELDS(obstacles_fields), ITEM(obstacles),
     "A list: spheres and boxes that skin cannot enter"},
    {"needles", "", true, FIELDS(needles_fields), ITEM(needles),
     "A list: points that move and start tears where they meet skin"},
    {"contact", "", false, FIELDS(contact_fields), offsetof(struct scene, contact), CALLED(contact),
     "Balloons do not pass through each other, nor through themselves"},
    {"fracture", "balloons", false, FIELDS(fracture_fields), EFFECT(fracture),
     "How the skin gives way; without the block as the paper has it"},
    {"schedule", "", true, FIELDS(schedule_fields), ITEM(schedule),
     "A list: one block { at = ...; and the keys that change then }"},
};
const size_t scene_block_count = sizeof scene_blocks / sizeof scene_blocks[0];

const struct scene_block *scene_find_block(const char *parent, const char *name)
{
    for (size_t i = 0; i < scene_block_count; i++)
        if (!strcmp(scene_blocks[i].parent, parent) && !strcmp(scene_blocks[i].name, name))
            return &scene_blocks[i];
    return NULL;
}

const struct scene_field *scene_find_field(const struct scene_block *block, const char *key)
{
    for (size_t i = 0; i < block->field_count; i++)
        if (!strcmp(block->fields[i].key, key))
            return &block->fields[i];
    return NULL;
}

int scene_line_of(const struct scene_block *block, const void *target, const struct scene_field *field)
{
    const struct scene_written *written = (const struct scene_written *)((const char *)target +
                                                                         block->written_offset);
    assert(block->field_count <= SCENE_KEYS_MAX);
    return written->line[field - block->fields];
}

static const struct scene_list lists[] = {
#define LIST(name, prefix)                                                                  \
    {                                                                                       \
#name, offsetof(struct scene, name), offsetof(struct scene, prefix##_count),        \
            offsetof(struct scene, prefix##_capacity), sizeof *((struct scene *)NULL)->name \
    }
    LIST(balloons, balloon),
    LIST(schedule, schedule),
    LIST(obstacles, obstacles),
    LIST(needles, needles),
#undef LIST
};

const struct scene_list *scene_find_list(const struct scene_block *block)
{
    const struct scene_list *list = lists;
    while (strcmp(list->name, block->name))
        list++;
    return list;
}

void *scene_list_item(const struct scene *scene, const struct scene_list *list, size_t index)
{
    char *items;
    memcpy(&items, (const char *)scene + list->items, sizeof items);
    return items + index * list->size;
}
