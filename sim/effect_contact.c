/* The scene's block `contact` (contact.h): what it keeps, and where it begins. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/contact.h"
#include "sim/effects.h"
#include "sim/instructions.h"
#include "sim/ledger.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene *scene)
{
    return scene->contact.on;
}

extern const struct contact_kernels contact_plain, contact_avx2;

static double least_edge(const struct sim *sim)
{
    double least = INFINITY;
    for (size_t b = 0; b < sim->balloon_count; b++)
        least = fmin(least, sim->balloons[b].mean_rest_length);
    return least;
}

bool contact_make_room(struct sim *sim, struct contact *c, uint32_t pairs)
{
    enum { EIGHT = 8 }; /* are looked at at a time */
    const size_t bytes = sim->bytes, a_pair = sizeof *c->pairs + 4 * sizeof *c->link + sizeof *c->hits;
    struct contact_pair *list = sim_table(sim, (size_t)pairs + EIGHT, sizeof *list);
    uint32_t *link = sim_table(sim, 4 * (size_t)pairs, sizeof *link),
             *hits = sim_table(sim, pairs, sizeof *hits);
    if (!list || !link || !hits) {
        free(list);
        free(link);
        free(hits);
        sim->bytes = bytes;
        return false;
    }
    if (c->pairs)
        sim->bytes -= c->pair_capacity * a_pair + EIGHT * sizeof *c->pairs;
    free(c->pairs);
    free(c->link);
    free(c->hits);
    c->pairs = list;
    c->link = link;
    c->hits = hits;
    c->pair_capacity = pairs;
    return true;
}

static uint32_t at_most(size_t pairs)
{
    const size_t most = UINT32_MAX / 4;
    return (uint32_t)(pairs < most ? pairs : most);
}

static bool allocate(struct sim *sim, struct contact *c)
{
    /* shreds that are flung together have hundreds of pairs a triangle */
    enum { PAIRS_A_TRIANGLE = 16, PAIRS_MOST = 64, MOST_OF_FEW = 1 << 22 };
    const size_t points = sim->point_count, triangles = sim->triangle_count, most = PAIRS_MOST * triangles;
    c->pair_most = at_most(most > MOST_OF_FEW ? most : MOST_OF_FEW);
    c->from = sim_table(sim, points, sizeof *c->from);
    c->to = sim_table(sim, points, sizeof *c->to);
    c->reach = sim_table(sim, points, sizeof *c->reach);
    c->off = sim_table(sim, points, sizeof *c->off);
    c->speed = sim_table(sim, points, sizeof *c->speed);
    c->star_end = sim_table(sim, points, sizeof *c->star_end);
    c->star = sim_table(sim, 3 * triangles, sizeof *c->star);
    c->lines = sim_table(sim, points, sizeof *c->lines);
    c->ways = sim_table(sim, points, sizeof *c->ways);
    c->taken = sim_table(sim, threads_workers(sim->pool), sizeof *c->taken);
    c->link_end = sim_table(sim, points, sizeof *c->link_end);
    c->chain = sim_table(sim, points, sizeof *c->chain);
    c->path = sim_table(sim, points, sizeof *c->path);
    c->ahead = sim_table(sim, points, sizeof *c->ahead);
    c->seen = sim_table(sim, points, sizeof *c->seen);
    c->moved = sim_table(sim, points, sizeof *c->moved);
    c->again = sim_table(sim, points, sizeof *c->again);
    c->around = sim_table(sim, triangles, sizeof *c->around);
    c->stirred = sim_table(sim, points, 1);
    c->marked = sim_table(sim, points, 1);
    c->held = sim_table(sim, points, 1);
    c->zone = sim_table(sim, points, sizeof *c->zone);
    c->drift = sim_table(sim, points, sizeof *c->drift);
    c->share = sim_table(sim, sim->part_count, sizeof *c->share);
    return contact_make_room(sim, c, at_most(PAIRS_A_TRIANGLE * triangles + 4096)) && c->from && c->to &&
           c->reach && c->off && c->speed && c->star_end && c->star && c->lines && c->ways && c->taken &&
           c->link_end && c->chain && c->path && c->ahead && c->seen && c->moved && c->again && c->around &&
           c->stirred && c->marked && c->held && c->zone && c->drift && c->share;
}

