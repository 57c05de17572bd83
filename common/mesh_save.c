#include "common/mesh_files.h"

static const struct {
    const char *extension;
    enum status (*write)(const struct mesh *mesh, FILE *stream, struct error *err);
} formats[] = {
    {"ply", mesh_write_ply},
    {"stl", mesh_write_stl},
    {"obj", mesh_write_obj},
};

enum status mesh_save(const struct mesh *mesh, const char *path, struct error *err)
{
    size_t i = 0;
    while (i < sizeof formats / sizeof *formats && !file_has_extension(path, formats[i].extension))
        i++;
    if (i == sizeof formats / sizeof *formats)
        return error_set(err, STATUS_USAGE, "%s: no known mesh format; must be .ply, .stl or .obj", path);
    struct file_out *out;
    struct error reason = {0};
    enum status status = file_out_open(path, &out, err);
    if (status)
        return status;
    status = formats[i].write(mesh, file_out_stream(out), &reason);
    if (status) {
        file_out_abandon(out);
        return error_set(err, status, "%s: %s", path, reason.text);
    }
    return file_out_commit(out, err);
}

enum status mesh_save_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                             const char *path, struct error *err)
{
    const bool ply = file_has_extension(path, "ply");
    struct file_out *out;
    if (!ply && !file_has_extension(path, "vtp"))
        return error_set(err, STATUS_USAGE, "%s: no format for meshes with values; must be .ply or .vtp",
                         path);
    enum status status = file_out_open(path, &out, err);
    if (status)
        return status;
    if (ply)
        mesh_write_ply_values(mesh, values, count, file_out_stream(out));
    else
        mesh_write_vtp_values(mesh, values, count, file_out_stream(out));
    return file_out_commit(out, err);
}
