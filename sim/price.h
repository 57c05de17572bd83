/* --accuracy-cost: for main.c. */
#ifndef SIM_PRICE_H
#define SIM_PRICE_H

#include "sim/price_picture.h"

struct price_table {
    struct accuracy_table accuracy;
    struct price_pictures pictures; /* of the scene at the end of that one's span */
};

/* Measures what accuracy costs on a scene, of the points and of a picture, with a progress bar; the table
 * goes to stdout and, as FILE.tsv, beside the plot FILE.png or FILE.svg, or alone. Errors: those of
 * accuracy_measure(); STATUS_RESOURCE where gnuplot is missing, STATUS_FILE. */
enum status price_accuracy(const struct scene *scene, const struct mesh *meshes, const char *path,
                           struct error *err);

#endif
