/* VTK's XML PolyData with its numbers behind the text: each array is its size in bytes, as
 * 8 bytes, and its items. */
#include "common/little_endian.h"
#include "common/mesh_files.h"

static void write_size(uint64_t bytes, FILE *stream)
{
    unsigned char size[8];
    fwrite(size, 1, (size_t)(put_bits(size, bytes, 8) - size), stream);
}

/* Offsets count from behind the sign `_` that begins the arrays; each call moves *offset behind its array. */
static void announce(const char *type, const char *name, int components, uint64_t bytes, uint64_t *offset,
                     FILE *stream)
{
    fprintf(stream,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" "
            "offset=\"%llu\"/>\n",
            type, name, components, (unsigned long long)*offset);
    *offset += 8 + bytes;
}

static void write_text(const struct mesh *mesh, const struct mesh_value *values, size_t count, FILE *stream)
{
    const uint64_t points = mesh->point_count, triangles = mesh->triangle_count;
    uint64_t offset = 0;
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
          stream);
    fprintf(stream,
            "<PolyData><Piece NumberOfPoints=\"%u\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"%u\">\n<PointData>\n",
            mesh->point_count, mesh->triangle_count);
    for (size_t v = 0; v < count; v++)
        announce(values[v].number ? "Float32" : "Int32", values[v].name, 1, 4 * points, &offset, stream);
    fputs("</PointData>\n<Points>\n", stream);
    announce("Float64", "points", 3, 24 * points, &offset, stream);
    fputs("</Points>\n<Polys>\n", stream);
    announce("Int64", "connectivity", 1, 24 * triangles, &offset, stream);
    announce("Int64", "offsets", 1, 8 * triangles, &offset, stream);
    fputs("</Polys>\n</Piece></PolyData>\n<AppendedData encoding=\"raw\">\n_", stream);
}

static void write_value(const struct mesh_value *value, uint32_t points, FILE *stream)
{
    write_size(4ull * points, stream);
    for (uint32_t p = 0; p < points; p++) {
        unsigned char item[4];
        if (value->number)
            put_float(item, (double)value->number[p]);
        else
            put_bits(item, (uint32_t)value->whole[p], 4);
        fwrite(item, 1, sizeof item, stream);
    }
}

static void write_points(const struct mesh *mesh, FILE *stream)
{
    write_size(24ull * mesh->point_count, stream);
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        unsigned char row[24], *to = row;
        for (int i = 0; i < 3; i++)
            to = put_double(to, mesh->position[p][i]);
        fwrite(row, 1, sizeof row, stream);
    }
}

/* A triangle's offset is where its corners end in the list of all corners. */
static void write_triangles(const struct mesh *mesh, FILE *stream)
{
    unsigned char row[24];
    write_size(24ull * mesh->triangle_count, stream);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        unsigned char *to = row;
        for (int k = 0; k < 3; k++)
            to = put_bits(to, mesh->triangle[t][k], 8);
        fwrite(row, 1, sizeof row, stream);
    }
    write_size(8ull * mesh->triangle_count, stream);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        fwrite(row, 1, (size_t)(put_bits(row, 3 * (t + 1ull), 8) - row), stream);
}

void mesh_write_vtp_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                           FILE *stream)
{
    write_text(mesh, values, count, stream);
    for (size_t v = 0; v < count; v++)
        write_value(&values[v], mesh->point_count, stream);
    write_points(mesh, stream);
    write_triangles(mesh, stream);
    fputs("\n</AppendedData>\n</VTKFile>\n", stream);
}
