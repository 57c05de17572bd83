/* The list of pairs that can come near each other: of points and triangles and of edges, from the triangles whose boxes meet. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/contact_links.h"

#include <string.h>

void contact_gather(double (*x)[4], const uint32_t points[4], double places[4][3])
{
    for (int i = 0; i < 4; i++)
        memcpy(places[i], x[points[i]], 3 * sizeof(double));
}

/* The triangles around each point, by counting: those of p end where those of p + 1 begin. */
static void find_stars(const struct sim *sim, struct contact *c)
{
    memset(c->star_end, 0, sim->point_count * sizeof *c->star_end);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            c->star_end[sim->triangle_point[t][k]]++;
    uint32_t end = 0;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const uint32_t count = c->star_end[p];
        c->star_end[p] = end; /* where they begin, until they are entered */
        end += count;
    }
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            c->star[c->star_end[sim->triangle_point[t][k]]++] = t;
}

struct finder {
    const struct sim *sim;
    struct contact *contact;
    double gone; /* of the lines, where the present step begins */
};

static bool shares_point(enum ccd_kind kind, const uint32_t p[4])
{
    if (kind == CCD_POINT_TRIANGLE)
        return p[0] == p[1] || p[0] == p[2] || p[0] == p[3];
    return p[0] == p[2] || p[0] == p[3] || p[1] == p[2] || p[1] == p[3];
}

static double reach_of(const struct contact *c, const uint32_t *p, int count)
{
    float reach = 0;
    for (int i = 0; i < count; i++)
        reach = c->reach[p[i]] > reach ? c->reach[p[i]] : reach;
    return (double)reach;
}

/* Of those that are taken the pairs that can touch come onto the list. */
static void list_taken(const struct finder *f, struct contact_taken *taken, enum ccd_kind kind)
{
    struct contact *c = f->contact;
    const struct contact_flock flock = {kind, c->from, c->to, f->gone};
    const int first = kind == CCD_POINT_TRIANGLE ? 1 : 2;
    double apart[CONTACT_TAKEN][2];
    c->tree.kernels->apart(&flock, taken->point[kind], taken->count[kind], apart);
    for (uint32_t i = 0; i < taken->count[kind]; i++) {
        const uint32_t *p = taken->point[kind][i];
        const double room = reach_of(c, p, first) + reach_of(c, p + first, 4 - first) + c->thickness;
        if (fmin(apart[i][0], apart[i][1]) > room)
            continue;
        const double pace = (apart[i][0] - apart[i][1]) / (1 - f->gone),
                     at_first = apart[i][0] + f->gone * pace;
        const uint32_t place = __atomic_fetch_add(&c->pair_count, 1, __ATOMIC_RELAXED);
        if (place >= c->pair_capacity)
            continue;
        c->awake[place] = 1;
        c->pairs[place] = (struct contact_pair){{p[0], p[1], p[2], p[3]},
                                                kind,
                                                (float)(at_first - 1e-6 * (fabs(at_first) + fabs(pace))),
                                                (float)pace};
    }
    taken->count[kind] = 0;
}

static void take_pair(const struct finder *f, struct contact_taken *taken, enum ccd_kind kind,
                      const uint32_t p[4])
{
    if (shares_point(kind, p))
        return;
    memcpy(taken->point[kind][taken->count[kind]++], p, 4 * sizeof *p);
    for (int k = 0; k < 4; k++) { /* wanted soon */
        __builtin_prefetch(f->contact->from[p[k]]);
        __builtin_prefetch(f->contact->to[p[k]]);
    }
    if (taken->count[kind] == CONTACT_TAKEN)
        list_taken(f, taken, kind);
}

/* What is left at the end of a search. */
static void list_rest(const struct finder *f, unsigned workers)
{
    for (unsigned i = 0; i < workers; i++) {
        list_taken(f, &f->contact->taken[i], CCD_POINT_TRIANGLE);
        list_taken(f, &f->contact->taken[i], CCD_EDGES);
    }
}

/* The first leaf's points and the second's triangles. */
static void take_points(const struct finder *f, struct contact_taken *taken, uint32_t a, uint32_t b)
{
    const struct contact_tree *tree = &f->contact->tree;
    const struct contact_node *node = &tree->nodes[b];
    const struct contact_leaf *leaf = &tree->leaves[tree->nodes[a].number];
    for (uint32_t i = leaf->point_begin; i < leaf->point_end; i++) {
        const uint32_t p = tree->leaf_point[i];
        const struct contact_box *box = &tree->point[p];
        for (uint32_t j = node->begin; j < node->end && (a == b || contact_boxes_meet(box, &node->box));
             j++) {
            const uint32_t *corners = f->sim->triangle_point[tree->order[j]];
            if (contact_boxes_meet(box, &tree->box[j]))
                take_pair(f, taken, CCD_POINT_TRIANGLE, (uint32_t[]){p, corners[0], corners[1], corners[2]});
        }
    }
}

