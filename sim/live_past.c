#include "sim/live_past.h"
#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A block's bytes, shared by the frames in which they are the same. */
struct live_chunk {
    size_t holders, size;
    unsigned char data[];
};

static size_t chunk_bytes(const struct live_chunk *chunk)
{
    return sizeof *chunk + chunk->size;
}

static void let_go(struct live_past *past, struct live_frame *frame)
{
    for (size_t i = 0; i < frame->chunk_count; i++) {
        struct live_chunk *chunk = frame->chunk[i];
        if (--chunk->holders > 0)
            continue;
        past->bytes -= chunk_bytes(chunk);
        free(chunk);
    }
    free(frame->chunk);
    *frame = (struct live_frame){0};
}

/* The chunk of the frame before, where it holds the same; else a new one. NULL: no memory. */
static struct live_chunk *chunk_of(struct live_past *past, const struct live_frame *before, size_t i,
                                   const struct sim_block *block)
{
    struct live_chunk *chunk = before && i < before->chunk_count ? before->chunk[i] : NULL;
    if (chunk && chunk->size == block->size &&
        (!block->size || !memcmp(chunk->data, block->data, block->size))) {
        chunk->holders++;
        return chunk;
    }
    chunk = malloc(sizeof *chunk + block->size);
    if (!chunk)
        return NULL;
    chunk->holders = 1;
    chunk->size = block->size;
    if (block->size)
        memcpy(chunk->data, block->data, block->size);
    past->bytes += chunk_bytes(chunk);
    return chunk;
}

/* Every second frame goes, but the first and the newest. */
static void thin_out(struct live_past *past)
{
    size_t kept = 1;
    for (size_t i = 1; i < past->count; i++) {
        if ((past->count - 1 - i) % 2)
            let_go(past, &past->items[i]);
        else
            past->items[kept++] = past->items[i];
    }
    past->count = kept;
}

static void forget_second(struct live_past *past)
{
    let_go(past, &past->items[1]);
    past->count--;
    memmove(&past->items[1], &past->items[2], (past->count - 1) * sizeof *past->items);
}

static void keep_limits(struct live_past *past)
{
    while (past->bytes > past->bytes_most && past->count > 3)
        thin_out(past);
    while ((past->count > past->frames_most || past->bytes > past->bytes_most) && past->count > 2)
        forget_second(past);
}

enum status live_past_add(struct live_past *past, struct sim *sim, struct live_marks marks, struct error *err)
{
    size_t count;
    const struct sim_block *blocks = sim_blocks(sim, &count);
    struct live_frame frame = {.marks = marks, .chunk = array_new(count, sizeof(struct live_chunk *))};
    bool room = frame.chunk && ARRAY_RESERVE(past, 1);
    const struct live_frame *before = past->count ? &past->items[past->count - 1] : NULL;
    for (; room && frame.chunk_count < count; frame.chunk_count++) {
        struct live_chunk *chunk = chunk_of(past, before, frame.chunk_count, &blocks[frame.chunk_count]);
        room = chunk;
        if (!room)
            break;
        frame.chunk[frame.chunk_count] = chunk;
    }
    if (!room) {
        let_go(past, &frame);
        return error_no_memory(err, "the past");
    }
    past->items[past->count++] = frame;
    keep_limits(past);
    return STATUS_OK;
}

/* Twice: where the first blocks say how long the others are, these are complete the second time. */
void live_past_restore(const struct live_past *past, size_t i, struct sim *sim)
{
    const struct live_frame *frame = &past->items[i];
    for (int round = 0; round < 2; round++) {
        size_t count;
        const struct sim_block *blocks = sim_blocks(sim, &count);
        for (size_t k = 0; k < count && k < frame->chunk_count; k++) {
            const struct live_chunk *chunk = frame->chunk[k];
            const size_t size = chunk->size < blocks[k].size ? chunk->size : blocks[k].size;
            if (size)
                memcpy(blocks[k].data, chunk->data, size);
        }
    }
    sim_restored(sim);
}

void live_past_forget_after(struct live_past *past, size_t i)
{
    while (past->count > i + 1)
        let_go(past, &past->items[--past->count]);
}

size_t live_past_nearest(const struct live_past *past, double time)
{
    size_t best = 0;
    for (size_t i = 1; i < past->count; i++)
        if (fabs(past->items[i].marks.time - time) <= fabs(past->items[best].marks.time - time))
            best = i;
    return best;
}

void live_past_clear(struct live_past *past)
{
    while (past->count)
        let_go(past, &past->items[--past->count]);
    free(past->items);
    past->items = NULL;
    past->capacity = 0;
}
