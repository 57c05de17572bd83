/* A patch of the skin that is held where it is: no force moves it. The last of all effects, since it takes
 * away what the others add. */
#include "sim/effects.h"
#include "sim/patch.h"
#include "sim/pins.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

struct pins {
    uint32_t *point; /* [count] owned */
    uint32_t count;
    double (*place)[4]; /* [count] where they are held; owned */
    uint64_t let_go;    /* 1: they are held no longer */
};

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->pins.on;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    struct pins *pins = b->pins = calloc(1, sizeof *pins);
    if (!pins)
        return error_no_memory(err, "the pins");
    enum status status = patch_find(sim, b, b->scene->pins.place, b->scene->pins.reach, &pins->point,
                                    &pins->count, err);
    if (status)
        return status;
    pins->place = sim_table(sim, pins->count, sizeof *pins->place);
    if (!pins->place)
        return error_no_memory(err, "the pins");
    for (uint32_t i = 0; i < pins->count; i++)
        memcpy(pins->place[i], sim->position[pins->point[i]], sizeof pins->place[i]);
    pins->let_go = b->scene->pins.until <= 0;
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->pins) {
        free(b->pins->point);
        free(b->pins->place);
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
        memcpy(sim->position[pins->point[i]], pins->place[i], sizeof pins->place[i]);
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
    reorder_points(how, b->pins->point, b->pins->count);
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
