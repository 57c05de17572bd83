/*
 * Rays through the octree, from leaf to leaf. As in Amanatides and Woo, "A fast voxel traversal algorithm
 * for ray tracing" (Eurographics 1987), the ray leaves a cube by the plane whose time comes first. A plane's
 * time is always calculated from its number, never summed up, and where the ray has got to along the other
 * axes is decided by comparing such times: so long strides through large leaves lead through the very cells
 * that single steps would.
 */
#include "common/octree_blocks.h"

#include <math.h>

struct march {
    const struct octree *tree;
    double origin[3];    /* in cells */
    double direction[3]; /* its largest component is 1 or -1, so that time is counted in cells too */
    double inverse[3];   /* HUGE_VAL along an axis that the ray does not move along */
    bool down[3];        /* moves towards smaller numbers */
    int cell[3];
    octree_node path[OCTREE_DEPTH_MAX + 1]; /* to the cell's leaf; number l has sides of 2^l cells */
    double time;                            /* when the cell was entered, and by which axis */
    int axis;
};

static inline double plane_time(const struct march *march, int k, int plane)
{
    return (plane - march->origin[k]) * march->inverse[k];
}

/* Has the ray crossed a plane along axis k when it has just crossed one along march->axis? */
static inline bool crossed(const struct march *march, int k, int plane)
{
    double time = plane_time(march, k, plane);
    return time < march->time || (time == march->time && k < march->axis);
}

/* Where the ray is along axis k at march->time, known to be from low to high. */
static inline int place_of(const struct march *march, int k, int low, int high)
{
    if (low == high)
        return low;
    double place = march->origin[k] + march->time * march->direction[k];
    int cell = place > low ? place < high ? (int)place : high : low; /* low where it is NaN */
    if (march->down[k]) {
        while (cell > low && crossed(march, k, cell))
            cell--;
        while (cell < high && !crossed(march, k, cell + 1))
            cell++;
    } else {
        while (cell < high && crossed(march, k, cell + 1))
            cell++;
        while (cell > low && !crossed(march, k, cell))
            cell--;
    }
    return cell;
}

/* Along one axis: false when the ray never comes to the cube's slab, or from beyond what a double can count.
 * The cell of an origin outside is -1 or `side`. */
static bool prepare_axis(struct march *march, int k, double origin, double direction, double largest)
{
    const int side = 1 << march->tree->depth;
    march->origin[k] = origin * side;
    march->direction[k] = direction / largest;
    march->inverse[k] = 1 / march->direction[k];
    if (!isfinite(march->inverse[k])) {
        march->direction[k] = 0;
        march->inverse[k] = HUGE_VAL;
    }
    march->down[k] = march->direction[k] < 0;
    double place = march->origin[k];
    double cell = march->down[k] ? ceil(place) - 1 : floor(place);
    march->cell[k] = cell < 0 ? -1 : cell < side ? (int)cell : side;
    if (march->cell[k] < 0)
        return march->direction[k] > 0 && isfinite(place);
    if (march->cell[k] == side)
        return march->direction[k] < 0 && isfinite(place);
    return true;
}

/* From an origin outside to the cube's border: the last slab entered decides when and by which axis. */
static bool enter_cube(struct march *march)
{
    const int side = 1 << march->tree->depth;
    march->axis = -1;
    for (int k = 0; k < 3; k++) {
        bool outside = march->cell[k] < 0 || march->cell[k] == side;
        double time = outside ? plane_time(march, k, march->down[k] ? side : 0) : 0;
        if (outside && (march->axis < 0 || time >= march->time)) {
            march->time = time;
            march->axis = k;
        }
    }
    for (int k = 0; k < 3 && march->axis >= 0; k++) {
        if (march->direction[k] == 0)
            continue;
        if (k != march->axis && crossed(march, k, march->down[k] ? 0 : side))
            return false;
        int first = march->cell[k] < 0 ? 0 : march->cell[k] == side ? side - 1 : march->cell[k];
        if (k == march->axis)
            march->cell[k] = first;
        else
            march->cell[k] = march->down[k] ? place_of(march, k, 0, first)
                                            : place_of(march, k, first, side - 1);
    }
    return true;
}

/* From the leaf of 2^level cells a side into the next one; the level where their ways from the root part, or
 * above the root's when the ray leaves the cube. */
static unsigned leave_leaf(struct march *march, unsigned level)
{
    const int side = 1 << level;
    int low[3], next[3];
    march->axis = -1;
    for (int k = 0; k < 3; k++) {
        low[k] = march->cell[k] & -side;
        double time = plane_time(march, k, march->down[k] ? low[k] : low[k] + side);
        if (march->axis < 0 || time < march->time) {
            march->time = time;
            march->axis = k;
        }
    }
    for (int k = 0; k < 3; k++) {
        if (k == march->axis)
            next[k] = march->down[k] ? low[k] - 1 : low[k] + side;
        else if (march->down[k])
            next[k] = place_of(march, k, low[k], march->cell[k]);
        else
            next[k] = place_of(march, k, march->cell[k], low[k] + side - 1);
    }
    unsigned differences = 0;
    for (int k = 0; k < 3; k++) {
        differences |= (unsigned)(march->cell[k] ^ next[k]);
        march->cell[k] = next[k];
    }
    return 32 - (unsigned)__builtin_clz(differences);
}

/* Down from path[level] to the leaf of the cell; returns the leaf's level. */
static inline unsigned find_leaf(struct march *march, unsigned level)
{
    const int *cell = march->cell;
    octree_node node = march->path[level];
    while (node_is_split(node)) {
        level--;
        node = march->tree->blocks[node_children(node) + node_child_of(cell[0], cell[1], cell[2], level)];
        march->path[level] = node;
    }
    return level;
}

bool octree_ray(const struct octree *tree, const double origin[3], const double direction[3],
                struct octree_hit *hit)
{
    struct march march = {.tree = tree};
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        if (!isfinite(origin[k]) || !isfinite(direction[k]))
            return false;
        largest = fmax(largest, fabs(direction[k]));
    }
    if (largest == 0)
        return false;
    for (int k = 0; k < 3; k++)
        if (!prepare_axis(&march, k, origin[k], direction[k], largest))
            return false;
    if (!enter_cube(&march))
        return false;
    march.path[tree->depth] = tree->root;
    unsigned level = find_leaf(&march, tree->depth);
    while (march.path[level] == 0) {
        level = leave_leaf(&march, level);
        if (level > tree->depth)
            return false;
        level = find_leaf(&march, level);
    }
    *hit = (struct octree_hit){.material = march.path[level]};
    for (int k = 0; k < 3; k++)
        hit->cell[k] = march.cell[k];
    if (march.axis >= 0) {
        hit->axis = march.axis;
        hit->outward = march.down[march.axis] ? 1 : -1;
        hit->distance = march.time / (1 << tree->depth) / largest;
    }
    return true;
}
