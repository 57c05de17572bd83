/*
 * The octree that holds a sculpture: the unit cube [0,1]^3, halved along every axis down to cells of side
 * 2^-depth. A node is a leaf of one material (0 is empty) or has eight children; eight equal leaves are
 * always merged, so two octrees hold the same sculpture exactly when their trees are equal.
 *
 * Nodes are 32-bit words, children lie eight together in one block, and there are no pointers: a copy is a
 * memcpy and a leaf costs 4 to 5 bytes.
 *
 *     struct octree tree = {0};
 *     if (octree_init(&tree, 6, 1, err)) ...                    a full cube of 64 cells a side
 *     if (octree_apply(&tree, sphere_covers, &s, 0, err)) ...   empty what the sphere covers
 *     octree_save(&tree, "shape.oct", err);
 *     octree_clear(&tree);
 *
 * Cells are numbered 0 .. 2^depth - 1 along x (right), y (up) and z (towards the viewer).
 */
#ifndef COMMON_OCTREE_H
#define COMMON_OCTREE_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    OCTREE_DEPTH_MAX = 10,     /* 1024 cells a side */
    OCTREE_MATERIALS = 256,    /* 0 is empty; 1 is what a new cube is made of */
    OCTREE_FORMAT_VERSION = 1, /* of .oct files */
};

/* Coefficients b_k are finite and not beyond this, either way. */
#define OCTREE_COEFFICIENT_MAX 1000.0

/* A node: below OCTREE_SPLIT the material of a leaf, else OCTREE_SPLIT + the number of its block of children.
 */
typedef uint32_t octree_node;
#define OCTREE_SPLIT 0x80000000u

struct octree_tape; /* see common/octree_tape.h */

struct octree {
    octree_node root;
    unsigned depth; /* 0 .. OCTREE_DEPTH_MAX */
    /* [8 * block_capacity]: child x + 2 y + 4 z of block b is blocks[8 b + x + 2 y + 4 z]. */
    octree_node *blocks;
    uint32_t block_count, block_capacity; /* blocks ever used, room */
    uint32_t free_block, free_count;      /* first of the freed blocks, linked by child 0; how many */
    float coefficient[OCTREE_MATERIALS];  /* b_k of the field of each material; 1 unless a sculpture says
                                            otherwise */
    struct octree_tape *tape;             /* where changes are recorded, or NULL; it is not the octree's */
};

/* A cube of one material. Errors: STATUS_RANGE for a depth above OCTREE_DEPTH_MAX. */
enum status octree_init(struct octree *tree, unsigned depth, unsigned material, struct error *err);
void octree_clear(struct octree *tree);
/* *to must be valid ({0} is); it is replaced, or left as it was when memory is not
 * enough. A copy has no tape. */
enum status octree_copy(struct octree *to, const struct octree *from, struct error *err);

/* Makes *cut (valid; {0} is) the octree in 2^depth cells a side, or a copy where it has no more: a cell is
 * full when any part of it is, of the material of the first such part. O(nodes of the result). Errors:
 * STATUS_NO_MEMORY; then *cut is empty. */
enum status octree_cut(const struct octree *tree, unsigned depth, struct octree *cut, struct error *err);

/* All leaves, empty ones too: each split turns one leaf into eight. */
static inline size_t octree_leaf_count(const struct octree *tree)
{
    return 1 + 7 * (size_t)(tree->block_count - tree->free_count);
}

/* True when depth, cells and the coefficients of the materials in use are the same. */
bool octree_equal(const struct octree *a, const struct octree *b);

/* The material of one cell; 0 outside the cube. */
unsigned octree_at(const struct octree *tree, int x, int y, int z);

/* How a shape covers eight cubes: bit i speaks of cube i. A cube with neither bit is crossed, or not known:
 * its eight parts are asked about in turn. */
struct octree_cover {
    unsigned inside, outside; /* wholly covered; not at all */
};

/* Says how a shape covers the eight cubes of this side that share the point corner + side; number x + 2 y + 4
 * z lies at corner + side (x, y, z), in units of the octree's cube. When `cells` is true they cannot be split
 * further, and only `inside` counts: whether a cell's centre belongs to the shape. */
typedef struct octree_cover octree_shape(const void *shape, const double corner[3], double side, bool cells);

