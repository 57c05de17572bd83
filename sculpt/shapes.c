/*
 * How each shape covers a cube. What matters are the centres of the finest cells in the cube, so the
 * question is put to the box that they span. The answers for box, ball and half-space are exact even in
 * floating point: the sum that decides for a centre is taken at the nearest and the farthest place of that
 * box, and rounding never reverses the order of two sums of the same form. Round shapes about an axis use
 * a distance at the middle of the box, which changes by no more than `steepness` a unit of length; what
 * that leaves open is split.
 */
#include "sculpt/shapes.h"

#include "common/vec3.h"

#include <math.h>

/* Without fmin's and fmax's care for NaN, which cannot be here, these are one instruction. */
static inline double lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

/* The centres of the cells in the lower and the upper cubes along axis k: from the first to the last. */
static inline void centres(const struct shape *shape, const double corner[3], double side, int k,
                           double first[2], double last[2])
{
    for (int upper = 0; upper < 2; upper++) {
        double start = corner[k] + upper * side;
        first[upper] = start + shape->half_cell;
        last[upper] = start + (side - shape->half_cell);
    }
}

/* The eight sums of one number for each axis, which is different for the lower and upper cubes. */
static inline void add_up(const double x[2], const double y[2], const double z[2], double sum[8])
{
    for (int i = 0; i < 8; i++)
        sum[i] = x[i & 1] + y[i >> 1 & 1] + z[i >> 2];
}

/* Two numbers at a time, and two sets of cubes: what every machine that this runs on can do at once. */
typedef double pair __attribute__((vector_size(16)));
typedef int64_t pair_of_sets __attribute__((vector_size(16)));

/* The set of cubes whose sum, as add_up() has it, is at most the limit. */
static inline unsigned at_most(const double x[2], const double y[2], const double z[2], double limit)
{
    const pair xs = {x[0], x[1]}, limits = {limit, limit};
    pair_of_sets set = {0, 0};
    for (int i = 0; i < 4; i++) {
        const pair ys = {y[i & 1], y[i & 1]}, zs = {z[i >> 1], z[i >> 1]};
        set |= (xs + ys + zs <= limits) & (pair_of_sets){1 << 2 * i, 2 << 2 * i};
    }
    return (unsigned)(set[0] | set[1]);
}

/* Half-open, so that boxes side by side share no cell even where their border runs through centres. */
static struct octree_cover box_covers(const void *context, const double corner[3], double side, bool cells)
{
    (void)cells;
    /* the numbers of the lower and of the upper cubes along each axis */
    static const unsigned numbers[3][2] = {{0x55, 0xaa}, {0x33, 0xcc}, {0x0f, 0xf0}};
    const struct shape *shape = context;
    struct octree_cover cover = {0xff, 0};
    for (int k = 0; k < 3; k++) {
        double first[2], last[2];
        centres(shape, corner, side, k, first, last);
        for (int upper = 0; upper < 2; upper++) {
            if (last[upper] < shape->low[k] || first[upper] >= shape->high[k])
                cover.outside |= numbers[k][upper];
            if (!(first[upper] >= shape->low[k] && last[upper] < shape->high[k]))
                cover.inside &= ~numbers[k][upper];
        }
    }
    return cover;
}

/* A cell has one centre, which is its nearest and its farthest. */
static unsigned ball_holds_cells(const struct shape *shape, const double corner[3], double side)
{
    double square[3][2];
    for (int k = 0; k < 3; k++)
        for (int upper = 0; upper < 2; upper++) {
            double off = corner[k] + upper * side + shape->half_cell - shape->centre[k];
            square[k][upper] = shape->weight[k] * (off * off);
        }
    return at_most(square[0], square[1], square[2], shape->limit);
}

