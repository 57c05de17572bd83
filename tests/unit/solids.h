/* Small meshes for the tests of meshes. */
#ifndef TESTS_UNIT_SOLIDS_H
#define TESTS_UNIT_SOLIDS_H

#include "check.h"
#include "common/mesh.h"

enum { CUBE_POINTS = 8, CUBE_TRIANGLES = 12 };

/* Point x + 2 y + 4 z is at (x, y, z); two triangles a face, wound outward. */
static const uint32_t cube_triangles[CUBE_TRIANGLES][3] = {
    {0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5},
};

/* Adds a cube of side 1 with its lower corner at x y z to a mesh of plain points and triangles. */
static inline void add_cube(struct mesh *mesh, double x, double y, double z)
{
    struct mesh larger;
    assert_int_equal(mesh_init(&larger, mesh->point_count + CUBE_POINTS,
                               mesh->triangle_count + CUBE_TRIANGLES, false, NULL),
                     STATUS_OK);
    if (mesh->point_count > 0) {
        memcpy(larger.position, mesh->position, mesh->point_count * sizeof *mesh->position);
        memcpy(larger.triangle, mesh->triangle, mesh->triangle_count * sizeof *mesh->triangle);
    }
    for (uint32_t p = 0; p < CUBE_POINTS; p++) {
        double *at = larger.position[mesh->point_count + p];
        at[0] = x + (p & 1);
        at[1] = y + (p >> 1 & 1);
        at[2] = z + (p >> 2);
    }
    for (uint32_t t = 0; t < CUBE_TRIANGLES; t++) {
        for (int k = 0; k < 3; k++)
            larger.triangle[mesh->triangle_count + t][k] = mesh->point_count + cube_triangles[t][k];
    }
    mesh_clear(mesh);
    *mesh = larger;
}

/* A mesh of these points and triangles. */
static inline struct mesh mesh_of(const double (*position)[3], size_t point_count,
                                  const uint32_t (*triangle)[3], size_t triangle_count)
{
    struct mesh mesh;
    assert_int_equal(mesh_init(&mesh, point_count, triangle_count, false, NULL), STATUS_OK);
    memcpy(mesh.position, position, point_count * sizeof *position);
    memcpy(mesh.triangle, triangle, triangle_count * sizeof *triangle);
    return mesh;
}

/* The same positions, to the bit, and the same triangles. */
static inline void assert_same_mesh(const struct mesh *a, const struct mesh *b)
{
    assert_int_equal(a->point_count, b->point_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_memory_equal(a->position, b->position, a->point_count * sizeof *a->position);
    assert_memory_equal(a->triangle, b->triangle, a->triangle_count * sizeof *a->triangle);
}

#endif
