/* Where edges cross the surface. */
#include "common/vec3.h"
#include "surface/mesher.h"

#include <stdlib.h>
#include <string.h>

/*
 * A corner of the grid that happens to lie almost on the surface would get three or more vertices almost in
 * one place, so near that they fall together in a file of single precision. Such a corner is moved away from
 * the surface, along the gradient to its own side, until it is about CLEARANCE cubes away. It stays inside
 * or outside as it was, so which edges are crossed does not change, and vertices are still found on the
 * true surface: only the edge that they are looked for on is bent. Where a corner goes depends on the field
 * there alone, so all edges and bricks that share it agree. Bent edges cost full evaluations of the field, so
 * there are to be few; slivers are relaxation's to cure.
 */
#define CLEARANCE 0.02

/* No vertex is nearer to an edge's end than this share of it, even where a corner cannot move (a threshold
 * that is the field's extreme value, where the gradient vanishes). */
#define LEAST_SHARE 1e-6

/* Well below the 1e-9 that is promised, since Newton's method squares the error at each turn. */
#define RESIDUAL 1e-10

/* A corner whose excess is this or more is far enough: the field is nowhere steeper. */
static double near_surface(const struct mesher *m)
{
    return CLEARANCE * m->grid.cube * m->field->steepness;
}

static void move_corner(const struct mesher *m, struct worker *worker, const int at[3],
                        struct moved_corner *corner)
{
    double gradient[3], clearance = CLEARANCE * m->grid.cube;
    if (fabs(corner->excess) >= near_surface(m))
        return;
    worker->evaluations++;
    block_corner(&worker->block, at, gradient);
    double steepness = vec3_length(gradient);
    double missing = clearance - fabs(corner->excess) / steepness;
    if (!(steepness > 0 && missing > 0))
        return;
    double place[3], along = copysign(missing / steepness, corner->excess);
    for (int axis = 0; axis < 3; axis++)
        place[axis] = corner->place[axis] + along * gradient[axis];
    double excess = worker_value(worker, place, gradient) - m->threshold;
    if (signbit(excess) != signbit(corner->excess) || fabs(excess) <= fabs(corner->excess))
        return;
    memcpy(corner->place, place, sizeof place);
    corner->excess = excess;
    corner->moved = true;
}

static const struct moved_corner *corner_of(const struct mesher *m, struct worker *worker, const int at[3])
{
    int index = (at[2] * BRICK_CORNERS + at[1]) * BRICK_CORNERS + at[0];
    struct moved_corner *corner = &worker->corner[index];
    if (corner->known)
        return corner;
    for (int axis = 0; axis < 3; axis++)
        corner->place[axis] = grid_coordinate(&m->grid, worker->block.corner[axis] + at[axis]);
    corner->excess = worker->block.values[index] - m->threshold;
    corner->known = true;
    corner->moved = false;
    move_corner(m, worker, at, corner);
    return corner;
}

/* The share of a way at which Newton's method looks next, kept between the last ones known to be inside and
 * outside; where a step would leave that bracket it is halved instead. */
struct bracket {
    double share, low, high;
};

static struct bracket bracket_at(double share)
{
    double low = LEAST_SHARE, high = 1 - LEAST_SHARE;
    return (struct bracket){share < low ? low : share > high ? high : share, low, high};
}

/* slope: of the excess, by the share. False when there is nowhere better to look. */
static bool next_share(struct bracket *b, double excess, double slope)
{
    if (fabs(excess) <= RESIDUAL || !(b->low < b->high))
        return false;
    *(excess >= 0 ? &b->low : &b->high) = b->share;
    double next = b->share - excess / slope;
    b->share = next > b->low && next < b->high ? next : (b->low + b->high) / 2;
    return true;
}

static void note_residual(struct worker *worker, double excess)
{
    if (!(fabs(excess) <= worker->worst_residual))
        worker->worst_residual = fabs(excess);
}

enum { TURNS = 80 }; /* of Newton's method; halving alone ends after some 55 */

void find_crossing(const struct mesher *m, struct worker *worker, const double inside[3],
                   double inside_excess, const double outside[3], double outside_excess, double point[3],
                   double gradient[3])
{
    double way[3], excess = 0;
    struct bracket b = bracket_at(inside_excess / (inside_excess - outside_excess));
    vec3_sub(outside, inside, way);
    for (int turn = 0; turn < TURNS; turn++) {
        for (int axis = 0; axis < 3; axis++)
            point[axis] = inside[axis] + b.share * way[axis];
        excess = worker_value(worker, point, gradient) - m->threshold;
        if (!next_share(&b, excess, vec3_dot(gradient, way)))
            break;
    }
    note_residual(worker, excess);
}

/* Where the cubic in the excess passes 0 that has both ends' places (0 and 1) and slopes: two orders better
 * than the straight line, whose share stands in where the slopes are of no use. */
static double first_share(double first, double last, double slope_first, double slope_last)
{
    double rise = last - first, t = -first / rise;
    double a = rise / slope_first, b = rise / slope_last; /* d share / d t at both ends */
    /* Both between 0 and 3: the cubic is monotone (Fritsch and Carlson 1980). */
    if (!(a > 0 && a < 3 && b > 0 && b < 3))
        return t;
    return t * t * (3 - 2 * t) + t * (1 - t) * ((1 - t) * a - t * b);
}

