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

struct mesh {
    uint32_t point_count, edge_count, triangle_count;
    double (*position)[3];        /* [point_count] */
    double (*normal)[3];          /* [point_count] outward, unit length; or NULL */
    uint32_t (*triangle)[3];      /* [triangle_count] points, counter-clockwise seen from outside */
    uint32_t (*edge)[2];          /* [edge_count] points, the smaller first; NULL until mesh_connect() */
    uint32_t (*triangle_edge)[3]; /* [triangle_count] edge k joins corners k and k + 1; NULL until then */
};

/* Allocates room for that many points and triangles, with normals or without; counts are set, values are
 * not. */
enum status mesh_init(struct mesh *mesh, size_t point_count, size_t triangle_count, bool normals,
                      struct error *err);
void mesh_clear(struct mesh *mesh);

/* A mesh from a soup: corner[3 t .. 3 t + 2] are the corners of triangle t. Corners at exactly the same place
 * (-0 and 0 are the same) become one point; points are numbered as they first appear. O(n). Errors:
 * STATUS_NO_MEMORY, STATUS_RANGE past 2^32 - 2 points. */
enum status mesh_from_soup(const double (*corner)[3], size_t triangle_count, struct mesh *mesh,
                           struct error *err);

/* Finds the unique edges and each triangle's three: edges are numbered as they first appear in the triangles'
 * order, which keeps them near their points in memory. The paper's "uniquely sorted into data structures for
 * points, edges, and triangles" (3.5). O(n). */
enum status mesh_connect(struct mesh *mesh, struct error *err);

/* What is unusual about a mesh, and what mesh_repair() did about it. */
struct mesh_report {
    size_t welded_points;       /* merged with another point at the same place */
    size_t unused_points;       /* belonged to no triangle; dropped */
    size_t flat_triangles;      /* had a corner twice, or no area; dropped */
    size_t repeated_triangles;  /* had the same three points as an earlier one; dropped */
    size_t boundary_edges;      /* edges with one triangle only: the mesh is open there */
    size_t overfull_edges;      /* edges with more than two triangles: not a surface */
    size_t inconsistent_edges;  /* edges that both triangles run along in the same sense */
    uint32_t first_overfull[2]; /* the points of the first such edge, by their number after repair */
    uint32_t first_inconsistent[2];
    uint32_t first_boundary[2];
    size_t pinched_points; /* points whose triangles form more than one fan */
    size_t components;     /* connected through shared edges */
    double volume;         /* signed: negative for an inside-out closed mesh */
};

/* Welds equal points, drops unused points and flat or repeated triangles, then measures the rest and connects
 * it. Refuses (STATUS_INPUT) positions that are not finite, indices out of range and a mesh without
 * triangles, naming the element. Whether to refuse open, overfull or inconsistent meshes is the caller's
 * business. */
enum status mesh_repair(struct mesh *mesh, struct mesh_report *report, struct error *err);

/* One line on what was repaired ("3 repeated points welded, 1 flat triangle dropped") into text, for a note
 * to the user; empty when nothing was. Returns text. */
const char *mesh_report_repairs(const struct mesh_report *report, char *text, size_t size);

/* Reads .ply (ASCII, both binary byte orders), .stl (ASCII and binary) or .obj, by extension; polygons are
 * cut into fans. *mesh is as it was after a failure. Claimed counts are checked against the file's size
 * before memory is asked for. Errors name the file and its line or element. */
enum status mesh_load(const char *path, struct mesh *mesh, struct error *err);

/* Writes .ply (binary little endian; with normals where the mesh has them), .stl (binary) or .obj, by
 * extension. */
enum status mesh_save(const struct mesh *mesh, const char *path, struct error *err);

/* Volume enclosed by the triangles (signed, from the divergence theorem) and their whole area. */
double mesh_volume(const struct mesh *mesh);
double mesh_area(const struct mesh *mesh);

#endif
