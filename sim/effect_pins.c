/* A patch of the skin that is held where it is: no force moves it. The last of all effects, since it takes
 * away what the others add. */
#include "sim/effects.h"
#include "sim/patch.h"
#include "sim/pins.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

struct pins {
    uint32_t *pin;      /* [points at first] the number of its place, by names; MESH_NONE: not held; owned */
    double (*place)[4]; /* where they are held; owned */
    uint32_t *point;    /* [count] owned, with room for what cuts make of them, */
    uint32_t *at;       /* [count] and the number of its place; likewise */
    uint32_t count;
    uint64_t let_go; /* 1: they are held no longer */
};

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->pins.on;
}

/* What a cut has made of a point that is held is held there, too. */
static void hold_point(const struct sim_balloon *b, uint32_t point)
{
    struct pins *pins = b->pins;
    const struct topology *top = b->topology;
    const uint32_t name = reorder_name(b, point), pin = pins->pin[top ? top->family[name] : name];
    if (pin == MESH_NONE)
        return;
    pins->point[pins->count] = point;
    pins->at[pins->count++] = pin;
}

void pins_hold_copy(const struct sim_balloon *b, uint32_t copy)
{
    if (b->pins)
        hold_point(b, copy);
}

static void find_held(const struct sim_balloon *b)
{
    b->pins->count = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        hold_point(b, p);
}

static bool make_tables(struct sim *sim, const struct sim_balloon *b, const uint32_t *patch, uint32_t count)
{
    struct pins *pins = b->pins;
    const uint32_t points = b->point_end - b->point_begin, room = count + b->point_room - b->point_end;
    pins->pin = sim_table(sim, points, sizeof *pins->pin);
    pins->place = sim_table(sim, count, sizeof *pins->place);
    pins->point = sim_table(sim, room, sizeof *pins->point);
    pins->at = sim_table(sim, room, sizeof *pins->at);
    if (!pins->pin || !pins->place || !pins->point || !pins->at)
        return false;
    memset(pins->pin, 0xff, points * sizeof *pins->pin); /* MESH_NONE */
    for (uint32_t i = 0; i < count; i++) {
        pins->pin[patch[i] - b->point_begin] = i;
        memcpy(pins->place[i], sim->position[patch[i]], sizeof pins->place[i]);
    }
    return true;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    b->pins = calloc(1, sizeof *b->pins);
    if (!b->pins)
        return error_no_memory(err, "the pins");
    uint32_t *patch = NULL, count;
    enum status status = patch_find(sim, b, b->scene->pins.place, b->scene->pins.reach, &patch, &count, err);
    if (!status && !make_tables(sim, b, patch, count))
        status = error_no_memory(err, "the pins");
    free(patch);
    if (status)
        return status;
    sim->bytes -= count * sizeof *patch; /* which is not kept */
    find_held(b);
    b->pins->let_go = b->scene->pins.until <= 0;
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->pins) {
        free(b->pins->pin);
        free(b->pins->place);
        free(b->pins->point);
        free(b->pins->at);
    }
    free(b->pins);
    b->pins = NULL;
}

static void hold(const struct pins *pins, double (*rows)[4])
{
    for (uint32_t i = 0; i < pins->count && !pins->let_go; i++)
        memset(rows[pins->point[i]], 0, sizeof *rows);
}

void pins_mark(const struct sim *sim, unsigned char *held)
{
    for (size_t k = 0; k < sim->balloon_count; k++) {
        const struct pins *pins = sim->balloons[k].pins;
        for (uint32_t i = 0; pins && !pins->let_go && i < pins->count; i++)
            held[pins->point[i]] = 1;
    }
}

void pins_hold(const struct sim *sim, double (*rows)[4])
{
    for (size_t k = 0; k < sim->balloon_count; k++)
        if (sim->balloons[k].pins)
            hold(sim->balloons[k].pins, rows);
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    hold(b->pins, sim->force);
}

static void product(struct sim *sim, struct sim_balloon *b, double a, double (*dx)[4], double f,
                    double (*dv)[4], double (*df)[4])
{
    (void)sim;
    (void)a;
    (void)dx;
    (void)f;
    (void)dv;
    hold(b->pins, df);
}

/* Methods that move points by other means than forces (xpbd) have moved them all the same. */
static void after(struct sim *sim, struct sim_balloon *b)
{
    struct pins *pins = b->pins;
    if (pins->let_go)
        return;
    for (uint32_t i = 0; i < pins->count; i++) {
        memcpy(sim->position[pins->point[i]], pins->place[pins->at[i]], sizeof *pins->place);
        memset(sim->velocity[pins->point[i]], 0, sizeof *sim->velocity);
    }
    if (sim->time >= b->scene->pins.until) {
        pins->let_go = 1;
        sim->changed = true;
        sim_tell(sim, b, "pins", "let go");
    }
}

static double due(const struct sim_balloon *b)
{
    return b->scene->pins.until;
}

static void reorder(struct sim *sim, struct sim_balloon *b, const struct reorder *how)
{
    (void)sim;
    if (how->balloon == b)
        find_held(b);
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *list)
{
    (void)sim;
    list[0] = (struct sim_block){"pins", &b->pins->let_go, sizeof b->pins->let_go};
    return 1;
}

const struct effect effect_pins = {.name = "pins",
                                   .phase = EFFECT_FORCES,
                                   .wanted = wanted,
                                   .open = open,
                                   .close = close,
                                   .apply = apply,
                                   .after = after,
                                   .due = due,
                                   .blocks = blocks,
                                   .reorder = reorder,
                                   .product = product,
                                   .source = "points of infinite mass"};
