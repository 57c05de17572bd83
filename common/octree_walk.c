/* What there is in an octree: single cells, leaves, exposed faces, figures. */
#include "common/octree_blocks.h"

unsigned octree_at(const struct octree *tree, int x, int y, int z)
{
    if ((x | y | z) < 0 || (x | y | z) >> tree->depth)
        return 0;
    octree_node node = tree->root;
    for (unsigned level = tree->depth; node_is_split(node);) {
        level--;
        node = tree->blocks[node_children(node) + node_child_of(x, y, z, level)];
    }
    return node;
}

struct leaf_walk {
    const struct octree *tree;
    const int *low, *high;
    octree_visitor *visit;
    void *context;
};

static bool visit_leaves(const struct leaf_walk *walk, octree_node node, const int at[3], int side)
{
    if (node == 0)
        return true;
    for (int k = 0; k < 3; k++)
        if (at[k] > walk->high[k] || at[k] + side - 1 < walk->low[k])
            return true;
    if (!node_is_split(node)) {
        const struct octree_leaf leaf = {at[0], at[1], at[2], side, node};
        return walk->visit(walk->context, &leaf);
    }
    int half = side / 2;
    for (int i = 0; i < 8; i++) {
        const int child[3] = {at[0] + (i & 1) * half, at[1] + (i >> 1 & 1) * half, at[2] + (i >> 2) * half};
        if (!visit_leaves(walk, walk->tree->blocks[node_children(node) + i], child, half))
            return false;
    }
    return true;
}

void octree_visit(const struct octree *tree, const int low[3], const int high[3], octree_visitor *visit,
                  void *context)
{
    const struct leaf_walk walk = {tree, low, high, visit, context};
    visit_leaves(&walk, tree->root, (const int[3]){0}, 1 << tree->depth);
}

void octree_visit_all(const struct octree *tree, octree_visitor *visit, void *context)
{
    const int last = (1 << tree->depth) - 1;
    octree_visit(tree, (const int[3]){0}, (const int[3]){last, last, last}, visit, context);
}

struct face_walk {
    const struct octree *tree;
    octree_face_visitor *visit;
    void *context;
};

static octree_node child_of(const struct octree *tree, octree_node node, int i)
{
    return node_is_split(node) ? tree->blocks[node_children(node) + i] : node;
}

/* The faces in the square where two cubes of the same side meet: `upper` begins at `at` along `axis`. */
static bool visit_between(const struct face_walk *walk, octree_node lower, octree_node upper, const int at[3],
                          int side, int axis)
{
    if (lower == upper && !node_is_split(lower))
        return true;
    if (!node_is_split(lower) && !node_is_split(upper)) {
        if (lower != 0 && upper != 0)
            return true;
        const struct octree_face face = {
            {at[0], at[1], at[2]}, side, axis, lower ? 1 : -1, lower ? lower : upper};
        return walk->visit(walk->context, &face);
    }
    for (int i = 0; i < 8; i++) {
        if (i >> axis & 1)
            continue;
        int half = side / 2;
        const int child[3] = {at[0] + (i & 1) * half, at[1] + (i >> 1 & 1) * half, at[2] + (i >> 2) * half};
        if (!visit_between(walk, child_of(walk->tree, lower, i | 1 << axis), child_of(walk->tree, upper, i),
                           child, half, axis))
            return false;
    }
    return true;
}

/* The faces inside a node: those inside its children and those between them. */
static bool visit_inside(const struct face_walk *walk, octree_node node, const int at[3], int side)
{
    if (!node_is_split(node))
        return true;
    int half = side / 2;
    for (int i = 0; i < 8; i++) {
        const int child[3] = {at[0] + (i & 1) * half, at[1] + (i >> 1 & 1) * half, at[2] + (i >> 2) * half};
        octree_node upper = child_of(walk->tree, node, i);
        for (int axis = 0; axis < 3; axis++)
            if (i >> axis & 1 &&
                !visit_between(walk, child_of(walk->tree, node, i ^ 1 << axis), upper, child, half, axis))
                return false;
        if (!visit_inside(walk, upper, child, half))
            return false;
    }
    return true;
}

void octree_visit_faces(const struct octree *tree, octree_face_visitor *visit, void *context)
{
    const struct face_walk walk = {tree, visit, context};
    const int side = 1 << tree->depth;
    for (int axis = 0; axis < 3; axis++) {
        int end[3] = {0};
        if (!visit_between(&walk, 0, tree->root, end, side, axis))
            return;
        end[axis] = side;
        if (!visit_between(&walk, tree->root, 0, end, side, axis))
            return;
    }
    visit_inside(&walk, tree->root, (const int[3]){0}, side);
}

static bool measure_leaf(void *context, const struct octree_leaf *leaf)
{
    struct octree_info *info = context;
    const int at[3] = {leaf->x, leaf->y, leaf->z};
    for (int k = 0; k < 3; k++) {
        if (info->full_leaves == 0 || at[k] < info->low[k])
            info->low[k] = at[k];
        if (info->full_leaves == 0 || at[k] + leaf->side - 1 > info->high[k])
            info->high[k] = at[k] + leaf->side - 1;
    }
    if (info->full_leaves == 0 || leaf->side < info->smallest_side)
        info->smallest_side = leaf->side;
    info->full_leaves++;
    info->cells += (uint64_t)leaf->side * leaf->side * leaf->side;
    return true;
}

static bool measure_face(void *context, const struct octree_face *face)
{
    struct octree_info *info = context;
    info->exposed_faces += (uint64_t)face->side * face->side;
    return true;
}

struct octree_info octree_measure(const struct octree *tree)
{
    struct octree_info info = {.leaves = octree_leaf_count(tree), .high = {-1, -1, -1}};
    info.nodes = info.leaves + (tree->block_count - tree->free_count);
    octree_visit_all(tree, measure_leaf, &info);
    octree_visit_faces(tree, measure_face, &info);
    for (int k = 0; k < 3; k++) {
        const int side = info.high[k] - info.low[k] + 1;
        info.extent = side > info.extent ? side : info.extent;
    }
    info.bytes = sizeof *tree + 8 * sizeof *tree->blocks * tree->block_capacity;
    return info;
}
