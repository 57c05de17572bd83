/* What is told of cubes that are coarser than the sculpture: for main.c. */
#ifndef SURFACE_MAIN_COARSE_H
#define SURFACE_MAIN_COARSE_H

#include "surface/surface.h"

enum { COARSE_TEXT = 1024 };

/* Says that the mesh made of the sculpture in this file, on cubes of that size, may be rough or have lost
 * thin walls, and what of other triangles, another sigma and no hollow would help. False: there is nothing to
 * say. The tree is only looked at. */
bool coarse_tell(struct octree *tree, const char *file, const struct surface_options *options,
                 const struct mesh *mesh, double cube, char text[COARSE_TEXT]);

#endif
