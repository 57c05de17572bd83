/*
 * From an octree to a balloon's mesh (paper 3.4): Gaussians are laid over the sculpture and the surface where
 * their sum passes a threshold is followed from cell to cell of marching cubes.
 *
 *     struct surface_options options = surface_defaults();
 *     options.triangles = 3000;
 *     struct mesh mesh = {0};
 *     struct surface_stats stats;
 *     if (surface_make(&tree, &options, &mesh, &stats, err)) ...
 *     if (mesh_connect(&mesh, err)) ...
 *     struct surface_shape shape;
 *     if (surface_measure(&mesh, &shape, err)) ...
 *
 * What the mesh is: closed, wound counter-clockwise seen from outside, every edge in exactly two triangles,
 * the triangles of each point in one ring; every component that the grid of cubes can see is there (see
 * surface_seeds). Points lie on the surface, |f - T| < 1e-9 (stats.worst_residual says how near), normals are
 * unit vectors along -gradient. Points and triangles are ordered by their place in space (Morton order of
 * bricks of 8 x 8 x 8 cubes), so the result is the same to the byte however its parts were found.
 */
#ifndef SURFACE_SURFACE_H
#define SURFACE_SURFACE_H

#include "common/mesh.h"
#include "common/octree.h"
#include "surface/field.h"

/*
 * Where the following begins.
 *
 * SURFACE_DESCENT goes down the octree of bricks and leaves out a brick only when bounds on the field prove
 * that all its corners are on one side of the threshold; all cubes of the others are looked at, so no
 * component is missed that has a cube's corner on its other side. SURFACE_RANDOM begins at (0,0,0) and then
 * at random points, as in the paper: from each it walks towards a point on the other side of the surface,
 * halving the way, and follows what it meets. Since this may miss components, the descent looks afterwards
 * for what is left; stats.seeds_random says how far the random points came by themselves.
 */
enum surface_seeds { SURFACE_DESCENT, SURFACE_RANDOM };

struct surface_options {
    struct field_settings field; /* sigma in the octree's finest cells; FIELDS_EXACT, 0.35 and 6 by default */
    double threshold;            /* T, above 0; 0.5 */
    double cube_size;            /* in units of the first cube; 0, the default: a third of the finest cell, or
                                    1/24 of the sculpture's longest extent where that is less */
    uint32_t triangles;          /* 0, or the number of triangles to choose the cube size for */
    unsigned relax;              /* rounds of relaxation, 0 .. 1000; 10; 0: plain marching cubes */
    bool force;                  /* go on where memory is estimated not to hold the mesh */
    enum surface_seeds seeds;
    uint64_t seed;                                /* of the random points */
    unsigned threads;                             /* 0, the default: as many as the machine has */
    void (*progress)(void *context, double done); /* NULL, or told the share that is done from time to time */
    void *progress_context;
};

struct surface_options surface_defaults(void);

struct surface_stats {
    double cube_size;           /* as used */
    uint64_t evaluations;       /* of the field with its gradient, at single points */
    uint64_t samples;           /* of the field on the grid */
    size_t seeds, seeds_random; /* connected sets of cubes; how many of them random points found */
    double worst_residual;      /* largest |f - T| at a point */
    size_t bytes;               /* of memory at the peak, without the octree */
};

/* Errors: STATUS_INPUT for an empty sculpture and a threshold that the field does not reach (naming the
 * largest value found); STATUS_RANGE for options out of range, a cube size larger than the object (naming
 * one that works) or so small that memory would not hold the mesh (naming the estimate; see force);
 * STATUS_NO_MEMORY.
 * *mesh, which must be empty, stays so on failure. */
enum status surface_make(const struct octree *tree, const struct surface_options *options, struct mesh *mesh,
                         struct surface_stats *stats, struct error *err);

/* The shape of a closed mesh. */
struct surface_shape {
    size_t components;
    long euler; /* points - edges + triangles: 2 for each sphere, 2 less for each handle */
    double volume, area;
    double shortest_edge, mean_edge, longest_edge;
    double smallest_angle_deg;
};

/* The mesh must be connected (mesh_connect). Errors: STATUS_NO_MEMORY. */
enum status surface_measure(const struct mesh *mesh, struct surface_shape *shape, struct error *err);

#endif
