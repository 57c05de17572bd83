#include "common/array.h"
#include "common/file.h"
#include "common/mesh.h"
#include "common/mesh_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

/* Formats with meshes that assimp 5 reads (doc/Fileformats.md there), less those that other programs
 * use for something else. */
static const char *const foreign_extensions[] = {
    "3ds", "3mf",  "ac",   "amf", "ase", "assbin", "b3d", "blend", "cob", "dae",     "dxf", "fbx",
    "glb", "gltf", "hmp",  "ifc", "lwo", "lws",    "lxo", "md2",   "md3", "md5mesh", "mdl", "ms3d",
    "nff", "off",  "ogex", "q3o", "q3s", "smd",    "ter", "x",     "x3d", "xgl",     "zgl",
};

static bool is_foreign(const char *path)
{
    for (size_t i = 0; i < sizeof foreign_extensions / sizeof *foreign_extensions; i++)
        if (file_has_extension(path, foreign_extensions[i]))
            return true;
    return false;
}

bool mesh_is_readable_name(const char *path)
{
    return mesh_is_file_name(path) || is_foreign(path);
}

static enum status load_own(const char *path, struct mesh *mesh, struct error *err)
{
    struct bytes bytes = {0};
    enum status status = file_read(path, &bytes, err);
    if (!status)
        status = formats[format_of(path)].read(&bytes, path, mesh, err);
    bytes_clear(&bytes);
    if (status && err && !strstr(err->text, path)) /* it says what is too large, not where */
        error_prefix(err, path);
    return status;
}

static enum status load_foreign(const char *path, struct mesh *mesh, struct error *err)
{
    if (access(path, R_OK)) /* of which assimp would not say why */
        return error_set(err, STATUS_FILE, "%s: cannot open: %s", path, strerror(errno));
    return mesh_read_foreign(path, mesh, err);
}

enum status mesh_load(const char *path, struct mesh *mesh, struct error *err)
{
    if (!mesh_is_readable_name(path))
        return error_set(err, STATUS_INPUT,
                         "%s: no known mesh file; must be .ply, .stl or .obj, or what assimp reads", path);
    struct mesh loaded = {0};
    enum status status = mesh_is_file_name(path) ? load_own(path, &loaded, err)
                                                 : load_foreign(path, &loaded, err);
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
