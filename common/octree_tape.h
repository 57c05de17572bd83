/*
 * A tape of the changes to an octree, with which they can be taken back and done again to the very byte.
 *
 *     struct octree_tape tape = {.limit = SIZE_MAX};
 *     octree_tape_begin(&tape, &tree);
 *     ... octree_apply(), octree_set(), octree_fill_hollows() ...
 *     octree_tape_end(&tape, &tree);
 *     octree_undo(&tree, tape.items, tape.count, &tape.before);
 *
 * Nothing is copied as a whole: a write of a node records the place and what was there, and the
 * few words that are not in the blocks are kept as they were before and after. Without a tape an
 * octree is as fast as ever.
 */
#ifndef COMMON_OCTREE_TAPE_H
#define COMMON_OCTREE_TAPE_H

#include "common/octree.h"

/* Cells from low to high, both included, along each axis. */
struct octree_region {
    int low[3], high[3];
};

/* Where something changed: boxes that hold it all and may overlap. Several, so that a chip and its mirror
 * images do not make one of all that lies between them. */
enum { OCTREE_REGIONS_MAX = 8 };
struct octree_regions {
    struct octree_region items[OCTREE_REGIONS_MAX];
    int count;
};

/* Adds a region: to the one that it is near to, or as one more where there is room and it would
 * make that much larger. */
void octree_regions_add(struct octree_regions *regions, const struct octree_region *region);

/* One node: its place in tree->blocks, and what was there before. Once undone it is what was there after. */
struct octree_write {
    uint32_t at;
    octree_node node;
};

/* What there is of a tree beside its blocks. */
struct octree_head {
    octree_node root;
    uint32_t block_count, free_block, free_count;
};

struct octree_tape {
    struct octree_write *items; /* in the order in which they were made */
    size_t count, capacity;
    size_t limit; /* writes at most */
    bool lost;    /* there were more than that, or memory was not enough: the tape cannot be undone */
    struct octree_head before, after;
    struct octree_regions regions;
};

/* Empties the tape and lets the tree record on it. Its memory is kept; free(tape->items) gives it back. */
void octree_tape_begin(struct octree_tape *tape, struct octree *tree);
void octree_tape_end(struct octree_tape *tape, struct octree *tree);

/* Takes back these writes, the last first, and the head; or makes them again. The tree must be as it was
 * after them (before them). O(count). */
void octree_undo(struct octree *tree, struct octree_write *writes, size_t count,
                 const struct octree_head *before);
void octree_redo(struct octree *tree, struct octree_write *writes, size_t count,
                 const struct octree_head *after);

#endif
