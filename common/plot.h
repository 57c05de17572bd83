/*
 * Plots, drawn by the program gnuplot, which reads a script on its standard input and writes the picture to
 * its standard output: no shell, no file in between.
 *
 *     const struct plot_series series[] = {
 *         {.name = "rk4", .style = PLOT_CURVE, .x = errors, .y = seconds, .count = count}};
 *     const struct plot_panel panels[] = {
 *         {.title = "Price of accuracy", .log_x = true, .log_y = true, .series = series, .series_count = 1}};
 *     const struct plot plot = {.title = "fox.cfg", .panels = panels, .panel_count = 1, .columns = 1};
 *     if (plot_check("cost.png", err)) ...            before the long work: no gnuplot, no plot
 *     if (plot_save(&plot, "cost.png", err)) ...
 *
 * Enough for a work-precision diagram (curves on logarithmic axes), a time series (lines) and bars.
 * Points that cannot be drawn, those not finite and those not above 0 on a logarithmic axis, are
 * left out and break a line.
 */
#ifndef COMMON_PLOT_H
#define COMMON_PLOT_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>

enum plot_style {
    PLOT_LINE,     /* for many points */
    PLOT_CURVE,    /* a line with a mark at each point, for few */
    PLOT_POINTS,   /* marks only */
    PLOT_UNDERLAY, /* a broad pale line below all others, which marks some of them */
    PLOT_BARS,     /* a bar a point, standing on 0 (on a logarithmic axis: on its lower end); x is not read */
};

enum { PLOT_COLOURS = 6, PLOT_BLACK }; /* colours count from 1 */
enum { PLOT_MARKS = 5, PLOT_RING };    /* so do marks */

/* All is borrowed. Text is UTF-8 and drawn as it is. */
struct plot_series {
    const char *name; /* in the key; NULL: not there */
    enum plot_style style;
    const double *x, *y;      /* [count] */
    const char *const *label; /* [count] beside each point, or below each bar; NULL: none */
    size_t count;
    int colour, mark;  /* 0: by its place among the series */
    bool labels_below; /* all but the first, on the left: where labels would cover one another */
};

struct plot_panel {
    const char *title, *x_label, *y_label; /* NULL: none */
    bool log_x, log_y;
    bool from_zero, whole; /* a linear y begins at 0 where nothing is below; has tics at whole numbers only */
    const struct plot_series *series; /* [series_count]; bars and others do not mix in a panel */
    size_t series_count;
    bool key_outside; /* right of the axes: for many series */
};

struct plot {
    const char *title;               /* above all panels; NULL: none */
    const struct plot_panel *panels; /* [panel_count] row by row */
    size_t panel_count, columns;     /* columns at least 1 */
    size_t width, height;            /* of a panel, in pixels; 0: 620 and 470 */
};

/* True when the name ends in .png or .svg, upper or lower case. */
bool plot_is_file_name(const char *path);

/* What the table beside a plot is called: as the plot, but for its extension .tsv, which the name of a table
 * has, upper or lower case. `path` ends in one of the three; free() the result. NULL: no memory. */
char *plot_table_name(const char *path);

/* Whether plot_save() could begin. Errors: STATUS_USAGE for another extension; STATUS_RESOURCE where gnuplot
 * is not installed, with how to get it. */
enum status plot_check(const char *path, struct error *err);

/* Draws into path, which is replaced when all went well and else stays as it was. Errors: those of
 * plot_check(); STATUS_FILE; STATUS_NO_MEMORY; STATUS_RESOURCE with the first line of gnuplot's complaint. */
enum status plot_save(const struct plot *plot, const char *path, struct error *err);

#endif
