/*
 * The boxes of fields that reach some region, gathered from the octree and sorted into rows along x: what the
 * sum at a point runs over. In each row neighbouring leaves of one material are one run, so big leaves and
 * long bars cost as little as one cell.
 */
#ifndef SURFACE_WINDOW_H
#define SURFACE_WINDOW_H

#include "surface/field.h"

/* Fields along x from plane `begin` to plane `end`. */
struct window_run {
    double weight;
    int16_t begin, end;
};

struct window_pending {
    struct window_run run;
    uint32_t row;
};

/* Row (layer, y, z) is number (layer size[2] + z - low[2]) size[1] + y - low[1]; along an axis whose track is
 * TRACK_PLANE y and z number planes, else cells. Its runs are run[start[row]] .. run[start[row + 1] - 1]. */
struct window {
    const struct field *field; /* borrowed */
    int low[3], size[3];       /* in cells, with room for the plane above the last */
    size_t rows;
    uint32_t *start;
    struct window_run *run;
    size_t start_room, run_room;
    uint32_t *last; /* [rows] while filling: the row's last pending run + 1 */
    size_t last_room;
    struct {
        struct window_pending *items;
        size_t count, capacity;
    } pending;
};

static inline size_t window_row(const struct window *window, int layer, int y, int z)
{
    return (size_t)(layer * window->size[2] + z - window->low[2]) * (size_t)window->size[1] +
           (size_t)(y - window->low[1]);
}

/* Gathers all fields that reach some point of low .. high. *window is {0} or was filled before. False when
 * there is no memory; it can be filled again. */
bool window_fill(struct window *window, const struct field *field, const double low[3], const double high[3]);
void window_clear(struct window *window);

/* The field and its gradient where axis[0], [1] and [2] are the profiles of x, y and z. */
double window_sum(const struct window *window, const struct profile *const axis[3], double gradient[3]);

/* The field and its gradient at a point of low .. high; *profiles becomes that of the point. */
double window_value(const struct window *window, const double point[3], struct profiles *profiles,
                    double gradient[3]);

#endif
