/* Sculptures with larger cells, to be looked at from afar. */
#ifndef SCULPT_COARSE_H
#define SCULPT_COARSE_H

#include "common/octree.h"

/* Makes *coarse (valid; it is replaced, or as it was after a failure) the sculpture in 2^depth cells a
 * side, or a copy where it has no more: a cell is full when half of it or more is, and of material 1.
 * Errors: STATUS_NO_MEMORY. */
enum status sculpt_coarsen(const struct octree *tree, unsigned depth, struct octree *coarse,
                           struct error *err);

#endif
