#include "surface/field.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>

#define SQRT_2PI 2.5066282746310005024

static enum status check(const struct field_settings *s, struct error *err)
{
    if (s->fields_per_cube != FIELDS_EXACT) {
        long side = lround(cbrt((double)labs(s->fields_per_cube)));
        if (s->fields_per_cube < 0 || side > FIELDS_SIDE_MAX || side * side * side != s->fields_per_cube)
            return error_set(
                err, STATUS_RANGE,
                "%ld fields per cube cannot be a regular n x n x n grid: use exact, 0, 1, 8, 27, 64, "
                "125, 216, 343, 512 ... up to 4096",
                s->fields_per_cube);
    }
    if (!(s->fields_per_area >= 0 && s->fields_per_area <= 1e7))
        return error_set(err, STATUS_RANGE, "%g fields per area: must be from 0 to 1e7", s->fields_per_area);
    if (!(s->sigma >= 0.01 && s->sigma <= 1e5))
        return error_set(err, STATUS_RANGE, "a sigma of %g cells: must be from 0.01 to 1e5", s->sigma);
    if (!(s->cutoff >= 2 && s->cutoff <= 8))
        return error_set(err, STATUS_RANGE, "a cut-off of %g sigma: must be from 2 to 8", s->cutoff);
    if (s->fields_per_cube == 0 && s->fields_per_area == 0)
        return error_set(err, STATUS_RANGE, "no fields per cube and none per area: there is no field");
    return STATUS_OK;
}

static void set_lattices(struct field *field, const struct field_settings *settings)
{
    double normal = 1 / (field->sigma * SQRT_2PI);
    struct field_lattice *volume = &field->lattice[TRACK_VOLUME];
    *volume = (struct field_lattice){.used = settings->fields_per_cube != 0};
    if (settings->fields_per_cube > 0) {
        volume->spacing = 1 / round(cbrt((double)settings->fields_per_cube));
        volume->offset = 0.5;
        volume->weight = volume->spacing * normal;
    }
    bool area = settings->fields_per_area > 0;
    double spacing = area ? field->side / sqrt(settings->fields_per_area) : 1;
    field->lattice[TRACK_AREA] = (struct field_lattice){area, spacing, 0.5, spacing * normal};
    field->lattice[TRACK_PLANE] = (struct field_lattice){area, 1, 0, 1};
}

/* The largest sum over a lattice of its Gaussians. The sum over all integers of exp(-k^2 c) is largest on a
 * point, and sum_{k >= 1} exp(-k^2 c) <= integral of exp(-t^2 c) over t > 0. */
static double largest_sum(const struct field *field, const struct field_lattice *lattice)
{
    if (lattice->spacing == 0)
        return 1;
    return lattice->weight * (1 + field->sigma * SQRT_2PI / lattice->spacing);
}

/* The largest sum over a lattice of the absolute slopes |t|/s^2 exp(-t^2/2s^2): each is at most
 * exp(-1/2)/s, and to either side of that maximum the sum is below the first term plus the integral. */
static double largest_slope_sum(const struct field *field, const struct field_lattice *lattice)
{
    double shift = 1 - exp(-field->cutoff * field->cutoff / 2);
    return lattice->weight * (4 * exp(-0.5) / field->sigma + 2 / lattice->spacing) / shift;
}