static struct octree_cover ball_covers(const void *context, const double corner[3], double side, bool cells)
{
    const struct shape *shape = context;
    double nearest[3][2], farthest[3][2];
    if (cells)
        return (struct octree_cover){ball_holds_cells(shape, corner, side), 0};
    for (int k = 0; k < 3; k++) {
        double first[2], last[2];
        centres(shape, corner, side, k, first, last);
        for (int upper = 0; upper < 2; upper++) {
            double below = first[upper] - shape->centre[k], above = last[upper] - shape->centre[k];
            double near = greater(greater(below, -above), 0), far = greater(-below, above);
            nearest[k][upper] = shape->weight[k] * (near * near);
            farthest[k][upper] = shape->weight[k] * (far * far);
        }
    }
    return (struct octree_cover){at_most(farthest[0], farthest[1], farthest[2], shape->limit),
                                 ~at_most(nearest[0], nearest[1], nearest[2], shape->limit) & 0xff};
}

static struct octree_cover half_space_covers(const void *context, const double corner[3], double side,
                                             bool cells)
{
    (void)cells;
    const struct shape *shape = context;
    double least[3][2], most[3][2], sum[8];
    for (int k = 0; k < 3; k++) {
        double first[2], last[2];
        centres(shape, corner, side, k, first, last);
        for (int upper = 0; upper < 2; upper++) {
            double along_first = shape->direction[k] * (first[upper] - shape->centre[k]);
            double along_last = shape->direction[k] * (last[upper] - shape->centre[k]);
            least[k][upper] = lesser(along_first, along_last);
            most[k][upper] = greater(along_first, along_last);
        }
    }
    struct octree_cover cover = {0};
    add_up(least[0], least[1], least[2], sum);
    for (int i = 0; i < 8; i++)
        cover.inside |= (unsigned)(sum[i] >= 0) << i;
    add_up(most[0], most[1], most[2], sum);
    for (int i = 0; i < 8; i++)
        cover.outside |= (unsigned)(sum[i] < 0) << i;
    return cover;
}

/* The middle of cube i as seen from an axis: how far along it is, and how far off. */
static inline void axis_place(const struct shape *shape, const double corner[3], double side, int i,
                              double *along, double *off)
{
    double from[3], beside[3];
    for (int k = 0; k < 3; k++)
        from[k] = corner[k] + ((i >> k & 1) + 0.5) * side - shape->centre[k];
    *along = vec3_dot(from, shape->direction);
    for (int k = 0; k < 3; k++)
        beside[k] = from[k] - *along * shape->direction[k];
    *off = vec3_length(beside);
}

/* Half the diagonal of the box that the centres of the cells in a cube span, and what rounding adds. */
static inline double reach(const struct shape *shape, double side)
{
    return sqrt(3) * (side / 2 - shape->half_cell) + shape->slack;
}

/* A cone with flat ends; a cylinder is one that does not taper. */
static struct octree_cover cone_covers(const void *context, const double corner[3], double side, bool cells)
{
    const struct shape *shape = context;
    const double spread = cells ? 0 : reach(shape, side), widest = shape->steepness * spread;
    struct octree_cover cover = {0};
    for (int i = 0; i < 8; i++) {
        double along, off;
        axis_place(shape, corner, side, i, &along, &off);
        double over = off - (shape->radius + shape->slope * along);
        bool inside = along - spread >= 0 && along + spread <= shape->length && over <= -widest;
        bool outside = along + spread < 0 || along - spread > shape->length || over > widest;
        cover.inside |= (unsigned)inside << i;
        cover.outside |= (unsigned)outside << i;
    }
    return cover;
}

/* Distance to the swept sphere's skin, negative inside: the least over the axis of (distance to the place u
 * of the axis) - (radius there). For r(u) = r + s u its derivative is zero where (along - u)/distance = -s,
 * so u = along + off s / sqrt(1 - s^2); the function is convex, so a u beyond an end means that end. Where
 * one end's sphere holds the other's (|s| >= 1) the least is at an end too. */
