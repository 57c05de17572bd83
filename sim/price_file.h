/*
 * What all tables of prices have in common, those of accuracy and those of effects: where they go, the bar
 * beside the work, and the picture.
 */
#ifndef SIM_PRICE_FILE_H
#define SIM_PRICE_FILE_H

#include "common/mesh.h"
#include "common/scene.h"
#include "common/status.h"

#include <stdbool.h>
#include <stdio.h>

struct sim;

enum { PRICE_SECONDS = 60 }; /* about how long a table takes */

/* A kind of table: `size` bytes, which begin as 0. */
struct price_kind {
    size_t size;
    enum status (*measure)(const struct scene *scene, const struct mesh *meshes, void *table,
                           struct error *err);
    void (*print)(const void *table, FILE *stream);
    enum status (*draw)(const void *table, const char *scene, const char *path, struct error *err);
};

/* Whether a table, and the picture where the name is one's, could be written. Errors: STATUS_FILE,
 * STATUS_RESOURCE where gnuplot is missing, STATUS_NO_MEMORY. */
enum status price_check(const char *path, struct error *err);

/* Measures a table; prints it on stdout and into path, whose name ends in .tsv, or beside the picture of it
 * that path is (.png, .svg). What cannot be written or drawn is found out before the work. Errors:
 * STATUS_FILE; STATUS_RESOURCE where a picture is wanted and gnuplot is missing; STATUS_NO_MEMORY;
 * those of interrupt.h after a signal; what measure says. */
enum status price_make(const struct price_kind *kind, const struct scene *scene, const struct mesh *meshes,
                       const char *path, struct error *err);

/* For whoever measures: shows the share that is done; false after a signal. `context`: where a part of the
 * work lies in the whole (struct price_part), or NULL: it is the whole. */
struct price_part {
    double from, to;
};
bool price_go_on(void *context, double done);

/* The same within a step, with nothing to show. */
bool price_goes_on(const struct sim *sim);

#endif
