#include "sculpt/voxelise_parts.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELL_BITS = 16, /* a cell is 2^16 units long */
    CELL = 1 << CELL_BITS,
    CENTRE = CELL / 2 + 1, /* of cell 0; odd */
};

/* A triangle as the lines see it; the third coordinate runs along them. */
struct corner {
    int64_t u, v;
    double w; /* in cells */
};

struct scan {
    int side;
    uint32_t *count; /* counting: [side * side] crossings of each column; */
    uint32_t *place; /* placing: where each column's next one goes */
    uint32_t *items;
    size_t total;
};

static int64_t floor_divide(int64_t a, int64_t b)
{
    int64_t quotient = a / b;
    return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

/* The cells, along one axis, whose centres lie within low .. high (units). */
static void cells_between(int64_t low, int64_t high, int side, int *first, int *last)
{
    int64_t from = -floor_divide(CENTRE - low, CELL), to = floor_divide(high - CENTRE, CELL);
    *first = from < 0 ? 0 : from > side ? side : (int)from;
    *last = to < -1 ? -1 : to >= side ? side - 1 : (int)to;
}

/* Narrows low .. high (u, in units) to where the point (u + e, v + e^2) lies on the left of the edge a b;
 * false when there is no such u. The edge function is (b - a) x (p - a) = k - (b.v - a.v) u. */
static bool clip_to_edge(const struct corner *a, const struct corner *b, int64_t v, int64_t *low,
                         int64_t *high)
{
    int64_t du = b->u - a->u, dv = b->v - a->v;
    int64_t k = du * (v - a->v) + dv * a->u;
    int64_t least = dv < 0 || (dv == 0 && du > 0) ? 0 : 1; /* on the edge, e decides */
    if (dv == 0)
        return k >= least;
    if (dv < 0) {
        int64_t bound = -floor_divide(k - least, -dv); /* u >= (least - k) / -dv */
        *low = bound > *low ? bound : *low;
    } else {
        int64_t bound = floor_divide(k - least, dv);
        *high = bound < *high ? bound : *high;
    }
    return *low <= *high;
}

static void add_crossing(struct scan *scan, size_t column, double w, bool outward)
{
    if (!scan->items) {
        scan->count[column]++;
        scan->total++;
        return;
    }
    const double centre = (double)CENTRE / CELL;
    double first = ceil(w - centre);
    uint32_t cell = first < 0 ? 0 : first > scan->side ? (uint32_t)scan->side : (uint32_t)first;
    scan->items[scan->place[column]++] = 2 * cell + outward;
}

/* `area` is twice that of the triangle in the plane u v; its corners run counter-clockwise there. */
static void scan_triangle(struct scan *scan, const struct corner corner[3], int64_t area, bool outward)
{
    int64_t low_v = corner[0].v, high_v = low_v, low_u = corner[0].u, high_u = low_u;
    for (int i = 1; i < 3; i++) {
        low_v = corner[i].v < low_v ? corner[i].v : low_v;
        high_v = corner[i].v > high_v ? corner[i].v : high_v;
        low_u = corner[i].u < low_u ? corner[i].u : low_u;
        high_u = corner[i].u > high_u ? corner[i].u : high_u;
    }
    const double slope_u = ((corner[1].w - corner[0].w) * (double)(corner[2].v - corner[0].v) -
                            (corner[2].w - corner[0].w) * (double)(corner[1].v - corner[0].v)) /
                           (double)area;
    const double slope_v = ((corner[2].w - corner[0].w) * (double)(corner[1].u - corner[0].u) -
                            (corner[1].w - corner[0].w) * (double)(corner[2].u - corner[0].u)) /
                           (double)area;
    int first_row, last_row;
    cells_between(low_v, high_v, scan->side, &first_row, &last_row);
    for (int row = first_row; row <= last_row; row++) {
        int64_t v = (int64_t)row * CELL + CENTRE, low = low_u, high = high_u;
        bool meets = true;
        for (int i = 0; i < 3 && meets; i++)
            meets = clip_to_edge(&corner[i], &corner[(i + 1) % 3], v, &low, &high);
        int first = 0, last = -1;
        if (meets)
            cells_between(low, high, scan->side, &first, &last);
        for (int i = first; i <= last; i++) {
            int64_t u = (int64_t)i * CELL + CENTRE;
            double w = corner[0].w + slope_u * (double)(u - corner[0].u) +
                       slope_v * (double)(v - corner[0].v);
            add_crossing(scan, (size_t)row * (size_t)scan->side + (size_t)i, w, outward);
        }
    }
}

/* Coordinates are rounded to even units. */
static int64_t round_to_units(double cells)
{
    return 2 * llround(cells * (CELL / 2));
}

static enum status scan_all(struct scan *scan, const struct mesh *mesh, int axis, struct error *err)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        struct corner corner[3];
        for (int i = 0; i < 3; i++) {
            const double *at = mesh->position[mesh->triangle[t][i]];
            corner[i] = (struct corner){round_to_units(at[(axis + 1) % 3]),
                                        round_to_units(at[(axis + 2) % 3]), at[axis]};
        }
        int64_t area = (corner[1].u - corner[0].u) * (corner[2].v - corner[0].v) -
                       (corner[2].u - corner[0].u) * (corner[1].v - corner[0].v);
        if (area < 0) {
            struct corner swap = corner[1];
            corner[1] = corner[2];
            corner[2] = swap;
        }
        if (area != 0) /* one that counts counter-clockwise is left, along the axis, to the outside */
            scan_triangle(scan, corner, area < 0 ? -area : area, area > 0);
        if (scan->total > CROSSINGS_MAX)
            return error_set(err, STATUS_RANGE,
                             "the triangles lie over each other too often: triangle %u is the %zuth layer on "
                             "average; simplify the mesh or give a smaller --depth",
                             t, scan->total / ((size_t)scan->side * (size_t)scan->side));
    }
    return STATUS_OK;
}

enum status crossings_find(const struct mesh *mesh, int axis, int side, struct crossings *crossings,
                           struct error *err)
{
    const size_t columns = (size_t)side * (size_t)side;
    uint32_t *begin = calloc(columns + 1, sizeof *begin), *place = array_new(columns + 1, sizeof *place);
    struct scan scan = {.side = side, .count = begin, .place = place};
    enum status status = begin && place ? scan_all(&scan, mesh, axis, err)
                                        : error_no_memory(err, "the mesh's crossings");
    if (!status && !(scan.items = array_new(scan.total, sizeof *scan.items)))
        status = error_no_memory(err, "the mesh's crossings");
    if (status) {
        free(begin);
        free(place);
        return status;
    }
    uint32_t sum = 0;
    for (size_t i = 0; i <= columns; i++) {
        uint32_t count = begin[i];
        begin[i] = sum;
        sum += count;
    }
    memcpy(place, begin, (columns + 1) * sizeof *place);
    scan_all(&scan, mesh, axis, NULL);
    free(place);
    *crossings = (struct crossings){scan.items, begin};
    return STATUS_OK;
}

void crossings_clear(struct crossings *crossings)
{
    free(crossings->items);
    free(crossings->begin);
    *crossings = (struct crossings){0};
}
