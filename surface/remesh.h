/*
 * A closed mesh whose edges can be collapsed, split and flipped: for relax.c.
 *
 *     struct remesh r;
 *     if (remesh_open(&r, &mesh, err)) ...             takes the mesh's arrays over
 *     if (remesh_collapse_allowed(&r, side)) remesh_collapse(&r, side, place, normal);
 *     if (remesh_close(&r, &mesh, err)) ...            and gives them back without what is dead
 *     remesh_clear(&r);
 *
 * Side 3 t + k of triangle t runs from its corner k to the next, and across[t][k] is the same edge's side in
 * the neighbour, which runs the other way. No operation changes a component's Euler characteristic or makes
 * an edge of three triangles: collapsing asks for the link condition (Dey, Edelsbrunner, Guha, Nekhayev,
 * "Topology preserving edge contraction", 1999), and no point ever has fewer than three neighbours.
 */
#ifndef SURFACE_REMESH_H
#define SURFACE_REMESH_H

#include "common/mesh.h"

/* Operations that would begin at or lead to a point of more neighbours are refused. */
enum { RING_MAX = 32, DEGREE_MAX = 255 };

struct remesh {
    /* With the dead ones, whose corner[p] or triangle[t][0] is MESH_NONE. */
    uint32_t point_count, triangle_count;
    uint32_t point_room, triangle_room;
    uint32_t points_alive, triangles_alive;
    uint32_t first_new;    /* points from here on were made by splitting */
    double (*position)[3]; /* [point_room] */
    double (*normal)[3];   /* [point_room] outward, unit length */
    uint8_t *degree;       /* [point_room] triangles round the point; DEGREE_MAX: or more */
    uint32_t *corner;      /* [point_room] 3 t + k, some corner at the point */
    uint32_t *beside; /* [point_room - first_new] the point that a new one was made beside; NULL: no room */
    uint32_t (*triangle)[3], (*across)[3]; /* [triangle_room] */
};

/* The mesh must be closed and oriented with one ring of triangles at each point, and have normals; it is left
 * empty. Errors: STATUS_NO_MEMORY, STATUS_INPUT where the mesh is not closed; the mesh is then as it was. */
enum status remesh_open(struct remesh *r, struct mesh *mesh, struct error *err);

/* Moves the result into *mesh, which must be empty: in the order in which the points were, new ones next to
 * those they were made beside, and triangles by their first point. Errors: STATUS_NO_MEMORY. */
enum status remesh_close(struct remesh *r, struct mesh *mesh, struct error *err);
void remesh_clear(struct remesh *r);

static inline uint32_t side_next(uint32_t side)
{
    return side % 3 == 2 ? side - 2 : side + 1;
}

/* The tables are read as one row of sides, which saves dividing by 3. */
static inline uint32_t side_point(const struct remesh *r, uint32_t side)
{
    const void *points = r->triangle;
    return ((const uint32_t *)points)[side];
}

static inline uint32_t side_across(const struct remesh *r, uint32_t side)
{
    const void *sides = r->across;
    return ((const uint32_t *)sides)[side];
}

/* From a corner at a point to the one in the next triangle round it. */
static inline uint32_t corner_around(const struct remesh *r, uint32_t corner)
{
    return side_next(side_across(r, corner));
}

/* The corners round a point in their order; 0 where they are more than RING_MAX. */
int remesh_ring(const struct remesh *r, uint32_t point, uint32_t corners[RING_MAX]);

/* Merges the end of the side's edge into its beginning, which moves to `place`. */
bool remesh_collapse_allowed(const struct remesh *r, uint32_t side);
void remesh_collapse(struct remesh *r, uint32_t side, const double place[3], const double normal[3]);

/* Turns the edge of a side into the one that joins the two points across. */
bool remesh_flip_allowed(const struct remesh *r, uint32_t side);
void remesh_flip(struct remesh *r, uint32_t side);

/* Puts a point into the edge of a side. False when there is no memory, and then nothing changed. */
bool remesh_split(struct remesh *r, uint32_t side, const double place[3], const double normal[3]);

#endif
