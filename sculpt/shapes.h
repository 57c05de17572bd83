/* Inside the sculptor: chips made ready to be asked how they cover boxes. */
#ifndef SCULPT_SHAPES_H
#define SCULPT_SHAPES_H

#include "sculpt/sculpt.h"

/* What octree_apply() hands to the functions of shapes.c. Which members count depends on the shape. */
struct shape {
    octree_shape *covers;
    double half_cell;        /* of the octree's finest cells */
    double low[3], high[3];  /* box */
    double centre[3];        /* ball; a point of the border of a half-space; the first end of an axis */
    double weight[3], limit; /* ball: sum of weight (p - centre)^2 <= limit */
    double direction[3];     /* the normal of a half-space; the axis, of length 1 */
    double length;           /* of the axis */
    double radius, slope;    /* at the first end, and its growth along the axis */
    double lean, push;       /* of a capsule: see capsule_distance() */
    double steepness;        /* how fast the distance to a round shape, as it is calculated, can change */
    double slack;            /* what rounding may change about a distance */
};

/* Makes `shape` ready for an octree of this depth. The chip is one that chip_check() accepts. */
void shape_init(struct shape *shape, const struct chip *chip, unsigned depth);

#endif
