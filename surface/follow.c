/* Following the surface from cell to cell (paper 3.4). */
#include "common/array.h"
#include "surface/mesher.h"

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
        for (int face = 0; face < CELL_FACES; face++)
            if (m->cells.crossed[inside] >> face & 1)
                cross_face(m, here.brick, here.cell, face);
    }
}

void follow_brick(struct mesher *m, uint32_t brick)
{
    for (int row = 0; row < BRICK * BRICK && !m->failed; row++) {
        unsigned cells = cells_crossed(&m->bricks.items[brick], row % BRICK, row / BRICK);
        for (; cells; cells &= cells - 1) {
            int cell = BRICK * row + __builtin_ctz(cells);
            if (!(m->bricks.items[brick].followed[cell / 64] >> cell % 64 & 1))
                follow(m, brick, cell);
        }
    }
}
