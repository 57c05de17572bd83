#include "sculpt/history.h"

#include "common/array.h"

#include <stdlib.h>
#include <string.h>

void history_init(struct history *history, size_t byte_limit)
{
    *history = (struct history){.byte_limit = byte_limit};
    history->tape.limit = byte_limit / sizeof(struct octree_write);
}

static size_t step_bytes(const struct history_step *step)
{
    return sizeof *step + step->count * sizeof *step->writes;
}

/* Forgets the steps from first to before last, which become fewer. */
static void forget(struct history *history, size_t first, size_t last)
{
    for (size_t i = first; i < last; i++) {
        history->bytes -= step_bytes(&history->items[i]);
        free(history->items[i].writes);
    }
    if (first < last && last < history->count)
        memmove(history->items + first, history->items + last,
                (history->count - last) * sizeof *history->items);
    history->count -= last - first;
}

void history_clear(struct history *history)
{
    forget(history, 0, history->count);
    free(history->items);
    free(history->tape.items);
    history_init(history, history->byte_limit);
}

void history_begin(struct history *history, struct octree *tree)
{
    octree_tape_begin(&history->tape, tree);
}

/* The step on the tape, in memory of just its size. False when it is not whole or there is no room for it. */
static bool keep(struct history *history)
{
    const struct octree_tape *tape = &history->tape;
    struct history_step step = {NULL, tape->count, tape->before, tape->after, tape->regions};
    if (tape->lost || step_bytes(&step) > history->byte_limit || !ARRAY_RESERVE(history, 1))
        return false;
    step.writes = array_new(step.count, sizeof *step.writes);
    if (!step.writes)
        return false;
    if (step.count > 0)
        memcpy(step.writes, tape->items, step.count * sizeof *step.writes);
    history->items[history->count++] = step;
    history->done = history->count;
    history->bytes += step_bytes(&step);
    return true;
}

/* The oldest steps go, several at a time so that moving the others does not count. */
static void keep_limit(struct history *history)
{
    size_t drop = 0, bytes = history->bytes;
    if (bytes <= history->byte_limit)
        return;
    while (bytes > history->byte_limit - history->byte_limit / 16 && drop + 1 < history->count)
        bytes -= step_bytes(&history->items[drop++]);
    forget(history, 0, drop);
    history->done -= drop;
}

bool history_end(struct history *history, struct octree *tree, struct octree_regions *regions)
{
    struct octree_tape *tape = &history->tape;
    octree_tape_end(tape, tree);
    if (regions)
        *regions = tape->regions;
    if (tape->count == 0 && !tape->lost && tape->before.root == tape->after.root)
        return true;
    forget(history, history->done, history->count);
    if (!keep(history)) {
        history_clear(history);
        return false;
    }
    keep_limit(history);
    return true;
}

bool history_cancel(struct history *history, struct octree *tree)
{
    struct octree_tape *tape = &history->tape;
    octree_tape_end(tape, tree);
    if (tape->lost) {
        history_clear(history);
        return false;
    }
    octree_undo(tree, tape->items, tape->count, &tape->before);
    forget(history, history->done, history->count);
    return true;
}

bool history_undo(struct history *history, struct octree *tree, struct octree_regions *regions)
{
    if (!history_can_undo(history))
        return false;
    struct history_step *step = &history->items[--history->done];
    octree_undo(tree, step->writes, step->count, &step->before);
    if (regions)
        *regions = step->regions;
    return true;
}

bool history_redo(struct history *history, struct octree *tree, struct octree_regions *regions)
{
    if (!history_can_redo(history))
        return false;
    struct history_step *step = &history->items[history->done++];
    octree_redo(tree, step->writes, step->count, &step->after);
    if (regions)
        *regions = step->regions;
    return true;
}
