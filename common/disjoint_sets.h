/*
 * Disjoint sets of numbers, as a forest: parent[i] is a lower number of i's set, or i where i is the lowest,
 * which stands for the set. At the start parent[i] = i for each i. Ways are halved as they are gone (Tarjan
 * and van Leeuwen, "Worst-case analysis of set union algorithms", Journal of the ACM, 1984).
 */
#ifndef COMMON_DISJOINT_SETS_H
#define COMMON_DISJOINT_SETS_H

#include <stdbool.h>
#include <stdint.h>

/* The lowest number of i's set. */
static inline uint32_t sets_find(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Makes the sets of a and b one. False where they were before. */
static inline bool sets_unite(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = sets_find(parent, a);
    b = sets_find(parent, b);
    parent[a < b ? b : a] = a < b ? a : b;
    return a != b;
}

#endif
