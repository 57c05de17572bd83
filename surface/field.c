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
    if (volume->used)
        field->layer[field->layers++] = (struct field_layer){{TRACK_VOLUME, TRACK_VOLUME, TRACK_VOLUME}};
    for (int axis = 0; axis < 3 && area; axis++) {
        struct field_layer *layer = &field->layer[field->layers++];
        *layer = (struct field_layer){{TRACK_AREA, TRACK_AREA, TRACK_AREA}};
        layer->track[axis] = TRACK_PLANE;
    }
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
    distribution_fill(&field->distribution, field->cutoff);
    field->profile_room = (int)fmin(field->side + 2, ceil(2 * field->reach) + 5);
    return STATUS_OK;
}

void field_cut_earlier(struct field *cut, const struct field *field, double cutoff)
{
    *cut = *field;
    if (cutoff < field->cutoff) {
        cut->cutoff = cutoff;
        cut->reach = cutoff * field->sigma;
        distribution_fill(&cut->distribution, cutoff);
    }
}

/* The continuum: the distribution function of the cut-off normal, less a half. */
static void fill_continuum(const struct field *field, double x, struct profile *profile)
{
    double *sum = profile->sum[TRACK_VOLUME], *slope = profile->slope[TRACK_VOLUME];
    double per_sigma = 1 / field->sigma;
    for (int plane = profile->first; plane <= profile->last; plane++, sum++, slope++) {
        double t = plane - x;
        if (fabs(t) < field->reach) {
            *sum = distribution_value(&field->distribution, t * per_sigma, slope);
            *slope *= -per_sigma;
        } else {
            *sum = copysign(0.5, t);
            *slope = 0;
        }
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
        *slope++ = total_slope;
    }
}

/* floor(x), kept to the planes there are. Without a call of the library's, which
 * would be the slowest part. */
static int plane_below(const struct field *field, double x)
{
    return x < 0 ? 0 : x > field->side + 1 ? field->side + 1 : (int)x;
}

/* No lattice point within reach lies below plane `first`, nor at or above plane `last`. */
void profile_fill(const struct field *field, double x, struct profile *profile)
{
    profile->first = plane_below(field, x - field->reach);
    profile->last = plane_below(field, x + field->reach + 1);
    for (int track = 0; track < FIELD_TRACKS; track++) {
        const struct field_lattice *lattice = &field->lattice[track];
        if (lattice->used && lattice->spacing == 0)
            fill_continuum(field, x, profile);
        else if (lattice->used)
            fill_lattice(field, x, lattice, profile, profile->sum[track], profile->slope[track]);
    }
}

void field_reach(const struct field *field, const double low[3], const double high[3], int cell_low[3],
                 int cell_high[3])
{
    /* A face may belong to the cell below it. */
    int below = field->lattice[TRACK_AREA].used;
    for (int axis = 0; axis < 3; axis++) {
        cell_low[axis] = (int)fmin(fmax(floor(low[axis] - field->reach) - below, 0), field->side);
        cell_high[axis] = (int)fmax(fmin(floor(high[axis] + field->reach), field->side - 1), -1);
    }
}

bool profiles_init(struct profiles *profiles, const struct field *field)
{
    size_t room = (size_t)field->profile_room;
    double *next = profiles->storage = array_new(room * 3 * FIELD_TRACKS * 2, sizeof *next);
    for (int axis = 0; next && axis < 3; axis++)
        for (int track = 0; track < FIELD_TRACKS; track++) {
            profiles->axis[axis].sum[track] = next;
            profiles->axis[axis].slope[track] = next + room;
            next += 2 * room;
        }
    return next;
}

void profiles_clear(struct profiles *profiles)
{
    free(profiles->storage);
    *profiles = (struct profiles){0};
}
