/* Pictures of a sculpture, for the program: its bridge to render. */
#ifndef SCULPT_MAIN_PICTURE_H
#define SCULPT_MAIN_PICTURE_H

#include "common/octree_chunks.h"

/* Draws it into a PNG file. Errors: STATUS_RANGE for an empty one, STATUS_FILE,
 * STATUS_RESOURCE, STATUS_NO_MEMORY. */
enum status picture_draw(const struct octree *tree, const char *path, struct error *err);

/* Puts a preview among the chunks; an empty sculpture has none. Errors: STATUS_RESOURCE, STATUS_NO_MEMORY. */
enum status picture_preview(const struct octree *tree, struct octree_chunks *chunks, struct error *err);

#endif
