/*
 * How each shape covers a cube. What matters are the centres of the finest cells in the cube, so the question
 * is put to the box that they span. The answers for box, ball and half-space are exact even in floating point:
 * the sum that decides for a centre is taken at the nearest and the farthest place of that box, and rounding
 * never reverses the order of two sums of the same form. Round shapes about an axis use a distance at the
 * middle of the box, which changes by no more than `steepness` a unit of length; what that leaves open is split.
 */
#include "sculpt/shapes.h"

#include "common/vec3.h"

#include <math.h>

static void centres(const struct shape *shape, const double corner[3], double side, double low[3],
                    double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = corner[k] + shape->half_cell;
        high[k] = corner[k] + (side - shape->half_cell);
    }
}

/* Half-open, so that boxes side by side share no cell even where their border runs through centres. */
static enum octree_cover box_covers(const void *context, const double corner[3], double side, bool cell)
{
    (void)cell;
    const struct shape *shape = context;
    double low[3], high[3];
    centres(shape, corner, side, low, high);
    bool inside = true;
    for (int k = 0; k < 3; k++) {
        if (high[k] < shape->low[k] || low[k] >= shape->high[k])
            return OCTREE_OUTSIDE;
        inside = inside && low[k] >= shape->low[k] && high[k] < shape->high[k];
    }
    return inside ? OCTREE_INSIDE : OCTREE_CROSSES;
}

static enum octree_cover ball_covers(const void *context, const double corner[3], double side, bool cell)
{
    (void)cell;
    const struct shape *shape = context;
    double low[3], high[3];
    centres(shape, corner, side, low, high);
    double nearest = 0, farthest = 0;
    for (int k = 0; k < 3; k++) {
        double below = low[k] - shape->centre[k], above = high[k] - shape->centre[k];
        double near = below > 0 ? below : above < 0 ? above : 0;
        double far = -below > above ? below : above;
        nearest += shape->weight[k] * (near * near);
        farthest += shape->weight[k] * (far * far);
    }
    if (nearest > shape->limit)
        return OCTREE_OUTSIDE;
    return farthest <= shape->limit ? OCTREE_INSIDE : OCTREE_CROSSES;
}

static enum octree_cover half_space_covers(const void *context, const double corner[3], double side,
                                           bool cell)
{
    (void)cell;
    const struct shape *shape = context;
    double low[3], high[3];
    centres(shape, corner, side, low, high);
    double least = 0, most = 0;
    for (int k = 0; k < 3; k++) {
        double along_low = shape->direction[k] * (low[k] - shape->centre[k]);
        double along_high = shape->direction[k] * (high[k] - shape->centre[k]);
        least += along_low < along_high ? along_low : along_high;
        most += along_low < along_high ? along_high : along_low;
    }
    if (most < 0)
        return OCTREE_OUTSIDE;
    return least >= 0 ? OCTREE_INSIDE : OCTREE_CROSSES;
}

/* The middle of a cube as seen from an axis: how far along it is, and how far off. */
static void axis_place(const struct shape *shape, const double corner[3], double side, double *along,
                       double *off)
{
    double from[3], beside[3];
    for (int k = 0; k < 3; k++)
        from[k] = corner[k] + side / 2 - shape->centre[k];
    *along = vec3_dot(from, shape->direction);
    for (int k = 0; k < 3; k++)
        beside[k] = from[k] - *along * shape->direction[k];
    *off = vec3_length(beside);
}

/* Half the diagonal of the box that the cells' centres span. */
static double reach(const struct shape *shape, double side)
{
    return sqrt(3) * (side / 2 - shape->half_cell);
}

/* A cone with flat ends; a cylinder is one that does not taper. */
static enum octree_cover cone_covers(const void *context, const double corner[3], double side, bool cell)
{
    const struct shape *shape = context;
    double along, off;
    axis_place(shape, corner, side, &along, &off);
    double over = off - (shape->radius + shape->slope * along);
    if (cell)
        return along >= 0 && along <= shape->length && over <= 0 ? OCTREE_INSIDE : OCTREE_OUTSIDE;
    double spread = reach(shape, side) + shape->slack;
    double widest = shape->steepness * spread;
    if (along + spread < 0 || along - spread > shape->length || over > widest)
        return OCTREE_OUTSIDE;
    return along - spread >= 0 && along + spread <= shape->length && over < -widest ? OCTREE_INSIDE
                                                                                    : OCTREE_CROSSES;
}

/* Distance to the swept sphere's skin, negative inside: the least over the axis of (distance to the place u of
 * the axis) - (radius there). For r(u) = r + s u its derivative is zero where (along - u)/distance = -s, so
 * u = along + off s / sqrt(1 - s^2); the function is convex, so a u beyond an end means that end. Where one
 * end's sphere holds the other's (|s| >= 1) the least is at an end too. */
static double capsule_distance(const struct shape *shape, double along, double off)
{
    double s = shape->slope, u = s > 0 ? shape->length : 0;
    if (fabs(s) < 1)
        u = fmin(fmax(along + off * s / sqrt(1 - s * s), 0), shape->length);
    return hypot(off, along - u) - (shape->radius + s * u);
}

static enum octree_cover capsule_covers(const void *context, const double corner[3], double side, bool cell)
{
    const struct shape *shape = context;
    double along, off;
    axis_place(shape, corner, side, &along, &off);
    double distance = capsule_distance(shape, along, off);
    if (cell)
        return distance <= 0 ? OCTREE_INSIDE : OCTREE_OUTSIDE;
    double spread = reach(shape, side) + shape->slack;
    if (distance > spread)
        return OCTREE_OUTSIDE;
    return distance < -spread ? OCTREE_INSIDE : OCTREE_CROSSES;
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

static void init_axis(struct shape *shape, const double *value, double first_radius, double last_radius)
{
    double axis[3], largest = fmax(first_radius, last_radius);
    vec3_sub(value + 3, value, axis);
    shape->length = vec3_length(axis);
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = value[k];
        shape->direction[k] = shape->length > 0 ? axis[k] / shape->length : 0;
        largest = fmax(largest, fmax(fabs(value[k]), fabs(value[k + 3])));
    }
    shape->radius = shape->length > 0 ? first_radius : fmax(first_radius, last_radius);
    shape->slope = shape->length > 0 ? (last_radius - first_radius) / shape->length : 0;
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
