/* What --info and --json print: for main.c. */
#ifndef SURFACE_MAIN_INFO_H
#define SURFACE_MAIN_INFO_H

#include "surface/census.h"

struct surface_info {
    const struct mesh *mesh;
    const struct surface_options *options;
    const struct surface_stats *stats;
    struct surface_shape shape;
    struct surface_census census;
    struct surface_distance distance;
};

/* One figure a line, its name first; or one JSON object. */
void info_print_text(const struct surface_info *info);
void info_print_json(const struct surface_info *info);

#endif
