/* Which pairs may touch, by what is known of their lines, for contact_kernels.c: eight at a time. */
#ifndef SIM_CONTACT_SIFT_H
#define SIM_CONTACT_SIFT_H

#include "sim/contact_kernels.h"
#include "sim/lanes8.h"

/* Eight pairs. */
struct sift_eight {
    lanes8_mask point[4], edges;
    lanes8 distance, approach;
};

static inline struct sift_eight sift_turn(const lanes8 pairs[8])
{
    lanes8 turned[8];
    lanes8_turn(pairs, turned);
    struct sift_eight e = {
        .edges = (lanes8_mask)turned[4] == CCD_EDGES, .distance = turned[5], .approach = turned[6]};
    for (int k = 0; k < 4; k++)
        e.point[k] = (lanes8_mask)turned[k];
    return e;
}

/* How much further the points of each pair would have to be off before it could touch; 0 and less: it may. */
static inline lanes8 sift_spare(const struct contact_sieve *s, const struct sift_eight *e)
{
    lanes8 off[4];
    for (int k = 0; k < 4; k++)
        off[k] = lanes8_pick(s->off, e->point[k]);
    const lanes8 gone = lanes8_select(e->approach > 0, lanes8_all(s->gone[1]), lanes8_all(s->gone[0])),
                 apart = e->distance - gone * e->approach, high = lanes8_max(off[2], off[3]),
                 first = lanes8_max(off[0], (lanes8)((lanes8_mask)off[1] & e->edges)),
                 second = lanes8_max(high, (lanes8)((lanes8_mask)off[1] & ~e->edges));
    return s->growth * apart - s->gap - first - second;
}

static uint32_t sift(const struct contact_sieve *sieve, const struct contact_pair *pairs,
                     const uint32_t *which, uint32_t count, uint32_t *near)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i += 8) {
        const unsigned all = count - i < 8 ? (1U << (count - i)) - 1 : 0xff;
        lanes8 rows[8];
        for (uint32_t k = 0; k < 8; k++)
            rows[k] = *(const lanes8 *)&pairs[which ? which[i + k] : i + k];
        const struct sift_eight e = sift_turn(rows);
        for (unsigned touch = all & lanes8_bits(sift_spare(sieve, &e) <= 0); touch; touch &= touch - 1) {
            const uint32_t k = i + (uint32_t)__builtin_ctz(touch);
            near[found++] = which ? which[k] : k;
        }
    }
    return found;
}

#endif
