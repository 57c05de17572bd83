/* Following the surface from cell to cell (paper 3.4). */
#include "common/array.h"
#include "surface/mesher.h"

unsigned cell_inside(const struct brick *brick, int x, int y, int z)
{
    const uint16_t *row = &brick->inside[z * BRICK_CORNERS + y];
    return (row[0] >> x & 3u) | (row[1] >> x & 3u) << 2 | (row[BRICK_CORNERS] >> x & 3u) << 4 |
           (row[BRICK_CORNERS + 1] >> x & 3u) << 6;
}

unsigned faces_joined(struct mesher *m, const struct brick *brick, const int at[3], unsigned ambiguous)
{
    unsigned joined = 0;
    for (int face = 0; face < CELL_FACES; face++) {
        if (!(ambiguous >> face & 1))
            continue;
        double middle[3], gradient[3];
        for (int axis = 0; axis < 3; axis++) {
            int line = brick->at[axis] * BRICK + at[axis];
            bool across = axis == face / 2;
            middle[axis] = across ? grid_coordinate(&m->grid, line + face % 2) : (line + 1) * m->grid.cube;
        }
        joined |= (unsigned)(probe_value(&m->probe, middle, gradient) >= m->threshold) << face;
    }
    return joined;
}

/* How many triangles a cell has; the few loops that need a vertex in their middle have two more. */
static int count_triangles(struct mesher *m, const struct brick *brick, int cell, unsigned inside)
{
    unsigned ambiguous = m->cells.ambiguous[inside];
    if (!ambiguous)
        return m->cells.triangles[inside];
    int at[3] = {cell % BRICK, cell / BRICK % BRICK, cell / 64}, count = 0;
    struct cell_loops loops;
    cell_find_loops(&m->cells, inside, faces_joined(m, brick, at, ambiguous), &loops);
    for (int i = 0; i < loops.count; i++)
        count += loops.length[i] - 2;
    return count;
}

/* Marks a cell and puts it on the stack, once. */
static void reach(struct mesher *m, uint32_t brick, int cell)
{
    uint64_t *followed = &m->bricks.items[brick].followed[cell / 64], bit = (uint64_t)1 << cell % 64;
    if (*followed & bit)
        return;
    if (!ARRAY_RESERVE(&m->stack, 1)) {
        m->failed = true;
        return;
    }
    *followed |= bit;
    m->stack.items[m->stack.count++] = (struct cell_at){brick, (uint16_t)cell};
}

static void cross_face(struct mesher *m, uint32_t brick, int cell, int face)
{
    int axis = face / 2, step = face % 2 ? 1 : -1;
    int at[3] = {cell % BRICK, cell / BRICK % BRICK, cell / 64};
    at[axis] += step;
    if (at[axis] < 0 || at[axis] >= BRICK) {
        int place[3];
        for (int k = 0; k < 3; k++)
            place[k] = m->bricks.items[brick].at[k] + (k == axis ? step : 0);
        brick = brick_get(m, place);
        if (brick == MESH_NONE)
            return;
        at[axis] &= BRICK - 1;
    }
    reach(m, brick, at[2] * 64 + at[1] * BRICK + at[0]);
}

void follow(struct mesher *m, uint32_t brick, int cell)
{
    m->follows++;
    reach(m, brick, cell);
    while (m->stack.count && !m->failed) {
        struct cell_at here = m->stack.items[--m->stack.count];
        unsigned inside = cell_inside(&m->bricks.items[here.brick], here.cell % BRICK,
                                      here.cell / BRICK % BRICK, here.cell / 64);
        if (m->count_only)
            m->triangles += (size_t)count_triangles(m, &m->bricks.items[here.brick], here.cell, inside);
        for (int face = 0; face < CELL_FACES; face++)
            if (m->cells.crossed[inside] >> face & 1)
                cross_face(m, here.brick, here.cell, face);
    }
}

void follow_brick(struct mesher *m, uint32_t brick)
{
    for (int cell = 0; cell < BRICK * BRICK * BRICK && !m->failed; cell++) {
        const struct brick *b = &m->bricks.items[brick];
        unsigned inside = cell_inside(b, cell % BRICK, cell / BRICK % BRICK, cell / 64);
        if (inside != 0 && inside != 255 && !(b->followed[cell / 64] >> cell % 64 & 1))
            follow(m, brick, cell);
    }
}
