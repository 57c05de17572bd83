/* Following the surface from cell to cell (paper 3.4), 64 cells at a time. */
#include "common/array.h"
#include "surface/mesher.h"

#include <string.h>

/* Cells of a brick: [z], bit 8 y + x, as in struct brick. */
#define FIRST_X 0x0101010101010101u
#define LAST_X  (FIRST_X << 7)

/* The cells whose lower or upper face across an axis the surface passes through: that face's corners
 * are not all on one side. */
struct faces {
    uint64_t lower[3][BRICK], upper[3][BRICK];
};

/* Bit x: the corners x and x + 1 of two rows are not all on one side. */
static uint64_t crossed_between(unsigned row, unsigned other)
{
    unsigned any = row | other, all = row & other;
    return (any | any >> 1) & ~(all & all >> 1) & 0xff;
}

static void find_faces(const struct brick *brick, struct faces *faces)
{
    memset(faces, 0, sizeof *faces);
    for (int z = 0; z < BRICK; z++)
        for (int y = 0; y < BRICK; y++) {
            const uint16_t *row = &brick->inside[z * BRICK_CORNERS + y], *next = row + BRICK_CORNERS;
            unsigned across = (row[0] | row[1] | next[0] | next[1]) & ~(row[0] & row[1] & next[0] & next[1]);
            faces->lower[0][z] |= (uint64_t)(across & 0xff) << 8 * y;
            faces->upper[0][z] |= (uint64_t)(across >> 1 & 0xff) << 8 * y;
            faces->lower[1][z] |= crossed_between(row[0], next[0]) << 8 * y;
            faces->upper[1][z] |= crossed_between(row[1], next[1]) << 8 * y;
            faces->lower[2][z] |= crossed_between(row[0], row[1]) << 8 * y;
            faces->upper[2][z] |= crossed_between(next[0], next[1]) << 8 * y;
        }
}

/* Spreads within the brick until nothing is new. */
static void spread(const struct faces *f, uint64_t cells[BRICK])
{
    for (bool changed = true; changed;) {
        changed = false;
        for (int z = 0; z < BRICK; z++) {
            uint64_t here = cells[z], reached = here;
            reached |= (here & f->upper[0][z] & ~LAST_X) << 1 | (here & f->lower[0][z] & ~FIRST_X) >> 1;
            reached |= (here & f->upper[1][z]) << 8 | (here & f->lower[1][z]) >> 8;
            if (z > 0)
                reached |= cells[z - 1] & f->upper[2][z - 1];
            if (z + 1 < BRICK)
                reached |= cells[z + 1] & f->lower[2][z + 1];
            changed |= reached != here;
            cells[z] = reached;
        }
    }
}

/* The cells of the neighbour beyond one side that are reached; false when there are none. */
static bool cross_side(const struct faces *f, const uint64_t cells[BRICK], int axis, bool up,
                       uint64_t beyond[BRICK])
{
    uint64_t any = 0;
    memset(beyond, 0, BRICK * sizeof *beyond);
    for (int z = 0; z < BRICK; z++) {
        uint64_t leaving = cells[z] & (up ? f->upper : f->lower)[axis][z];
        if (axis == 0)
            beyond[z] = up ? (leaving & LAST_X) >> 7 : (leaving & FIRST_X) << 7;
        else if (axis == 1)
            beyond[z] = up ? leaving >> 56 : leaving << 56;
        else if (z == (up ? BRICK - 1 : 0))
            beyond[BRICK - 1 - z] = leaving;
    }
    for (int z = 0; z < BRICK; z++)
        any |= beyond[z];
    return any;
}

/* Marks cells of a brick; those that are new are followed in their turn. */
static void reach(struct mesher *m, uint32_t number, const uint64_t cells[BRICK])
{
    struct brick *brick = &m->bricks.items[number];
    uint64_t fresh = 0;
    for (int z = 0; z < BRICK; z++) {
        fresh |= cells[z] & ~brick->followed[z];
        brick->followed[z] |= cells[z];
    }
    if (!fresh || brick->queued)
        return;
    if (!ARRAY_RESERVE(&m->stack, 1)) {
        m->failed = true;
        return;
    }
    brick->queued = true;
    m->stack.items[m->stack.count++] = number;
}

static void follow_through(struct mesher *m, uint32_t number)
{
    struct brick *brick = &m->bricks.items[number];
    struct faces faces;
    uint64_t beyond[BRICK], cells[BRICK];
    brick->queued = false;
    find_faces(brick, &faces);
    spread(&faces, brick->followed);
    memcpy(cells, brick->followed, sizeof cells);
    for (int side = 0; side < 6; side++) {
        int axis = side / 2, at[3];
        if (!cross_side(&faces, cells, axis, side % 2, beyond))
            continue;
        memcpy(at, m->bricks.items[number].at, sizeof at); /* the array may have moved */
        at[axis] += side % 2 ? 1 : -1;
        uint32_t next = brick_get(m, at);
        if (next != MESH_NONE)
            reach(m, next, beyond);
    }
}

void follow(struct mesher *m, uint32_t brick, int cell)
{
    uint64_t start[BRICK] = {0};
    start[cell / 64] = (uint64_t)1 << cell % 64;
    m->follows++;
    reach(m, brick, start);
    while (m->stack.count && !m->failed)
        follow_through(m, m->stack.items[--m->stack.count]);
}

void follow_brick(struct mesher *m, uint32_t brick)
{
    for (int row = 0; row < BRICK * BRICK && !m->failed; row++) {
        const struct brick *b = &m->bricks.items[brick];
        unsigned followed = b->followed[row / BRICK] >> 8 * (row % BRICK) & 0xff;
        unsigned cells = cells_crossed(b, row % BRICK, row / BRICK) & ~followed;
        if (!cells)
            continue;
        follow(m, brick, BRICK * row + __builtin_ctz(cells));
        row--; /* there may be more in this row, of other parts */
    }
}
