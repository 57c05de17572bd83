#include "sculpt/import.h"

#include "common/file.h"
#include "sculpt/sculpt.h"

#include <stdio.h>

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

const char *sculpt_import_notes(const char *path, const struct voxelise_report *report, char *text,
                                size_t size)
{
    char repairs[256];
    const bool repaired = mesh_report_repairs(&report->mesh, repairs, sizeof repairs)[0];
    const size_t open = report->mesh.boundary_edges;
    int length = 0;
    text[0] = '\0';
    if (repaired)
        length = snprintf(text, size, "%s: %s%s", path, repairs, open ? "\n" : "");
    if (open && length >= 0 && (size_t)length < size)
        snprintf(text + length, size - (size_t)length,
                 "%s: %zu edges are open; its holes were closed as what surrounds them suggests", path, open);
    return text;
}
