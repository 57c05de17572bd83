/*
 * A triangle mesh: what the mesher writes, the simulator reads, and the renderer draws.
 *
 *     struct mesh mesh = {0};
 *     struct mesh_report report;
 *     if (mesh_load("fox.ply", &mesh, err)) ...      .ply, .stl or .obj, by extension
 *     if (mesh_repair(&mesh, &report, err)) ...      welds, drops what is flat; says what it did
 *     if (mesh_connect(&mesh, err)) ...              edges and which triangle has which
 *     mesh_clear(&mesh);
 *
 * The members are open for all to read. Arrays that are NULL were not asked for.
 */
#ifndef COMMON_MESH_H
#define COMMON_MESH_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Points, edges and triangles are counted in 32 bits; the largest number means "none". */
#define MESH_NONE UINT32_MAX

/* The largest coordinate mesh_repair() lets pass: areas and volumes of what is larger might not be finite. */
#define MESH_COORDINATE_MAX 1e90

struct mesh {
    uint32_t point_count, edge_count, triangle_count;
    double (*position)[3];        /* [point_count] */
    double (*normal)[3];          /* [point_count] outward, unit length; or NULL */
    uint32_t (*triangle)[3];      /* [triangle_count] points, counter-clockwise seen from outside */
    uint32_t (*edge)[2];          /* [edge_count] points, the smaller first; NULL until mesh_connect() */
    uint32_t (*triangle_edge)[3]; /* [triangle_count] edge k joins corners k and k + 1; NULL until then */
};

/* Refuses (STATUS_RANGE) more than 2^32 - 2 points or triangles. */
enum status mesh_check_size(size_t point_count, size_t triangle_count, struct error *err);

/* Allocates room for that many points and triangles, with normals or without; counts are set, values are
 * not. *mesh is overwritten, not cleared, and on failure it is as it was. Errors: STATUS_NO_MEMORY,
 * STATUS_RANGE past 2^32 - 2 of either. */
enum status mesh_init(struct mesh *mesh, size_t point_count, size_t triangle_count, bool normals,
                      struct error *err);
void mesh_clear(struct mesh *mesh);

/* A mesh from a soup: corner[3 t .. 3 t + 2] are the corners of triangle t. Corners at exactly the same
 * place (-0 and 0 are the same) become one point; points are numbered as they first appear. *mesh, which
 * must be {0} or a mesh, is replaced; on failure it is as it was. O(n). Errors: STATUS_NO_MEMORY,
 * STATUS_RANGE past 2^32 - 2 points. */
enum status mesh_from_soup(const double (*corner)[3], size_t triangle_count, struct mesh *mesh,
                           struct error *err);

/* Finds the unique edges and each triangle's three: edges are numbered as they first appear in the
 * triangles' order, which keeps them near their points in memory. The paper's "uniquely sorted into data
 * structures for points, edges, and triangles" (3.5). Winding and order of the triangles stay. O(n),
 * whatever the mesh. Errors: STATUS_NO_MEMORY, STATUS_INPUT for a corner that is no point, STATUS_RANGE
 * past 2^32 / 3 triangles. */
enum status mesh_connect(struct mesh *mesh, struct error *err);

/* Gives the edges up, as before mesh_connect(). */
void mesh_disconnect(struct mesh *mesh);

/* Renumbers the points of a connected mesh by a walk in breadth, and the triangles by their lowest point, so
 * that what is near in space is near in memory: a step over a large mesh in random order takes several times
 * as long. Corners keep their order; the mesh is connected anew. O(n). Errors: STATUS_NO_MEMORY; the mesh is
 * then as it was, or has no edges. */
enum status mesh_order(struct mesh *mesh, struct error *err);

