#include "common/mesh.h"

#include "common/array.h"
#include "common/vec3.h"

#include <stdlib.h>

enum status mesh_check_size(size_t point_count, size_t triangle_count, struct error *err)
{
    if (point_count < MESH_NONE && triangle_count < MESH_NONE)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE,
                     "a mesh of %zu points and %zu triangles is too large; there can be %u of each",
                     point_count, triangle_count, MESH_NONE - 1);
}

enum status mesh_init(struct mesh *mesh, size_t point_count, size_t triangle_count, bool normals,
                      struct error *err)
{
    if (mesh_check_size(point_count, triangle_count, err))
        return STATUS_RANGE;
    struct mesh made = {
        .point_count = (uint32_t)point_count,
        .triangle_count = (uint32_t)triangle_count,
        .position = array_new(point_count, sizeof *made.position),
        .normal = normals ? array_new(point_count, sizeof *made.normal) : NULL,
        .triangle = array_new(triangle_count, sizeof *made.triangle),
    };
    if (!made.position || !made.triangle || (normals && !made.normal)) {
        mesh_clear(&made);
        return error_no_memory(err, "the mesh");
    }
    *mesh = made;
    return STATUS_OK;
}

void mesh_clear(struct mesh *mesh)
{
    free(mesh->position);
    free(mesh->normal);
    free(mesh->triangle);
    free(mesh->edge);
    free(mesh->triangle_edge);
    *mesh = (struct mesh){0};
}

/* The mean of the points. Seen from there a volume's terms are small, and little cancels. */
static void middle_of(const struct mesh *mesh, double middle[3])
{
    for (int i = 0; i < 3; i++)
        middle[i] = 0;
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        for (int i = 0; i < 3; i++)
            middle[i] += mesh->position[p][i] / mesh->point_count;
    }
}

double mesh_volume(const struct mesh *mesh)
{
    double middle[3];
    middle_of(mesh, middle);
    double six_volumes = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double a[3], b[3], c[3], across[3];
        vec3_sub(mesh->position[mesh->triangle[t][0]], middle, a);
        vec3_sub(mesh->position[mesh->triangle[t][1]], middle, b);
        vec3_sub(mesh->position[mesh->triangle[t][2]], middle, c);
        vec3_cross(b, c, across);
        six_volumes += vec3_dot(a, across);
    }
    return six_volumes / 6;
}

double mesh_area(const struct mesh *mesh)
{
    double two_areas = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *corner = mesh->triangle[t];
        double across[3];
        vec3_triangle(mesh->position[corner[0]], mesh->position[corner[1]], mesh->position[corner[2]],
                      across);
        two_areas += vec3_length(across);
    }
    return two_areas / 2;
}
