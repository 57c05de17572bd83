/* The table of --accuracy-cost as a picture. */
#ifndef SIM_PRICE_PLOT_H
#define SIM_PRICE_PLOT_H

#include "sim/accuracy.h"

/* Error and seconds of each method, one colour a family, above a broad line along the best; what auto picked beside its marks; and
 * beside all that, where there are ensembles, the pieces that each method comes to. Errors: those of plot_save(). */
enum status price_plot(const struct accuracy_table *table, const char *scene, const char *path,
                       struct error *err);

#endif
