/* Meshes that tests and benchmarks make for themselves. */
#ifndef TESTS_SUPPORT_SHAPES_H
#define TESTS_SUPPORT_SHAPES_H

#include "common/mesh.h"

/* A regular icosphere of radius 1 around the origin: 20 x 4^level triangles, wound outward, connected. Level
 * 0 to 8. Ends the program when memory is not enough. */
void shape_icosphere(unsigned level, struct mesh *mesh);

#endif
