#include "common/octree.h"
#include "common/octree_blocks.h"

#include <stdlib.h>
#include <string.h>

enum status octree_init(struct octree *tree, unsigned depth, unsigned material, struct error *err)
{
    if (depth > OCTREE_DEPTH_MAX)
        return error_set(err, STATUS_RANGE, "depth %u: must be from 0 to %d", depth, OCTREE_DEPTH_MAX);
    if (material >= OCTREE_MATERIALS)
        return error_set(err, STATUS_RANGE, "material %u: must be from 0 to %d", material,
                         OCTREE_MATERIALS - 1);
    *tree = (struct octree){.root = material, .depth = depth};
    for (int m = 0; m < OCTREE_MATERIALS; m++)
        tree->coefficient[m] = 1;
    return STATUS_OK;
}

void octree_clear(struct octree *tree)
{
    free(tree->blocks);
    *tree = (struct octree){0};
}

enum status octree_copy(struct octree *to, const struct octree *from, struct error *err)
{
    size_t bytes = 8 * sizeof *from->blocks * from->block_count;
    octree_node *blocks = NULL;
    if (bytes > 0) {
        blocks = malloc(bytes);
        if (!blocks)
            return error_no_memory(err, "a copy of the octree");
        memcpy(blocks, from->blocks, bytes);
    }
    free(to->blocks);
    *to = *from;
    to->blocks = blocks;
    to->block_capacity = from->block_count;
    to->tape = NULL;
    return STATUS_OK;
}

static bool nodes_equal(const struct octree *a, octree_node in_a, const struct octree *b, octree_node in_b)
{
    if (!node_is_split(in_a) || !node_is_split(in_b))
        return in_a == in_b && (in_a == 0 || a->coefficient[in_a] == b->coefficient[in_b]);
    for (int i = 0; i < 8; i++)
        if (!nodes_equal(a, a->blocks[node_children(in_a) + i], b, b->blocks[node_children(in_b) + i]))
            return false;
    return true;
}

bool octree_equal(const struct octree *a, const struct octree *b)
{
    return a->depth == b->depth && nodes_equal(a, a->root, b, b->root);
}

/* Half as much again each time: at most half of the memory of the blocks in use lies idle. */
static bool grow(struct octree *tree)
{
    uint64_t wanted = (uint64_t)tree->block_capacity + tree->block_capacity / 2 + 64;
    if (wanted > OCTREE_SPLIT)
        wanted = OCTREE_SPLIT;
    if (wanted <= tree->block_count || wanted > PTRDIFF_MAX / (8 * sizeof *tree->blocks))
        return false;
    octree_node *blocks = realloc(tree->blocks, wanted * 8 * sizeof *blocks);
    if (!blocks)
        return false;
    tree->blocks = blocks;
    tree->block_capacity = (uint32_t)wanted;
    return true;
}

static bool take_block(struct octree *tree, uint32_t *block)
{
    if (tree->free_count > 0) {
        *block = tree->free_block;
        tree->free_block = tree->blocks[8 * (size_t)*block];
        tree->free_count--;
        return true;
    }
    if (tree->block_count == tree->block_capacity && !grow(tree))
        return false;
    *block = tree->block_count++;
    return true;
}

/* A block that was not in use before the tape began is nothing to go back to, and nobody writes there between
 * an undo and a redo: what it holds need not be noted. */
bool octree_split(struct octree *tree, const struct octree_eight *children, octree_node *node)
{
    uint32_t block;
    if (!take_block(tree, &block))
        return false;
    *node = OCTREE_SPLIT + block;
    if (tree->tape && block < tree->tape->before.block_count)
        node_write_eight(tree, *node, children);
    else
        memcpy(tree->blocks + 8 * (size_t)block, children, sizeof *children);
    return true;
}

void octree_give(struct octree *tree, octree_node node)
{
    node_write(tree, node_children(node), tree->free_block);
    tree->free_block = node & ~OCTREE_SPLIT;
    tree->free_count++;
}

bool octree_join(struct octree *tree, const octree_node children[8], octree_node *node)
{
    const struct octree_eight eight = eight_load(children);
    if (!eight_agree(&eight))
        return octree_split(tree, &eight, node);
    *node = children[0];
    return true;
}

octree_node octree_merge(struct octree *tree, octree_node node)
{
    const struct octree_eight children = eight_load(tree->blocks + node_children(node));
    if (!eight_agree(&children))
        return node;
    octree_give(tree, node);
    return children.low[0];
}

void octree_release(struct octree *tree, octree_node node)
{
    if (!node_is_split(node))
        return;
    const struct octree_eight children = eight_load(tree->blocks + node_children(node));
    if (eight_split(&children))
        for (int i = 0; i < 8; i++)
            octree_release(tree, tree->blocks[node_children(node) + i]);
    octree_give(tree, node);
}
