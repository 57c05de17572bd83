/*
 * Undo and redo without limit but memory's.
 *
 *     struct history history;
 *     history_init(&history, 256 << 20);
 *     history_begin(&history, &tree);
 *     status = sculpt_chip(&tree, &chip, err);          as many as belong to the step
 *     if (status)
 *         history_cancel(&history, &tree);              the tree is as it was
 *     else
 *         history_end(&history, &tree, &regions);       what a window has to draw anew
 *     history_undo(&history, &tree, &regions);
 *     history_clear(&history);
 *
 * A step keeps the nodes that it replaced, so it costs as much memory as it changed, and taking it back is
 * faster than it was to make. Between steps nobody else may change the tree; where it is replaced by another
 * (opened, imported), the history is cleared.
 */
#ifndef SCULPT_HISTORY_H
#define SCULPT_HISTORY_H

#include "common/octree_tape.h"

/* What was done between begin and end. */
struct history_step {
    struct octree_write *writes; /* [count] */
    size_t count;
    struct octree_head before, after;
    struct octree_regions regions;
};

struct history {
    struct history_step *items; /* the oldest first */
    size_t count, capacity;
    size_t done;              /* that many of them are done, the others were undone */
    size_t bytes, byte_limit; /* kept, and at most */
    struct octree_tape tape;
};

/* An empty history that keeps at most byte_limit bytes of steps (beside one step being recorded, which is
 * held twice for a moment). */
void history_init(struct history *history, size_t byte_limit);

/* Forgets all steps and gives their memory back; the limit stays. */
void history_clear(struct history *history);

/* Begins a step. Only changes until its end may be undone. */
void history_begin(struct history *history, struct octree *tree);

/* Ends a step: it can be undone, and what was undone before can no longer be redone. Steps that changed
 * nothing are not kept. Drops the oldest steps while there are more bytes than the limit. False when the step
 * alone is larger than that, or memory is not enough to keep it: then it is done, and nothing can be undone
 * any more. *regions, unless NULL, says where cells changed. */
bool history_end(struct history *history, struct octree *tree, struct octree_regions *regions);

/* Takes back what was done since the beginning of a step, and forgets it. What was undone before can no
 * longer be redone: the blocks that it needs may have been used. False when the step was too large to be
 * recorded: then the tree stays as it has become, and the history is empty. */
bool history_cancel(struct history *history, struct octree *tree);

/* Takes back the last step that is done; does again the one taken back last. False when there is none. */
bool history_undo(struct history *history, struct octree *tree, struct octree_regions *regions);
bool history_redo(struct history *history, struct octree *tree, struct octree_regions *regions);

static inline bool history_can_undo(const struct history *history)
{
    return history->done > 0;
}

static inline bool history_can_redo(const struct history *history)
{
    return history->done < history->count;
}

#endif