/* Whether the edge a b passes through the triangle: its ends on two sides, and its
 * line between the corners. */
static bool passes(double (*x)[4], const uint32_t *edge, const uint32_t *t)
{
    double side[2], turn[3], n[3], a[3], b[3], cross[3], way[3];
    vec3_triangle(x[t[0]], x[t[1]], x[t[2]], n);
    for (int i = 0; i < 2; i++) {
        vec3_sub(x[edge[i]], x[t[0]], a);
        side[i] = vec3_dot(a, n);
    }
    if ((side[0] > 0) == (side[1] > 0))
        return false;
    vec3_sub(x[edge[1]], x[edge[0]], way);
    for (int k = 0; k < 3; k++) {
        vec3_sub(x[t[k]], x[edge[0]], a);
        vec3_sub(x[t[(k + 1) % 3]], x[edge[0]], b);
        vec3_cross(a, b, cross);
        turn[k] = vec3_dot(cross, way);
    }
    return (turn[0] > 0) == (turn[1] > 0) && (turn[1] > 0) == (turn[2] > 0);
}

struct crossings {
    const struct sim *sim;
    uint32_t t, u; /* the first that cross */
    uint32_t found;
};

static void cross(struct crossings *crossings, uint32_t t, uint32_t u)
{
    const struct sim *sim = crossings->sim;
    const uint32_t both[2] = {t, u};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *edge = sim->edge_point[sim->triangle_edge[both[i]][k]],
                           *other = sim->triangle_point[both[!i]];
            bool shared = false;
            for (int j = 0; j < 3; j++)
                shared |= other[j] == edge[0] || other[j] == edge[1];
            if (!shared && passes(sim->position, edge, other) &&
                !__atomic_fetch_add(&crossings->found, 1, __ATOMIC_RELAXED)) {
                crossings->t = t;
                crossings->u = u;
            }
        }
}

static void cross_leaves(void *context, unsigned worker, uint32_t a, uint32_t b)
{
    (void)worker;
    struct crossings *crossings = context;
    const struct contact_tree *tree = &crossings->sim->contact->tree;
    const uint32_t *of_a = tree->order + tree->nodes[a].begin, *of_b = tree->order + tree->nodes[b].begin;
    struct contact_cell first, second;
    contact_tree_cell(tree, crossings->sim, a, &first);
    contact_tree_cell(tree, crossings->sim, b, &second);
    for (uint32_t i = 0; i < first.triangles.count; i++)
        for (uint32_t j = a == b ? i + 1 : 0; j < second.triangles.count; j++)
            if (contact_boxes_meet(&first.triangle[i], &second.triangle[j]))
                cross(crossings, of_a[i], of_b[j]);
}

static size_t number_of_balloon(const struct sim *sim, uint32_t triangle)
{
    return (size_t)(sim_balloon_of(sim, triangle) - sim->balloons);
}

/* Contact keeps apart what is apart; what crosses at first would hang together for ever. */
static enum status check_apart(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    struct crossings crossings = {.sim = sim};
    contact_tree_share(&c->tree, sim);
    contact_tree_fit(&c->tree, sim, &(struct contact_ways){sim->position, sim->position, c->reach, 0});
    contact_tree_pairs(&c->tree, sim, cross_leaves, &crossings);
    if (crossings.found == 0)
        return STATUS_OK;
    const double *x = sim->position[sim->triangle_point[crossings.t][0]];
    const size_t one = number_of_balloon(sim, crossings.t), other = number_of_balloon(sim, crossings.u);
    char line[16] = "", who[96];
    if (sim->scene->contact.line)
        snprintf(line, sizeof line, ":%u", sim->scene->contact.line);
    if (one == other)
        snprintf(who, sizeof who, "the skin of balloons[%zu] crosses itself", one);
    else
        snprintf(who, sizeof who, "the skins of balloons[%zu] and balloons[%zu] cross", one, other);
    return error_set(err, STATUS_INPUT, "%s%s: contact: %s before the first step, near (%g, %g, %g); %s",
                     sim->scene->path, line, who, x[0], x[1], x[2],
                     one == other ? "take a mesh that does not, as of more triangles, or leave out contact"
                                  : "move them apart");
}

