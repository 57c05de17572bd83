#include "sim/contact_links.h"

#include <string.h>

/* By counting: the links of p end where those of p + 1 begin. */
static void make_index(struct contact *c, uint32_t points)
{
    memset(c->link_end, 0, points * sizeof *c->link_end);
    for (uint32_t i = 0; i < c->pair_count; i++)
        for (uint32_t k = 0; k < 4; k++)
            c->link_end[c->pairs[i].point[k]]++;
    uint32_t end = 0;
    for (uint32_t p = 0; p < points; p++) {
        const uint32_t count = c->link_end[p];
        c->link_end[p] = end; /* where they begin, until they are entered */
        end += count;
    }
    for (uint32_t i = 0; i < c->pair_count; i++)
        for (uint32_t k = 0; k < 4; k++)
            c->link[c->link_end[c->pairs[i].point[k]]++] = 4 * i + k;
    memset(c->chain, 0xff, points * sizeof *c->chain);
    c->indexed = c->linked = c->pair_count;
}

void contact_links_make(struct sim *sim)
{
    struct contact *c = sim->contact;
    if (c->indexed == 0)
        make_index(c, sim->point_count);
    for (; c->linked < c->pair_count; c->linked++)
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t *first = &c->chain[c->pairs[c->linked].point[k]];
            c->link[4 * c->linked + k] = *first;
            *first = 4 * c->linked + k;
        }
}
