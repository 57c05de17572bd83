/* Octrees that end higher up: what is seen of one from afar. */
#include "common/octree_blocks.h"

/* The material of the first leaf below that is not empty; a split node has one, or it would be merged. */
static octree_node some_material(const struct octree *tree, octree_node node)
{
    if (!node_is_split(node))
        return node;
    octree_node found = 0;
    for (size_t i = 0; i < 8 && !found; i++)
        found = some_material(tree, tree->blocks[node_children(node) + i]);
    return found;
}

static bool cut_node(const struct octree *tree, octree_node node, unsigned levels, struct octree *cut,
                     octree_node *result)
{
    octree_node children[8];
    if (!node_is_split(node) || levels == 0) {
        *result = some_material(tree, node);
        return true;
    }
    for (size_t i = 0; i < 8; i++)
        if (!cut_node(tree, tree->blocks[node_children(node) + i], levels - 1, cut, &children[i]))
            return false;
    return octree_join(cut, children, result);
}

/* The blocks that the last one had are used again. */
enum status octree_cut(const struct octree *tree, unsigned depth, struct octree *cut, struct error *err)
{
    const unsigned levels = depth < tree->depth ? depth : tree->depth;
    cut->depth = levels;
    cut->block_count = cut->free_block = cut->free_count = 0;
    cut->tape = NULL;
    memcpy(cut->coefficient, tree->coefficient, sizeof cut->coefficient);
    if (cut_node(tree, tree->root, levels, cut, &cut->root))
        return STATUS_OK;
    octree_clear(cut);
    return error_no_memory(err, "the octree as seen from afar");
}
