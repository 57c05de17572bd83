#include "common/triple_set.h"

#include "common/array.h"
#include "common/random.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_SLOTS = 1024 };

/* Neighbours in space, whose bits differ little, are spread over the whole table. */
static uint64_t hash_of(const double triple[3])
{
    uint64_t hash = 0;
    for (int i = 0; i < 3; i++) {
        uint64_t bits;
        memcpy(&bits, &triple[i], sizeof bits);
        hash = random_mix((hash + RANDOM_STEP) ^ bits);
    }
    return hash;
}

/* The slot that holds the triple, or the free one where it belongs. */
static uint32_t *find_slot(const struct triple_set *set, const double triple[3])
{
    size_t mask = set->slot_count - 1, at = hash_of(triple) & mask;
    while (set->slot[at] != TRIPLE_NONE && memcmp(set->items[set->slot[at]], triple, sizeof *set->items) != 0)
        at = (at + 1) & mask;
    return &set->slot[at];
}

static bool grow_slots(struct triple_set *set)
{
    size_t slot_count = set->slot_count ? 2 * set->slot_count : FIRST_SLOTS;
    uint32_t *slot = array_new(slot_count, sizeof *slot);
    if (!slot)
        return false;
    memset(slot, 0xff, slot_count * sizeof *slot);
    free(set->slot);
    set->slot = slot;
    set->slot_count = slot_count;
    for (size_t i = 0; i < set->count; i++)
        *find_slot(set, set->items[i]) = (uint32_t)i;
    return true;
}

uint32_t triple_set_add(struct triple_set *set, const double triple[3])
{
    /* + 0.0 turns -0 into 0, so that equal numbers have equal bits */
    const double key[3] = {triple[0] + 0.0, triple[1] + 0.0, triple[2] + 0.0};
    if (set->count >= set->slot_count / 2 && !grow_slots(set))
        return TRIPLE_NONE;
    uint32_t *slot = find_slot(set, key);
    if (*slot != TRIPLE_NONE)
        return *slot;
    if (set->count >= TRIPLE_NONE - 1 || !ARRAY_RESERVE(set, 1))
        return TRIPLE_NONE;
    memcpy(set->items[set->count], key, sizeof key);
    *slot = (uint32_t)set->count;
    return (uint32_t)set->count++;
}

void triple_set_clear(struct triple_set *set)
{
    free(set->items);
    free(set->slot);
    *set = (struct triple_set){0};
}
