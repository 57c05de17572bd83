/* Where the following begins: by descent. */
#include "common/array.h"
#include "common/vec3.h"
#include "surface/mesher.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/*
 * Proofs that a brick can be left out. Where it is small against sigma, the field in its middle serves
 * (sides.h). Otherwise, let all cells within `reach` of a box be of one material k (or all empty, b_k = 0).
 * Of a point of the box, let M be the sum of the one-dimensional Gaussians of the whole lattice, between
 * `least` and `most`, and at most `tail` what of it lies further than `reach` to either side. Then the near
 * cells contribute between b_k (least - tail)^3 and b_k most^3, and all others at most B 3 tail most^2, B =
 * max |b|; of area fields there are only others. If the threshold is not in between, the box is on one side
 * of it.
 */
struct bounds {
    double reach;                    /* in cells */
    bool excluded[OCTREE_MATERIALS]; /* a box in the midst of this material is on one side */
};

struct sums {
    double least, most, tail;
};

static struct sums lattice_sums(const struct field *field, const struct field_lattice *lattice, double reach)
{
    double s = field->sigma, R = field->cutoff, r = reach / s;
    if (!lattice->used)
        return (struct sums){0, 0, 0};
    if (lattice->spacing == 0)
        return (struct sums){1, 1, r < R ? erfc(r / M_SQRT2) : 0};
    /* By Poisson's sum formula the sum over the whole lattice ripples about weight s sqrt(2 pi) / spacing =
     * `mean` by at most 2 sum exp(-2 (pi j s/spacing)^2) of it; cutting off takes away no more than `cut`.
     * */
    double mean = lattice->weight * s * sqrt(2 * M_PI) / lattice->spacing, ripple = 0;
    for (int j = 1; j < 50; j++)
        ripple += 2 * exp(-2 * pow(M_PI * j * s / lattice->spacing, 2));
    double floor_value = exp(-R * R / 2), points = 2 * R * s / lattice->spacing + 1;
    double shrink = 1 - floor_value;
    double cut = lattice->weight * (points + 2) * floor_value + mean * erfc(R / M_SQRT2);
    double most = fmin(mean * (1 + ripple), mean + lattice->weight) / shrink;
    /* The first point of either tail and the integral over the rest. */
    double tail = r < R ? (2 * lattice->weight * exp(-r * r / 2) + mean * erfc(r / M_SQRT2)) / shrink : 0;
    return (struct sums){fmax(mean * (1 - ripple) - cut, 0), most, tail};
}

/* Whether a box of coefficient b, `far` being the most that others contribute, is on one side of the
 * threshold. */
static bool one_sided(double b, struct sums volume, double far, double threshold)
{
    double near = fmax(volume.least - volume.tail, 0), low = b * pow(near, 3), high = b * pow(volume.most, 3);
    return threshold < fmin(low, high) - far || threshold > fmax(low, high) + far;
}

static struct bounds bounds_at(const struct mesher *m, double reach)
{
    const struct field *field = m->field;
    struct bounds bounds = {.reach = reach};
    struct sums volume = lattice_sums(field, &field->lattice[TRACK_VOLUME], reach);
    struct sums area = lattice_sums(field, &field->lattice[TRACK_AREA], reach);
    struct sums plane = lattice_sums(field, &field->lattice[TRACK_PLANE], reach);
    double largest = 0;
    for (int k = 1; k < OCTREE_MATERIALS; k++)
        largest = fmax(largest, fabs(field->coefficient[k]));
    double far = 3 * volume.tail * volume.most * volume.most +
                 3 * (plane.tail * area.most * area.most + 2 * plane.most * area.tail * area.most);
    /* Sums are rounded: a margin well above that, well below anything that matters. */
    far = largest * (far + 1e-12);
    for (int k = 0; k < OCTREE_MATERIALS; k++)
        bounds.excluded[k] = one_sided(field->coefficient[k], volume, far, m->threshold);
    return bounds;
}

static int count_excluded(const struct bounds *bounds)
{
    int count = 0;
    for (int k = 0; k < OCTREE_MATERIALS; k++)
        count += bounds->excluded[k];
    return count;
}

/* The shortest reach that excludes as many materials as the longest does. */
static struct bounds find_bounds(const struct mesher *m)
{
    struct bounds longest = bounds_at(m, m->field->reach);
    for (double r = 0.25; r < m->field->cutoff; r += 0.125) {
        struct bounds bounds = bounds_at(m, r * m->field->sigma);
        if (bounds.excluded[0] && count_excluded(&bounds) == count_excluded(&longest))
            return bounds;
    }
    return longest;
}

/* Bricks, low and high included. */
struct box {
    int low[3], high[3];
};

struct survey {
    const int *low, *high;
    int material; /* of all leaves met so far; 0 when none */
    bool mixed;
    double volume; /* of them, within low .. high, in cells */
};

static bool survey_leaf(void *context, const struct octree_leaf *leaf)
{
    struct survey *survey = context;
    int start[3] = {leaf->x, leaf->y, leaf->z};
    double volume = 1;
    for (int axis = 0; axis < 3; axis++)
        volume *= fmin(start[axis] + leaf->side - 1, survey->high[axis]) -
                  fmax(start[axis], survey->low[axis]) + 1;
    survey->volume += volume;
    survey->mixed = survey->material && survey->material != (int)leaf->material;
    survey->material = (int)leaf->material;
    return !survey->mixed;
}