static void take_two_edges(const struct finder *f, struct contact_taken *taken, uint32_t e, uint32_t g)
{
    const uint32_t *low = f->sim->edge_point[e < g ? e : g], *high = f->sim->edge_point[e < g ? g : e];
    take_pair(f, taken, CCD_EDGES, (uint32_t[]){low[0], low[1], high[0], high[1]});
}

/* Of a leaf's edges those that come near a box, by their places in leaf_edge; returns how many. */
static int edges_near(const struct contact_tree *tree, uint32_t node, const struct contact_box *box,
                      uint32_t edges[CONTACT_BESIDE])
{
    const struct contact_leaf *leaf = &tree->leaves[tree->nodes[node].number];
    int count = 0;
    for (uint32_t i = leaf->edge_begin; i < leaf->edge_end; i++) {
        edges[count] = i;
        count += contact_boxes_meet(&tree->edge_box[i], box);
    }
    return count;
}

static void take_edges(const struct finder *f, struct contact_taken *taken, uint32_t a, uint32_t b)
{
    const struct contact_tree *tree = &f->contact->tree;
    uint32_t of_a[CONTACT_BESIDE], of_b[CONTACT_BESIDE];
    const int first = edges_near(tree, a, &tree->nodes[b].box, of_a);
    const int second = first ? edges_near(tree, b, &tree->nodes[a].box, of_b) : 0;
    for (int i = 0; i < first; i++)
        for (int j = a == b ? i + 1 : 0; j < second; j++)
            if (contact_boxes_meet(&tree->edge_box[of_a[i]], &tree->edge_box[of_b[j]]))
                take_two_edges(f, taken, tree->leaf_edge[of_a[i]], tree->leaf_edge[of_b[j]]);
}

static void take_leaves(void *context, unsigned worker, uint32_t a, uint32_t b)
{
    const struct finder *f = context;
    struct contact_taken *taken = &f->contact->taken[worker];
    take_points(f, taken, a, b);
    if (a != b)
        take_points(f, taken, b, a);
    take_edges(f, taken, a, b);
}

static void share_anew(struct sim *sim)
{
    struct contact *c = sim->contact;
    if (c->shared_broken == sim->broken && c->listed + 1 == c->memory.found)
        return;
    contact_tree_share(&c->tree, sim);
    find_stars(sim, c);
    c->shared_broken = sim->broken;
}

static enum status check_room(const struct sim *sim, struct error *err)
{
    const struct contact *c = sim->contact;
    if (c->pair_count <= c->pair_capacity)
        return STATUS_OK;
    return error_set(
        err, STATUS_RANGE,
        "%s: contact at time %g: %u pairs of points, edges and triangles are near each other, and there is "
        "room for %u; contact.thickness = %g is too much for edges of this length, or the skin is crushed",
        sim->scene->path, sim->time, c->pair_count, c->pair_capacity, c->thickness);
}

static struct contact_ways ways_of(const struct contact *c)
{
    return (struct contact_ways){c->from, c->to, c->reach, c->thickness};
}

enum status contact_pairs_find(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    const struct contact_ways ways = ways_of(c);
    struct finder finder = {sim, c, contact_list_gone_before(sim)};
    share_anew(sim);
    c->pair_count = c->indexed = c->linked = 0;
    contact_tree_fit(&c->tree, sim, &ways);
    contact_tree_pairs(&c->tree, sim, take_leaves, &finder);
    list_rest(&finder, threads_workers(sim->pool));
    c->listed = c->memory.found;
    return check_room(sim, err);
}

/* Pairs at that distance are never looked at again. */
static void forget_pairs(struct contact *c, uint32_t point)
{
    struct contact_links links = contact_links_of(c, point);
    for (uint32_t at; (at = contact_links_next(&links)) != UINT32_MAX;)
        c->pairs[at / 4].distance = INFINITY;
}

