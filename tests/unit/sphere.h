/* A sphere to draw: rows of triangles from pole to pole, of radius 1 about the origin. */
#ifndef TESTS_UNIT_SPHERE_H
#define TESTS_UNIT_SPHERE_H

#include "common/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* 2 columns (rows - 1) triangles, outward normals; free with sphere_free(). */
static inline struct mesh sphere_new(uint32_t rows, uint32_t columns)
{
    struct mesh mesh = {.point_count = (rows - 1) * columns + 2, .triangle_count = 2 * columns * (rows - 1)};
    mesh.position = calloc(mesh.point_count, sizeof *mesh.position);
    mesh.normal = calloc(mesh.point_count, sizeof *mesh.normal);
    mesh.triangle = calloc(mesh.triangle_count, sizeof *mesh.triangle);
    uint32_t bottom = mesh.point_count - 1, t = 0;
    for (uint32_t p = 0; p < mesh.point_count; p++) {
        uint32_t row = p == 0 ? 0 : p == bottom ? rows : 1 + (p - 1) / columns;
        double down = M_PI * row / rows, around = 2 * M_PI * ((p - 1) % columns + 0.5 * (row % 2)) / columns;
        mesh.position[p][0] = sin(down) * sin(around);
        mesh.position[p][1] = cos(down);
        mesh.position[p][2] = sin(down) * cos(around);
    }
    memcpy(mesh.normal, mesh.position, mesh.point_count * sizeof *mesh.normal);
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t j = 0; j < columns; j++) {
            uint32_t above = row ? 1 + (row - 1) * columns : 0, below = 1 + row * columns,
                     k = (j + 1) % columns;
            const uint32_t left[3] = {above + j, below + j, above + k};
            const uint32_t right[3] = {above + k, below + j, below + k};
            const uint32_t top[3] = {0, below + j, below + k};
            const uint32_t last[3] = {above + j, bottom, above + k};
            if (row == 0) {
                memcpy(mesh.triangle[t++], top, sizeof top);
            } else if (row == rows - 1) {
                memcpy(mesh.triangle[t++], last, sizeof last);
            } else {
                memcpy(mesh.triangle[t++], left, sizeof left);
                memcpy(mesh.triangle[t++], right, sizeof right);
            }
        }
    return mesh;
}

static inline void sphere_free(struct mesh *mesh)
{
    free(mesh->position);
    free(mesh->normal);
    free(mesh->triangle);
    *mesh = (struct mesh){0};
}

#endif
