/*
 * The faces of the cubes, brick by brick: what a window draws, and draws anew only where a chip fell.
 *
 *     struct brick_faces faces = {0};
 *     if (brick_find_faces(&tree, brick, &faces, err)) ...     for each brick of bricks_of_region()
 *     free(faces.items);
 *
 * A brick is a cube of BRICK_SIDE cells; brick (x, y, z) begins at cell BRICK_SIDE * (x, y, z).
 */
#ifndef SCULPT_BRICKS_H
#define SCULPT_BRICKS_H

#include "common/octree_tape.h"

#include <stdint.h>

enum { BRICK_SIDE = 32 };

/* A rectangle of exposed cell faces of one material. */
struct brick_face {
    uint16_t corner[3]; /* the first cell's lower corner, on the face's plane, in cells */
    uint8_t size[2];    /* in cells: along y, z for sides of x; along z, x for y; along x, y for z */
    uint8_t side;       /* where it looks: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z */
    uint8_t material;   /* behind it */
};

struct brick_faces {
    struct brick_face *items;
    size_t count, capacity;
};

/* How many bricks there are along each axis. */
int bricks_along(const struct octree *tree);

/* Replaces *faces by the brick's. Errors: STATUS_NO_MEMORY. */
enum status brick_find_faces(const struct octree *tree, const int brick[3], struct brick_faces *faces,
                             struct error *err);

/* The bricks whose faces may have changed when the cells of a region did: first .. last, both included. */
void bricks_of_region(const struct octree *tree, const struct octree_region *region, int first[3],
                      int last[3]);

#endif
