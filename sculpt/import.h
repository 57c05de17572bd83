/* Models that sculptures begin with: .vox, and meshes (.stl, .ply, .obj) by voxelising. */
#ifndef SCULPT_IMPORT_H
#define SCULPT_IMPORT_H

#include "sculpt/voxelise.h"

bool sculpt_import_is_name(const char *path);

/* Reads a model whose name sculpt_import_is_name() knows; a mesh into 2^depth cells a side. *report is {0}
 * for a .vox. Sets *hollow to the number of cells that are empty but enclosed: models are often shells, and a
 * shell makes a balloon inside a balloon. *tree (valid; it is replaced) is as it was after a failure. Errors:
 * those of vox_load() and voxelise_load(). */
enum status sculpt_import(const char *path, unsigned depth, struct octree *tree,
                          struct voxelise_report *report, uint64_t *hollow, struct error *err);

/* What was repaired in a mesh, and that it was open, a line each with "\n" between them; "" where there is
 * nothing to tell. Cut off at size. Returns text. */
const char *sculpt_import_notes(const char *path, const struct voxelise_report *report, char *text,
                                size_t size);

#endif
