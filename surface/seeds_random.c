/* Where the following begins: by the paper's random points. */
#include "common/random.h"
#include "surface/mesher.h"

#include <stdlib.h>

static bool corner_inside(struct mesher *m, const int corner[3])
{
    double point[3], gradient[3];
    for (int axis = 0; axis < 3; axis++)
        point[axis] = grid_coordinate(&m->grid, corner[axis]);
    return probe_value(&m->worker[0]->probe, point, gradient) >= m->threshold;
}

/* The corner after `steps` steps from a to b: first along x, then y, then z. */
static void on_the_way(const int a[3], const int b[3], long steps, int corner[3])
{
    for (int axis = 0; axis < 3; axis++) {
        long length = labs((long)b[axis] - a[axis]), part = steps < length ? steps : length;
        corner[axis] = a[axis] + (int)(b[axis] > a[axis] ? part : -part);
        steps -= part;
    }
}

/* Halves the way between two corners on different sides down to one edge, and follows the surface from
 * there. True when that part of it is new. */
static bool follow_between(struct mesher *m, const int a[3], const int b[3])
{
    long low = 0, high = 0;
    for (int axis = 0; axis < 3; axis++)
        high += labs((long)b[axis] - a[axis]);
    bool begin = corner_inside(m, a);
    while (high - low > 1 && !m->failed) {
        int corner[3];
        long middle = low + (high - low) / 2;
        on_the_way(a, b, middle, corner);
        *(corner_inside(m, corner) == begin ? &low : &high) = middle;
    }
    int p[3], q[3], brick_at[3], cell = 0;
    on_the_way(a, b, low, p);
    on_the_way(a, b, high, q);
    for (int axis = 2; axis >= 0; axis--) {
        int line = p[axis] < q[axis] ? p[axis] : q[axis];
        brick_at[axis] = line >= 0 ? line / BRICK : -((BRICK - 1 - line) / BRICK);
        cell = cell * BRICK + (line - brick_at[axis] * BRICK);
    }
    uint32_t brick = brick_get(m, brick_at);
    if (brick == MESH_NONE || m->bricks.items[brick].followed[cell / 64] >> cell % 64 & 1)
        return false;
    follow(m, brick, cell);
    return true;
}

void seeds_random(struct mesher *m, uint64_t seed)
{
    enum { TRIES = 400 }; /* points in a row that lead to nothing new, after which it gives up */
    int corner[3] = {0, 0, 0}, other[2][3];
    bool known[2] = {false, false};
    for (int tries = 0; tries < TRIES && !m->failed; tries++) {
        int side = corner_inside(m, corner);
        if (known[!side] && follow_between(m, corner, other[!side]))
            tries = 0;
        known[side] = true;
        for (int axis = 0; axis < 3; axis++) {
            other[side][axis] = corner[axis];
            int first = m->grid.brick_low[axis] * BRICK;
            int count = (m->grid.brick_high[axis] - m->grid.brick_low[axis] + 1) * BRICK + 1;
            corner[axis] = first + (int)(random_unit(&seed) * count);
        }
    }
}
