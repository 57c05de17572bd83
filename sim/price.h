/* --accuracy-cost: for main.c. */
#ifndef SIM_PRICE_H
#define SIM_PRICE_H

#include "sim/accuracy.h"

/* Measures what accuracy costs on a scene, with a progress bar; the table goes to stdout and, as FILE.tsv, beside the plot FILE.png or
 * FILE.svg, or alone. Errors: those of accuracy_measure(); STATUS_RESOURCE where gnuplot is missing,
 * STATUS_FILE. */
enum status price_accuracy(const struct scene *scene, const struct mesh *meshes, const char *path,
                           struct error *err);

#endif
