/* Changes to an octree: what a shape covers, and single cells. */
#include "common/octree_blocks.h"

#include <assert.h>

struct edit {
    struct octree *tree;
    octree_shape *covers;
    const void *shape;
    octree_node material;
    bool failed; /* a block could not be had */
};

static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level);

static octree_node edit_child(struct edit *edit, octree_node child, int i, const double corner[3],
                              double half, unsigned level)
{
    if (edit->failed || child == edit->material)
        return child;
    const double at[3] = {corner[0] + (i & 1 ? half : 0), corner[1] + (i & 2 ? half : 0),
                          corner[2] + (i & 4 ? half : 0)};
    return edit_node(edit, child, at, half, level);
}

/* Children are made on the stack, so that a leaf whose children end up alike costs no block. */
static octree_node edit_leaf(struct edit *edit, octree_node leaf, const double corner[3], double half,
                             unsigned level)
{
    octree_node children[8], node;
    for (int i = 0; i < 8; i++)
        children[i] = edit_child(edit, leaf, i, corner, half, level);
    if (octree_join(edit->tree, children, &node))
        return node;
    edit->failed = true;
    for (int i = 0; i < 8; i++)
        octree_release(edit->tree, children[i]);
    return leaf;
}

/* The node that takes the place of `node`. `level` is the number of halvings left. */
static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level)
{
    enum octree_cover cover = edit->covers(edit->shape, corner, side, level == 0);
    if (cover == OCTREE_OUTSIDE)
        return node;
    if (cover == OCTREE_INSIDE) {
        octree_release(edit->tree, node);
        return edit->material;
    }
    assert(level > 0);
    if (!node_is_split(node))
        return edit_leaf(edit, node, corner, side / 2, level - 1);
    for (int i = 0; i < 8; i++) {
        octree_node child = edit->tree->blocks[node_children(node) + i];
        child = edit_child(edit, child, i, corner, side / 2, level - 1);
        edit->tree->blocks[node_children(node) + i] = child; /* blocks may have moved meanwhile */
    }
    return octree_merge(edit->tree, node);
}

enum status octree_apply(struct octree *tree, octree_shape *covers, const void *shape, unsigned material,
                         struct error *err)
{
    assert(material < OCTREE_MATERIALS);
    struct edit edit = {tree, covers, shape, material, false};
    const double corner[3] = {0};
    if (tree->root != material)
        tree->root = edit_node(&edit, tree->root, corner, 1, tree->depth);
    return edit.failed ? error_no_memory(err, "the octree") : STATUS_OK;
}

/* Splits a leaf along the way to one of its cells; false when memory is not enough. */
static bool set_in_leaf(struct octree *tree, octree_node *node, const unsigned cell[3], unsigned level,
                        octree_node material)
{
    octree_node made = material;
    for (unsigned bit = 0; bit < level; bit++) {
        octree_node children[8], leaf = *node;
        for (int i = 0; i < 8; i++)
            children[i] = leaf;
        children[(cell[0] >> bit & 1) + 2 * (cell[1] >> bit & 1) + 4 * (cell[2] >> bit & 1)] = made;
        octree_node parent;
        if (!octree_join(tree, children, &parent)) {
            octree_release(tree, made);
            return false;
        }
        made = parent;
    }
    *node = made;
    return true;
}

enum status octree_set(struct octree *tree, int x, int y, int z, unsigned material, struct error *err)
{
    assert(material < OCTREE_MATERIALS);
    assert((x | y | z) >= 0 && ((x | y | z) >> tree->depth) == 0);
    const unsigned cell[3] = {(unsigned)x, (unsigned)y, (unsigned)z};
    octree_node path[OCTREE_DEPTH_MAX];
    size_t place[OCTREE_DEPTH_MAX];
    octree_node node = tree->root;
    unsigned level = tree->depth, steps = 0;
    for (; node_is_split(node); steps++) {
        level--;
        path[steps] = node;
        place[steps] = node_children(node) + (cell[0] >> level & 1) + 2 * (cell[1] >> level & 1) +
                       4 * (cell[2] >> level & 1);
        node = tree->blocks[place[steps]];
    }
    if (node == material)
        return STATUS_OK;
    if (!set_in_leaf(tree, &node, cell, level, material))
        return error_no_memory(err, "the octree");
    while (steps-- > 0) {
        tree->blocks[place[steps]] = node;
        node = octree_merge(tree, path[steps]);
    }
    tree->root = node;
    return STATUS_OK;
}
