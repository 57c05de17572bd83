/* What is told of cubes that are coarser than the sculpture: for main.c. */
#ifndef SURFACE_MAIN_COARSE_H
#define SURFACE_MAIN_COARSE_H

#include "surface/surface.h"

/* Notes that the mesh made of the sculpture in this file, on cubes of that size, may be rough or have lost
 * thin walls, where that may be; and what of other triangles, another sigma and no hollow would help. The
 * tree is only looked at. */
void coarse_note(struct octree *tree, const char *file, const struct surface_options *options,
                 const struct mesh *mesh, double cube);

#endif
