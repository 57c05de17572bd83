/*
 * The way out of the smooth surface that a sculpture's cells approximate: what a face is lit
 * by as part of a whole.
 *
 *     struct brick_normals normals;
 *     brick_normals_begin(&normals, &tree, brick);
 *     brick_normal(&normals, cell, side, normal);           for exposed faces of cells of this brick
 */
#ifndef SCULPT_NORMALS_H
#define SCULPT_NORMALS_H

#include "sculpt/bricks.h"

enum { NORMALS_REACH = 3, NORMALS_ROWS = BRICK_SIDE + 2 * NORMALS_REACH };

/* The cells of a brick and as many around it as count: bit x of row [z][y] is cell first +
 * (x, y, z). About 12 KB. */
struct brick_normals {
    int first[3];
    uint64_t row[NORMALS_ROWS][NORMALS_ROWS];
};

void brick_normals_begin(struct brick_normals *normals, const struct octree *tree, const int brick[3]);

/* The normal at a face of a cell of the brick (side as in struct brick_face), its longest component 100: down
 * the gradient of the cells within NORMALS_REACH, weighted by a Gaussian, but never against the side. Where
 * that says nothing, in a wall as thin as a cell, it is the side's. */
void brick_normal(const struct brick_normals *normals, const int cell[3], int side, int8_t normal[3]);

#endif
