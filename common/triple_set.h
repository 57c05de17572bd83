/*
 * An exact set of triples of numbers: points by their place, triangles by their corners. Each triple gets a
 * number, from 0, in the order of first appearance. 0 and -0 are the same and kept as 0; nothing else is
 * rounded. A hash table with open addressing: O(1) for each triple.
 */
#ifndef COMMON_TRIPLE_SET_H
#define COMMON_TRIPLE_SET_H

#include <stddef.h>
#include <stdint.h>

struct triple_set {
    double (*items)[3]; /* [count], by number */
    size_t count, capacity;
    uint32_t *slot;    /* [slot_count] numbers, TRIPLE_NONE where free */
    size_t slot_count; /* 0 or a power of two */
};

#define TRIPLE_NONE UINT32_MAX

/* The number of a triple, which is added where it is new. TRIPLE_NONE, with the set as it was, when there
 * is no memory or count is 2^32 - 2 already. */
uint32_t triple_set_add(struct triple_set *set, const double triple[3]);
void triple_set_clear(struct triple_set *set);

#endif
