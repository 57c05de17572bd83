/* Meshes around sculptures for tests: made, and held to be whole, closed and on the surface. */
#ifndef TESTS_UNIT_SURFACES_H
#define TESTS_UNIT_SURFACES_H

#include "check.h"
#include "common/vec3.h"
#include "surface/probe.h"
#include "surface/surface.h"

static inline struct octree new_tree(unsigned depth, unsigned material)
{
    struct error err = {0};
    struct octree tree;
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

static inline struct mesh make(const struct octree *tree, const struct surface_options *options)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct surface_stats stats;
    assert_ok(surface_make(tree, options, &mesh, &stats, &err), &err);
    assert_ok(mesh_connect(&mesh, &err), &err);
    assert_true(stats.worst_residual < 1e-9);
    return mesh;
}

/* Marching cubes as they are, one point a crossed edge. */
static inline struct surface_options plain(void)
{
    struct surface_options options = surface_defaults();
    options.relax = 0;
    return options;
}

static inline struct surface_shape shape_of(const struct mesh *mesh)
{
    struct error err = {0};
    struct surface_shape shape;
    assert_ok(surface_measure(mesh, &shape, &err), &err);
    return shape;
}

/* Each edge is run along exactly once in each sense. */
static inline void assert_closed(const struct mesh *mesh)
{
    unsigned char(*runs)[2] = calloc(mesh->edge_count, sizeof *runs);
    assert_int_equal(2 * mesh->edge_count, 3 * mesh->triangle_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            assert_int_equal(runs[edge][mesh->edge[edge][0] == from]++, 0);
        }
    free(runs);
}

/* The triangles of each point form one ring: going from each to its neighbour across the next edge meets
 * them all. */
static inline void assert_single_rings(const struct mesh *mesh)
{
    uint32_t(*across)[3] = calloc(mesh->triangle_count, sizeof *across);
    uint32_t(*owner)[2] = calloc(mesh->edge_count, sizeof *owner);
    uint32_t *degree = calloc(mesh->point_count, sizeof *degree);
    uint32_t *some = calloc(mesh->point_count, sizeof *some);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            owner[edge][mesh->edge[edge][0] == from] = t;
            degree[from]++;
            some[from] = t;
        }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            across[t][k] = owner[edge][mesh->edge[edge][0] != from];
        }
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        uint32_t t = some[p], count = 0;
        do {
            int k = mesh->triangle[t][0] == p ? 0 : mesh->triangle[t][1] == p ? 1 : 2;
            t = across[t][k];
            count++;
        } while (t != some[p] && count <= degree[p]);
        assert_int_equal(count, degree[p]);
    }
    free(across);
    free(owner);
    free(degree);
    free(some);
}

static inline void assert_on_surface(const struct mesh *mesh, const struct octree *tree,
                                     const struct surface_options *options)
{
    struct error err = {0};
    struct field field;
    struct probe probe;
    double side = 1 << tree->depth;
    assert_ok(field_init(&field, tree, &options->field, &err), &err);
    assert_ok(probe_init(&probe, &field, &err), &err);
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        double point[3], gradient[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = mesh->position[p][axis] * side;
        assert_near(probe_value(&probe, point, gradient), options->threshold, 1e-9);
        assert_near(vec3_length(mesh->normal[p]), 1, 1e-12);
        assert_near(vec3_dot(mesh->normal[p], gradient), -vec3_length(gradient), 1e-6);
    }
    probe_clear(&probe);
}

static inline void assert_sound(const struct mesh *mesh, const struct octree *tree,
                                const struct surface_options *options)
{
    assert_closed(mesh);
    assert_single_rings(mesh);
    assert_on_surface(mesh, tree, options);
    assert_true(mesh_volume(mesh) > 0);
    struct surface_shape shape = shape_of(mesh);
    assert_int_equal(shape.euler % 2, 0);
    /* In a file of single precision no two points may fall together. */
    assert_true(shape.shortest_edge > 1e-3 * shape.mean_edge);
}

#endif