/* What is unusual about a mesh, and what mesh_repair() did about it. */
struct mesh_report {
    size_t welded_points;       /* merged with another point at the same place */
    size_t unused_points;       /* belong to no triangle that was kept; dropped */
    size_t flat_triangles;      /* had a corner twice after welding, or an area that is exactly zero as
                                   computed (the cross product of two sides is 0); dropped */
    size_t repeated_triangles;  /* had the same three points as an earlier one, either way round; dropped */
    size_t boundary_edges;      /* edges with one triangle only: the mesh is open there */
    size_t overfull_edges;      /* edges with more than two triangles: not a surface */
    size_t inconsistent_edges;  /* edges that both triangles run along in the same sense */
    uint32_t first_overfull[2]; /* the points of the first such edge, by their number after repair; both
                                   MESH_NONE where there is none */
    uint32_t first_inconsistent[2];
    uint32_t first_boundary[2];
    size_t pinched_points; /* points whose triangles form more than one fan */
    size_t components;     /* connected through shared edges */
    double volume;         /* signed: negative for an inside-out closed mesh */
};

/* Welds equal points, drops unused points and flat or repeated triangles, then measures the rest and
 * connects it. Points and triangles keep their order; of welded points the first one's normal stays.
 * Refuses (STATUS_INPUT) positions that are not finite or beyond MESH_COORDINATE_MAX and indices out of
 * range, naming the element, and a mesh without triangles or with flat ones only. Whether to refuse open,
 * overfull or inconsistent meshes is the caller's business. After STATUS_NO_MEMORY the mesh may be
 * repaired in part. */
enum status mesh_repair(struct mesh *mesh, struct mesh_report *report, struct error *err);

/* One line on what was repaired ("3 repeated points welded, 1 flat triangle dropped") into text, for a note
 * to the user; empty when nothing was. Returns text. */
const char *mesh_report_repairs(const struct mesh_report *report, char *text, size_t size);

/* Reads .ply (ASCII, both binary byte orders), .stl (ASCII and binary) or .obj, by extension; polygons are
 * cut into fans. Many other formats (.gltf, .dae, .fbx, .3ds, .off, ...) are read through assimp, where that
 * library is installed (else STATUS_RESOURCE): all of the model's meshes where its scene puts them, without
 * animation; about such files nothing is promised that the library does not. *mesh, which must be {0} or a
 * mesh, is replaced; after a failure it is as it was. Claimed counts are checked against the file's size
 * before memory is asked for. Loaded positions are finite and indices in range; there is at least one
 * triangle. Normals come from PLY only, of unit length, and only where every point has one. Errors, which
 * name the file and its line or element: STATUS_FILE, STATUS_INPUT, STATUS_NO_MEMORY, STATUS_RANGE. */
enum status mesh_load(const char *path, struct mesh *mesh, struct error *err);

/* True when the name ends as those files do, upper or lower case. */
bool mesh_is_file_name(const char *path);

/* True when mesh_load() takes the file for a mesh: also by the extensions of formats that are left to assimp,
 * whether it is there or not. */
bool mesh_is_readable_name(const char *path);

/* Writes .ply (binary little endian, positions to the bit; with normals where the mesh has them), .stl
 * (binary, positions rounded to float, no normals of points) or .obj (all digits), by extension. Errors:
 * STATUS_USAGE for another extension, STATUS_RANGE where STL's floats cannot hold a position, STATUS_FILE,
 * STATUS_NO_MEMORY. */
enum status mesh_save(const struct mesh *mesh, const char *path, struct error *err);

/* A number of each point that goes into its file beside the place: float, or whole
 * where there are no numbers. */
struct mesh_value {
    const char *name;
    const float *number;  /* [point_count] or NULL, and */
    const int32_t *whole; /* [point_count] */
};
enum { MESH_VALUES_MAX = 8 };

/* Writes a .ply as mesh_save() does, with up to MESH_VALUES_MAX further properties of its points (mesh_load()
 * passes them over), or, by the extension .vtp, the XML PolyData of VTK (its file formats, "VTK User's
 * Guide", 11th edition, chapter 19): VTK's and ParaView's readers know no properties of .ply but their own.
 * Errors: STATUS_USAGE for another extension, STATUS_FILE. */
enum status mesh_save_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                             const char *path, struct error *err);

/* Volume enclosed by the triangles (signed, from the divergence theorem) and their whole area. An open
 * mesh is taken as closed by cones from its boundaries to the mean of its points. */
double mesh_volume(const struct mesh *mesh);
double mesh_area(const struct mesh *mesh);

#endif
