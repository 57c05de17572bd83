#include "sim/without.h"
#include "common/array.h"
#include "common/scene_fields.h"

#include <stdlib.h>
#include <string.h>

/* What stands in for an effect that is not there. */
static const struct {
    const char *name, *instead;
} stand_ins[] = {{"gas", "a constant pressure, the gas's at the start"},
                 {"membrane", "springs"},
                 {"fracture", "edges that let go at the threshold"}};

/* The gas's pressure at the start, in the rest volume. */
static void press_instead(struct scene_balloon *balloon)
{
    balloon->pressure = balloon->gas.ambient * (balloon->gas.fill - 1);
    balloon->pressure_on = SCENE_ON_AREAS;
}

/* A block of a balloon, or the scene's own. */
static void drop_block(const struct scene_block *block, void *parent)
{
    *(bool *)((char *)parent + block->offset + block->on_offset) = false;
}

static void drop_list(struct scene *scene, const char *name)
{
    if (!strcmp(name, "obstacles"))
        scene->obstacles_count = 0;
    else
        scene->needles_count = 0;
}

static void drop(struct scene *scene, const char *name)
{
    const struct scene_block *own = scene_find_block("", name), *of = scene_find_block("balloons", name);
    if (own && own->list)
        drop_list(scene, name);
    else if (own)
        drop_block(own, scene);
    for (size_t i = 0; of && i < scene->balloon_count; i++) {
        if (!strcmp(name, "gas") && scene->balloons[i].gas.on)
            press_instead(&scene->balloons[i]);
        drop_block(of, &scene->balloons[i]);
    }
}

enum status without_open(struct without *without, const struct scene *scene, const struct effect *effect,
                         struct error *err)
{
    *without = (struct without){.scene = *scene};
    without->scene.balloons = array_new(scene->balloon_count, sizeof *scene->balloons);
    if (!without->scene.balloons)
        return error_no_memory(err, "the scene without an effect");
    memcpy(without->scene.balloons, scene->balloons, scene->balloon_count * sizeof *scene->balloons);
    if (!scene_find_block("", effect->name) && !scene_find_block("balloons", effect->name))
        return error_set(err, STATUS_INPUT,
                         "it says how the pressure acts, and adds nothing that could be left out");
    drop(&without->scene, effect->name);
    for (size_t i = 0; i < sizeof stand_ins / sizeof stand_ins[0]; i++)
        if (!strcmp(stand_ins[i].name, effect->name))
            without->instead = stand_ins[i].instead;
    return scene_check(&without->scene, err);
}

void without_close(struct without *without)
{
    free(without->scene.balloons);
    *without = (struct without){0};
}
