/* The bricks of all workers: made, found, put together. */
#include "surface/mesher.h"

#include "common/array.h"

#include <stdlib.h>
#include <string.h>

static enum status open_workers(struct mesher *m, double cube, struct error *err)
{
    unsigned count = threads_workers(m->pool);
    m->worker = calloc(count, sizeof *m->worker);
    if (!m->worker)
        return error_no_memory(err, "the workers");
    for (unsigned i = 0; i < count; i++) {
        m->worker[i] = calloc(1, sizeof **m->worker);
        if (!m->worker[i] || !block_init(&m->worker[i]->block, &m->grid))
            return error_no_memory(err, "the workers");
        if (probe_init(&m->worker[i]->probe, m->field, err))
            return err->status;
        probe_expect(&m->worker[i]->probe, cube);
    }
    return STATUS_OK;
}

enum status mesher_init(struct mesher *m, const struct field *field, double threshold, double cube,
                        struct threads *pool, struct error *err)
{
    *m = (struct mesher){
        .field = field, .threshold = threshold, .sides = sides_of(field, threshold), .pool = pool};
    cell_table_make(&m->cells);
    enum status status = grid_init(&m->grid, field, cube, err);
    if (status == STATUS_OK)
        status = open_workers(m, cube, err);
    if (status)
        mesher_clear(m);
    return status;
}

static void close_worker(struct worker *worker)
{
    if (!worker)
        return;
    probe_clear(&worker->probe);
    block_clear(&worker->block);
    free(worker->bricks.items);
    for (struct vertex_chunk *chunk = worker->chunks, *next; chunk; chunk = next) {
        next = chunk->next;
        free(chunk);
    }
    free(worker);
}

void mesher_clear(struct mesher *m)
{
    for (unsigned i = 0; m->worker && i < threads_workers(m->pool); i++)
        close_worker(m->worker[i]);
    free(m->worker);
    free(m->bricks.items);
    free(m->slots);
    free(m->stack.items);
    grid_clear(&m->grid);
    *m = (struct mesher){0};
}

bool mesher_failed(const struct mesher *m)
{
    bool failed = m->failed;
    for (unsigned i = 0; i < threads_workers(m->pool); i++)
        failed |= m->worker[i]->failed || m->worker[i]->probe.failed;
    return failed;
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

static bool make_slots(struct mesher *m, size_t bricks)
{
    size_t count = m->slot_count ? m->slot_count : 64;
    while (count < 2 * bricks)
        count *= 2;
    if (count == m->slot_count)
        return true;
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

/* Moves a worker's bricks to those of all. */
static void take_bricks(struct mesher *m, struct worker *worker)
{
    size_t count = worker->bricks.count;
    if (count >= MESH_NONE - m->bricks.count || !ARRAY_RESERVE(&m->bricks, count) ||
        !make_slots(m, m->bricks.count + count)) {
        m->failed = true;
        return;
    }
    for (size_t i = 0; i < count; i++) {
        m->bricks.items[m->bricks.count] = worker->bricks.items[i];
        put_in_slot(m, (uint32_t)m->bricks.count++);
    }
    worker->bricks.count = 0;
}

uint32_t brick_get(struct mesher *m, const int at[3])
{
    uint64_t code = brick_code(&m->grid, at);
    uint32_t found = brick_find(m, code);
    if (found != MESH_NONE || m->failed)
        return found;
    brick_make(m, m->worker[0], at);
    take_bricks(m, m->worker[0]);
    return brick_find(m, code);
}

static int by_code(const void *a, const void *b)
{
    uint64_t p = ((const struct brick *)a)->code, q = ((const struct brick *)b)->code;
    return (p > q) - (p < q);
}

static void number_bricks(struct mesher *m)
{
    m->vertex_count = m->triangle_count = m->middle_count = 0;
    for (size_t i = 0; i < m->bricks.count; i++) {
        struct brick *brick = &m->bricks.items[i];
        brick->vertex_first = m->vertex_count;
        brick->triangle_first = m->triangle_count;
        brick->middle_first = m->middle_count;
        m->vertex_count += brick->vertex_count;
        m->triangle_count += brick->triangle_count;
        m->middle_count += brick->middle_count;
    }
}

void bricks_join(struct mesher *m)
{
    for (unsigned i = 0; i < threads_workers(m->pool); i++) {
        struct worker *worker = m->worker[i];
        take_bricks(m, worker);
        free(worker->bricks.items);
        worker->bricks = (struct bricks){0};
    }
    if (m->bricks.count == 0 || m->failed)
        return;
    qsort(m->bricks.items, m->bricks.count, sizeof *m->bricks.items, by_code);
    memset(m->slots, 0, m->slot_count * sizeof *m->slots);
    for (uint32_t i = 0; i < m->bricks.count; i++)
        put_in_slot(m, i);
    number_bricks(m);
}
