/*
 * Hollows: empty leaves that no way from leaf to leaf, across faces, joins to the outside.
 *
 * Every leaf has a slot: where its node is among tree->blocks, or the one after them for the root. Empty
 * leaves that share a face are united in sets (Tarjan, "Efficiency of a good but not linear set union
 * algorithm", Journal of the ACM, 1975), and so is the outside with those at the cube's faces; what is not
 * in its set is a hollow.
 */
#include "common/array.h"
#include "common/octree_blocks.h"

#include <stdlib.h>

typedef uint32_t slot; /* fits: a tree of the largest depth has fewer than 2^31 */

struct sets {
    struct octree *tree;
    slot *parent; /* a member's, on the way to the one that stands for its set; that one's is itself */
    slot root, outside;
};

static octree_node node_at(const struct sets *sets, slot at)
{
    if (at == sets->outside)
        return 0;
    return at == sets->root ? sets->tree->root : sets->tree->blocks[at];
}

/* The slot of child i, or of the leaf that stands in its place. */
static slot child_at(const struct sets *sets, slot at, int i)
{
    octree_node node = node_at(sets, at);
    return node_is_split(node) ? (slot)node_children(node) + (slot)i : at;
}

static slot find(struct sets *sets, slot member)
{
    while (sets->parent[member] != member)
        member = sets->parent[member] = sets->parent[sets->parent[member]];
    return member;
}

/* The higher slot stands for both: the outside's is the highest. */
static void unite(struct sets *sets, slot a, slot b)
{
    a = find(sets, a);
    b = find(sets, b);
    sets->parent[a < b ? a : b] = a < b ? b : a;
}

/* Unites the empty leaves that meet where two cubes of the same side do, the second above the first. */
static void unite_between(struct sets *sets, slot lower, slot upper, int axis)
{
    octree_node below = node_at(sets, lower), above = node_at(sets, upper);
    bool split = node_is_split(below) || node_is_split(above);
    if (!split && below == 0 && above == 0)
        unite(sets, lower, upper);
    if (!split || (below != 0 && !node_is_split(below)) || (above != 0 && !node_is_split(above)))
        return;
    for (int i = 0; i < 8; i++)
        if (!(i >> axis & 1))
            unite_between(sets, child_at(sets, lower, i | 1 << axis), child_at(sets, upper, i), axis);
}

static void unite_inside(struct sets *sets, slot at)
{
    if (!node_is_split(node_at(sets, at)))
        return;
    for (int i = 0; i < 8; i++) {
        slot upper = child_at(sets, at, i);
        for (int axis = 0; axis < 3; axis++)
            if (i >> axis & 1)
                unite_between(sets, child_at(sets, at, i ^ 1 << axis), upper, axis);
        unite_inside(sets, upper);
    }
}

/* The node that takes the place of one whose hollows are filled; *filled counts their cells. */
static octree_node fill(struct sets *sets, slot at, uint64_t side, octree_node material, uint64_t *filled)
{
    const octree_node node = node_at(sets, at);
    if (!node_is_split(node)) {
        if (node != 0 || find(sets, at) == sets->outside)
            return node;
        *filled += side * side * side;
        return material;
    }
    for (int i = 0; i < 8; i++) {
        slot child = child_at(sets, at, i);
        node_write(sets->tree, child, fill(sets, child, side / 2, material, filled));
    }
    return octree_merge(sets->tree, node);
}

enum status octree_fill_hollows(struct octree *tree, unsigned material, uint64_t *cells, struct error *err)
{
    const slot root = 8 * tree->block_count, outside = root + 1;
    struct sets sets = {tree, array_new((size_t)outside + 1, sizeof *sets.parent), root, outside};
    if (!sets.parent)
        return error_no_memory(err, "the search for hollows");
    for (slot at = 0; at <= outside; at++)
        sets.parent[at] = at;
    for (int axis = 0; axis < 3; axis++) {
        unite_between(&sets, outside, root, axis);
        unite_between(&sets, root, outside, axis);
    }
    unite_inside(&sets, root);
    *cells = 0;
    tree->root = fill(&sets, root, UINT64_C(1) << tree->depth, material, cells);
    free(sets.parent);
    if (tree->tape && *cells > 0 && material != 0)
        octree_tape_region(tree->tape, (const int[3]){0}, 1 << tree->depth);
    return STATUS_OK;
}
