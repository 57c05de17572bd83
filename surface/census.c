#include "surface/census.h"

#include "common/array.h"
#include "common/disjoint_sets.h"
#include "common/vec3.h"

#include <math.h>
#include <stdlib.h>

size_t surface_number_parts(const struct mesh *mesh, uint32_t *part)
{
    size_t count = 0;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        part[p] = p;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 2; k++)
            sets_unite(part, mesh->triangle[t][k], mesh->triangle[t][k + 1]);
    /* A part's first point stands for it, so its number is known before the others ask. */
    for (uint32_t p = 0; p < mesh->point_count; p++)
        part[p] = part[p] == p ? (uint32_t)count++ : part[part[p]];
    return count;
}

static void add_triangle(const struct mesh *mesh, uint32_t t, struct surface_part *part)
{
    const double *a = mesh->position[mesh->triangle[t][0]], *b = mesh->position[mesh->triangle[t][1]],
                 *c = mesh->position[mesh->triangle[t][2]];
    const double *origin = mesh->position[mesh->triangle[0][0]];
    double across[3], from[3];
    vec3_triangle(a, b, c, across);
    vec3_sub(a, origin, from);
    part->triangles++;
    part->area += vec3_length(across) / 2;
    part->volume += vec3_dot(across, from) / 6;
}

static void count_angles(const struct mesh *mesh, uint32_t t, uint64_t *angles)
{
    for (int k = 0; k < 3; k++) {
        const double angle_deg = surface_angle(mesh, mesh->triangle[t], k) * 180 / M_PI;
        angles[(int)fmin(angle_deg / (180.0 / CENSUS_ANGLES), CENSUS_ANGLES - 1)]++;
    }
}

static bool count_valences(const struct mesh *mesh, uint32_t *valences)
{
    uint32_t *valence = calloc(mesh->point_count, sizeof *valence);
    if (!valence)
        return false;
    for (uint32_t e = 0; e < mesh->edge_count; e++)
        for (int end = 0; end < 2; end++)
            valence[mesh->edge[e][end]]++;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        valences[valence[p] < CENSUS_VALENCES ? valence[p] : CENSUS_VALENCES - 1]++;
    free(valence);
    return true;
}

enum status surface_count_parts(const struct mesh *mesh, struct surface_census *census, struct error *err)
{
    *census = (struct surface_census){0};
    uint32_t *part = array_new(mesh->point_count, sizeof *part);
    census->part_count = part ? surface_number_parts(mesh, part) : 0;
    census->parts = part ? calloc(census->part_count, sizeof *census->parts) : NULL;
    if (census->parts) {
        for (uint32_t p = 0; p < mesh->point_count; p++)
            census->parts[part[p]].points++;
        for (uint32_t e = 0; e < mesh->edge_count; e++)
            census->parts[part[mesh->edge[e][0]]].edges++;
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            add_triangle(mesh, t, &census->parts[part[mesh->triangle[t][0]]]);
    }
    free(part);
    return census->parts ? STATUS_OK : error_no_memory(err, "the parts");
}

enum status surface_count(const struct mesh *mesh, const struct surface_shape *shape,
                          struct surface_census *census, struct error *err)
{
    const enum status status = surface_count_parts(mesh, census, err);
    if (status)
        return status;
    if (!count_valences(mesh, census->valences)) {
        surface_census_clear(census);
        return error_no_memory(err, "the parts");
    }
    for (size_t i = 0; i < census->part_count; i++) {
        struct surface_part *part = &census->parts[i];
        part->euler = (long)part->points - (long)part->edges + (long)part->triangles;
        part->genus = 1 - part->euler / 2;
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        count_angles(mesh, t, census->angles);
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        double length = vec3_distance(mesh->position[mesh->edge[e][0]], mesh->position[mesh->edge[e][1]]);
        census->edges[(int)fmin(10 * length / shape->mean_edge, CENSUS_EDGES - 1)]++;
    }
    return STATUS_OK;
}

void surface_census_clear(struct surface_census *census)
{
    free(census->parts);
    *census = (struct surface_census){0};
}
