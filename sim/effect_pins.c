/* A patch of the skin that is held where it is: no force moves it. The last of all effects, since it takes
 * away what the others add. */
#include "sim/effects.h"
#include "sim/patch.h"
#include "sim/pins.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

struct pins {
    struct patch patch;
    double (*place)[4]; /* [patch.first] where they are held; owned */
    uint64_t let_go;    /* 1: they are held no longer */
};

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->pins.on;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    b->pins = calloc(1, sizeof *b->pins);
    if (!b->pins)
        return error_no_memory(err, "the pins");
    struct patch *patch = &b->pins->patch;
    enum status status = patch_open(sim, b, b->scene->pins.place, b->scene->pins.reach, "the pins", patch,
                                    err);
    if (status)
        return status;
    b->pins->place = sim_table(sim, patch->first, sizeof *b->pins->place);
    if (!b->pins->place)
        return error_no_memory(err, "the pins");
    for (uint32_t k = 0; k < patch->first; k++)
        memcpy(b->pins->place[k], sim->position[patch->point[k]], sizeof *b->pins->place);
    b->pins->let_go = b->scene->pins.until <= 0;
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->pins) {
        patch_clear(&b->pins->patch);
        free(b->pins->place);
    }
    free(b->pins);
    b->pins = NULL;
}

static void hold(const struct pins *pins, double (*rows)[4])
{
    for (uint32_t k = 0; k < pins->patch.count && !pins->let_go; k++)
        memset(rows[pins->patch.point[k]], 0, sizeof *rows);
}

void pins_mark(const struct sim *sim, unsigned char *held)
{
    for (size_t k = 0; k < sim->balloon_count; k++) {
        const struct pins *pins = sim->balloons[k].pins;
        for (uint32_t i = 0; pins && !pins->let_go && i < pins->patch.count; i++)
            held[pins->patch.point[i]] = 1;
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
    for (uint32_t k = 0; k < pins->patch.count; k++) {
        const uint32_t p = pins->patch.point[k];
        memcpy(sim->position[p], pins->place[pins->patch.of[k]], sizeof *pins->place);
        memset(sim->velocity[p], 0, sizeof *sim->velocity);
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

/* What a cut has made of a point that is held is held there, too. */
static void copied(struct sim *sim, struct sim_balloon *b, uint32_t point, uint32_t copy, double share)
{
    (void)sim;
    (void)point;
    (void)share;
    patch_copied(&b->pins->patch, b, copy);
}

static void reorder(struct sim *sim, struct sim_balloon *b, const struct reorder *how)
{
    (void)sim;
    if (how->balloon == b)
        patch_reorder(&b->pins->patch, b);
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
                                   .copied = copied,
                                   .reorder = reorder,
                                   .product = product,
                                   .source = "points of infinite mass"};
