/*
 * Which pairs a point is in.
 *
 *     contact_links_make(sim);                                       once there are pairs, and when more have come
 *     struct contact_links links = contact_links_of(c, point);
 *     for (uint32_t at; (at = contact_links_next(&links)) != UINT32_MAX;)
 *         c->pairs[at / 4] ...                                       whose point at % 4 it is
 *
 * The pairs of a new list come into an index, in which those of a point follow each other; what is found
 * later, little as a rule, into chains. Both are in c->link: the index in the places of the pairs that it
 * has, the next in each chain in the place of the one before.
 */
#ifndef SIM_CONTACT_LINKS_H
#define SIM_CONTACT_LINKS_H

#include "sim/contact.h"

struct contact_links {
    const uint32_t *link;
    uint32_t at, end, chain;
};

void contact_links_make(struct sim *sim);

static inline struct contact_links contact_links_of(const struct contact *c, uint32_t point)
{
    return (struct contact_links){c->link, point ? c->link_end[point - 1] : 0, c->link_end[point],
                                  c->chain[point]};
}

static inline uint32_t contact_links_next(struct contact_links *links)
{
    if (links->at < links->end)
        return links->link[links->at++];
    const uint32_t found = links->chain;
    links->chain = found == UINT32_MAX ? found : links->link[found];
    return found;
}

/* Whether no point of a pair before the place is flagged: so each pair of flagged points is taken once.
 * Without branches. */
static inline bool contact_is_first(const unsigned char *flag, const uint32_t p[4], uint32_t place)
{
    const int before = flag[p[0]] | flag[p[1]] << 1 | flag[p[2]] << 2;
    return (before & ((1 << place) - 1)) == 0;
}

#endif
