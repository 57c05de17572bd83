/* --accuracy-cost: for main.c. */
#ifndef SURFACE_MAIN_COST_H
#define SURFACE_MAIN_COST_H

#include "surface/cost.h"

#include <stdio.h>

/* The table, tab-separated with a header line; then, on lines that begin with "#", the fitted orders and what
 * to set for errors of 1e-2, 1e-3 and 1e-4. */
void cost_print(const struct cost_table *table, FILE *stream);

/* Writes FILE.tsv, or the plot FILE.png or FILE.svg with the table in FILE.tsv beside it. Errors:
 * STATUS_USAGE for another extension, STATUS_RESOURCE where gnuplot is missing (the table is then
 * written), STATUS_FILE. */
enum status cost_save(const struct cost_table *table, const char *sculpture, const char *path,
                      struct error *err);

#endif
