/* Changes to an octree: what a shape covers, and single cells. */
#include "common/octree_blocks.h"

#include <assert.h>

struct edit {
    struct octree *tree;
    octree_shape *covers;
    const void *shape;
    octree_node material;
    bool failed; /* a block could not be had */
    struct octree_tape *tape;
    double low[3], high[3]; /* around what changed; kept where there is a tape */
};

static inline void note_change(struct edit *edit, const double corner[3], double side)
{
    for (int k = 0; k < 3; k++) {
        edit->low[k] = corner[k] < edit->low[k] ? corner[k] : edit->low[k];
        edit->high[k] = corner[k] + side > edit->high[k] ? corner[k] + side : edit->high[k];
    }
}

static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level);

/* The children that a shape may cover something of, as a set of bits; and the first of such a set. */
static inline unsigned touched(struct octree_cover cover)
{
    return ~cover.outside & 0xff;
}

static inline int first_of(unsigned children)
{
    return __builtin_ctz(children);
}

/* The node that takes the place of child i of a cube, which is one of those touched. `level` is the
 * number of halvings that are left to the child. */
static inline octree_node edit_child(struct edit *edit, struct octree_cover cover, octree_node child, int i,
                                     const double corner[3], double side, unsigned level)
{
    if (child == edit->material || edit->failed)
        return child;
    const double at[3] = {corner[0] + (i & 1 ? side : 0), corner[1] + (i & 2 ? side : 0),
                          corner[2] + (i & 4 ? side : 0)};
    if (cover.inside >> i & 1) {
        if (edit->tape)
            note_change(edit, at, side);
        if (node_is_split(child))
            octree_release(edit->tree, child);
        return edit->material;
    }
    return edit_node(edit, child, at, side, level);
}

/* Children are made on the stack, so that a leaf whose children end up alike costs no block. */
static octree_node edit_leaf(struct edit *edit, struct octree_cover cover, octree_node leaf,
                             const double corner[3], double half, unsigned level)
{
    octree_node children[8], node;
    for (int i = 0; i < 8; i++)
        children[i] = leaf;
    for (unsigned left = touched(cover); left != 0; left &= left - 1)
        children[first_of(left)] = edit_child(edit, cover, leaf, first_of(left), corner, half, level);
    if (octree_join(edit->tree, children, &node))
        return node;
    edit->failed = true;
    for (int i = 0; i < 8; i++)
        octree_release(edit->tree, children[i]);
    return leaf;
}

/* The same for children that are cells: they are leaves and are not crossed. */
static octree_node edit_cells(struct edit *edit, unsigned inside, octree_node node, const double corner[3],
                              double side)
{
    octree_node cells[8];
    if (inside == 0 || node == edit->material)
        return node;
    if (edit->tape)
        note_change(edit, corner, side);
    if (node_is_split(node)) {
        octree_node *cell = edit->tree->blocks + node_children(node);
        if (edit->tape)
            for (unsigned left = inside; left != 0; left &= left - 1)
                node_write(edit->tree, node_children(node) + first_of(left), edit->material);
        else
            for (int i = 0; i < 8; i++)
                cell[i] = inside >> i & 1 ? edit->material : cell[i];
        return octree_merge(edit->tree, node);
    }
    for (int i = 0; i < 8; i++)
        cells[i] = inside >> i & 1 ? edit->material : node;
    if (!octree_join(edit->tree, cells, &node))
        edit->failed = true;
    return node;
}

/* The node that takes the place of one that the shape crosses. */
static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level)
{
    const double half = side / 2;
    level--;
    struct octree_cover cover = edit->covers(edit->shape, corner, half, level == 0);
    if (level == 0)
        return edit_cells(edit, cover.inside, node, corner, side);
    if (!node_is_split(node))
        return edit_leaf(edit, cover, node, corner, half, level);
    for (unsigned left = touched(cover); left != 0; left &= left - 1) {
        size_t at = node_children(node) + first_of(left);
        octree_node child = edit->tree->blocks[at];
        child = edit_child(edit, cover, child, first_of(left), corner, half, level);
        node_write(edit->tree, at, child); /* blocks may have moved meanwhile */
    }
    return octree_merge(edit->tree, node);
}

static void note_region(const struct edit *edit)
{
    struct octree_region region;
    const double cells = 1 << edit->tree->depth;
    for (int k = 0; k < 3; k++) {
        region.low[k] = (int)(edit->low[k] * cells);
        region.high[k] = (int)(edit->high[k] * cells) - 1;
    }
    octree_regions_add(&edit->tape->regions, &region);
}

enum status octree_apply(struct octree *tree, octree_shape *covers, const void *shape, unsigned material,
                         struct error *err)
{
    assert(material < OCTREE_MATERIALS);
    struct edit edit = {tree, covers, shape, material, false, tree->tape, {1, 1, 1}, {0}};
    const double corner[3] = {0}; /* the root is the first child of a cube of side 2 */
    struct octree_cover cover = covers(shape, corner, 1, tree->depth == 0);
    if (tree->depth == 0)
        cover.outside = ~cover.inside;
    if (touched(cover) & 1)
        tree->root = edit_child(&edit, cover, tree->root, 0, corner, 1, tree->depth);
    if (tree->tape && edit.high[0] > 0)
        note_region(&edit);
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
    if (tree->tape)
        octree_tape_region(tree->tape, (const int[3]){x, y, z}, 1);
    while (steps-- > 0) {
        node_write(tree, place[steps], node);
        node = octree_merge(tree, path[steps]);
    }
    tree->root = node;
    return STATUS_OK;
}