static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    (void)balloon;
    struct contact *c = sim->contact = calloc(1, sizeof *c);
    if (!c)
        return error_no_memory(err, "contact");
    const struct scene_contact *given = &sim->scene->contact;
    c->thickness = given->thickness > 0 ? given->thickness : least_edge(sim) / 10;
    c->friction = given->friction;
    c->tree.kernels = FOR_THIS_MACHINE(contact);
    c->shared_broken = UINT32_MAX;
    if (!allocate(sim, c))
        return error_no_memory(err, "contact");
    enum status status = sim_keep_before(sim, err);
    if (!status)
        status = contact_tree_open(&c->tree, sim, err);
    if (!status)
        status = check_apart(sim, err);
    if (status)
        return status;
    memcpy(sim->before, sim->position, sim->point_count * sizeof *sim->before);
    return contact_list_make(sim, err);
}

static void close(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    struct contact *c = sim->contact;
    if (!c)
        return;
    contact_tree_close(&c->tree);
    void *tables[] = {c->from,    c->to,     c->reach, c->off,   c->speed, c->star_end, c->star,
                      c->lines,   c->ways,   c->taken, c->pairs, c->link,  c->link_end, c->chain,
                      c->path,    c->ahead,  c->seen,  c->hits,  c->moved, c->again,    c->around,
                      c->stirred, c->marked, c->held,  c->zone,  c->drift, c->share};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        free(tables[i]);
    free(c);
    sim->contact = NULL;
}

static size_t blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *list)
{
    (void)balloon;
    struct contact *c = sim->contact;
    const size_t rows = sim->point_count * sizeof *c->from;
    list[0] = (struct sim_block){"contact", &c->memory, sizeof c->memory};
    list[1] = (struct sim_block){"contact from", c->from, rows};
    list[2] = (struct sim_block){"contact to", c->to, rows};
    list[3] = (struct sim_block){"contact reach", c->reach, sim->point_count * sizeof *c->reach};
    list[4] = (struct sim_block){"contact off", c->off, sim->point_count * sizeof *c->off};
    list[5] = (struct sim_block){"contact speed", c->speed, sim->point_count * sizeof *c->speed};
    return 6;
}

/* Its list is made anew, and so is what stands for points. */
static void reorder(struct sim *sim, struct sim_balloon *balloon, const struct reorder *how)
{
    (void)balloon;
    struct contact *c = sim->contact;
    const uint32_t first = how->balloon->point_begin;
    reorder_rows(how, c->from + first, sizeof *c->from);
    reorder_rows(how, c->to + first, sizeof *c->to);
    reorder_rows(how, c->reach + first, sizeof *c->reach);
    reorder_rows(how, c->off + first, sizeof *c->off);
    reorder_rows(how, c->speed + first, sizeof *c->speed);
    c->listed = c->shared_broken = UINT32_MAX;
}

static enum status settle(struct sim *sim, struct error *err)
{
    enum status status = contact_settle(sim, err);
    ledger_book(sim, !status && sim->changed);
    return status;
}

const struct effect effect_contact = {.name = "contact",
                                      .phase = EFFECT_MOVED,
                                      .scene_wanted = wanted,
                                      .open = open,
                                      .close = close,
                                      .blocks = blocks,
                                      .reorder = reorder,
                                      .settle = settle,
                                      .source = "Bridson, Fedkiw & Anderson 2002"};
