/* Which pairs may touch, by what is known of their lines, for contact_kernels.c: eight at a time, without
 * branches, since nobody can guess. */
#ifndef SIM_CONTACT_SIFT_H
#define SIM_CONTACT_SIFT_H

#include "sim/contact_kernels.h"
#include "sim/lanes8.h"

#include <string.h>

/* How much further the points of each pair would have to be off before it could touch; 0 and less: it may. */
static inline lanes8 sift_spare(const struct contact_sieve *s, const lanes8 pairs[8])
{
    lanes8 turned[8], off[4];
    lanes8_turn(pairs, turned);
    for (int k = 0; k < 4; k++)
        off[k] = lanes8_pick(s->off, (lanes8_mask)turned[k]);
    const lanes8_mask edges = (lanes8_mask)turned[4] == CCD_EDGES;
    const lanes8 distance = turned[5], approach = turned[6],
                 gone = lanes8_select(approach > 0, lanes8_all(s->gone[1]), lanes8_all(s->gone[0])),
                 apart = distance - gone * approach, high = lanes8_max(off[2], off[3]),
                 first = lanes8_max(off[0], (lanes8)((lanes8_mask)off[1] & edges)),
                 second = lanes8_max(high, (lanes8)((lanes8_mask)off[1] & ~edges));
    return s->growth * apart - s->gap - first - second;
}

/* As bytes of 0 and 1. Most are so already: what is not written stays in the caches of all who read it. */
static inline void sift_note(lanes8_mask true_ones, unsigned char *bytes)
{
    typedef unsigned char eight_bytes __attribute__((vector_size(8)));
    const eight_bytes now = (eight_bytes) __builtin_convertvector(true_ones & 1, eight_bytes);
    if (memcmp(bytes, &now, sizeof now) != 0)
        memcpy(bytes, &now, sizeof now);
}

static uint32_t sift(const struct contact_sieve *sieve, const struct contact_pair *pairs,
                     const uint32_t *which, uint32_t count, unsigned char *awake, uint32_t *near)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i += 8) {
        lanes8 rows[8];
        for (uint32_t k = 0; k < 8; k++)
            rows[k] = *(const lanes8 *)&pairs[which ? which[i + k] : i + k];
        const lanes8 spare = sift_spare(sieve, rows);
        if (!which)
            sift_note(spare <= sieve->more, &awake[i]);
        unsigned bits = lanes8_bits(spare <= 0);
        if (count - i < 8)
            bits &= (1U << (count - i)) - 1;
        for (; bits; bits &= bits - 1) {
            const uint32_t k = i + (uint32_t)__builtin_ctz(bits);
            near[found++] = which ? which[k] : k;
        }
    }
    return found;
}

#endif
