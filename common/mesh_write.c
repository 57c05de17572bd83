/* The formats that meshes are saved in. Binary numbers are put together byte by byte, so that files are the
 * same on any machine. */
#include "common/mesh_files.h"
#include "common/vec3.h"

#include <float.h>
#include <string.h>

/* Puts the low `size` bytes of bits at `to`, lowest first, and returns the place behind them. */
static unsigned char *put(unsigned char *to, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; i++)
        to[i] = (unsigned char)(bits >> 8 * i);
    return to + size;
}

static unsigned char *put_float(unsigned char *to, double value)
{
    float single = (float)value;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    return put(to, bits, sizeof bits);
}

static unsigned char *put_double(unsigned char *to, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put(to, bits, sizeof bits);
}

enum status mesh_write_ply(const struct mesh *mesh, FILE *stream, struct error *err)
{
    (void)err;
    fprintf(stream, "ply\nformat binary_little_endian 1.0\nelement vertex %u\n", mesh->point_count);
    fputs("property double x\nproperty double y\nproperty double z\n", stream);
    if (mesh->normal)
        fputs("property float nx\nproperty float ny\nproperty float nz\n", stream);
    fprintf(stream, "element face %u\nproperty list uchar uint vertex_indices\nend_header\n",
            mesh->triangle_count);
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        unsigned char row[3 * 8 + 3 * 4], *to = row;
        for (int i = 0; i < 3; i++)
            to = put_double(to, mesh->position[p][i]);
        for (int i = 0; i < 3 && mesh->normal; i++)
            to = put_float(to, mesh->normal[p][i]);
        fwrite(row, 1, (size_t)(to - row), stream);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        unsigned char row[1 + 3 * 4], *to = put(row, 3, 1);
        for (int k = 0; k < 3; k++)
            to = put(to, mesh->triangle[t][k], 4);
        fwrite(row, 1, sizeof row, stream);
    }
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
    put(head + 80, mesh->triangle_count, 4);
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
        put(to, 0, 2);
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
        uint64_t a = mesh->triangle[t][0] + 1ull, b = mesh->triangle[t][1] + 1ull,
                 c = mesh->triangle[t][2] + 1ull;
        if (mesh->normal)
            fprintf(stream, "f %ju//%ju %ju//%ju %ju//%ju\n", (uintmax_t)a, (uintmax_t)a, (uintmax_t)b,
                    (uintmax_t)b, (uintmax_t)c, (uintmax_t)c);
        else
            fprintf(stream, "f %ju %ju %ju\n", (uintmax_t)a, (uintmax_t)b, (uintmax_t)c);
    }
    return STATUS_OK;
}
