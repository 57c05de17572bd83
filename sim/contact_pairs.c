/* The list of pairs that can come near each other: of points and triangles and of edges, from the
 * triangles whose boxes meet. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/contact_finder.h"

#include <string.h>

void contact_gather(double (*x)[4], const uint32_t points[4], double places[4][3])
{
    for (int i = 0; i < 4; i++)
        memcpy(places[i], x[points[i]], 3 * sizeof(double));
}

/* The triangles around each point that have not vanished, by counting: those of p end where those of p + 1
 * begin. */
static void find_stars(const struct sim *sim, struct contact *c)
{
    memset(c->star_end, 0, sim->point_count * sizeof *c->star_end);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            c->star_end[sim->triangle_point[t][k]] += sim->triangle_active[t];
    uint32_t end = 0;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const uint32_t count = c->star_end[p];
        c->star_end[p] = end; /* where they begin, until they are entered */
        end += count;
    }
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            c->star[c->star_end[sim->triangle_point[t][k]]++] = t;
}

static bool shares_point(enum ccd_kind kind, const uint32_t p[4])
{
    if (kind == CCD_POINT_TRIANGLE)
        return p[0] == p[1] || p[0] == p[2] || p[0] == p[3];
    return p[0] == p[2] || p[0] == p[3] || p[1] == p[2] || p[1] == p[3];
}

static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

/* How far the features of a pair may come nearer to each other than their lines do. */
static inline float reach_of(const struct contact *c, const uint32_t *p, enum ccd_kind kind)
{
    const float *r = c->reach;
    const float high = larger(r[p[2]], r[p[3]]);
    return kind == CCD_EDGES ? larger(r[p[0]], r[p[1]]) + high : r[p[0]] + larger(r[p[1]], high);
}

/* The pairs that can touch, by how far they are apart: `kept` of all on trial. */
static void list_kept(const struct contact_finder *f, struct contact_taken *taken, enum ccd_kind kind,
                      float (*apart)[2], const uint32_t *kept, uint32_t count)
{
    struct contact *c = f->contact;
    const uint32_t begin = __atomic_fetch_add(&c->pair_count, count, __ATOMIC_RELAXED);
    for (uint32_t i = 0; i < count && begin + i < c->pair_capacity; i++) {
        const uint32_t *p = taken->point[kind][kept[i]];
        const double first = (double)apart[kept[i]][0],
                     pace = (first - (double)apart[kept[i]][1]) / (1 - f->gone),
                     at_first = first + f->gone * pace;
        c->pairs[begin + i] = (struct contact_pair){{p[0], p[1], p[2], p[3]},
                                                    kind,
                                                    (float)(at_first - 1e-6 * (fabs(at_first) + fabs(pace))),
                                                    (float)pace,
                                                    -1};
    }
}

/* Of those that are taken the pairs that can touch come onto the list. */
static void list_taken(const struct contact_finder *f, struct contact_taken *taken, enum ccd_kind kind)
{
    const struct contact *c = f->contact;
    const struct contact_flock flock = {kind, f->contact->lines, (float)f->gone};
    const float thickness = (float)c->thickness;
    float apart[CONTACT_TAKEN][2];
    uint32_t kept[CONTACT_TAKEN], count = 0;
    c->tree.kernels->apart(&flock, taken->point[kind], taken->count[kind], apart);
    for (uint32_t i = 0; i < taken->count[kind]; i++) {
        const float room = 1.000001F *
                           (reach_of(c, taken->point[kind][i], kind) + thickness); /* rounded up */
        kept[count] = i;
        count += !(apart[i][0] > room && apart[i][1] > room);
    }
    list_kept(f, taken, kind, apart, kept, count);
    taken->count[kind] = 0;
}

static void take_pair(const struct contact_finder *f, struct contact_taken *taken, enum ccd_kind kind,
                      const uint32_t p[4])
{
    if (shares_point(kind, p))
        return;
    memcpy(taken->point[kind][taken->count[kind]++], p, 4 * sizeof *p);
    if (taken->count[kind] == CONTACT_TAKEN)
        list_taken(f, taken, kind);
}

void contact_take_point(const struct contact_finder *f, struct contact_taken *taken, uint32_t point,
                        uint32_t triangle)
{
    const uint32_t *c = f->sim->triangle_point[triangle];
    take_pair(f, taken, CCD_POINT_TRIANGLE, (uint32_t[]){point, c[0], c[1], c[2]});
}

void contact_take_edges(const struct contact_finder *f, struct contact_taken *taken, uint32_t e, uint32_t g)
{
    const uint32_t *low = f->sim->edge_point[e < g ? e : g], *high = f->sim->edge_point[e < g ? g : e];
    take_pair(f, taken, CCD_EDGES, (uint32_t[]){low[0], low[1], high[0], high[1]});
}

const struct contact_cell *contact_finder_cell(const struct contact_finder *f, struct contact_taken *taken,
                                               uint32_t leaf, const struct contact_cell *used)
{
    const struct contact_tree *tree = &f->contact->tree;
    uint32_t place = tree->nodes[leaf].number % CONTACT_CELLS;
    if (&taken->cells[place] == used && used->leaf != leaf)
        place = CONTACT_CELLS;
    if (taken->leaf[place] != leaf)
        contact_tree_cell(tree, f->sim, leaf, &taken->cells[place]);
    taken->leaf[place] = leaf;
    return &taken->cells[place];
}

enum { COUPLES = CONTACT_BESIDE * CONTACT_BESIDE };

