/* --effect-cost: for main.c. */
#ifndef SIM_PRICE_EFFECTS_H
#define SIM_PRICE_EFFECTS_H

#include "sim/effect_cost.h"

/* Measures what each effect costs on a scene, and what it changes, with a progress bar; the table
 * goes to stdout and, as FILE.tsv, beside the picture FILE.png or FILE.svg, or alone. Errors: those
 * of effect_cost_measure(); STATUS_INPUT for a scene without effects; STATUS_RESOURCE where gnuplot
 * is missing, STATUS_FILE. */
enum status price_effects(const struct scene *scene, const struct mesh *meshes, const char *path,
                          struct error *err);

/* Whether that could begin: the errors that it has before a step is taken. */
enum status price_effects_check(const struct scene *scene, const char *path, struct error *err);

#endif
