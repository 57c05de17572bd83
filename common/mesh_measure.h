/* The second half of mesh_repair(): what is unusual about a mesh whose corners and edges are in order. */
#ifndef COMMON_MESH_MEASURE_H
#define COMMON_MESH_MEASURE_H

#include "common/mesh.h"

/* Sets all of *report but the counts of repairs. The mesh must be connected and no triangle have a corner
 * twice. O(n). Errors: STATUS_NO_MEMORY. */
enum status mesh_measure(const struct mesh *mesh, struct mesh_report *report, struct error *err);

#endif
