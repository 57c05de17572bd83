/* Bricks: sampled once, kept by Morton code. */
#include "common/array.h"
#include "surface/mesher.h"

#include <math.h>

/* 21 bits apart: bit i goes to bit 3 i. */
static uint64_t spread(uint64_t bits)
{
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffff;
    bits = (bits | bits << 16) & 0x1f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

uint64_t brick_code(const struct grid *grid, const int at[3])
{
    uint64_t x = (uint64_t)(at[0] - grid->brick_low[0]), y = (uint64_t)(at[1] - grid->brick_low[1]);
    return spread(x) | spread(y) << 1 | spread((uint64_t)(at[2] - grid->brick_low[2])) << 2;
}

/* Whether all corners are on one side of the threshold, by the field in the middle. */
static bool is_one_sided(const struct mesher *m, struct worker *worker)
{
    static const int middle[3] = {BRICK / 2, BRICK / 2, BRICK / 2};
    double gradient[3];
    const double radius = sqrt(3) * BRICK / 2 * m->grid.cube;
    if (!sides_may_tell(&m->sides, radius))
        return false;
    worker->evaluations++;
    return sides_tell(&m->sides, block_corner(&worker->block, middle, gradient), radius);
}

/* The signs of the values; false when they are all the same. */
static bool find_signs(const struct mesher *m, const double *value, struct brick *brick)
{
    unsigned all = 0x1ff, any = 0;
    for (int row = 0; row < BRICK_CORNERS * BRICK_CORNERS; row++) {
        unsigned bits = 0;
        for (int x = 0; x < BRICK_CORNERS; x++)
            bits |= (unsigned)(*value++ >= m->threshold) << x;
        brick->inside[row] = (uint16_t)bits;
        all &= bits;
        any |= bits;
    }
    return any && all != 0x1ff;
}

static void find_crossed_edges(struct brick *brick)
{
    uint32_t count = 0;
    for (int z = 0; z < BRICK; z++) {
        for (int y = 0; y < BRICK; y++) {
            const uint16_t *row = &brick->inside[z * BRICK_CORNERS + y];
            unsigned x_edges = row[0] ^ row[0] >> 1, y_edges = row[0] ^ row[1];
            unsigned z_edges = row[0] ^ row[BRICK_CORNERS];
            brick->crossed[0][z] |= (uint64_t)(x_edges & 0xff) << 8 * y;
            brick->crossed[1][z] |= (uint64_t)(y_edges & 0xff) << 8 * y;
            brick->crossed[2][z] |= (uint64_t)(z_edges & 0xff) << 8 * y;
        }
        for (int axis = 0; axis < 3; axis++) {
            brick->rank[z][axis] = (uint16_t)count;
            count += (uint32_t)__builtin_popcountll(brick->crossed[axis][z]);
        }
    }
    brick->vertex_count = count;
}

/* Bit f: the field in the middle of ambiguous face f is inside. */
static unsigned faces_joined(const struct mesher *m, struct worker *worker, const struct brick *brick,
                             const int at[3], unsigned ambiguous)
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
        joined |= (unsigned)(worker_value(worker, middle, gradient) >= m->threshold) << face;
    }
    return joined;
}

const struct cell_loops *cell_loops_of(const struct mesher *m, struct worker *worker,
                                       const struct brick *brick, const int at[3], unsigned inside,
                                       struct cell_loops *own)
{
    unsigned ambiguous = m->cells.ambiguous[inside];
    if (!ambiguous)
        return &m->cells.loops[inside];
    cell_find_loops(&m->cells, inside, faces_joined(m, worker, brick, at, ambiguous), own);
    return own;
}

static void count_loops(const struct cell_table *table, const struct cell_loops *loops, struct brick *brick)
{
    for (int i = 0; i < loops->count; i++) {
        bool fan = cell_needs_middle(table, loops->edge[i], loops->length[i]);
        brick->triangle_count += fan ? loops->length[i] : loops->length[i] - 2u;
        brick->middle_count += fan;
    }
}

static void count_triangles(const struct mesher *m, struct worker *worker, struct brick *brick)
{
    for (int row = 0; row < BRICK * BRICK; row++)
        for (unsigned cells = cells_crossed(brick, row % BRICK, row / BRICK); cells; cells &= cells - 1) {
            int at[3] = {__builtin_ctz(cells), row % BRICK, row / BRICK};
            unsigned inside = cell_inside(brick, at[0], at[1], at[2]);
            struct cell_loops own;
            if (m->cells.ambiguous[inside])
                count_loops(&m->cells, cell_loops_of(m, worker, brick, at, inside, &own), brick);
            else
                brick->triangle_count += m->cells.triangles[inside];
        }
}

double worker_value(struct worker *worker, const double point[3], double gradient[3])
{
    if (!worker->in_block)
        return probe_value(&worker->probe, point, gradient);
    worker->evaluations++;
    return block_value(&worker->block, point, gradient);
}

/* What the worker's block, moved to the brick, holds; false when the surface does not pass through it. */
static bool find_contents(const struct mesher *m, struct worker *worker, struct brick *brick)
{
    if (is_one_sided(m, worker))
        return false;
    worker->failed |= !block_sample(&worker->block);
    worker->samples += BLOCK_VALUES;
    if (worker->failed || !find_signs(m, worker->block.values, brick))
        return false;
    find_crossed_edges(brick);
    count_triangles(m, worker, brick);
    if (!m->count_only)
        brick_find_vertices(m, worker, brick);
    return true;
}

void brick_make(const struct mesher *m, struct worker *worker, const int at[3])
{
    struct brick brick = {.at = {at[0], at[1], at[2]}, .code = brick_code(&m->grid, at)};
    worker->failed |= worker->failed || !block_move(&worker->block, at);
    if (worker->failed)
        return;
    worker->in_block = true;
    bool crossed = find_contents(m, worker, &brick);
    worker->in_block = false;
    worker->failed |= crossed && !ARRAY_RESERVE(&worker->bricks, 1);
    if (crossed && !worker->failed)
        worker->bricks.items[worker->bricks.count++] = brick;
}