/* What is near a point that is marked: all pairs with it, but for those with a lower one that is marked too. */
enum { VICINITY_MOST = 64 };
struct vicinity {
    const struct finder *finder;
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

static void take_near_points(const struct vicinity *r, const struct contact_tree *tree,
                             const struct contact_node *node)
{
    const struct sim *sim = r->finder->sim;
    const struct contact_leaf *leaf = &tree->leaves[node->number];
    for (uint32_t i = node->begin; i < node->end; i++) {
        const uint32_t *c = sim->triangle_point[tree->order[i]];
        if (contact_boxes_meet(&tree->point[r->point], &tree->box[i]) && is_ours(r, c, 3))
            take_pair(r->finder, r->taken, CCD_POINT_TRIANGLE, (uint32_t[]){r->point, c[0], c[1], c[2]});
    }
    for (uint32_t i = leaf->point_begin; i < leaf->point_end; i++) {
        const uint32_t p = tree->leaf_point[i];
        for (uint32_t j = 0; j < r->count && contact_boxes_meet(&tree->point[p], &r->all); j++) {
            const uint32_t *c = sim->triangle_point[r->triangle[j]];
            if (contact_boxes_meet(&tree->point[p], &r->box[j]) && is_ours(r, &p, 1) && is_ours(r, c, 3))
                take_pair(r->finder, r->taken, CCD_POINT_TRIANGLE, (uint32_t[]){p, c[0], c[1], c[2]});
        }
    }
}

static void take_near(void *context, uint32_t leaf)
{
    const struct vicinity *r = context;
    const struct contact_tree *tree = &r->finder->contact->tree;
    uint32_t near[CONTACT_BESIDE];
    take_near_points(r, tree, &tree->nodes[leaf]);
    const int count = edges_near(tree, leaf, &r->all, near);
    for (int i = 0; i < count; i++)
        for (uint32_t j = 0; j < r->edge_count; j++) {
            const uint32_t e = tree->leaf_edge[near[i]], g = r->edge[j];
            if (contact_boxes_meet(&tree->edge_box[near[i]], &r->edge_box[j]) &&
                is_ours(r, r->finder->sim->edge_point[e], 2) && is_ours(r, r->finder->sim->edge_point[g], 2))
                take_two_edges(r->finder, r->taken, e, g);
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
        const uint32_t t = r->triangle[i] = star[i], *p = sim->triangle_point[t];
        r->box[i] = tree->point[p[0]];
        contact_box_join(&r->box[i], &tree->point[p[1]]);
        contact_box_join(&r->box[i], &tree->point[p[2]]);
        contact_box_join(&r->all, &r->box[i]);
        for (int k = 0; k < 3; k++) {
            const uint32_t edge = sim->triangle_edge[t][k], *ends = sim->edge_point[edge];
            bool known = ends[0] != r->point && ends[1] != r->point;
            for (uint32_t j = 0; j < r->edge_count; j++)
                known |= r->edge[j] == edge;
            if (known)
                continue;
            r->edge_box[r->edge_count] = tree->point[ends[0]];
            contact_box_join(&r->edge_box[r->edge_count], &tree->point[ends[1]]);
            r->edge[r->edge_count++] = edge;
        }
    }
}

static void find_vicinity(void *context, size_t index, unsigned worker)
{
    const struct finder *f = context;
    const struct contact *c = f->contact;
    const uint32_t p = c->again[index], begin = p ? c->star_end[p - 1] : 0;
    struct vicinity r;
    r.finder = f;
    r.taken = &f->contact->taken[worker];
    r.point = p;
    r.count = c->star_end[p] - begin;
    gather_vicinity(&r, c->star + begin);
    contact_tree_near(&c->tree, &r.all, take_near, &r);
}

/* The triangles around the points in c->again, each once; returns how many, or UINT32_MAX where too many are around one. */
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
    const struct contact_ways ways = ways_of(c);
    struct finder finder = {sim, c, contact_list_gone_before(sim)};
    share_anew(sim);
    contact_links_make(sim);
    for (uint32_t i = 0; i < c->again_count; i++) {
        forget_pairs(c, c->again[i]);
        c->marked[c->again[i]] = 1;
    }
    enum status status = STATUS_OK;
    const uint32_t around = list_around(sim, c);
    if (around != UINT32_MAX &&
        contact_tree_refit(&c->tree, sim, &ways, c->again, c->again_count, c->around, around)) {
        threads_run(sim->pool, c->again_count, find_vicinity, &finder);
        contact_tree_pairs_opened(&c->tree, sim, take_leaves, &finder);
        list_rest(&finder, threads_workers(sim->pool));
    } else {
        status = contact_pairs_find(sim, err);
    }
    for (uint32_t i = 0; i < c->again_count; i++)
        c->marked[c->again[i]] = 0;
    c->listed = c->memory.found;
    return status ? status : check_room(sim, err);
}
