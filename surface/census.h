/*
 * What a mesh is made of, part by part, and how regular its triangles are; how far it is
 * from the field's surface.
 *
 *     struct surface_census census;
 *     if (surface_count(&mesh, &shape, &census, err)) ...
 *     surface_census_clear(&census);
 *
 *     struct surface_distance distance;
 *     if (surface_compare(&tree, &options, &mesh, &distance, err)) ...
 */
#ifndef SURFACE_CENSUS_H
#define SURFACE_CENSUS_H

#include "surface/surface.h"

enum {
    CENSUS_ANGLES = 18,   /* bins of 10 degrees */
    CENSUS_EDGES = 20,    /* bins of a tenth of the mean; the last holds all from 1.9 on */
    CENSUS_VALENCES = 13, /* 0 .. 11; the last holds all from 12 on */
};

struct surface_part {
    uint32_t points, edges, triangles;
    long euler, genus; /* points - edges + triangles = 2 - 2 genus */
    double volume;     /* negative: a cavity, seen from within */
    double area;
};

struct surface_census {
    struct surface_part *parts; /* [part_count] in the order of their first points */
    size_t part_count;
    uint64_t angles[CENSUS_ANGLES]; /* triangles' corners by angle */
    uint32_t edges[CENSUS_EDGES];   /* by length over the mean */
    uint32_t valences[CENSUS_VALENCES];
};

/* part[point_count]: the number of the part that each point belongs to, in the order of the parts' first
 * points. Returns how many there are. */
size_t surface_number_parts(const struct mesh *mesh, uint32_t *part);

/* The angle at corner k of a triangle, in radians. */
double surface_angle(const struct mesh *mesh, const uint32_t triangle[3], int k);

/* The parts alone. Of a mesh that is not connected they have no edges, euler and genus. Errors:
 * STATUS_NO_MEMORY. */
enum status surface_count_parts(const struct mesh *mesh, struct surface_census *census, struct error *err);

/* The mesh must be connected and closed, shape what surface_measure() found. Errors: STATUS_NO_MEMORY. */
enum status surface_count(const struct mesh *mesh, const struct surface_shape *shape,
                          struct surface_census *census, struct error *err);
void surface_census_clear(struct surface_census *census);

/*
 * Distances to the surface f = T of the options' field, in units of the first cube: of the points alone, and
 * of the flat triangles between them. From a place Newton's method runs along the gradient to the surface,
 * and the distance is that to where it ends: the nearest point's to second order in the distance. Triangles
 * are looked at by the rule of seven places, exact for cubic functions: corners weigh 1/20, middles of sides
 * 2/15, the centre 9/20. Of many triangles every so-manieth is taken, about COMPARE_TRIANGLES of them.
 */
enum { COMPARE_TRIANGLES = 20000 };

struct surface_distance {
    double worst_residual, mean_residual; /* of |f - T| at the points */
    double point_rms, point_largest;
    double rms, largest; /* over the triangles, by area */
};

/* Errors: those of field_init(), STATUS_NO_MEMORY. */
enum status surface_compare(const struct octree *tree, const struct surface_options *options,
                            const struct mesh *mesh, struct surface_distance *distance, struct error *err);

#endif
