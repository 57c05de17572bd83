/* Inside the octree: how octree_*.c take nodes apart and keep the blocks of children. Nobody else includes
 * this. */
#ifndef COMMON_OCTREE_BLOCKS_H
#define COMMON_OCTREE_BLOCKS_H

#include "common/octree_tape.h"

static inline bool node_is_split(octree_node node)
{
    return node >= OCTREE_SPLIT;
}

/* Where the first of a split node's children lies in tree->blocks. */
static inline size_t node_children(octree_node node)
{
    return 8 * (size_t)(node & ~OCTREE_SPLIT);
}

/* More room on a tape; false when there can be none: then the tape is lost. */
bool octree_tape_grow(struct octree_tape *tape);

/* Records what was at a place of tree->blocks, just before something else is written there. */
static inline void octree_tape_note(struct octree_tape *tape, size_t at, octree_node before)
{
    if (tape->count == tape->capacity && !octree_tape_grow(tape))
        return;
    tape->items[tape->count++] = (struct octree_write){(uint32_t)at, before};
}

/* Records that something changed in a cube of cells. */
void octree_tape_region(struct octree_tape *tape, const int corner[3], int side);

/* Every change to a block that belongs to the tree, or did, is made by this. */
static inline void node_write(struct octree *tree, size_t at, octree_node node)
{
    if (tree->tape && tree->blocks[at] != node)
        octree_tape_note(tree->tape, at, tree->blocks[at]);
    tree->blocks[at] = node;
}

/* The node that has these children: the leaf that they agree on, or a split node over a new block, which may
 * move tree->blocks. False when memory is not enough; then the children are still the caller's. */
bool octree_join(struct octree *tree, const octree_node children[8], octree_node *node);

/* The leaf that the children of a split node agree on (its block is then free), or the node itself. */
octree_node octree_merge(struct octree *tree, octree_node node);

/* Gives every block at and below a node back to the free list. */
void octree_release(struct octree *tree, octree_node node);

#endif
