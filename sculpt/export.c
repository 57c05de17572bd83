#include "sculpt/export.h"

#include "sculpt/chip_log.h"
#include "sculpt/sculpt.h"

#include <assert.h>

static enum status save_voxels(const struct octree *tree, const struct octree_chunks *chunks,
                               const char *path, struct error *err)
{
    (void)chunks;
    return vox_save(tree, path, err);
}

static enum status save_faces(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                              struct error *err)
{
    (void)chunks;
    struct mesh mesh = {0};
    enum status status = sculpt_faces(tree, &mesh, err);
    if (!status)
        status = mesh_save(&mesh, path, err);
    else if (err)
        error_prefix(err, path);
    mesh_clear(&mesh);
    return status;
}

static enum status save_script(const struct octree *tree, const struct octree_chunks *chunks,
                               const char *path, struct error *err)
{
    const struct octree_chunk *log = octree_chunks_find(chunks, OCTREE_CHUNK_LOG);
    struct file_out *out;
    bool holds = false;
    enum status status = log ? chip_log_holds(&log->data, tree, &holds, err) : STATUS_OK;
    if (!status && !holds)
        return chips_save(tree, path, err);
    if (!status)
        status = file_out_open(path, &out, err);
    if (status)
        return status;
    fwrite(log->data.data, 1, log->data.size, file_out_stream(out));
    return file_out_commit(out, err);
}

static const struct {
    const char *extension;
    enum status (*save)(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                        struct error *err);
} exporters[] = {{"vox", save_voxels}, {"ply", save_faces}, {"chips", save_script}};

enum { EXPORTERS = sizeof exporters / sizeof *exporters };

static int exporter_of(const char *path)
{
    for (int i = 0; i < EXPORTERS; i++)
        if (file_has_extension(path, exporters[i].extension))
            return i;
    return -1;
}

bool sculpt_export_is_name(const char *path)
{
    return exporter_of(path) >= 0;
}

enum status sculpt_export(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                          struct error *err)
{
    int exporter = exporter_of(path);
    assert(exporter >= 0);
    return exporters[exporter].save(tree, chunks, path, err);
}
