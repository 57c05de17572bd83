#include "sculpt/import.h"

#include "common/file.h"
#include "sculpt/sculpt.h"

bool sculpt_import_is_name(const char *path)
{
    return mesh_is_readable_name(path) || file_has_extension(path, "vox");
}

enum status sculpt_import(const char *path, unsigned depth, struct octree *tree,
                          struct voxelise_report *report, uint64_t *hollow, struct error *err)
{
    struct octree made = {0};
    *report = (struct voxelise_report){0};
    enum status status = mesh_is_readable_name(path) ? voxelise_load(path, depth, &made, report, err)
                                                     : vox_load(path, &made, err);
    if (!status)
        status = octree_fill_hollows(&made, 0, hollow, err); /* it only counts */
    if (status) {
        octree_clear(&made);
        return status;
    }
    octree_clear(tree);
    *tree = made;
    return STATUS_OK;
}