/* Makes what the shape covers of this material (0 chips it away), splitting where the shape cuts a node and
 * merging where eight children agree. Returns STATUS_NO_MEMORY, then with the tree whole but the shape partly
 * applied, or STATUS_OK. */
enum status octree_apply(struct octree *tree, octree_shape *covers, const void *shape, unsigned material,
                         struct error *err);

/* Sets one cell; the cell must lie in the cube. */
enum status octree_set(struct octree *tree, int x, int y, int z, unsigned material, struct error *err);

/* Fills what is empty and cannot be reached from outside, going from cell to cell across faces; *cells
 * is how many cells that were. (Material 0 fills nothing: it only counts.) Errors: STATUS_NO_MEMORY,
 * with the tree as it was. */
enum status octree_fill_hollows(struct octree *tree, unsigned material, uint64_t *cells, struct error *err);

/* Where a ray meets the sculpture: the first cell on its way that is not empty, of the finest, and its
 * material; the axis that the face it enters by is square to (0 x, 1 y, 2 z), and the way out of the cell
 * along that axis (-1 or 1); the distance to that face in lengths of `direction`. Where the ray begins in
 * material, outward and distance are 0. */
struct octree_hit {
    int cell[3];
    int axis, outward;
    double distance;
    unsigned material;
};

/* The first cell that is not empty along the ray origin + t direction, t >= 0, in units of the octree's cube.
 * The ray goes from cell to cell through faces, so the face it enters by borders on an empty cell or on the
 * outside; where it meets an edge or a corner it crosses x first, then y, then z. A ray that begins on a
 * border begins in the cell that it goes into; one that runs along a border runs in the cells above. False
 * when there is no such cell, and for an origin or direction that is not finite and a direction without
 * length. O(depth) for each leaf on the way. */
bool octree_ray(const struct octree *tree, const double origin[3], const double direction[3],
                struct octree_hit *hit);

/* A leaf, as a visitor meets it: its first cell, its side in cells, its material. */
struct octree_leaf {
    int x, y, z, side;
    unsigned material;
};

/* Calls visit for each leaf that is not empty and meets the cells low .. high (both included, also beyond the
 * cube), in Morton order; visit returns false to end the walk. octree_visit_all visits all such leaves. */
typedef bool octree_visitor(void *context, const struct octree_leaf *leaf);
void octree_visit(const struct octree *tree, const int low[3], const int high[3], octree_visitor *visit,
                  void *context);
void octree_visit_all(const struct octree *tree, octree_visitor *visit, void *context);

/* A square where material borders on emptiness or on the outside of the cube, as large as the smaller of the
 * two leaves that meet there. Its first lattice corner (0 .. 2^depth along each axis, in cells), its side in
 * cells, the axis that it is square to (0 x, 1 y, 2 z), the way out along that axis (-1 or 1), the material
 * behind it. */
struct octree_face {
    int corner[3], side, axis, outward;
    unsigned material;
};

/* Calls visit for each exposed face, in an order that depends on the sculpture alone; visit returns false to
 * end the walk. O(nodes). */
typedef bool octree_face_visitor(void *context, const struct octree_face *face);
void octree_visit_faces(const struct octree *tree, octree_face_visitor *visit, void *context);

struct octree_info {
    size_t leaves, full_leaves, nodes; /* all leaves, those not empty, leaves and split nodes together */
    uint64_t cells;                    /* finest cells that are not empty */
    uint64_t exposed_faces; /* faces of those cells that border on an empty cell or on the outside */
    int low[3], high[3];    /* bounds of the cells that are not empty; high < low when there is none */
    int extent;             /* the longest side of those bounds, in cells; 0: there is none */
    int smallest_side;      /* side of the smallest leaf that is not empty, in cells; 0: there is none */
    size_t bytes;           /* of memory */
};
struct octree_info octree_measure(const struct octree *tree);

/* .oct files: see octree_io.c for the layout. *tree must be valid ({0} is): a load replaces it, or leaves it
 * as it was when it fails. Errors name the file and the chunk: STATUS_FILE, STATUS_INPUT (cut short, damaged,
 * foreign, a depth or count that lies, a newer version), STATUS_NO_MEMORY. Equal sculptures with equal
 * coefficients are saved as equal bytes. */
enum status octree_load(const char *path, struct octree *tree, struct error *err);
enum status octree_save(const struct octree *tree, const char *path, struct error *err);

#endif
