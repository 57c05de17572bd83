/* Sculptures in other forms, by the extension of the file. */
#ifndef SCULPT_EXPORT_H
#define SCULPT_EXPORT_H

#include "common/octree_chunks.h"

/* True when the name ends in .vox, .ply or .chips, upper or lower case. */
bool sculpt_export_is_name(const char *path);

/* Writes .vox (see vox_save()), .ply (see sculpt_faces()) or .chips: the chip log where `chunks` has one that
 * replays to this sculpture, else one fill a leaf. path is one that sculpt_export_is_name() accepts. Errors
 * name it: STATUS_FILE, STATUS_RANGE, STATUS_NO_MEMORY. */
enum status sculpt_export(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                          struct error *err);

#endif
