#include "surface/window.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static bool push(struct window *w, size_t row, struct window_run run)
{
    if (!ARRAY_RESERVE(&w->pending, 1))
        return false;
    w->pending.items[w->pending.count++] = (struct window_pending){run, (uint32_t)row};
    w->last[row] = (uint32_t)w->pending.count;
    return true;
}

/* Leaves of a row come in the order of x, whatever the region, so runs join in the same way in each. */
static bool push_box(struct window *w, const struct octree_leaf *leaf)
{
    struct window_run run = {w->field->coefficient[leaf->material], (int16_t)leaf->x,
                             (int16_t)(leaf->x + leaf->side)};
    int y_first = larger(leaf->y, w->low[1]), z_first = larger(leaf->z, w->low[2]);
    int y_end = smaller(leaf->y + leaf->side, w->low[1] + w->size[1] - 1);
    int z_end = smaller(leaf->z + leaf->side, w->low[2] + w->size[2] - 1);
    for (int z = z_first; z < z_end; z++) {
        size_t row = window_row(w, 0, y_first, z);
        for (int y = y_first; y < y_end; y++, row++) {
            struct window_run *before = w->last[row] ? &w->pending.items[w->last[row] - 1].run : NULL;
            if (before && before->end == run.begin && before->weight == run.weight)
                before->end = run.end;
            else if (!push(w, row, run))
                return false;
        }
    }
    return true;
}

/* What face fields need to know of the face that they lie on. */
struct face {
    int layer, axis, plane;
    int outside; /* the cell beyond it, along axis */
    double weight;
};

/* The runs of a face's row along x from `begin` to `end`, at y and z, where it borders on emptiness. */
static bool push_row(struct window *w, const struct face *face, int begin, int end, int y, int z)
{
    int cell[3] = {begin, y, z};
    cell[face->axis] = face->outside;
    size_t row = window_row(w, face->layer, face->axis == 1 ? face->plane : y,
                            face->axis == 2 ? face->plane : z);
    int first = begin;
    for (bool open = false; begin <= end; begin++) {
        cell[0] = begin;
        bool exposed = begin < end && octree_at(w->field->tree, cell[0], cell[1], cell[2]) == 0;
        first = exposed && !open ? begin : first;
        if (open && !exposed &&
            !push(w, row, (struct window_run){face->weight, (int16_t)first, (int16_t)begin}))
            return false;
        open = exposed;
    }
    return true;
}

static bool push_cell_across_x(struct window *w, const struct face *face, int y, int z)
{
    struct window_run run = {face->weight, (int16_t)face->plane, (int16_t)(face->plane + 1)};
    return octree_at(w->field->tree, face->outside, y, z) != 0 ||
           push(w, window_row(w, face->layer, y, z), run);
}

/* The exposed part of a leaf's face, as far as it is in the window. */
static bool push_face(struct window *w, const struct octree_leaf *leaf, int axis, bool upper)
{
    int first[3] = {leaf->x, leaf->y, leaf->z}, end[3];
    struct face face = {.layer = w->field->layers - 3 + axis,
                        .axis = axis,
                        .plane = first[axis] + (upper ? leaf->side : 0),
                        .weight = w->field->coefficient[leaf->material]};
    face.outside = upper ? face.plane : face.plane - 1;
    if (face.plane < w->low[axis] || face.plane >= w->low[axis] + w->size[axis])
        return true;
    for (int k = 0; k < 3; k++) {
        end[k] = smaller(first[k] + leaf->side, w->low[k] + w->size[k] - 1);
        first[k] = larger(first[k], w->low[k]);
    }
    end[axis] = first[axis] + 1; /* one layer of cells */
    bool done = true;
    for (int z = first[2]; z < end[2] && done; z++)
        for (int y = first[1]; y < end[1] && done; y++)
            done = axis == 0 ? push_cell_across_x(w, &face, y, z)
                             : push_row(w, &face, first[0], end[0], y, z);
    return done;
}

struct gathering {
    struct window *window;
    bool failed;
};

static bool visit(void *context, const struct octree_leaf *leaf)
{
    struct gathering *g = context;
    const struct field *field = g->window->field;
    if (field->lattice[TRACK_VOLUME].used)
        g->failed |= !push_box(g->window, leaf);
    if (field->lattice[TRACK_AREA].used)
        for (int k = 0; k < 6; k++)
            g->failed |= !push_face(g->window, leaf, k / 2, k % 2);
    return !g->failed;
}

