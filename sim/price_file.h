/*
 * What all tables of prices have in common, those of accuracy and those of effects: where they go, and the bar beside the work.
 *
 *     if (price_file_open(&file, "cost.png", err)) ...           what cannot be written or drawn is found out before the work
 *     price_watch();
 *     status = price_watched(measure(..., price_go_on, ...), err);
 *     if (price_file_save(&file, print, table, err)) ...         on stdout, and in cost.tsv
 *     price_file_close(&file);
 */
#ifndef SIM_PRICE_FILE_H
#define SIM_PRICE_FILE_H

#include "common/status.h"

#include <stdbool.h>
#include <stdio.h>

enum { PRICE_SECONDS = 60 }; /* about how long a table takes */

struct price_file {
    char *table; /* the table's name, beside a picture's; owned */
};

/* Errors: STATUS_FILE; STATUS_RESOURCE where a picture is wanted and gnuplot is missing; STATUS_NO_MEMORY. Close it in any case. */
enum status price_file_open(struct price_file *file, const char *path, struct error *err);
enum status price_file_save(const struct price_file *file, void (*print)(const void *table, FILE *stream),
                            const void *table, struct error *err);
void price_file_close(struct price_file *file);

/* Shows the share that is done; false after a signal. */
bool price_go_on(void *context, double done);
void price_watch(void);
/* Ends the bar; says by which signal the work was ended. */
enum status price_watched(enum status status, struct error *err);

#endif
