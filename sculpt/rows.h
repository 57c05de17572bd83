/* Inside the sculptor: the full cells of a small cube, a bit a cell, so that a row is looked at at once. */
#ifndef SCULPT_ROWS_H
#define SCULPT_ROWS_H

#include "common/octree.h"

/* Sets the bits of a leaf's cells: bit x of row[z side + y] is the cell first + (x, y, z). The leaf meets the
 * cube; side is at most 63. */
static inline void rows_mark(uint64_t *row, int side, const int first[3], const struct octree_leaf *leaf)
{
    const int start[3] = {leaf->x, leaf->y, leaf->z};
    int low[3], end[3];
    for (int k = 0; k < 3; k++) {
        low[k] = start[k] - first[k];
        end[k] = low[k] + leaf->side < side ? low[k] + leaf->side : side;
        low[k] = low[k] > 0 ? low[k] : 0;
    }
    const uint64_t bits = (UINT64_C(1) << end[0]) - (UINT64_C(1) << low[0]);
    for (int z = low[2]; z < end[2]; z++)
        for (int y = low[1]; y < end[1]; y++)
            row[z * side + y] |= bits;
}

#endif