static double largest_steepness(const struct field *field)
{
    double low = 0, high = 0, sum[FIELD_TRACKS], slope[FIELD_TRACKS];
    for (int k = 0; k < OCTREE_MATERIALS; k++) {
        low = fmin(low, field->coefficient[k]);
        high = fmax(high, field->coefficient[k]);
    }
    for (int k = 0; k < FIELD_TRACKS; k++) {
        sum[k] = largest_sum(field, &field->lattice[k]);
        slope[k] = largest_slope_sum(field, &field->lattice[k]);
    }
    /* The exact field's derivative along a direction is its convolution with the Gaussian's, so it is at
     * most (high - low) times the mass of the positive half of that: 1/(s sqrt(2 pi)). Cutting off by a box
     * adds the steps at its faces, exp(-R^2/2) of the same for each axis, and divides by the mass within.
     * */
    double steepness = 0;
    const struct field_lattice *volume = &field->lattice[TRACK_VOLUME];
    if (volume->used && volume->spacing == 0)
        steepness += (high - low) * (1 + sqrt(3) * exp(-field->cutoff * field->cutoff / 2)) /
                     (field->sigma * SQRT_2PI * pow(erf(field->cutoff / M_SQRT2), 3));
    else if (volume->used)
        steepness += fmax(-low, high) * sqrt(3) * slope[TRACK_VOLUME] * pow(sum[TRACK_VOLUME], 2);
    if (field->lattice[TRACK_AREA].used)
        steepness += fmax(-low, high) * 3 * sqrt(3) *
                     (slope[TRACK_PLANE] * pow(sum[TRACK_AREA], 2) +
                      2 * slope[TRACK_AREA] * sum[TRACK_AREA] * sum[TRACK_PLANE]);
    return steepness;
}

enum status field_init(struct field *field, const struct octree *tree, const struct field_settings *settings,
                       struct error *err)
{
    if (check(settings, err))
        return STATUS_RANGE;
    *field = (struct field){.tree = tree,
                            .side = 1 << tree->depth,
                            .sigma = settings->sigma,
                            .cutoff = settings->cutoff,
                            .reach = settings->cutoff * settings->sigma};
    for (int k = 1; k < OCTREE_MATERIALS; k++)
        field->coefficient[k] = (double)tree->coefficient[k];
    set_lattices(field, settings);
    field->steepness = largest_steepness(field);
    field->profile_room = (int)fmin(field->side + 2, ceil(2 * field->reach) + 5);
    return STATUS_OK;
}

/* The continuum: the distribution function of the cut-off normal, less a half. */
static void fill_continuum(const struct field *field, double x, struct profile *profile)
{
    double *sum = profile->sum[TRACK_VOLUME], *slope = profile->slope[TRACK_VOLUME];
    double mass = erf(field->cutoff / M_SQRT2);
    for (int plane = profile->first; plane <= profile->last; plane++) {
        double t = plane - x, u = t / field->sigma;
        bool within = fabs(t) < field->reach;
        *sum++ = within ? 0.5 * erf(u / M_SQRT2) / mass : copysign(0.5, t);
        if (slope)
            *slope++ = within ? -exp(-u * u / 2) / (field->sigma * SQRT_2PI * mass) : 0;
    }
}

static void fill_lattice(const struct field *field, double x, const struct field_lattice *lattice,
                         const struct profile *profile, double *sum, double *slope)
{
    double floor_value = exp(-field->cutoff * field->cutoff / 2);
    double scale = lattice->weight / (1 - floor_value), total = 0, total_slope = 0;
    double j = fmax(ceil((x - field->reach) / lattice->spacing - lattice->offset), 0);
    for (int plane = profile->first; plane <= profile->last; plane++) {
        for (; (j + lattice->offset) * lattice->spacing < plane; j++) {
            double t = (j + lattice->offset) * lattice->spacing - x, u = t / field->sigma;
            if (fabs(t) >= field->reach) {
                if (t > 0)
                    break;
                continue;
            }
            double bell = exp(-u * u / 2);
            total += scale * (bell - floor_value);
            total_slope += scale * bell * u / field->sigma;
        }
        *sum++ = total;
        if (slope)
            *slope++ = total_slope;
    }
}

static int clamp_plane(const struct field *field, double plane)
{
    return (int)fmin(fmax(plane, 0), field->side + 1);
}

