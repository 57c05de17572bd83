/* The table of --accuracy-cost as a picture. */
#ifndef SIM_PRICE_PLOT_H
#define SIM_PRICE_PLOT_H

#include "sim/price.h"

/* Error and seconds of each method, one colour a family, above a broad line along the best; what auto picked
 * beside its marks. Below it, where pictures were drawn, the error and seconds of each order of triangles.
 * Errors: those of plot_save(). */
enum status price_plot(const struct price_table *table, const char *scene, const char *path,
                       struct error *err);

#endif
