#include "common/array.h"
#include "common/vec3.h"
#include "surface/census.h"

#include <math.h>
#include <stdlib.h>

static bool count_components(const struct mesh *mesh, size_t *count)
{
    uint32_t *part = array_new(mesh->point_count, sizeof *part);
    if (!part)
        return false;
    *count = surface_number_parts(mesh, part);
    free(part);
    return true;
}

double surface_angle(const struct mesh *mesh, const uint32_t triangle[3], int k)
{
    const double *corner = mesh->position[triangle[k]];
    double a[3], b[3], across[3];
    vec3_sub(mesh->position[triangle[(k + 1) % 3]], corner, a);
    vec3_sub(mesh->position[triangle[(k + 2) % 3]], corner, b);
    vec3_cross(a, b, across);
    return atan2(vec3_length(across), vec3_dot(a, b));
}

static double smallest_angle_deg(const struct mesh *mesh)
{
    double least = M_PI;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            least = fmin(least, surface_angle(mesh, mesh->triangle[t], k));
    return least * 180 / M_PI;
}

static void measure_edges(const struct mesh *mesh, struct surface_shape *shape)
{
    double total = 0;
    shape->shortest_edge = INFINITY;
    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        double length = vec3_distance(mesh->position[mesh->edge[i][0]], mesh->position[mesh->edge[i][1]]);
        shape->shortest_edge = fmin(shape->shortest_edge, length);
        shape->longest_edge = fmax(shape->longest_edge, length);
        total += length;
    }
    shape->mean_edge = total / mesh->edge_count;
}

enum status surface_measure(const struct mesh *mesh, struct surface_shape *shape, struct error *err)
{
    *shape = (struct surface_shape){.volume = mesh_volume(mesh), .area = mesh_area(mesh)};
    if (!count_components(mesh, &shape->components))
        return error_no_memory(err, "the components");
    shape->euler = (long)mesh->point_count - (long)mesh->edge_count + (long)mesh->triangle_count;
    measure_edges(mesh, shape);
    shape->smallest_angle_deg = smallest_angle_deg(mesh);
    return STATUS_OK;
}
