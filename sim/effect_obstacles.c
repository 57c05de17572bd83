/* Ground, spheres and boxes: what the scene puts in the way of the points (obstacles.h). */
#include "common/array.h"
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/ledger.h"
#include "sim/obstacles.h"

#include <stdlib.h>
#include <string.h>

static bool ground_wanted(const struct scene *scene)
{
    return scene->ground.on;
}

static bool obstacles_wanted(const struct scene *scene)
{
    return scene->obstacles_count > 0;
}

static struct obstacle make_ground(const struct scene_ground *ground)
{
    struct obstacle o = {.kind = OBSTACLE_PLANE,
                         .place = {0, ground->height, 0},
                         .friction = ground->friction,
                         .bounce = ground->bounce};
    for (int i = 0; i < 3; i++)
        o.normal[i] = ground->normal[i] / vec3_length(ground->normal);
    return o;
}

static struct obstacle make_obstacle(const struct scene_obstacles *given)
{
    struct obstacle o = {.kind = given->shape == SCENE_BOX ? OBSTACLE_BOX : OBSTACLE_SPHERE,
                         .radius = given->radius,
                         .friction = given->friction,
                         .bounce = given->bounce};
    for (int i = 0; i < 3; i++) {
        o.place[i] = given->place[i];
        o.half[i] = given->size[i] / 2;
    }
    return o;
}

static enum status refuse_inside(const struct sim *sim, size_t item, size_t balloon, uint32_t point,
                                 struct error *err)
{
    const struct scene *scene = sim->scene;
    const bool ground = scene->ground.on && item == 0;
    const size_t number = item - scene->ground.on;
    const unsigned line = ground ? scene->ground.line : scene->obstacles[number].line;
    char where[64] = "the ground", at[16] = "";
    if (!ground)
        snprintf(where, sizeof where, "obstacles[%zu]", number);
    if (line)
        snprintf(at, sizeof at, ":%u", line);
    const double *x = sim->position[point];
    return error_set(err, STATUS_INPUT,
                     "%s%s: balloons[%zu] begins inside %s, with its point at (%g, %g, %g); move one of them",
                     scene->path, at, balloon, where, x[0], x[1], x[2]);
}

static enum status check_outside(const struct sim *sim, struct error *err)
{
    for (size_t i = 0; i < sim->obstacles->count; i++)
        for (size_t b = 0; b < sim->balloon_count; b++)
            for (uint32_t p = sim->balloons[b].point_begin; p < sim->balloons[b].point_end; p++)
                if (obstacle_holds(&sim->obstacles->items[i], sim->position[p]))
                    return refuse_inside(sim, i, b, p, err);
    return STATUS_OK;
}

/* Both kinds in one list, by whichever comes first. */
static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    const struct scene *scene = sim->scene;
    if (sim->obstacles)
        return STATUS_OK;
    struct obstacles *obstacles = sim->obstacles = calloc(1, sizeof *obstacles);
    if (!obstacles)
        return error_no_memory(err, "the obstacles");
    obstacles->items = array_new(scene->obstacles_count + 1, sizeof *obstacles->items);
    obstacles->found = array_new(sim->part_count, sizeof *obstacles->found);
    if (!obstacles->items || !obstacles->found)
        return error_no_memory(err, "the obstacles");
    if (scene->ground.on)
        obstacles->items[obstacles->count++] = make_ground(&scene->ground);
    for (size_t i = 0; i < scene->obstacles_count; i++)
        obstacles->items[obstacles->count++] = make_obstacle(&scene->obstacles[i]);
    obstacles->margin = 1e-9 * balloon->radius;
    sim->bytes += obstacles->count * sizeof *obstacles->items + sim->part_count * sizeof *obstacles->found;
    enum status status = check_outside(sim, err);
    return status ? status : sim_keep_before(sim, err);
}

static void close(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    if (!sim->obstacles)
        return;
    free(sim->obstacles->items);
    free(sim->obstacles->found);
    free(sim->obstacles);
    sim->obstacles = NULL;
}

static enum status settle(struct sim *sim, struct error *err)
{
    (void)err;
    const bool moved = obstacles_settle(sim);
    sim->changed |= moved;
    ledger_book(sim, moved);
    return STATUS_OK;
}

/* Once where the scene has both, and with skins that keep each other apart not here (contact.h). */
static enum status settle_ground(struct sim *sim, struct error *err)
{
    return obstacles_wanted(sim->scene) || sim->contact ? STATUS_OK : settle(sim, err);
}

static enum status settle_obstacles(struct sim *sim, struct error *err)
{
    return sim->contact ? STATUS_OK : settle(sim, err);
}

/* Of both kinds together, wherever they are settled. */
static size_t blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *list)
{
    (void)balloon;
    list[0] = (struct sim_block){"room", &sim->obstacles->room, sizeof sim->obstacles->room};
    return 1;
}

static size_t ground_blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *list)
{
    return obstacles_wanted(sim->scene) ? 0 : blocks(sim, balloon, list);
}

const struct effect effect_ground = {.name = "ground",
                                     .phase = EFFECT_MOVED,
                                     .scene_wanted = ground_wanted,
                                     .open = open,
                                     .close = close,
                                     .settle = settle_ground,
                                     .blocks = ground_blocks,
                                     .source = "Coulomb's friction, Newton's restitution"};

const struct effect effect_obstacles = {.name = "obstacles",
                                        .phase = EFFECT_MOVED,
                                        .scene_wanted = obstacles_wanted,
                                        .open = open,
                                        .close = close,
                                        .settle = settle_obstacles,
                                        .blocks = blocks,
                                        .source = "Coulomb's friction, Newton's restitution"};
