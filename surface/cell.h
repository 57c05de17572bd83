/*
 * One cell of marching cubes: how the surface leaves it through its edges, as closed loops, and how a loop
 * becomes triangles. All of it is derived from the numbering below, none is tabulated by hand.
 *
 * Corner c is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + u + 2 v runs along axis a and lies at u, v on
 * the next two axes, (a + 1) % 3 and (a + 2) % 3. Face 2 a + s is the lower (s = 0) or upper (s = 1) one
 * across axis a.
 *
 * Why the mesh closes. On each face of the grid the crossed edges are joined by arcs by a rule that both
 * its cells share: walking round the face counter-clockwise as the cell sees it from outside, an arc runs
 * from an edge where the walk enters the object to an edge where it leaves it. The neighbour walks the
 * other way round, so it runs along the same arcs in the opposite sense. Each crossed edge of a cell begins
 * one arc and ends one: arcs link into loops, and the loops of neighbours fit together along each arc once
 * in each sense. With four crossings on a face the value in its middle decides which corners belong
 * together.
 *
 * Why no edge is used more than twice. Two loops of the same cell have no vertex in common, and two cells
 * can only both join two vertices if they share the face on which both lie. So no triangle may have a side
 * within a face other than an arc. A few of the longest loops (of 8, 9 and 12 arcs, all with faces of four
 * crossings) leave no such choice: these get a vertex of their own in the middle.
 */
#ifndef SURFACE_CELL_H
#define SURFACE_CELL_H

#include <stdbool.h>
#include <stdint.h>

enum { CELL_EDGES = 12, CELL_FACES = 6, CELL_LOOPS = 4 };

struct cell_loops {
    uint8_t count;
    uint8_t length[CELL_LOOPS];
    uint8_t edge[CELL_LOOPS][CELL_EDGES];
};

/* Corners and edges of each face in counter-clockwise order from outside the cell: edge[f][i] runs from
 * corner i to corner i + 1. */
struct cell_table {
    uint8_t corner[CELL_FACES][4];
    uint8_t edge[CELL_FACES][4];
    uint8_t faces[CELL_EDGES];    /* bit f: the edge borders on face f */
    uint8_t ends[CELL_EDGES][2];  /* its corners, the lower first */
    uint8_t crossed[256];         /* by mask of inside corners: bit f, the surface passes through face f */
    uint8_t ambiguous[256];       /* bit f: all four edges of face f are crossed */
    struct cell_loops loops[256]; /* where no ambiguous face is joined */
    uint8_t triangles[256];       /* how many those make */
};

void cell_table_make(struct cell_table *table);

/* The loops of a cell with these corners inside (bit c), counter-clockwise seen from outside the object.
 * `joined`: bit f says that the inside corners of the ambiguous face f belong together. */
void cell_find_loops(const struct cell_table *table, unsigned inside, unsigned joined,
                     struct cell_loops *loops);

/* Triangulates a loop of `length` edges whose vertices are at `place`, such that the smallest angle is as
 * large as possible. Triangles are triples of positions in the loop. Returns their number, length - 2, or 0
 * when the loop needs a vertex in its middle (see above). */
int cell_triangulate(const struct cell_table *table, const uint8_t *edges, int length,
                     const double place[][3], uint8_t triangles[][3]);

/* Whether cell_triangulate() would return 0. */
bool cell_needs_middle(const struct cell_table *table, const uint8_t *edges, int length);

#endif
