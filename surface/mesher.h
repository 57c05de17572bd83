/*
 * The surface while it is being found: shared by the files of this module, not for others.
 *
 *     struct mesher m;
 *     if (mesher_init(&m, &field, threshold, cube, err)) ...
 *     seeds_random(&m, seed); seeds_descent(&m);     find and follow all parts of it
 *     if (m.failed) ...                                memory ran out somewhere
 *     if (mesher_assemble(&m, mesh, err)) ...
 *     mesher_clear(&m);
 *
 * A brick of 8 x 8 x 8 cells is sampled at once, with the corners it shares with its upper neighbours, so
 * it needs nobody else's values; the vertices on the edges that it owns (those that begin in its 8 x 8 x 8
 * lowest corners) are found then too, and only signs and vertices are kept. A vertex's number is its
 * brick's first plus its rank among the crossed edges, so there is no table of vertices to search.
 */
#ifndef SURFACE_MESHER_H
#define SURFACE_MESHER_H

#include "common/mesh.h"
#include "surface/cell.h"
#include "surface/grid.h"

struct brick {
    int at[3];                                      /* in bricks */
    uint64_t code;                                  /* Morton code */
    uint16_t inside[BRICK_CORNERS * BRICK_CORNERS]; /* [9 z + y], bit x: f >= T at that corner */
    uint64_t crossed[3][BRICK];                     /* [axis][z], bit 8 y + x: the edge from that corner */
    uint16_t rank[BRICK][3];  /* crossed edges of this brick before those of [z][axis] */
    uint64_t followed[BRICK]; /* [z], bit 8 y + x: that cell was reached */
    size_t vertex_first;      /* in mesher.vertices; after sorting, in the mesh */
    uint32_t vertex_count;
};

struct vertex {
    double position[3]; /* in units of the first cube */
    double normal[3];
};

/* A corner of a brick that is being sampled, moved off the surface (see vertex.c). */
struct moved_corner {
    bool known;
    double place[3], excess;
};

struct cell_at {
    uint32_t brick;
    uint16_t cell; /* 64 z + 8 y + x */
};

struct mesher {
    const struct field *field; /* borrowed */
    double threshold;
    struct grid grid;
    struct probe probe;
    struct cell_table cells;
    bool count_only; /* vertices are counted, not found: for choosing a cube size */
    bool failed;     /* memory ran out */
    struct {
        struct brick *items;
        size_t count, capacity;
    } bricks;
    uint32_t *slots; /* [slot_count] open addressing by Morton code: brick + 1, or 0 */
    size_t slot_count;
    struct {
        struct vertex *items;
        size_t count, capacity;
    } vertices;
    struct {
        struct cell_at *items;
        size_t count, capacity;
    } stack; /* cells whose neighbours are still to be followed */
    struct field_items scratch;
    double values[BRICK_CORNERS * BRICK_CORNERS * BRICK_CORNERS];
    struct moved_corner moved[BRICK_CORNERS * BRICK_CORNERS * BRICK_CORNERS];
    uint64_t samples;
    size_t follows, triangles; /* triangles: counted while count_only */
    double worst_residual;
    size_t vertices_expected; /* for progress */
    void (*progress)(void *context, double done);
    void *progress_context;
};

enum status mesher_init(struct mesher *m, const struct field *field, double threshold, double cube,
                        struct error *err);
void mesher_clear(struct mesher *m);

/* The brick at this place, sampled now if it is new. MESH_NONE: the surface does not pass through it (it is
 * not kept), or memory ran out. */
uint32_t brick_get(struct mesher *m, const int at[3]);

/* The same, without sampling. */
uint32_t brick_find(const struct mesher *m, uint64_t code);
uint64_t brick_code(const struct grid *grid, const int at[3]);

/* Puts the bricks into Morton order. */
void bricks_sort(struct mesher *m);

/* Bit c: corner c of that cell of the brick is inside. */
unsigned cell_inside(const struct brick *brick, int x, int y, int z);

/* Bit f: the field in the middle of ambiguous face f of that cell of the brick is inside. Both cells of a face
 * ask at the same place. */
unsigned faces_joined(struct mesher *m, const struct brick *brick, const int at[3], unsigned ambiguous);

/* Finds the vertices of a brick whose values are in m->values. */
void brick_find_vertices(struct mesher *m, struct brick *brick);

/* The point where the field passes the threshold between two points, one inside (excess f - T >= 0), one
 * outside. In the octree's cells; gradient is the field's there. */
void find_crossing(struct mesher *m, const double inside[3], double inside_excess, const double outside[3],
                   double outside_excess, double point[3], double gradient[3]);

/* Fills *vertex from a point in cells and the field's gradient there; `outwards` stands in for a gradient
 * of 0. */
void vertex_set(const struct mesher *m, const double point[3], const double gradient[3],
                const double outwards[3], struct vertex *vertex);

/* Follows the surface from this cell across crossed faces until all cells are done. */
void follow(struct mesher *m, uint32_t brick, int cell);

/* Follows from every cell that the surface passes through and that was not followed yet. */
void follow_brick(struct mesher *m, uint32_t brick);

void seeds_descent(struct mesher *m);
void seeds_random(struct mesher *m, uint64_t seed);

/* Sorts bricks into Morton order, numbers the vertices, makes the triangles. */
enum status mesher_assemble(struct mesher *m, struct mesh *mesh, struct error *err);

#endif
