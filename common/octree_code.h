/* The cells of an octree as bytes: what the chunk TREE of an .oct file holds. Only octree_io.c and tests
 * include this. */
#ifndef COMMON_OCTREE_CODE_H
#define COMMON_OCTREE_CODE_H

#include "common/octree.h"

/* A growable array of bytes (see common/array.h). */
struct octree_code {
    unsigned char *items;
    size_t count, capacity;
};

/*
 * Appends the cells of tree to code:
 *
 *     1 byte       number of materials in use, less one
 *     1 byte each  those materials, ascending (0, empty, is one of them)
 *     bits         the nodes in preorder, children in Morton order; the first bit is the lowest of its byte
 *
 * A node above the finest level begins with a bit, 1 if it is split. A leaf is followed by the place of its
 * material among those in use, lowest bit first, in as few bits as the number of materials needs: none for
 * one, 1 for two, 2 for up to four. Zero bits fill the last byte. Equal cells give equal bytes.
 */
enum status octree_encode(const struct octree *tree, struct octree_code *code, struct error *err);

/* Sets the cells of tree, whose depth is known and which holds no blocks, from all of these bytes. Refuses
 * (STATUS_INPUT) whatever octree_encode() would not write: too few bytes or too many, materials twice or
 * unused, eight equal leaves. The tree stays in need of octree_clear(). */
enum status octree_decode(const unsigned char *bytes, size_t size, struct octree *tree, struct error *err);

#endif
