/*
 * What each effect costs on the user's own scene, and what it does to the answer: the scene is run whole and
 * without one effect after the other.
 *
 *     struct effect_cost_table *table = calloc(1, sizeof *table);
 *     if (effect_cost_measure(&scene, meshes, &options, table, err)) ...
 *     effect_cost_say(table, &table->rows[i], text, sizeof text)
 *
 * The whole and the rest go through the same stretches of time in turns, so that other programs weigh on both
 * alike; seconds are the thread's own on a processor, and of several goes through a stretch the shortest
 * counts. States are compared at the ends of the stretches until something breaks in one of the two; from
 * there on only positions are: single runs say little point by point.
 */
#ifndef SIM_EFFECT_COST_H
#define SIM_EFFECT_COST_H

#include "sim/pricing.h"

enum { EFFECT_COST_ROWS_MAX = 32, EFFECT_COST_STRETCHES = 16 };

/* Below this share of the radius a change cannot be seen: a tenth of a pixel, where
 * the radius has a hundred. */
#define EFFECT_COST_VISIBLE 1e-3

/* The scene without one effect. */
struct effect_cost_row {
    const struct effect *effect;
    /* why it could not be left out, or what became of the run without it; "": nothing did */
    char refused[1024];
    bool failed;         /* the latter */
    const char *instead; /* what did its work; NULL: nothing */
    double seconds;      /* a step, without it */
    /* Of the whole's time that is its own; below 0: of the time of the run without it, which takes longer,
     * what it saves. */
    double share;
    double bytes;                      /* that are its own */
    double position, volume, pressure; /* largest changes: RMS in mean radii; relative to the largest */
    /* as position, from when the skin breaks in one of the two: chance has its part in that */
    double position_after;
    double first_break; /* s, without it; INFINITY: nothing let go */
    uint64_t steps;
    uint32_t pieces; /* at the end */
};

struct effect_cost_table {
    struct effect_cost_row rows[EFFECT_COST_ROWS_MAX];
    size_t count;
    double span, end; /* s: how far the runs went; the scene's end */
    double seconds;   /* a step of the whole */
    size_t bytes;     /* of the whole */
    double first_break;
    uint64_t steps;
    uint32_t pieces;
    int goes; /* through each stretch */
};

/* meshes as for sim_open(). Errors: those of sim_open() and sim_step() for the whole scene;
 * STATUS_INPUT where that ends before a step; STATUS_INTERRUPTED; STATUS_NO_MEMORY. */
enum status effect_cost_measure(const struct scene *scene, const struct mesh *meshes,
                                const struct pricing_options *options, struct effect_cost_table *table,
                                struct error *err);

/* Whether the skin first breaks at another time, by more than one in a hundred, or only with or without
 * it. */
bool effect_cost_breaks_otherwise(const struct effect_cost_table *table, const struct effect_cost_row *row);

/* "drag: 3 % of the time, changes positions by 2e-06 radii: you may not need it". */
void effect_cost_say(const struct effect_cost_table *table, const struct effect_cost_row *row, char *text,
                     size_t size);

#endif
