/*
 * Triangle meshes (.stl, .ply, .obj) as sculptures: which cells lie inside.
 *
 *     struct octree tree = {0};
 *     struct voxelise_report report;
 *     if (voxelise_load("cat.stl", 7, &tree, &report, err)) ...
 *
 * Every cell's centre looks along the six axes and counts, with their sense, the triangles on its way out. A
 * closed mesh gives six times its winding number, however often it overlaps itself, and has inside what that
 * is not 0 for: parts that are inside out too (the ray crossings of Nooruddin and Turk, "Simplification and
 * repair of polygonal models using volumetric techniques", IEEE TVCG 9, 2003, counted with their sense). Holes
 * make the six differ: where at least five say "inside", or all "outside", a cell is decided; for the
 * others the solid angle under which the whole mesh is seen decides, the generalised winding number of
 * Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
 * numbers", SIGGRAPH 2013: inside above 1/2. It is summed over a tree of triangles,
 * far ones as one, after Barill et al., "Fast winding numbers for soups and clouds", SIGGRAPH 2018.
 */
#ifndef SCULPT_VOXELISE_H
#define SCULPT_VOXELISE_H

#include "common/mesh.h"
#include "common/octree.h"

enum {
    VOXELISE_DEPTH_DEFAULT = 7,
    VOXELISE_DEPTH_MIN = 2, /* below that nothing is left beside the free cells at the border */
};

struct voxelise_report {
    struct mesh_report mesh; /* what was repaired, and where it is open */
    uint64_t inside;         /* cells */
    uint64_t doubtful;       /* cells that the solid angle decided */
    uint64_t undecided;      /* of those, cells that see between 1/4 and 3/4 of the sphere as surface */
};

/* Makes *tree (valid; it is replaced, or as it was after a failure) a cube of 2^depth cells a side with the
 * mesh in its middle, as large as leaves a cell free all around, of material 1. The mesh is one that
 * mesh_repair() has passed and reported on in report->mesh; the rest of *report is set here. Triangles that
 * are not all turned alike are counted without their sense. Errors: STATUS_RANGE for another depth than
 * VOXELISE_DEPTH_MIN .. OCTREE_DEPTH_MAX and for a mesh that covers its cells too often; STATUS_INPUT for a
 * mesh that encloses no cell or is too open to tell; STATUS_NO_MEMORY. */
enum status voxelise(const struct mesh *mesh, unsigned depth, struct octree *tree,
                     struct voxelise_report *report, struct error *err);

/* Reads, repairs and voxelises a mesh file. Errors: also those of mesh_load() and mesh_repair(); all name the
 * file. */
enum status voxelise_load(const char *path, unsigned depth, struct octree *tree,
                          struct voxelise_report *report, struct error *err);

#endif
