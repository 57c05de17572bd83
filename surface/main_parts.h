/* What is told of a mesh that is no single balloon: for main.c. */
#ifndef SURFACE_MAIN_PARTS_H
#define SURFACE_MAIN_PARTS_H

#include "common/mesh.h"

#include <stdbool.h>

enum { PARTS_TEXT = 1024 };

/* *several becomes whether the mesh made of the sculpture in this file has parts that do not hang together;
 * `text` then says how many, how large the largest is, and what may join them or fill hollows. The mesh must
 * be closed. Errors: STATUS_NO_MEMORY. */
enum status parts_tell(const struct mesh *mesh, const char *file, bool *several, char text[PARTS_TEXT],
                       struct error *err);

#endif
