/* What finding pairs is made of: contact_pairs.c finds all, contact_again.c those of a few points. */
#ifndef SIM_CONTACT_FINDER_H
#define SIM_CONTACT_FINDER_H

#include "sim/contact.h"

struct contact_finder {
    const struct sim *sim;
    struct contact *contact;
    double gone; /* of the lines, where the present step begins */
};

/* With the leaves' points and edges found anew where some are torn. */
struct contact_finder contact_finder_begin(struct sim *sim);
/* Couples to look at: a point and a triangle by its number; two edges by theirs. They are looked at some at a
 * time, and what can touch comes onto the list. */
void contact_take_point(const struct contact_finder *f, struct contact_taken *taken, uint32_t point,
                        uint32_t triangle);
void contact_take_edges(const struct contact_finder *f, struct contact_taken *taken, uint32_t e, uint32_t g);
/* The cell of a leaf: one that the worker has, or made in the place of one that is not `used`. */
const struct contact_cell *contact_finder_cell(const struct contact_finder *f, struct contact_taken *taken,
                                               uint32_t leaf, const struct contact_cell *used);
/* The pairs of two leaves, for contact_tree_pairs(): of a struct contact_finder. */
void contact_take_leaves(void *finder, unsigned worker, uint32_t a, uint32_t b);
/* Looks at what is left. Returns how many pairs are near; where there is no room for all, there is none on
 * the list. */
uint32_t contact_finder_end(const struct contact_finder *f);

/* The lines as the inner loops take them. */
static inline struct contact_rounding contact_round_lines(const struct contact *c)
{
    return (struct contact_rounding){c->from, c->to, c->origin, NULL, c->lines};
}

/* For what ways. */
static inline struct contact_ways contact_ways_of(const struct contact *c)
{
    return (struct contact_ways){c->from, c->to, c->reach, c->thickness};
}

#endif
