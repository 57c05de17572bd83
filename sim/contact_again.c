/* The pairs of a few points found anew, in place of those that the list has. */
#include "sim/contact_finder.h"
#include "sim/contact_links.h"
#include "sim/contact_shares.h"

/* Pairs at that distance are never looked at again. Those of several such points are left to one
 * worker. */
static void forget_pairs(struct contact *c, uint32_t point)
{
    struct contact_links links = contact_links_of(c, point);
    for (uint32_t at; (at = contact_links_next(&links)) != UINT32_MAX;) {
        struct contact_pair *pair = &c->pairs[at / 4];
        if (!contact_is_first(c->marked, pair->point, at % 4))
            continue;
        pair->distance = pair->until = INFINITY;
    }
}

/* What is near a point that is marked: all pairs with it, but for those with a lower
 * one that is marked too. */
enum { VICINITY_MOST = 64 };
struct vicinity {
    const struct contact_finder *finder;
    struct contact_taken *taken;
    uint32_t point, count;
    uint32_t triangle[VICINITY_MOST], edge[2 * VICINITY_MOST]; /* around it: so many triangles, */
    uint32_t edge_count;                                       /* and so many edges that lead to it */
    struct contact_box box[VICINITY_MOST], edge_box[2 * VICINITY_MOST], all;
};

static bool is_ours(const struct vicinity *r, const uint32_t *p, int count)
{
    const unsigned char *marked = r->finder->contact->marked;
    bool ours = true;
    for (int i = 0; i < count; i++)
        ours &= !marked[p[i]] || p[i] >= r->point;
    return ours;
}

/* The point and a leaf's triangles, and a leaf's points and the triangles around it. */
static void take_near_points(const struct vicinity *r, const struct contact_cell *cell)
{
    const struct sim *sim = r->finder->sim;
    const struct contact_tree *tree = &r->finder->contact->tree;
    uint8_t couples[VICINITY_MOST * CONTACT_BESIDE][2];
    const struct contact_box *box = &tree->point[r->point];
    const struct contact_group alone = {box, 1, box}, around = {r->box, r->count, &r->all};
    const uint32_t *triangle = tree->order + tree->nodes[cell->leaf].begin,
                   *point = tree->leaf_point + tree->leaves[tree->nodes[cell->leaf].number].point_begin;
    uint32_t count = tree->kernels->meet(&alone, &cell->triangles, couples);
    for (uint32_t i = 0; i < count; i++)
        if (is_ours(r, sim->triangle_point[triangle[couples[i][1]]], 3))
            contact_take_point(r->finder, r->taken, r->point, triangle[couples[i][1]]);
    count = tree->kernels->meet(&around, &cell->points, couples);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t t = r->triangle[couples[i][0]], p = point[couples[i][1]];
        if (is_ours(r, &p, 1) && is_ours(r, sim->triangle_point[t], 3))
            contact_take_point(r->finder, r->taken, p, t);
    }
}

static void take_near(void *context, uint32_t leaf)
{
    const struct vicinity *r = context;
    const struct sim *sim = r->finder->sim;
    const struct contact_tree *tree = &r->finder->contact->tree;
    const struct contact_cell *cell = contact_finder_cell(r->finder, r->taken, leaf, NULL);
    uint8_t couples[2 * VICINITY_MOST * CONTACT_BESIDE][2];
    take_near_points(r, cell);
    const struct contact_group around = {r->edge_box, r->edge_count, &r->all};
    const uint32_t *edge = tree->leaf_edge + tree->leaves[tree->nodes[leaf].number].edge_begin,
                   count = tree->kernels->meet(&around, &cell->edges, couples);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t e = edge[couples[i][1]], g = r->edge[couples[i][0]];
        if (is_ours(r, sim->edge_point[e], 2) && is_ours(r, sim->edge_point[g], 2))
            contact_take_edges(r->finder, r->taken, e, g);
    }
}

/* The triangles around it, with their boxes, and the edges to it, each once. */
static void gather_vicinity(struct vicinity *r, const uint32_t *star)
{
    const struct sim *sim = r->finder->sim;
    const struct contact_tree *tree = &r->finder->contact->tree;
    r->all = contact_box_empty();
    r->edge_count = 0;
    for (uint32_t i = 0; i < r->count; i++) {
        const uint32_t t = r->triangle[i] = star[i];
        r->box[i] = contact_box_triangle(tree->point, sim->triangle_point[t]);
        contact_box_join(&r->all, &r->box[i]);
        for (int k = 0; k < 3; k++) {
            const uint32_t edge = sim->triangle_edge[t][k], *ends = sim->edge_point[edge];
            bool known = ends[0] != r->point && ends[1] != r->point;
            for (uint32_t j = 0; j < r->edge_count; j++)
                known |= r->edge[j] == edge;
            if (known)
                continue;
            r->edge_box[r->edge_count] = contact_box_edge(tree->point, ends);
            r->edge[r->edge_count++] = edge;
        }
    }
}

static void find_vicinity(void *context, size_t index, unsigned worker)
{
    const struct contact_finder *f = context;
    const struct contact *c = f->contact;
    const uint32_t p = c->again[index], begin = p ? c->star_end[p - 1] : 0;
    struct vicinity r;
    r.finder = f;
    r.taken = &f->contact->taken[worker];
    r.point = p;
    r.count = c->star_end[p] - begin;
    forget_pairs(f->contact, p);
    gather_vicinity(&r, c->star + begin);
    contact_tree_near(&c->tree, &r.all, take_near, &r);
}

/* The triangles around the points in c->again, each once; returns how many, or UINT32_MAX where
 * too many are around one. */
static uint32_t list_around(const struct sim *sim, struct contact *c)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->again_count; i++) {
        const uint32_t p = c->again[i];
        if (c->star_end[p] - (p ? c->star_end[p - 1] : 0) > VICINITY_MOST)
            return UINT32_MAX;
        for (uint32_t s = p ? c->star_end[p - 1] : 0; s < c->star_end[p]; s++) {
            const uint32_t *corner = sim->triangle_point[c->star[s]];
            uint32_t lowest = UINT32_MAX;
            for (int k = 0; k < 3; k++)
                lowest = c->marked[corner[k]] && corner[k] < lowest ? corner[k] : lowest;
            if (lowest == p)
                c->around[count++] = c->star[s];
        }
    }
    return count;
}

enum status contact_pairs_find_again(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    const struct contact_ways ways = contact_ways_of(c);
    struct contact_finder finder = contact_finder_begin(sim);
    struct contact_rounding lines = contact_round_lines(c);
    lines.points = c->again;
    c->tree.kernels->round(&lines, 0, c->again_count);
    contact_links_make(sim);
    for (uint32_t i = 0; i < c->again_count; i++)
        c->marked[c->again[i]] = 1;
    const uint32_t around = list_around(sim, c);
    bool found = false;
    if (around != UINT32_MAX &&
        contact_tree_refit(&c->tree, sim, &ways, c->again, c->again_count, c->around, around)) {
        contact_share_out(sim->pool, c->again_count, find_vicinity, &finder);
        contact_tree_pairs_opened(&c->tree, sim, contact_take_leaves, &finder);
        found = contact_finder_end(&finder) <= c->pair_capacity;
    }
    const enum status status = found ? STATUS_OK : contact_pairs_find(sim, err);
    for (uint32_t i = 0; i < c->again_count; i++)
        c->marked[c->again[i]] = 0;
    return status;
}