void vertex_set(const struct mesher *m, const double point[3], const double gradient[3],
                const double outwards[3], struct vertex *vertex)
{
    double length = vec3_length(gradient), unit = 1.0 / m->field->side; /* a power of 2: exact */
    const double *along = length > 0 ? gradient : outwards;
    double per_length = length > 0 ? -1 / length : 1 / vec3_length(outwards);
    for (int axis = 0; axis < 3; axis++) {
        vertex->position[axis] = point[axis] * unit;
        vertex->normal[axis] = along[axis] * per_length;
    }
}

/* Along an edge of the grid, whose corners were not moved. */
static void cross_line(const struct mesher *m, struct worker *worker, int axis, const int at[3], double first,
                       double last, struct vertex *vertex)
{
    struct line line = block_line(&worker->block, axis, at);
    double cube = m->grid.cube, slopes[2], slope = 0, excess = 0, point[3], gradient[3], outwards[3] = {0};
    bool rising = first < last;
    for (int k = 0; k < 3; k++)
        point[k] = grid_coordinate(&m->grid, worker->block.corner[k] + at[k]);
    line_slopes(&line, at, slopes);
    double start = point[axis], share = first_share(first, last, slopes[0] * cube, slopes[1] * cube);
    struct bracket b = bracket_at(rising ? 1 - share : share); /* from the inside out */
    for (int turn = 0; turn < TURNS; turn++) {
        point[axis] = start + cube * (rising ? 1 - b.share : b.share);
        excess = line_value(&line, point[axis], &slope) - m->threshold;
        worker->evaluations++;
        if (!next_share(&b, excess, rising ? -slope * cube : slope * cube))
            break;
    }
    line_gradient(&line, slope, gradient);
    note_residual(worker, excess);
    outwards[axis] = rising ? -1 : 1;
    vertex_set(m, point, gradient, outwards, vertex);
}

/* Along an edge of which an end may have moved. */
static void cross_bent_edge(const struct mesher *m, struct worker *worker, int axis, const int at[3],
                            struct vertex *vertex)
{
    int end[3] = {at[0], at[1], at[2]};
    end[axis]++;
    const struct moved_corner *inside = corner_of(m, worker, at), *outside = corner_of(m, worker, end);
    double point[3], gradient[3], outwards[3];
    if (!inside->moved && !outside->moved) {
        cross_line(m, worker, axis, at, inside->excess, outside->excess, vertex);
        return;
    }
    if (signbit(inside->excess)) {
        const struct moved_corner *swap = inside;
        inside = outside;
        outside = swap;
    }
    find_crossing(m, worker, inside->place, inside->excess, outside->place, outside->excess, point, gradient);
    vec3_sub(outside->place, inside->place, outwards);
    vertex_set(m, point, gradient, outwards, vertex);
}

static void find_vertex(const struct mesher *m, struct worker *worker, int axis, const int at[3],
                        struct vertex *vertex)
{
    static const int next[3] = {1, BRICK_CORNERS, BRICK_CORNERS * BRICK_CORNERS};
    const double *value = &worker->block.values[(at[2] * BRICK_CORNERS + at[1]) * BRICK_CORNERS + at[0]];
    double first = value[0] - m->threshold, last = value[next[axis]] - m->threshold, near = near_surface(m);
    if (fabs(first) < near || fabs(last) < near)
        cross_bent_edge(m, worker, axis, at, vertex);
    else
        cross_line(m, worker, axis, at, first, last, vertex);
}

/* Room for that many vertices, side by side; NULL when there is no memory. */
static struct vertex *take_vertices(struct worker *worker, uint32_t count)
{
    enum { CHUNK = 4096 }; /* a brick has at most 3 x 512 */
    struct vertex_chunk *chunk = worker->chunks;
    if (!chunk || chunk->count + count > CHUNK) {
        chunk = malloc(sizeof *chunk + CHUNK * sizeof chunk->items[0]);
        if (!chunk)
            return NULL;
        *chunk = (struct vertex_chunk){.next = worker->chunks};
        worker->chunks = chunk;
        worker->bytes += sizeof *chunk + CHUNK * sizeof chunk->items[0];
    }
    chunk->count += count;
    return &chunk->items[chunk->count - count];
}

void brick_find_vertices(const struct mesher *m, struct worker *worker, struct brick *brick)
{
    struct vertex *next = brick->vertices = take_vertices(worker, brick->vertex_count);
    if (!next) {
        worker->failed = true;
        return;
    }
    for (size_t i = 0; i < BLOCK_VALUES; i++)
        worker->corner[i].known = false;
    for (int z = 0; z < BRICK; z++)
        for (int axis = 0; axis < 3; axis++)
            for (uint64_t edges = brick->crossed[axis][z]; edges; edges &= edges - 1) {
                int bit = __builtin_ctzll(edges);
                find_vertex(m, worker, axis, (int[3]){bit % BRICK, bit / BRICK, z}, next++);
            }
}
