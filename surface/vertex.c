/* Where edges cross the surface. */
#include "common/array.h"
#include "common/vec3.h"
#include "surface/mesher.h"

#include <string.h>

/*
 * A corner of the grid that happens to lie almost on the surface would get three or more vertices almost in
 * one place: slivers, and sides that vanish in a file of single precision. Such a corner is moved away from
 * the surface, along the gradient to its own side, until it is about CLEARANCE cubes away. It stays inside
 * or outside as it was, so which edges are crossed does not change, and vertices are still found on the
 * true surface: only the edge that they are looked for on is bent. Where a corner goes depends on the field
 * there alone, so all edges and bricks that share it agree.
 */
#define CLEARANCE 0.2

/* No vertex is nearer to an edge's end than this share of it, even where a corner cannot move (a threshold
 * that is the field's extreme value, where the gradient vanishes). */
#define LEAST_SHARE 1e-6

/* Well below the 1e-9 that is promised, since Newton's method squares the error at each turn. */
#define RESIDUAL 1e-10

static void move_corner(struct mesher *m, struct moved_corner *corner)
{
    double gradient[3], clearance = CLEARANCE * m->grid.cube;
    if (fabs(corner->excess) >= clearance * m->field->steepness)
        return;
    probe_value(&m->probe, corner->place, gradient);
    double steepness = vec3_length(gradient);
    double missing = clearance - fabs(corner->excess) / steepness;
    if (!(steepness > 0 && missing > 0))
        return;
    double place[3], along = copysign(missing / steepness, corner->excess);
    for (int axis = 0; axis < 3; axis++)
        place[axis] = corner->place[axis] + along * gradient[axis];
    double excess = probe_value(&m->probe, place, gradient) - m->threshold;
    if (signbit(excess) != signbit(corner->excess) || fabs(excess) <= fabs(corner->excess))
        return;
    memcpy(corner->place, place, sizeof place);
    corner->excess = excess;
}

static const struct moved_corner *corner_of(struct mesher *m, const struct brick *brick, const int at[3])
{
    int index = (at[2] * BRICK_CORNERS + at[1]) * BRICK_CORNERS + at[0];
    struct moved_corner *corner = &m->moved[index];
    if (corner->known)
        return corner;
    for (int axis = 0; axis < 3; axis++)
        corner->place[axis] = grid_coordinate(&m->grid, brick->at[axis] * BRICK + at[axis]);
    corner->excess = m->values[index] - m->threshold;
    corner->known = true;
    move_corner(m, corner);
    return corner;
}

/* Newton's method along the segment, kept between the last points known to be inside and outside; where a
 * step would leave that bracket it is halved instead. */
void find_crossing(struct mesher *m, const double inside[3], double inside_excess, const double outside[3],
                   double outside_excess, double point[3], double gradient[3])
{
    double way[3], low = LEAST_SHARE, high = 1 - LEAST_SHARE, excess = 0;
    double share = fmin(fmax(inside_excess / (inside_excess - outside_excess), low), high);
    vec3_sub(outside, inside, way);
    for (int turn = 0; turn < 80; turn++) {
        for (int axis = 0; axis < 3; axis++)
            point[axis] = inside[axis] + share * way[axis];
        excess = probe_value(&m->probe, point, gradient) - m->threshold;
        if (fabs(excess) <= RESIDUAL || !(low < high))
            break;
        *(excess >= 0 ? &low : &high) = share;
        double next = share - excess / vec3_dot(gradient, way);
        share = next > low && next < high ? next : (low + high) / 2;
    }
    m->worst_residual = fmax(m->worst_residual, fabs(excess));
}

void vertex_set(const struct mesher *m, const double point[3], const double gradient[3],
                const double outwards[3], struct vertex *vertex)
{
    double length = vec3_length(gradient), spare = vec3_length(outwards);
    for (int axis = 0; axis < 3; axis++) {
        vertex->position[axis] = point[axis] / m->field->side;
        vertex->normal[axis] = length > 0 ? -gradient[axis] / length : outwards[axis] / spare;
    }
}

static void find_vertex(struct mesher *m, const struct brick *brick, const int at[3], int axis,
                        struct vertex *vertex)
{
    int end[3] = {at[0], at[1], at[2]};
    end[axis]++;
    const struct moved_corner *inside = corner_of(m, brick, at), *outside = corner_of(m, brick, end);
    if (signbit(inside->excess)) {
        const struct moved_corner *swap = inside;
        inside = outside;
        outside = swap;
    }
    double point[3], gradient[3], outwards[3];
    find_crossing(m, inside->place, inside->excess, outside->place, outside->excess, point, gradient);
    vec3_sub(outside->place, inside->place, outwards);
    vertex_set(m, point, gradient, outwards, vertex);
}

void brick_find_vertices(struct mesher *m, struct brick *brick)
{
    if (!ARRAY_RESERVE(&m->vertices, brick->vertex_count)) {
        m->failed = true;
        return;
    }
    for (size_t i = 0; i < sizeof m->moved / sizeof m->moved[0]; i++)
        m->moved[i].known = false;
    for (int z = 0; z < BRICK; z++)
        for (int axis = 0; axis < 3; axis++)
            for (uint64_t edges = brick->crossed[axis][z]; edges; edges &= edges - 1) {
                int bit = __builtin_ctzll(edges);
                find_vertex(m, brick, (int[3]){bit % BRICK, bit / BRICK, z}, axis,
                            &m->vertices.items[m->vertices.count++]);
            }
    m->failed |= m->probe.failed;
}
