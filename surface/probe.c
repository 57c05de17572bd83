#include "surface/probe.h"

#include <math.h>

enum status probe_init(struct probe *probe, const struct field *field, struct error *err)
{
    *probe = (struct probe){.field = field};
    if (!profiles_init(&probe->profiles, field))
        return error_no_memory(err, "the field");
    return STATUS_OK;
}

void probe_clear(struct probe *probe)
{
    for (int k = 0; k < PROBE_WINDOWS; k++)
        window_clear(&probe->kept[k].near);
    profiles_clear(&probe->profiles);
    *probe = (struct probe){0};
}

/* The fields that reach some point of this cell; kept for the next points in it. NULL: no memory. */
static const struct window *near_cell(struct probe *probe, const int cell[3])
{
    int slot = (cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4;
    int *kept = probe->kept[slot].cell;
    struct window *near = &probe->kept[slot].near;
    if (probe->kept[slot].valid && kept[0] == cell[0] && kept[1] == cell[1] && kept[2] == cell[2])
        return near;
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        kept[axis] = cell[axis];
        low[axis] = cell[axis];
        high[axis] = cell[axis] + 1;
    }
    probe->kept[slot].valid = window_fill(near, probe->field, low, high);
    probe->failed |= !probe->kept[slot].valid;
    return probe->kept[slot].valid ? near : NULL;
}

double probe_value(struct probe *probe, const double point[3], double gradient[3])
{
    int cell[3];
    probe->evaluations++;
    gradient[0] = gradient[1] = gradient[2] = 0;
    for (int axis = 0; axis < 3; axis++) {
        double reach = probe->field->reach;
        if (!(point[axis] > -reach && point[axis] < probe->field->side + reach))
            return 0;
        cell[axis] = (int)floor(point[axis]);
    }
    const struct window *near = near_cell(probe, cell);
    return near ? window_value(near, point, &probe->profiles, gradient) : 0;
}