/* Sorts the pending runs into rows, each row's in the order in which they came. */
static bool sort_rows(struct window *w)
{
    if (!array_renew(&w->run, w->pending.count, sizeof *w->run, &w->run_room))
        return false;
    memset(w->start, 0, (w->rows + 1) * sizeof *w->start);
    for (size_t i = 0; i < w->pending.count; i++)
        w->start[w->pending.items[i].row]++;
    uint32_t total = 0;
    for (size_t row = 0; row <= w->rows; row++)
        w->start[row] = total += w->start[row];
    for (size_t i = w->pending.count; i-- > 0;)
        w->run[--w->start[w->pending.items[i].row]] = w->pending.items[i].run;
    return true;
}

bool window_fill(struct window *w, const struct field *field, const double low[3], const double high[3])
{
    int cell_high[3];
    struct gathering g = {w, false};
    w->field = field;
    field_reach(field, low, high, w->low, cell_high);
    bool empty = false;
    for (int axis = 0; axis < 3; axis++) {
        empty |= cell_high[axis] < w->low[axis];
        w->size[axis] = larger(cell_high[axis] - w->low[axis], -1) + 2;
    }
    w->rows = (size_t)field->layers * (size_t)w->size[1] * (size_t)w->size[2];
    w->pending.count = 0;
    if (!array_renew(&w->start, w->rows + 1, sizeof *w->start, &w->start_room) ||
        !array_renew(&w->last, w->rows, sizeof *w->last, &w->last_room))
        return false;
    memset(w->last, 0, w->rows * sizeof *w->last);
    if (!empty)
        octree_visit(field->tree, w->low, cell_high, visit, &g);
    return !g.failed && sort_rows(w);
}

void window_clear(struct window *w)
{
    free(w->start);
    free(w->run);
    free(w->last);
    free(w->pending.items);
    *w = (struct window){0};
}

struct row_sum {
    double value, slope;
};

/* A row's sum along x, and its derivative by x. */
static struct row_sum sum_row(const struct window *w, size_t row, const struct profile *x,
                              enum field_track track)
{
    struct row_sum total = {0, 0};
    for (uint32_t i = w->start[row]; i < w->start[row + 1]; i++) {
        const struct window_run *run = &w->run[i];
        if (run->end <= x->first || run->begin >= x->last)
            continue;
        int begin = profile_index(x->first, x->last, run->begin),
            end = profile_index(x->first, x->last, run->end);
        total.value += run->weight * (x->sum[track][end] - x->sum[track][begin]);
        total.slope += run->weight * (x->slope[track][end] - x->slope[track][begin]);
    }
    return total;
}

struct plane_sum {
    double value, slope_x, slope_y;
};

static struct plane_sum sum_plane(const struct window *w, int layer, int z,
                                  const struct profile *const axis[3])
{
    struct plane_sum total = {0, 0, 0};
    const enum field_track *track = w->field->layer[layer].track;
    const double *sum = axis[1]->sum[track[1]], *slope = axis[1]->slope[track[1]];
    int first = larger(axis[1]->first, w->low[1]), end = smaller(axis[1]->last, w->low[1] + w->size[1]);
    for (int y = first; y < end; y++) {
        size_t row = window_row(w, layer, y, z);
        if (w->start[row] == w->start[row + 1])
            continue;
        int i = y - axis[1]->first;
        struct row_sum along = sum_row(w, row, axis[0], track[0]);
        total.value += (sum[i + 1] - sum[i]) * along.value;
        total.slope_x += (sum[i + 1] - sum[i]) * along.slope;
        total.slope_y += (slope[i + 1] - slope[i]) * along.value;
    }
    return total;
}

double window_sum(const struct window *w, const struct profile *const axis[3], double gradient[3])
{
    const struct profile *z = axis[2];
    double value = 0;
    for (int k = 0; k < 3; k++)
        gradient[k] = 0;
    int first = larger(z->first, w->low[2]), end = smaller(z->last, w->low[2] + w->size[2]);
    for (int layer = 0; layer < w->field->layers; layer++) {
        enum field_track track = w->field->layer[layer].track[2];
        const double *sum = z->sum[track], *slope = z->slope[track];
        for (int k = first; k < end; k++) {
            struct plane_sum plane = sum_plane(w, layer, k, axis);
            int i = k - z->first;
            value += (sum[i + 1] - sum[i]) * plane.value;
            gradient[0] += (sum[i + 1] - sum[i]) * plane.slope_x;
            gradient[1] += (sum[i + 1] - sum[i]) * plane.slope_y;
            gradient[2] += (slope[i + 1] - slope[i]) * plane.value;
        }
    }
    return value;
}

double window_value(const struct window *w, const double point[3], struct profiles *profiles,
                    double gradient[3])
{
    struct profile *axis = profiles->axis;
    for (int k = 0; k < 3; k++)
        profile_fill(w->field, point[k], &axis[k]);
    return window_sum(w, (const struct profile *const[3]){&axis[0], &axis[1], &axis[2]}, gradient);
}
