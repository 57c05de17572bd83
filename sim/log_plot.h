/* The log as a picture: pressure, radius, energy and pieces over time. */
#ifndef SIM_LOG_PLOT_H
#define SIM_LOG_PLOT_H

#include "common/status.h"

#include <stddef.h>

/* Draws the rows of a log, which begin with its header (sim_log_rows()), into a file that common/plot.h can
 * write; `title` stands above. Errors: those of plot_save(). */
enum status log_plot_save(const char *rows, size_t bytes, const char *title, const char *path,
                          struct error *err);

#endif
