/* Which boxes of fields are near: found through the octree. */
#include "common/array.h"
#include "surface/field.h"

#include <math.h>

struct gathering {
    const struct field *field;
    const int *low, *high;
    struct field_items *out;
    bool failed;
};

static bool push(struct gathering *g, struct field_item item)
{
    if (!ARRAY_RESERVE(g->out, 1)) {
        g->failed = true;
        return false;
    }
    g->out->items[g->out->count++] = item;
    return true;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* One row of cells along a leaf's face: the runs of it that border on emptiness. `cell` is the first cell
 * outside the leaf, u the axis along the row, `end` the cell after the row's last. */
static bool push_row(struct gathering *g, int cell[3], int u, int end, struct field_item face)
{
    int begin = cell[u];
    for (bool open = false; cell[u] <= end; cell[u]++) {
        bool exposed = cell[u] < end && octree_at(g->field->tree, cell[0], cell[1], cell[2]) == 0;
        if (exposed && !open)
            begin = cell[u];
        if (open && !exposed) {
            face.low[u] = (int16_t)begin;
            face.high[u] = (int16_t)cell[u];
            if (!push(g, face))
                return false;
        }
        open = exposed;
    }
    return true;
}

/* The exposed part of the face of a leaf across `axis`, on its upper or lower side, as far as it is in the
 * box. */
static bool push_face(struct gathering *g, const struct octree_leaf *leaf, int axis, bool upper)
{
    int start[3] = {leaf->x, leaf->y, leaf->z}, u = (axis + 1) % 3, v = (axis + 2) % 3;
    int plane = start[axis] + (upper ? leaf->side : 0);
    if (plane < g->low[axis] || plane > g->high[axis] + 1)
        return true;
    struct field_item face = {.weight = g->field->coefficient[leaf->material]};
    face.track[axis] = TRACK_PLANE;
    face.low[axis] = (int16_t)plane;
    face.high[axis] = (int16_t)(plane + 1);
    face.track[u] = face.track[v] = TRACK_AREA;
    int u_end = smaller(start[u] + leaf->side, g->high[u] + 1);
    int v_end = smaller(start[v] + leaf->side, g->high[v] + 1);
    for (int row = larger(start[v], g->low[v]); row < v_end; row++) {
        int cell[3];
        cell[axis] = upper ? plane : plane - 1;
        cell[u] = larger(start[u], g->low[u]);
        cell[v] = row;
        face.low[v] = (int16_t)row;
        face.high[v] = (int16_t)(row + 1);
        if (!push_row(g, cell, u, u_end, face))
            return false;
    }
    return true;
}

static bool visit(void *context, const struct octree_leaf *leaf)
{
    struct gathering *g = context;
    int start[3] = {leaf->x, leaf->y, leaf->z};
    if (g->field->lattice[TRACK_VOLUME].used) {
        struct field_item box = {.weight = g->field->coefficient[leaf->material]};
        for (int axis = 0; axis < 3; axis++) {
            box.low[axis] = (int16_t)start[axis];
            box.high[axis] = (int16_t)(start[axis] + leaf->side);
            box.track[axis] = TRACK_VOLUME;
        }
        if (!push(g, box))
            return false;
    }
    if (g->field->lattice[TRACK_AREA].used)
        for (int k = 0; k < 6; k++)
            if (!push_face(g, leaf, k / 2, k % 2))
                return false;
    return true;
}

bool field_gather(const struct field *field, const int low[3], const int high[3], struct field_items *out)
{
    struct gathering g = {field, low, high, out, false};
    if (low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2])
        octree_visit(field->tree, low, high, visit, &g);
    return !g.failed;
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
