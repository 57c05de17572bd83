/*
 * The field at single points.
 *
 *     struct probe probe;
 *     if (probe_init(&probe, &field, err)) ...          one for each thread: it keeps what it found near by
 *     value = probe_value(&probe, point, gradient);
 *     if (probe.failed) ...                             memory ran out in one of the calls so far
 *     probe_clear(&probe);
 */
#ifndef SURFACE_PROBE_H
#define SURFACE_PROBE_H

#include "surface/window.h"

enum { PROBE_WINDOWS = 64 };

/* Scratch, and the fields around the last few regions. */
struct probe {
    const struct field *field; /* borrowed */
    int region;                /* cells along an axis whose points share a window */
    struct {
        bool valid;
        int region[3]; /* its place, in regions */
        struct window near;
    } kept[PROBE_WINDOWS];
    struct profiles profiles;
    bool failed;          /* memory ran out: values since then are 0 */
    uint64_t evaluations; /* so far */
};

/* Errors: STATUS_NO_MEMORY. */
enum status probe_init(struct probe *probe, const struct field *field, struct error *err);
void probe_clear(struct probe *probe);

/* Prepares for many points on a surface, each about `spacing` cells from the next. Values are
 * the same, only sooner. */
void probe_expect(struct probe *probe, double spacing);

/* The field at a point, and its gradient. */
double probe_value(struct probe *probe, const double point[3], double gradient[3]);

#endif