/* No lattice point within reach lies below plane `first`, nor at or above plane `last`. */
void profile_fill(const struct field *field, double x, struct profile *profile)
{
    profile->first = clamp_plane(field, floor(x - field->reach));
    profile->last = clamp_plane(field, floor(x + field->reach) + 1);
    for (int track = 0; track < FIELD_TRACKS; track++) {
        const struct field_lattice *lattice = &field->lattice[track];
        if (lattice->used && lattice->spacing == 0)
            fill_continuum(field, x, profile);
        else if (lattice->used)
            fill_lattice(field, x, lattice, profile, profile->sum[track], profile->slope[track]);
    }
}

enum status probe_init(struct probe *probe, const struct field *field, struct error *err)
{
    *probe = (struct probe){.field = field};
    size_t room = (size_t)field->profile_room;
    probe->storage = array_new(room * 3 * FIELD_TRACKS * 2, sizeof *probe->storage);
    if (!probe->storage)
        return error_no_memory(err, "the field");
    double *next = probe->storage;
    for (int axis = 0; axis < 3; axis++)
        for (int track = 0; track < FIELD_TRACKS; track++) {
            probe->axis[axis].sum[track] = next;
            probe->axis[axis].slope[track] = next + room;
            next += 2 * room;
        }
    return STATUS_OK;
}

void probe_clear(struct probe *probe)
{
    for (int k = 0; k < FIELD_WINDOWS; k++)
        free(probe->window[k].near.items);
    free(probe->storage);
    *probe = (struct probe){0};
}

/* The fields that reach some point of this cell; kept for the next points in it. */
static const struct field_items *near_cell(struct probe *probe, const int cell[3])
{
    int slot = (cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4;
    const int *kept = probe->window[slot].cell;
    struct field_items *near = &probe->window[slot].near;
    if (probe->window[slot].valid && kept[0] == cell[0] && kept[1] == cell[1] && kept[2] == cell[2])
        return near;
    double low[3], high[3];
    int cell_low[3], cell_high[3];
    for (int axis = 0; axis < 3; axis++) {
        probe->window[slot].cell[axis] = cell[axis];
        low[axis] = cell[axis];
        high[axis] = cell[axis] + 1;
    }
    field_reach(probe->field, low, high, cell_low, cell_high);
    near->count = 0;
    probe->window[slot].valid = field_gather(probe->field, cell_low, cell_high, near);
    if (!probe->window[slot].valid) {
        probe->failed = true;
        near->count = 0;
    }
    return near;
}

/* An item's one-dimensional sum along an axis and its slope. */
static double item_sum(const struct profile *p, const struct field_item *item, int axis, double *slope)
{
    int low = profile_index(p->first, p->last, item->low[axis]), track = item->track[axis];
    int high = profile_index(p->first, p->last, item->high[axis]);
    *slope = p->slope[track][high] - p->slope[track][low];
    return p->sum[track][high] - p->sum[track][low];
}

static double add_up(const struct profile axis[3], const struct field_items *near, double gradient[3])
{
    double value = 0;
    for (size_t i = 0; i < near->count; i++) {
        const struct field_item *item = &near->items[i];
        double sum[3], slope[3];
        if ((sum[0] = item_sum(&axis[0], item, 0, &slope[0])) == 0 ||
            (sum[1] = item_sum(&axis[1], item, 1, &slope[1])) == 0 ||
            (sum[2] = item_sum(&axis[2], item, 2, &slope[2])) == 0)
            continue;
        double zy = item->weight * sum[2] * sum[1];
        value += zy * sum[0];
        gradient[0] += zy * slope[0];
        gradient[1] += item->weight * sum[2] * slope[1] * sum[0];
        gradient[2] += item->weight * slope[2] * sum[1] * sum[0];
    }
    return value;
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
        profile_fill(probe->field, point[axis], &probe->axis[axis]);
    }
    const struct field_items *near = near_cell(probe, cell);
    return add_up(probe->axis, near, gradient);
}
