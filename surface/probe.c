#include "surface/probe.h"

#include <math.h>

enum status probe_init(struct probe *probe, const struct field *field, struct error *err)
{
    *probe = (struct probe){.field = field, .region = 1};
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

/* Gathering the fields of a window takes as long as some tens of values: it is made wide enough for a few
 * hundred points of a surface, and for neighbouring windows not to overlap by more than they are wide. */
void probe_expect(struct probe *probe, double spacing)
{
    enum { POINTS = 16 }; /* along a side */
    double wanted = ceil(fmax(POINTS * spacing, 2 * probe->field->reach));
    probe->region = (int)fmin(wanted, probe->field->side);
}

/* The fields that reach some point of this region; kept for the next points in it. NULL: no memory. */
static const struct window *near_region(struct probe *probe, const int region[3])
{
    int slot = (region[0] & 3) | (region[1] & 3) << 2 | (region[2] & 3) << 4;
    int *kept = probe->kept[slot].region;
    struct window *near = &probe->kept[slot].near;
    if (probe->kept[slot].valid && kept[0] == region[0] && kept[1] == region[1] && kept[2] == region[2])
        return near;
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        kept[axis] = region[axis];
        low[axis] = (double)region[axis] * probe->region;
        high[axis] = low[axis] + probe->region;
    }
    probe->kept[slot].valid = window_fill(near, probe->field, low, high);
    probe->failed |= !probe->kept[slot].valid;
    return probe->kept[slot].valid ? near : NULL;
}

double probe_value(struct probe *probe, const double point[3], double gradient[3])
{
    int region[3];
    probe->evaluations++;
    gradient[0] = gradient[1] = gradient[2] = 0;
    for (int axis = 0; axis < 3; axis++) {
        double reach = probe->field->reach;
        if (!(point[axis] > -reach && point[axis] < probe->field->side + reach))
            return 0;
        region[axis] = (int)floor(point[axis] / probe->region);
    }
    const struct window *near = near_region(probe, region);
    return near ? window_value(near, point, &probe->profiles, gradient) : 0;
}
