#include "common/scene_fields.h"
#include "common/scene.h"

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
const char *const scene_stereo_names[] = {"mono", "parallel", "crossed", NULL};

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
#define SCHEDULE_ROW(...)         ROW(scene_schedule, __VA_ARGS__)

static const struct scene_field time_fields[] = {SCENE_TIME_FIELDS(TIME_ROW)};
static const struct scene_field view_fields[] = {SCENE_VIEW_FIELDS(VIEW_ROW)};
static const struct scene_field balloon_fields[] = {SCENE_BALLOON_FIELDS(BALLOON_ROW)};
static const struct scene_field spring_by_height_fields[] = {
    SCENE_SPRING_BY_HEIGHT_FIELDS(SPRING_BY_HEIGHT_ROW)};
static const struct scene_field rip_fields[] = {SCENE_RIP_FIELDS(RIP_ROW)};
static const struct scene_field schedule_fields[] = {SCENE_SCHEDULE_FIELDS(SCHEDULE_ROW)};

#define FIELDS(list) list, sizeof(list) / sizeof(list)[0]
#define EFFECT(name) offsetof(struct scene_balloon, name), offsetof(struct scene_##name, on)

const struct scene_block scene_blocks[] = {
    {"time", "", false, FIELDS(time_fields), offsetof(struct scene, time), SIZE_MAX,
     "How time is cut into steps"},
    {"view", "", false, FIELDS(view_fields), offsetof(struct scene, view), SIZE_MAX,
     "How the pictures are taken"},
    {"balloons", "", true, FIELDS(balloon_fields), 0, SIZE_MAX, "A list: one block { ... } a balloon"},
    {"spring_by_height", "balloons", false, FIELDS(spring_by_height_fields), EFFECT(spring_by_height),
     "Spring constants that vary with height, as the skin's thickness does"},
    {"rip", "balloons", false, FIELDS(rip_fields), EFFECT(rip), "An artificial rip"},
    {"schedule", "", true, FIELDS(schedule_fields), 0, SIZE_MAX,
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
