/* Changes to an octree: what a shape covers, and single cells. */
#include "common/octree_blocks.h"

#include <assert.h>
#include <string.h>

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

/* A node that the shape covers wholly. */
static octree_node take_whole(struct edit *edit, octree_node node, const double corner[3], double side)
{
    if (edit->tape)
        note_change(edit, corner, side);
    octree_release(edit->tree, node);
    return edit->material;
}

/* What becomes of a cube of eight cells of which the shape takes some. Whether it was split and whether it
 * will be is chance, so that nothing else here branches. */
static octree_node edit_cells(struct edit *edit, unsigned inside, octree_node node, const double corner[3],
                              double side)
{
    if (inside == 0 || node == edit->material)
        return node;
    if (edit->tape)
        note_change(edit, corner, side);
    const struct octree_eight was = eight_of(edit->tree, node);
    const struct octree_eight is = eight_blend(&was, edit->material, inside);
    if (eight_agree(&is)) {
        if (node_is_split(node))
            octree_give(edit->tree, node);
        return is.low[0];
    }
    if (node_is_split(node))
        node_write_eight(edit->tree, node, &is);
    else if (!octree_split(edit->tree, &is, &node))
        edit->failed = true;
    return node;
}

/* Eight cubes that a shape may change some of. */
struct parts {
    double corner[2][3]; /* of the lower and of the upper ones */
    double side;
    unsigned level;  /* the number of halvings that are left to them */
    unsigned change; /* those that the shape covers something of and that are not what it makes already */
    unsigned inside; /* those that it covers wholly */
    unsigned char cells[8]; /* at level 1: the cells that it covers */
};

static inline int first_of(unsigned children)
{
    return __builtin_ctz(children);
}

static inline void corner_of(const struct parts *parts, int i, double corner[3])
{
    for (int k = 0; k < 3; k++)
        corner[k] = parts->corner[i >> k & 1][k];
}

static struct parts parts_of(const struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level)
{
    const struct octree_cover cover = edit->covers(edit->shape, corner, side, false);
    const struct octree_eight children = eight_of(edit->tree, node);
    struct parts parts = {.side = side, .level = level, .inside = cover.inside};
    for (int k = 0; k < 3; k++) {
        parts.corner[0][k] = corner[k];
        parts.corner[1][k] = corner[k] + side;
    }
    parts.change = ~cover.outside & 0xff & ~eight_equal(&children, edit->material);
    if (level > 1)
        return parts;
    memset(parts.cells, 0xff, sizeof parts.cells);
    for (unsigned left = parts.change & ~cover.inside; left != 0; left &= left - 1) {
        double at[3];
        corner_of(&parts, first_of(left), at);
        parts.cells[first_of(left)] = (unsigned char)edit->covers(edit->shape, at, side / 2, true).inside;
    }
    return parts;
}

static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level);

/* The node that takes the place of one of the parts, which is to change. */
static inline octree_node edit_part(struct edit *edit, const struct parts *parts, int i, octree_node part)
{
    double corner[3];
    corner_of(parts, i, corner);
    if (edit->failed)
        return part;
    if (parts->level == 1)
        return edit_cells(edit, parts->cells[i], part, corner, parts->side);
    if (!(parts->inside >> i & 1))
        return edit_node(edit, part, corner, parts->side, parts->level);
    return take_whole(edit, part, corner, parts->side);
}

/* Children are made on the stack, so that a leaf whose children end up alike costs no block. */
static octree_node edit_leaf(struct edit *edit, const struct parts *parts, octree_node leaf)
{
    octree_node children[8], node;
    for (int i = 0; i < 8; i++)
        children[i] = leaf;
    for (unsigned left = parts->change; left != 0; left &= left - 1)
        children[first_of(left)] = edit_part(edit, parts, first_of(left), leaf);
    if (octree_join(edit->tree, children, &node))
        return node;
    edit->failed = true;
    for (int i = 0; i < 8; i++)
        octree_release(edit->tree, children[i]);
    return leaf;
}

/* Blocks lie anywhere in memory: those of all children are asked for together, not one after the other. */
static inline void fetch_ahead(const struct octree *tree, octree_node node)
{
    const octree_node *children = tree->blocks + node_children(node);
    for (int i = 0; i < 8; i++)
        __builtin_prefetch(tree->blocks + node_children(node_is_split(children[i]) ? children[i] : node));
}

/* The node that takes the place of one that the shape crosses. */
static octree_node edit_node(struct edit *edit, octree_node node, const double corner[3], double side,
                             unsigned level)
{
    const double half = side / 2;
    if (level == 1)
        return edit_cells(edit, edit->covers(edit->shape, corner, half, true).inside, node, corner, side);
    if (node_is_split(node))
        fetch_ahead(edit->tree, node);
    const struct parts parts = parts_of(edit, node, corner, half, level - 1);
    if (!node_is_split(node))
        return edit_leaf(edit, &parts, node);
    for (unsigned left = parts.change; left != 0; left &= left - 1) {
        const size_t at = node_children(node) + first_of(left);
        const octree_node part = edit_part(edit, &parts, first_of(left), edit->tree->blocks[at]);
        node_write(edit->tree, at, part); /* blocks may have moved meanwhile */
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
    const struct octree_cover cover = covers(shape, corner, 1, tree->depth == 0);
    if (tree->root == material)
        return STATUS_OK;
    if (cover.inside & 1)
        tree->root = take_whole(&edit, tree->root, corner, 1);
    else if (tree->depth > 0 && !(cover.outside & 1))
        tree->root = edit_node(&edit, tree->root, corner, 1, tree->depth);
    if (tree->tape && edit.high[0] > 0)
        note_region(&edit);
    return edit.failed ? error_no_memory(err, "the octree") : STATUS_OK;
}

/* Splits a leaf along the way to one of its cells; false when memory is not enough. */
static bool set_in_leaf(struct octree *tree, octree_node *node, const int cell[3], unsigned level,
                        octree_node material)
{
    octree_node made = material;
    for (unsigned bit = 0; bit < level; bit++) {
        octree_node children[8], leaf = *node;
        for (int i = 0; i < 8; i++)
            children[i] = leaf;
        children[node_child_of(cell[0], cell[1], cell[2], bit)] = made;
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
    const int cell[3] = {x, y, z};
    octree_node path[OCTREE_DEPTH_MAX];
    size_t place[OCTREE_DEPTH_MAX];
    octree_node node = tree->root;
    unsigned level = tree->depth, steps = 0;
    for (; node_is_split(node); steps++) {
        level--;
        path[steps] = node;
        place[steps] = node_children(node) + node_child_of(x, y, z, level);
        node = tree->blocks[place[steps]];
    }
    if (node == material)
        return STATUS_OK;
    if (!set_in_leaf(tree, &node, cell, level, material))
        return error_no_memory(err, "the octree");
    if (tree->tape)
        octree_tape_region(tree->tape, cell, 1);
    while (steps-- > 0) {
        node_write(tree, place[steps], node);
        node = octree_merge(tree, path[steps]);
    }
    tree->root = node;
    return STATUS_OK;
}