/* The material of all cells low .. high; -1 where they differ. Cells outside the cube are empty. */
static int only_material(const struct octree *tree, const int low[3], const int high[3])
{
    int side = 1 << tree->depth, inside_low[3], inside_high[3];
    double volume = 1;
    for (int axis = 0; axis < 3; axis++) {
        volume *= high[axis] - low[axis] + 1;
        inside_low[axis] = low[axis] < 0 ? 0 : low[axis];
        inside_high[axis] = high[axis] >= side ? side - 1 : high[axis];
        if (inside_low[axis] > inside_high[axis])
            return 0;
    }
    unsigned corner = octree_at(tree, low[0], low[1], low[2]);
    if (corner != octree_at(tree, high[0], high[1], high[2]))
        return -1;
    struct survey survey = {.low = inside_low, .high = inside_high};
    octree_visit(tree, inside_low, inside_high, survey_leaf, &survey);
    if (survey.mixed || (survey.material && survey.volume < volume))
        return -1;
    return survey.material;
}

static bool in_one_material(const struct mesher *m, const struct bounds *bounds, const double low[3],
                            const double high[3])
{
    int cell_low[3], cell_high[3];
    for (int axis = 0; axis < 3; axis++) {
        cell_low[axis] = (int)floor(fmax(low[axis] - bounds->reach, -1));
        cell_high[axis] = (int)floor(fmin(high[axis] + bounds->reach, m->field->side));
    }
    int material = only_material(m->field->tree, cell_low, cell_high);
    return material >= 0 && bounds->excluded[material];
}

/* Whether a box is on one side of the threshold, by the field in its middle. */
static bool far_from_threshold(const struct mesher *m, struct worker *worker, const double low[3],
                               const double high[3])
{
    double middle[3], half[3], gradient[3];
    for (int axis = 0; axis < 3; axis++) {
        half[axis] = (high[axis] - low[axis]) / 2;
        middle[axis] = low[axis] + half[axis];
    }
    const double radius = vec3_length(half);
    return sides_may_tell(&m->sides, radius) &&
           sides_tell(&m->sides, probe_value(&worker->probe, middle, gradient), radius);
}

/* Whether all corners of the bricks low .. high are proven to be on one side. A single brick's middle is
 * looked at when it is made, which gathers the fields around it anyway. */
static bool left_out(const struct mesher *m, struct worker *worker, const struct bounds *bounds,
                     const struct box *box)
{
    double start[3], end[3];
    bool single = true;
    for (int axis = 0; axis < 3; axis++) {
        single &= box->low[axis] == box->high[axis];
        start[axis] = grid_coordinate(&m->grid, box->low[axis] * BRICK);
        end[axis] = grid_coordinate(&m->grid, (box->high[axis] + 1) * BRICK);
    }
    return in_one_material(m, bounds, start, end) || (!single && far_from_threshold(m, worker, start, end));
}

/* Halves a box across its longest axis, between groups where it has several. */
static void halve(const struct box *box, struct box half[2])
{
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (box->high[k] - box->low[k] > box->high[axis] - box->low[axis])
            axis = k;
    half[0] = half[1] = *box;
    int bricks = (box->high[axis] - box->low[axis] + 1) / 2;
    half[1].low[axis] = box->low[axis] + (bricks > GRID_GROUP ? bricks & -GRID_GROUP : bricks);
    half[0].high[axis] = half[1].low[axis] - 1;
}

static bool is_longer_than(const struct box *box, int bricks)
{
    for (int axis = 0; axis < 3; axis++)
        if (box->high[axis] - box->low[axis] >= bricks)
            return true;
    return false;
}

/* Makes the bricks of a box that are not left out and not known yet. */
static void descend(const struct mesher *m, struct worker *worker, const struct bounds *bounds,
                    const struct box *box)
{
    if (worker->failed || left_out(m, worker, bounds, box))
        return;
    if (is_longer_than(box, 1)) {
        struct box half[2];
        halve(box, half);
        descend(m, worker, bounds, &half[0]);
        descend(m, worker, bounds, &half[1]);
    } else if (brick_find(m, brick_code(&m->grid, box->low)) == MESH_NONE) {
        brick_make(m, worker, box->low);
    }
}

/* What the workers share while they descend. */
struct descent {
    struct mesher *m;
    struct bounds bounds;
    struct {
        struct box *items;
        size_t count, capacity;
    } boxes; /* small ones, each a job */
    atomic_size_t done;
};

/* Cuts a box into jobs, groups of bricks: a millisecond or so of work, so that workers end together.
 * What can be left out is. */
static void plan(struct descent *d, const struct box *box)
{
    struct mesher *m = d->m;
    if (m->failed || left_out(m, m->worker[0], &d->bounds, box))
        return;
    if (is_longer_than(box, GRID_GROUP)) {
        struct box half[2];
        halve(box, half);
        plan(d, &half[0]);
        plan(d, &half[1]);
        return;
    }
    if (ARRAY_RESERVE(&d->boxes, 1))
        d->boxes.items[d->boxes.count++] = *box;
    else
        m->failed = true;
}

static void do_job(void *context, size_t index, unsigned number)
{
    struct descent *d = context;
    descend(d->m, d->m->worker[number], &d->bounds, &d->boxes.items[index]);
    size_t done = atomic_fetch_add_explicit(&d->done, 1, memory_order_relaxed) + 1;
    if (number == 0 && d->m->progress)
        d->m->progress(d->m->progress_context, (double)done / (double)d->boxes.count);
}

void seeds_descent(struct mesher *m)
{
    struct descent d = {.m = m, .bounds = find_bounds(m)};
    struct box all;
    memcpy(all.low, m->grid.brick_low, sizeof all.low);
    memcpy(all.high, m->grid.brick_high, sizeof all.high);
    plan(&d, &all);
    if (!m->failed)
        threads_run(m->pool, d.boxes.count, do_job, &d);
    free(d.boxes.items);
    bricks_join(m);
    for (uint32_t i = 0; i < m->bricks.count && !m->count_only; i++)
        follow_brick(m, i);
}
