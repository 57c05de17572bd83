#include "shapes.h"

#include "common/vec3.h"

#include <stdlib.h>
#include <string.h>

/* The icosahedron: the even permutations of (0, +-1, +-golden ratio), and the triples of
 * them that are neighbours. */
static void icosahedron(struct mesh *mesh)
{
    const double golden = (1 + sqrt(5)) / 2;
    if (mesh_init(mesh, 12, 20, false, NULL))
        abort();
    for (uint32_t p = 0; p < 12; p++) {
        const uint32_t zero = p / 4;
        double *x = mesh->position[p];
        x[zero] = 0;
        x[(zero + 1) % 3] = (p & 1 ? -1 : 1) / sqrt(1 + golden * golden);
        x[(zero + 2) % 3] = (p & 2 ? -golden : golden) / sqrt(1 + golden * golden);
    }
    const double near = 4 / (1 + golden * golden) + 1e-9; /* the square of an edge, 2 / sqrt(1 + golden^2) */
    uint32_t t = 0;
    for (uint32_t a = 0; a < 12; a++)
        for (uint32_t b = a + 1; b < 12; b++)
            for (uint32_t c = b + 1; c < 12; c++) {
                double ab[3], bc[3], ca[3], n[3];
                vec3_sub(mesh->position[b], mesh->position[a], ab);
                vec3_sub(mesh->position[c], mesh->position[b], bc);
                vec3_sub(mesh->position[a], mesh->position[c], ca);
                if (vec3_dot(ab, ab) > near || vec3_dot(bc, bc) > near || vec3_dot(ca, ca) > near)
                    continue;
                vec3_triangle(mesh->position[a], mesh->position[b], mesh->position[c], n);
                const uint32_t outward = vec3_dot(n, mesh->position[a]) > 0;
                memcpy(mesh->triangle[t++], (uint32_t[3]){a, outward ? b : c, outward ? c : b}, 3 * sizeof a);
            }
}

/* Each edge's middle becomes a point on the sphere, each triangle four. */
static void refine(struct mesh *mesh)
{
    struct mesh fine = {0};
    if (mesh_connect(mesh, NULL) ||
        mesh_init(&fine, mesh->point_count + mesh->edge_count, 4 * (size_t)mesh->triangle_count, false, NULL))
        abort();
    memcpy(fine.position, mesh->position, mesh->point_count * sizeof *fine.position);
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        double *x = fine.position[mesh->point_count + e];
        for (int i = 0; i < 3; i++)
            x[i] = mesh->position[mesh->edge[e][0]][i] + mesh->position[mesh->edge[e][1]][i];
        const double length = vec3_length(x);
        for (int i = 0; i < 3; i++)
            x[i] /= length;
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *p = mesh->triangle[t];
        uint32_t m[3];
        for (int k = 0; k < 3; k++)
            m[k] = mesh->point_count + mesh->triangle_edge[t][k];
        const uint32_t four[4][3] = {
            {p[0], m[0], m[2]}, {m[0], p[1], m[1]}, {m[2], m[1], p[2]}, {m[0], m[1], m[2]}};
        memcpy(fine.triangle[4 * (size_t)t], four, sizeof four);
    }
    mesh_clear(mesh);
    *mesh = fine;
}

void shape_icosphere(unsigned level, struct mesh *mesh)
{
    *mesh = (struct mesh){0};
    icosahedron(mesh);
    while (level--)
        refine(mesh);
    if (mesh_connect(mesh, NULL))
        abort();
}
