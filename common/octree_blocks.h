/* Inside the octree: how octree_*.c take nodes apart and keep the blocks of children. Nobody else includes
 * this. */
#ifndef COMMON_OCTREE_BLOCKS_H
#define COMMON_OCTREE_BLOCKS_H

#include "common/octree_tape.h"

#include <string.h>

static inline bool node_is_split(octree_node node)
{
    return node >= OCTREE_SPLIT;
}

/* Where the first of a split node's children lies in tree->blocks. */
static inline size_t node_children(octree_node node)
{
    return 8 * (size_t)(node & ~OCTREE_SPLIT);
}

/* Which child of a node of 2^(level + 1) cells a side the cell is in. */
static inline unsigned node_child_of(int x, int y, int z, unsigned level)
{
    return (unsigned)((x >> level & 1) + 2 * (y >> level & 1) + 4 * (z >> level & 1));
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

/* The children of a node, four words at a time. */
typedef octree_node octree_four __attribute__((vector_size(16)));
struct octree_eight {
    octree_four low, high;
};

static inline struct octree_eight eight_load(const octree_node children[8])
{
    struct octree_eight eight;
    memcpy(&eight, children, sizeof eight);
    return eight;
}

static inline struct octree_eight eight_alike(octree_node leaf)
{
    const octree_four four = {leaf, leaf, leaf, leaf};
    return (struct octree_eight){four, four};
}

/* The children of a split node; for a leaf what they would be. */
static inline struct octree_eight eight_of(const struct octree *tree, octree_node node)
{
    return node_is_split(node) ? eight_load(tree->blocks + node_children(node)) : eight_alike(node);
}

/* Which of them are this leaf, a bit each. */
static inline unsigned eight_equal(const struct octree_eight *eight, octree_node leaf)
{
    const octree_four bits = ((octree_four)(eight->low == leaf) & (octree_four){1, 2, 4, 8}) |
                             ((octree_four)(eight->high == leaf) & (octree_four){16, 32, 64, 128});
    return bits[0] | bits[1] | bits[2] | bits[3];
}

/* With the children of this set, a bit each, replaced by a leaf. */
static inline struct octree_eight eight_blend(const struct octree_eight *eight, octree_node leaf,
                                              unsigned set)
{
    const octree_four bits = {set, set, set, set};
    const octree_four low = (bits & (octree_four){1, 2, 4, 8}) != 0;
    const octree_four high = (bits & (octree_four){16, 32, 64, 128}) != 0;
    return (struct octree_eight){(eight->low & ~low) | (leaf & low), (eight->high & ~high) | (leaf & high)};
}

/* True when they are all the same leaf; two split nodes are never the same. */
static inline bool eight_agree(const struct octree_eight *eight)
{
    const octree_node first = eight->low[0];
    const octree_four differences = (eight->low ^ first) | (eight->high ^ first);
    uint64_t halves[2];
    memcpy(halves, &differences, sizeof halves);
    return (halves[0] | halves[1]) == 0;
}

/* True when one of them is split. */
static inline bool eight_split(const struct octree_eight *eight)
{
    const octree_four any = eight->low | eight->high;
    return node_is_split(any[0] | any[1] | any[2] | any[3]);
}

/* The same for the children of a node. Which of them change is chance, so that nothing branches on it. */
static inline void octree_tape_note_eight(struct octree_tape *tape, size_t at, const octree_node before[8],
                                          const octree_node after[8])
{
    if (tape->capacity - tape->count >= 8) {
        struct octree_write *write = tape->items + tape->count;
        for (int i = 0; i < 8; i++) {
            *write = (struct octree_write){(uint32_t)(at + (size_t)i), before[i]};
            write += before[i] != after[i];
        }
        tape->count = (size_t)(write - tape->items);
    } else {
        for (int i = 0; i < 8; i++)
            if (before[i] != after[i])
                octree_tape_note(tape, at + (size_t)i, before[i]);
    }
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

/* Writes the children of a split node. */
static inline void node_write_eight(struct octree *tree, octree_node node,
                                    const struct octree_eight *children)
{
    octree_node *to = tree->blocks + node_children(node), after[8];
    memcpy(after, children, sizeof after);
    if (tree->tape)
        octree_tape_note_eight(tree->tape, node_children(node), to, after);
    memcpy(to, after, sizeof after);
}

/* A split node over a new block with these children, which may move tree->blocks. False
 * when memory is not enough. */
bool octree_split(struct octree *tree, const struct octree_eight *children, octree_node *node);

/* Gives the block of a split node back to the free list. */
void octree_give(struct octree *tree, octree_node node);

/* The node that has these children: the leaf that they agree on, or a split node over a new block, which may
 * move tree->blocks. False when memory is not enough; then the children are still the caller's. */
bool octree_join(struct octree *tree, const octree_node children[8], octree_node *node);

/* The leaf that the children of a split node agree on (its block is then free), or the node itself. */
octree_node octree_merge(struct octree *tree, octree_node node);

/* Gives every block at and below a node back to the free list. */
void octree_release(struct octree *tree, octree_node node);

#endif
