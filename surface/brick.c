/* Bricks: sampled once, kept by Morton code. */
#include "common/array.h"
#include "surface/mesher.h"

#include <stdlib.h>
#include <string.h>

enum status mesher_init(struct mesher *m, const struct field *field, double threshold, double cube,
                        struct error *err)
{
    memset(m, 0, sizeof *m);
    m->field = field;
    m->threshold = threshold;
    cell_table_make(&m->cells);
    if (grid_init(&m->grid, field, cube, err) || probe_init(&m->probe, field, err))
        mesher_clear(m);
    return m->field ? STATUS_OK : err->status;
}

void mesher_clear(struct mesher *m)
{
    free(m->bricks.items);
    free(m->slots);
    free(m->vertices.items);
    free(m->stack.items);
    free(m->scratch.items);
    grid_clear(&m->grid);
    probe_clear(&m->probe);
    memset(m, 0, sizeof *m);
}

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

static size_t slot_of(const struct mesher *m, uint64_t code)
{
    return (code * 0x9e3779b97f4a7c15u >> 20) & (m->slot_count - 1);
}

uint32_t brick_find(const struct mesher *m, uint64_t code)
{
    if (!m->slot_count)
        return MESH_NONE;
    for (size_t slot = slot_of(m, code);; slot = (slot + 1) & (m->slot_count - 1)) {
        if (!m->slots[slot])
            return MESH_NONE;
        if (m->bricks.items[m->slots[slot] - 1].code == code)
            return m->slots[slot] - 1;
    }
}

static void put_in_slot(struct mesher *m, uint32_t brick)
{
    size_t slot = slot_of(m, m->bricks.items[brick].code);
    while (m->slots[slot])
        slot = (slot + 1) & (m->slot_count - 1);
    m->slots[slot] = brick + 1;
}

static int by_code(const void *a, const void *b)
{
    uint64_t p = ((const struct brick *)a)->code, q = ((const struct brick *)b)->code;
    return (p > q) - (p < q);
}

void bricks_sort(struct mesher *m)
{
    qsort(m->bricks.items, m->bricks.count, sizeof *m->bricks.items, by_code);
    memset(m->slots, 0, m->slot_count * sizeof *m->slots);
    for (uint32_t i = 0; i < m->bricks.count; i++)
        put_in_slot(m, i);
}

static bool make_room(struct mesher *m)
{
    if (!ARRAY_RESERVE(&m->bricks, 1))
        return false;
    if (2 * (m->bricks.count + 1) <= m->slot_count)
        return true;
    size_t count = m->slot_count ? 2 * m->slot_count : 64;
    uint32_t *slots = calloc(count, sizeof *slots);
    if (!slots)
        return false;
    free(m->slots);
    m->slots = slots;
    m->slot_count = count;
    for (uint32_t i = 0; i < m->bricks.count; i++)
        put_in_slot(m, i);
    return true;
}

/* The signs of m->values; false when they are all the same. */
static bool find_signs(const struct mesher *m, struct brick *brick)
{
    unsigned all = 0x1ff, any = 0;
    const double *value = m->values;
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

static void report_progress(const struct mesher *m)
{
    if (m->progress && m->bricks.count % 256 == 0)
        m->progress(m->progress_context, (double)m->vertices.count / (double)(m->vertices_expected + 1));
}

uint32_t brick_get(struct mesher *m, const int at[3])
{
    uint64_t code = brick_code(&m->grid, at);
    uint32_t found = brick_find(m, code);
    if (found != MESH_NONE || m->failed)
        return found;
    struct brick brick = {.at = {at[0], at[1], at[2]}, .code = code};
    int corner[3] = {at[0] * BRICK, at[1] * BRICK, at[2] * BRICK};
    if (!grid_sample(&m->grid, corner, BRICK_CORNERS, &m->scratch, m->values) || !make_room(m)) {
        m->failed = true;
        return MESH_NONE;
    }
    m->samples += BRICK_CORNERS * BRICK_CORNERS * BRICK_CORNERS;
    if (!find_signs(m, &brick))
        return MESH_NONE;
    find_crossed_edges(&brick);
    brick.vertex_first = m->vertices.count;
    if (m->count_only)
        m->vertices.count += brick.vertex_count;
    else
        brick_find_vertices(m, &brick);
    m->bricks.items[m->bricks.count] = brick;
    put_in_slot(m, (uint32_t)m->bricks.count);
    report_progress(m);
    return (uint32_t)m->bricks.count++;
}
