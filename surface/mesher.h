/*
 * The surface while it is being found: shared by the files of this module, not for others.
 *
 *     struct mesher m;
 *     if (mesher_init(&m, &field, threshold, cube, pool, err)) ...
 *     seeds_random(&m, seed); seeds_descent(&m);     find and follow all parts of it
 *     if (mesher_failed(&m)) ...                       memory ran out somewhere
 *     if (mesher_assemble(&m, mesh, err)) ...
 *     mesher_clear(&m);
 *
 * A brick of 8 x 8 x 8 cells is sampled at once, with the corners it shares with its upper neighbours, so
 * it needs nobody else's values; the vertices on the edges that it owns (those that begin in its 8 x 8 x 8
 * lowest corners) are found then too, and only signs and vertices are kept. A vertex's number is its
 * brick's first plus its rank among the crossed edges, so there is no table of vertices to search.
 *
 * Workers sample bricks each for itself and triangulate them each for itself; what lies between, numbering
 * them, is little. Since a brick's contents are a function of its place, and bricks are put in order before
 * they are numbered, who made which does not show.
 */
#ifndef SURFACE_MESHER_H
#define SURFACE_MESHER_H

#include "common/mesh.h"
#include "common/threads.h"
#include "surface/block.h"
#include "surface/cell.h"
#include "surface/probe.h"
#include "surface/sides.h"

struct vertex {
    double position[3]; /* in units of the first cube */
    double normal[3];
};

struct brick {
    int at[3];                                      /* in bricks */
    uint64_t code;                                  /* Morton code */
    uint16_t inside[BRICK_CORNERS * BRICK_CORNERS]; /* [9 z + y], bit x: f >= T at that corner */
    uint64_t crossed[3][BRICK];                     /* [axis][z], bit 8 y + x: the edge from that corner */
    uint16_t rank[BRICK][3];  /* crossed edges of this brick before those of [z][axis] */
    uint64_t followed[BRICK]; /* [z], bit 8 y + x: that cell was reached */
    bool queued;              /* on the mesher's stack */
    struct vertex *vertices;  /* [vertex_count] in some worker's chunks, until they are in the mesh */
    uint32_t vertex_count, triangle_count;
    uint32_t middle_count; /* vertices in the middle of cells, for loops that need one */
    size_t vertex_first, triangle_first, middle_first; /* in the mesh */
};

struct bricks {
    struct brick *items;
    size_t count, capacity;
};

/* Vertices in the order in which a worker found them; those of a brick lie together. */
struct vertex_chunk {
    struct vertex_chunk *next;
    size_t count;
    struct vertex items[];
};

/* A corner of a brick that is being sampled, moved off the surface (see vertex.c). */
struct moved_corner {
    bool known, moved;
    double place[3], excess;
};

/* What a thread needs for itself. */
struct worker {
    struct probe probe;
    struct block block;
    struct moved_corner corner[BLOCK_VALUES];
    struct bricks bricks; /* found by it, until they are put together */
    struct vertex_chunk *chunks;
    size_t bytes; /* in chunks */
    bool failed;  /* memory ran out */
    uint64_t samples, evaluations;
    double worst_residual;
    bool in_block; /* all points asked for lie in the block: no need for a probe's own windows */
};

struct mesher {
    const struct field *field; /* borrowed */
    double threshold;
    struct sides sides;
    struct grid grid;
    struct cell_table cells;
    struct threads *pool;   /* borrowed */
    struct worker **worker; /* [threads_workers(pool)] */
    bool count_only;        /* vertices are counted, not found: for choosing a cube size */
    bool failed;            /* memory ran out; see mesher_failed() */
    struct bricks bricks;
    uint32_t *slots; /* [slot_count] open addressing by Morton code: brick + 1, or 0 */
    size_t slot_count;
    struct {
        uint32_t *items;
        size_t count, capacity;
    } stack; /* bricks with cells whose neighbours are still to be followed */
    size_t follows;
    size_t vertex_count, triangle_count, middle_count; /* of all bricks, once they are numbered */
    size_t bytes;                                      /* at the peak */
    void (*progress)(void *context, double done);
    void *progress_context;
};

enum status mesher_init(struct mesher *m, const struct field *field, double threshold, double cube,
                        struct threads *pool, struct error *err);
void mesher_clear(struct mesher *m);
bool mesher_failed(const struct mesher *m);

/* The brick at this place, sampled now by the first worker if it is new. MESH_NONE: the surface does not pass
 * through it (it is not kept), or memory ran out. */
uint32_t brick_get(struct mesher *m, const int at[3]);

/* The same, without sampling. */
uint32_t brick_find(const struct mesher *m, uint64_t code);
uint64_t brick_code(const struct grid *grid, const int at[3]);

/* Samples the brick at this place, which is new, into the worker's bricks. */
void brick_make(const struct mesher *m, struct worker *worker, const int at[3]);

/* Puts all bricks together, in Morton order, and numbers what is in them. */
void bricks_join(struct mesher *m);

/* Bit c: corner c of that cell of the brick is inside. */
static inline unsigned cell_inside(const struct brick *brick, int x, int y, int z)
{
    const uint16_t *row = &brick->inside[z * BRICK_CORNERS + y];
    return (row[0] >> x & 3u) | (row[1] >> x & 3u) << 2 | (row[BRICK_CORNERS] >> x & 3u) << 4 |
           (row[BRICK_CORNERS + 1] >> x & 3u) << 6;
}

/* Bit x: the surface passes through cell x of that row. */
static inline unsigned cells_crossed(const struct brick *brick, int y, int z)
{
    const uint16_t *row = &brick->inside[z * BRICK_CORNERS + y];
    unsigned any = row[0] | row[1] | row[BRICK_CORNERS] | row[BRICK_CORNERS + 1];
    unsigned all = row[0] & row[1] & row[BRICK_CORNERS] & row[BRICK_CORNERS + 1];
    return (any | any >> 1) & ~(all & all >> 1) & 0xff;
}

/* The loops of a cell through which the surface passes: the table's, or *own, worked out for a
 * cell with ambiguous faces, where the field in the middle of each decides. Both cells of a face
 * ask at the same place. */
const struct cell_loops *cell_loops_of(const struct mesher *m, struct worker *worker,
                                       const struct brick *brick, const int at[3], unsigned inside,
                                       struct cell_loops *own);

/* Finds the vertices of a brick that the worker's block has just sampled. */
void brick_find_vertices(const struct mesher *m, struct worker *worker, struct brick *brick);

/* The field at a point in cells, and its gradient. */
double worker_value(struct worker *worker, const double point[3], double gradient[3]);

/* The point where the field passes the threshold between two points, one inside (excess f - T >= 0), one
 * outside. In the octree's cells; gradient is the field's there. */
void find_crossing(const struct mesher *m, struct worker *worker, const double inside[3],
                   double inside_excess, const double outside[3], double outside_excess, double point[3],
                   double gradient[3]);

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

/* Makes points and triangles of the bricks and gives up their vertices. */
enum status mesher_assemble(struct mesher *m, struct mesh *mesh, struct error *err);

#endif
