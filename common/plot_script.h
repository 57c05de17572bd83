/* The plot as gnuplot's script: for plot.c alone. */
#ifndef COMMON_PLOT_SCRIPT_H
#define COMMON_PLOT_SCRIPT_H

#include "common/plot.h"

#include <stdio.h>

/* Writes a script that draws the plot, as SVG or else PNG, to gnuplot's standard output. */
void plot_write_script(const struct plot *plot, bool svg, FILE *script);

#endif
