#include "common/array.h"
#include "common/file.h"
#include "common/mesh.h"
#include "common/mesh_files.h"

#include <stdlib.h>

static const struct {
    const char *extension;
    enum status (*read)(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err);
} formats[] = {
    {"ply", mesh_read_ply},
    {"stl", mesh_read_stl},
    {"obj", mesh_read_obj},
};

enum { FORMATS = sizeof formats / sizeof *formats };

static size_t format_of(const char *path)
{
    size_t i = 0;
    while (i < FORMATS && !file_has_extension(path, formats[i].extension))
        i++;
    return i;
}

bool mesh_is_file_name(const char *path)
{
    return format_of(path) < FORMATS;
}

enum status mesh_load(const char *path, struct mesh *mesh, struct error *err)
{
    const size_t i = format_of(path);
    if (i == FORMATS)
        return error_set(err, STATUS_INPUT, "%s: no known mesh file; must be .ply, .stl or .obj", path);
    struct bytes bytes = {0};
    struct mesh loaded = {0};
    enum status status = file_read(path, &bytes, err);
    if (!status)
        status = formats[i].read(&bytes, path, &loaded, err);
    bytes_clear(&bytes);
    if (!status && loaded.triangle_count == 0)
        status = error_set(err, STATUS_INPUT, "%s: the mesh has no triangles", path);
    if (status) {
        mesh_clear(&loaded);
        return status;
    }
    mesh_clear(mesh);
    *mesh = loaded;
    return STATUS_OK;
}

enum status triangle_list_add(struct triangle_list *list, uint32_t a, uint32_t b, uint32_t c,
                              struct error *err)
{
    if (list->count >= MESH_NONE - 1)
        return error_set(err, STATUS_RANGE, "more than %u triangles", MESH_NONE - 1);
    if (!ARRAY_RESERVE(list, 1))
        return error_no_memory(err, "the triangles");
    uint32_t *corner = list->items[list->count++];
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    return STATUS_OK;
}

void triangle_list_give(struct triangle_list *list, struct mesh *mesh)
{
    if (list->count > 0) {
        uint32_t(*fitting)[3] = realloc(list->items, list->count * sizeof *list->items);
        free(mesh->triangle);
        mesh->triangle = fitting ? fitting : list->items;
        mesh->triangle_count = (uint32_t)list->count;
    } else {
        free(list->items);
    }
    *list = (struct triangle_list){0};
}