static inline double capsule_distance(const struct shape *shape, double along, double off)
{
    double u = lesser(greater(along + off * shape->lean + shape->push, 0), shape->length);
    double ahead = along - u;
    return sqrt(off * off + ahead * ahead) - (shape->radius + shape->slope * u);
}

static struct octree_cover capsule_covers(const void *context, const double corner[3], double side,
                                          bool cells)
{
    const struct shape *shape = context;
    const double spread = cells ? 0 : reach(shape, side);
    struct octree_cover cover = {0};
    for (int i = 0; i < 8; i++) {
        double along, off;
        axis_place(shape, corner, side, i, &along, &off);
        double distance = capsule_distance(shape, along, off);
        cover.inside |= (unsigned)(distance <= -spread) << i;
        cover.outside |= (unsigned)(distance > spread) << i;
    }
    return cover;
}

static void init_box(struct shape *shape, const double *value)
{
    shape->covers = box_covers;
    for (int k = 0; k < 3; k++) {
        shape->low[k] = fmin(value[k], value[k + 3]);
        shape->high[k] = fmax(value[k], value[k + 3]);
    }
}

static void init_sphere(struct shape *shape, const double *value)
{
    shape->covers = ball_covers;
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = value[k];
        shape->weight[k] = 1;
    }
    shape->limit = value[3] * value[3];
}

static void init_ellipsoid(struct shape *shape, const double *value)
{
    shape->covers = ball_covers;
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = value[k];
        shape->weight[k] = 1 / (value[k + 3] * value[k + 3]);
    }
    shape->limit = 1;
}

static void init_half_space(struct shape *shape, const double *value)
{
    shape->covers = half_space_covers;
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = value[k];
        shape->direction[k] = value[k + 3];
    }
}

/* Shorter ways, whose squares are hardly numbers, are none. */
static const double shortest = 1e-150;

static void init_axis(struct shape *shape, const double *value, double first_radius, double last_radius)
{
    double axis[3], largest = fmax(first_radius, last_radius);
    vec3_sub(value + 3, value, axis);
    shape->length = vec3_length(axis) >= shortest ? vec3_length(axis) : 0;
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = value[k];
        shape->direction[k] = shape->length > 0 ? axis[k] / shape->length : 0;
        largest = fmax(largest, fmax(fabs(value[k]), fabs(value[k + 3])));
    }
    shape->radius = shape->length > 0 ? first_radius : fmax(first_radius, last_radius);
    shape->slope = shape->length > 0 ? (last_radius - first_radius) / shape->length : 0;
    double s = shape->slope;
    if (fabs(s) < 1)
        shape->lean = s / sqrt(1 - s * s);
    else
        shape->push = s > 0 ? HUGE_VAL : -HUGE_VAL;
    shape->steepness = sqrt(1 + shape->slope * shape->slope);
    shape->slack = 1e-14 * (1 + largest); /* some 50 roundings of numbers of that size */
}

void shape_init(struct shape *shape, const struct chip *chip, unsigned depth)
{
    const double *value = chip->value;
    *shape = (struct shape){.half_cell = ldexp(0.5, -(int)depth)};
    switch (chip->shape) {
    case CHIP_BOX:
        init_box(shape, value);
        break;
    case CHIP_SPHERE:
        init_sphere(shape, value);
        break;
    case CHIP_ELLIPSOID:
        init_ellipsoid(shape, value);
        break;
    case CHIP_HALF_SPACE:
        init_half_space(shape, value);
        break;
    case CHIP_CYLINDER:
        init_axis(shape, value, value[6], value[6]);
        shape->covers = cone_covers;
        break;
    case CHIP_CONE:
        init_axis(shape, value, value[6], value[7]);
        shape->covers = cone_covers;
        break;
    case CHIP_CAPSULE:
    case CHIP_SHAPES:
        init_axis(shape, value, value[6], value[7]);
        shape->covers = capsule_covers;
        break;
    }
}
