/* What can be told about a sculpture. Belongs to the program, not to the library. */
#ifndef SCULPT_INFO_H
#define SCULPT_INFO_H

#include "common/octree_chunks.h"

#include <stdio.h>

/* Writes a line a figure: its name, then its value. */
void info_print(const struct octree *tree, const struct octree_chunks *chunks, FILE *stream);

/* The material of most cells, 1 when there are none. */
unsigned info_main_material(const struct octree *tree);

#endif
