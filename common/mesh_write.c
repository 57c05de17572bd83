/* The formats that meshes are saved in. */
#include "common/little_endian.h"
#include "common/mesh_files.h"
#include "common/vec3.h"

#include <float.h>

static void write_ply_point(const struct mesh *mesh, uint32_t p, const struct mesh_value *values,
                            size_t count, FILE *stream)
{
    unsigned char row[3 * 8 + 3 * 4 + 4 * MESH_VALUES_MAX], *to = row;
    for (int i = 0; i < 3; i++)
        to = put_double(to, mesh->position[p][i]);
    for (int i = 0; i < 3 && mesh->normal; i++)
        to = put_float(to, mesh->normal[p][i]);
    for (size_t v = 0; v < count; v++)
        to = values[v].number ? put_float(to, (double)values[v].number[p])
                              : put_bits(to, (uint32_t)values[v].whole[p], 4);
    fwrite(row, 1, (size_t)(to - row), stream);
}

void mesh_write_ply_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                           FILE *stream)
{
    fprintf(stream, "ply\nformat binary_little_endian 1.0\nelement vertex %u\n", mesh->point_count);
    fputs("property double x\nproperty double y\nproperty double z\n", stream);
    if (mesh->normal)
        fputs("property float nx\nproperty float ny\nproperty float nz\n", stream);
    for (size_t v = 0; v < count; v++)
        fprintf(stream, "property %s %s\n", values[v].number ? "float" : "int", values[v].name);
    fprintf(stream, "element face %u\nproperty list uchar uint vertex_indices\nend_header\n",
            mesh->triangle_count);
    for (uint32_t p = 0; p < mesh->point_count; p++)
        write_ply_point(mesh, p, values, count, stream);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        unsigned char row[1 + 3 * 4], *to = put_bits(row, 3, 1);
        for (int k = 0; k < 3; k++)
            to = put_bits(to, mesh->triangle[t][k], 4);
        fwrite(row, 1, sizeof row, stream);
    }
}

enum status mesh_write_ply(const struct mesh *mesh, FILE *stream, struct error *err)
{
    (void)err;
    mesh_write_ply_values(mesh, NULL, 0, stream);
    return STATUS_OK;
}

/* The unit normal of triangle t; zeros, as the format asks, where it has none. */
static void facet_normal(const struct mesh *mesh, uint32_t t, double normal[3])
{
    const uint32_t *corner = mesh->triangle[t];
    vec3_triangle(mesh->position[corner[0]], mesh->position[corner[1]], mesh->position[corner[2]], normal);
    double length = vec3_length(normal);
    for (int i = 0; i < 3; i++)
        normal[i] = length > 0 && length < HUGE_VAL ? normal[i] / length : 0;
}

static enum status check_floats(const struct mesh *mesh, struct error *err)
{
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        for (int i = 0; i < 3; i++) {
            if (!(fabs(mesh->position[p][i]) <= (double)FLT_MAX))
                return error_set(err, STATUS_RANGE,
                                 "point %u has a coordinate %g; STL holds up to %g, PLY more", p,
                                 mesh->position[p][i], (double)FLT_MAX);
        }
    }
    return STATUS_OK;
}

/* The header must not begin with "solid", which many readers take for the text format. */
enum status mesh_write_stl(const struct mesh *mesh, FILE *stream, struct error *err)
{
    enum status status = check_floats(mesh, err);
    if (status)
        return status;
    unsigned char head[84] = "balloon";
    put_bits(head + 80, mesh->triangle_count, 4);
    fwrite(head, 1, sizeof head, stream);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        unsigned char facet[50], *to = facet;
        double normal[3];
        facet_normal(mesh, t, normal);
        for (int i = 0; i < 3; i++)
            to = put_float(to, normal[i]);
        for (int k = 0; k < 3; k++) {
            for (int i = 0; i < 3; i++)
                to = put_float(to, mesh->position[mesh->triangle[t][k]][i]);
        }
        put_bits(to, 0, 2);
        fwrite(facet, 1, sizeof facet, stream);
    }
    return STATUS_OK;
}

enum status mesh_write_obj(const struct mesh *mesh, FILE *stream, struct error *err)
{
    (void)err;
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        const double *at = mesh->position[p];
        fprintf(stream, "v %.17g %.17g %.17g\n", at[0], at[1], at[2]);
    }
    for (uint32_t p = 0; p < mesh->point_count && mesh->normal; p++) {
        const double *normal = mesh->normal[p];
        fprintf(stream, "vn %.9g %.9g %.9g\n", normal[0], normal[1], normal[2]);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *corner = mesh->triangle[t];
        const uint32_t a = corner[0] + 1, b = corner[1] + 1, c = corner[2] + 1; /* at most 2^32 - 2 */
        if (mesh->normal)
            fprintf(stream, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
        else
            fprintf(stream, "f %u %u %u\n", a, b, c);
    }
    return STATUS_OK;
}