/* The first cell's points and the second's triangles. */
static void take_points(const struct contact_finder *f, struct contact_taken *taken,
                        const struct contact_cell *a, const struct contact_cell *b)
{
    const struct contact_tree *tree = &f->contact->tree;
    uint8_t couples[COUPLES][2];
    const uint32_t *point = tree->leaf_point + tree->leaves[tree->nodes[a->leaf].number].point_begin,
                   *triangle = tree->order + tree->nodes[b->leaf].begin,
                   count = tree->kernels->meet(&a->points, &b->triangles, couples);
    for (uint32_t i = 0; i < count; i++)
        contact_take_point(f, taken, point[couples[i][0]], triangle[couples[i][1]]);
}

static void take_edges(const struct contact_finder *f, struct contact_taken *taken,
                       const struct contact_cell *a, const struct contact_cell *b)
{
    const struct contact_tree *tree = &f->contact->tree;
    uint8_t couples[COUPLES][2];
    const uint32_t *of_a = tree->leaf_edge + tree->leaves[tree->nodes[a->leaf].number].edge_begin,
                   *of_b = tree->leaf_edge + tree->leaves[tree->nodes[b->leaf].number].edge_begin,
                   count = tree->kernels->meet(&a->edges, &b->edges, couples);
    for (uint32_t i = 0; i < count; i++)
        contact_take_edges(f, taken, of_a[couples[i][0]], of_b[couples[i][1]]);
}

void contact_take_leaves(void *finder, unsigned worker, uint32_t a, uint32_t b)
{
    const struct contact_finder *f = finder;
    struct contact_taken *taken = &f->contact->taken[worker];
    const struct contact_cell *first = contact_finder_cell(f, taken, a, NULL),
                              *second = contact_finder_cell(f, taken, b, first);
    take_points(f, taken, first, second);
    if (a != b)
        take_points(f, taken, second, first);
    take_edges(f, taken, first, second);
}

/* With this step's way. */
static void begin_paths(struct sim *sim, const struct sim_part *part, void *context)
{
    struct contact *c = sim->contact;
    (void)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        c->path[p] = (float)(1.000001 * vec3_distance(sim->before[p], sim->position[p]));
        c->ahead[p] = 2 * c->path[p];
        memcpy(c->seen[p], sim->position[p], sizeof c->seen[p]);
    }
}

static void round_part(struct sim *sim, const struct sim_part *part, void *job)
{
    sim->contact->tree.kernels->round(job, part->point_begin, part->point_end);
}

void contact_round(struct sim *sim, struct contact_rounding *job)
{
    sim_each_part(sim, round_part, job);
}

/* Triangles of edges that an effect cut after the last step vanish at the end of this one only: what is found
 * before that holds for this step. */
static uint32_t broken_when_found(const struct sim *sim)
{
    return sim->edges_broke ? UINT32_MAX : sim->broken;
}

struct contact_finder contact_finder_begin(struct sim *sim)
{
    struct contact *c = sim->contact;
    if (c->shared_broken != sim->broken || c->listed + 1 != c->memory.found) {
        contact_tree_share(&c->tree, sim);
        find_stars(sim, c);
        c->shared_broken = broken_when_found(sim);
    }
    for (unsigned i = 0; i < threads_workers(sim->pool); i++)
        memset(c->taken[i].leaf, 0xff, sizeof c->taken[i].leaf);
    return (struct contact_finder){sim, c, contact_list_gone_before(sim)};
}

uint32_t contact_finder_end(const struct contact_finder *f)
{
    const struct sim *sim = f->sim;
    struct contact *c = f->contact;
    for (unsigned i = 0; i < threads_workers(sim->pool); i++) {
        list_taken(f, &c->taken[i], CCD_POINT_TRIANGLE);
        list_taken(f, &c->taken[i], CCD_EDGES);
    }
    c->listed = c->memory.found;
    const uint32_t near = c->pair_count;
    if (near > c->pair_capacity)
        c->pair_count = 0; /* what is not whole is no list: nothing goes by it */
    return near;
}

/* Returns how many are near. */
static uint32_t find_all(struct sim *sim)
{
    struct contact *c = sim->contact;
    const struct contact_ways ways = contact_ways_of(c);
    struct contact_finder finder = contact_finder_begin(sim);
    c->pair_count = c->indexed = c->linked = 0;
    c->listed_broken = broken_when_found(sim);
    memcpy(c->origin, c->from[0], sizeof c->origin);
    struct contact_rounding lines = contact_round_lines(c);
    contact_round(sim, &lines);
    sim_each_part(sim, begin_paths, NULL);
    contact_tree_fit(&c->tree, sim, &ways);
    contact_tree_pairs(&c->tree, sim, contact_take_leaves, &finder);
    return contact_finder_end(&finder);
}

enum status contact_pairs_find(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    uint32_t near = find_all(sim);
    if (near > c->pair_capacity && near <= c->pair_most) {
        const uint32_t more = near + near / 2;
        if (!contact_make_room(sim, c, more < c->pair_most ? more : c->pair_most))
            return error_no_memory(err, "the pairs that are near each other");
        near = find_all(sim);
    }
    if (near <= c->pair_capacity)
        return STATUS_OK;
    return error_set(
        err, STATUS_RANGE,
        "%s: contact at time %g: %u pairs of points, edges and triangles are near each other, and there is "
        "room for %u; skin that is flung together is slowed by drag, more viscosity of a membrane or more "
        "damping of springs; or contact.thickness = %g is too much for edges of this length",
        sim->scene->path, sim->time, near, c->pair_most, c->thickness);
}
