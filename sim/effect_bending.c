/* What resists being bent (bending.h): its hinges are made when a simulation is opened. The loops
 * are bending_kernels.c's. */
#include "common/array.h"
#include "common/vec3.h"
#include "sim/bending_kernels.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/instructions.h"

#include <stdlib.h>

extern const struct bending_kernels bending_plain, bending_avx2;

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->bending.on;
}

/* Of a triangle and its corner across from an edge: to the hinge as its first where the triangle runs along
 * the edge, else as its second. How many it has then. */
static int add_wing(const struct sim *sim, struct bending_corners *c, uint32_t triangle_begin, uint32_t t,
                    int corner, uint32_t edge)
{
    const bool first = sim->triangle_point[t][(corner + 1) % 3] == sim->edge_point[edge][0];
    c->triangle[!first] = t - triangle_begin;
    c->corner[!first] = (unsigned char)corner;
    return first ? 1 : 2;
}

/* An edge with two triangles that are wound alike: both bits are set. */
static void find_corners(const struct sim *sim, const struct sim_balloon *b, unsigned char *wings)
{
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t edge = sim->triangle_edge[t][(k + 1) % 3], hinge = edge - b->edge_begin;
            wings[hinge] |= (unsigned char)add_wing(sim, &b->bending->corners[hinge], b->triangle_begin, t, k,
                                                    edge);
        }
}

static void find_points(const struct sim *sim, const struct sim_balloon *b, uint32_t hinge)
{
    const struct bending_corners *c = &b->bending->corners[hinge];
    for (int k = 0; k < 2; k++) {
        b->bending->point[hinge][k] = sim->edge_point[b->edge_begin + hinge][k];
        b->bending->point[hinge][k + 2] =
            sim->triangle_point[b->triangle_begin + c->triangle[k]][c->corner[k]];
    }
}

/* Of the sum of squares of the angle's gradients at most: of one wing, over |e|^2. */
static double wing_slope(const double d[3], const double e[3], double square)
{
    const double along = vec3_dot(d, e) / vec3_dot(e, e);
    return (1 + 2 * along * along + 2 * (1 - along) * (1 - along)) / square;
}

/* A hinge of triangles without area is none. */
static void set_rest(const struct sim *sim, const struct sim_balloon *b, uint32_t hinge)
{
    const struct scene_bending *block = &b->scene->bending;
    struct bending *h = b->bending;
    double e[3], d2[3], d3[3], n1[3], n2[3];
    const uint32_t *p = h->point[hinge];
    vec3_sub(sim->position[p[1]], sim->position[p[0]], e);
    vec3_sub(sim->position[p[2]], sim->position[p[0]], d2);
    vec3_sub(sim->position[p[3]], sim->position[p[0]], d3);
    vec3_cross(e, d2, n1);
    vec3_cross(d3, e, n2);
    const double twice1 = vec3_length(n1), twice2 = vec3_length(n2), least = fmin(twice1, twice2) / 4;
    if (!(least > 0))
        return;
    const double square = vec3_dot(e, e), w = 2 * block->stiffness * square / (twice1 + twice2);
    const bool flat = block->rest == SCENE_FLAT;
    h->rest[0][hinge] = w * (flat ? 1 : vec3_dot(n1, n2) / twice1 / twice2);
    h->rest[1][hinge] = w * (flat ? 0 : -sqrt(square) * vec3_dot(n1, d3) / twice1 / twice2);
    h->rest[2][hinge] = 1 / (least * least);
    for (int k = 0; k < 2; k++) {
        double *below = &h->passes.least[h->corners[hinge].triangle[k]];
        *below = fmax(*below, (1 + 1e-9) * least * least); /* whatever the rounding */
    }
    h->rest[3][hinge] = 1 /
                        (square * (wing_slope(d2, e, twice1 * twice1) + wing_slope(d3, e, twice2 * twice2)));
}

/* Whether a hinge of another part reaches into this one. */
static bool reaches(const struct sim_part *part, uint32_t edge)
{
    const uint32_t *p = part->balloon->bending->point[edge - part->balloon->edge_begin];
    for (int i = 0; i < 4; i++)
        if (p[i] - part->point_begin < part->point_end - part->point_begin)
            return true;
    return false;
}

/* Counts those hinges, and stores them where there is an array to store them in. */
static void find_reach(const struct sim_part *part, struct bending_reach *reach)
{
    const struct sim_balloon *b = part->balloon;
    reach->before = reach->count = 0;
    for (uint32_t i = 0; i < b->bending->count; i++) {
        const uint32_t edge = b->edge_begin + i;
        const bool own = edge - part->edge_begin < part->edge_end - part->edge_begin;
        if (own || b->bending->rest[2][i] == 0 || !reaches(part, edge))
            continue;
        if (reach->hinge)
            reach->hinge[reach->count] = edge;
        reach->count++;
        reach->before += edge < part->edge_begin;
    }
}

static bool make_reach(struct sim *sim, const struct sim_balloon *b)
{
    for (size_t i = 0; i < sim->part_count; i++) {
        struct bending_reach *reach = &b->bending->reach[i];
        if (sim->parts[i].balloon != b)
            continue;
        find_reach(&sim->parts[i], reach);
        reach->hinge = sim_table(sim, reach->count, sizeof *reach->hinge);
        if (!reach->hinge)
            return false;
        find_reach(&sim->parts[i], reach);
    }
    return true;
}

/* What the guard takes for the steepest must hold what there is: with so much to spare that it is seldom
 * asked again, and moved back only where it has become far too much. */
static const double spare = 1.15, too_much = 2;

static bool make_passes(struct sim *sim, const struct sim_balloon *b, struct bending *h)
{
    struct bending_passes *p = &h->passes;
    const uint32_t triangles = b->triangle_end - b->triangle_begin;
    p->normal = sim_table(sim, triangles, sizeof *p->normal);
    p->least = sim_table(sim, triangles, sizeof *p->least);
    if (!sim->hinge_pull)
        sim->hinge_pull = sim_table(sim, sim->edge_count, sizeof *sim->hinge_pull);
    p->crushed = sim_table(sim, sim->part_count, sizeof *p->crushed);
    p->hinge_crushed = sim_table(sim, h->count, sizeof *p->hinge_crushed);
    bool room = p->normal && p->least && p->crushed && p->hinge_crushed && sim->hinge_pull;
    for (int k = 0; k < 3 && room; k++) {
        p->cotangent[k] = sim_table(sim, triangles, sizeof *p->cotangent[k]);
        if (h->damping > 0)
            p->swing[k] = sim_table(sim, triangles, sizeof *p->swing[k]);
        room = p->cotangent[k] && (h->damping == 0 || p->swing[k]);
    }
    return room;
}

static bool make_tables(struct sim *sim, const struct sim_balloon *b, struct bending *h)
{
    h->corners = sim_table(sim, h->count, sizeof *h->corners);
    h->point = sim_table(sim, h->count, sizeof *h->point);
    h->reach = sim_table(sim, sim->part_count, sizeof *h->reach);
    h->range = sim_table(sim, sim->part_count, sizeof *h->range);
    bool room = h->corners && h->point && h->reach && h->range;
    for (int k = 0; k < 4 && room; k++) {
        h->rest[k] = sim_table(sim, h->count, sizeof *h->rest[k]);
        room = h->rest[k];
    }
    return room && make_passes(sim, b, h);
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    if (b->scene->bending.stiffness == 0)
        return STATUS_OK;
    struct bending *h = b->bending = calloc(1, sizeof *h);
    if (!h)
        return error_no_memory(err, "the hinges");
    h->count = b->edge_end - b->edge_begin;
    h->damping = b->scene->bending.damping;
    h->bounded = spare;
    h->kernels = FOR_THIS_MACHINE(bending);
    unsigned char *wings = calloc(h->count, 1);
    bool room = wings && make_tables(sim, b, h);
    if (room) {
        find_corners(sim, b, wings);
        for (uint32_t i = 0; i < h->count; i++)
            if (wings[i] == 3) {
                find_points(sim, b, i);
                set_rest(sim, b, i);
            }
        room = make_reach(sim, b);
    }
    free(wings);
    return room ? STATUS_OK : error_no_memory(err, "the hinges");
}

static void free_passes(struct bending_passes *p)
{
    for (int k = 0; k < 3; k++) {
        free(p->cotangent[k]);
        free(p->swing[k]);
    }
    free(p->normal);
    free(p->least);
    free(p->crushed);
    free(p->hinge_crushed);
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    struct bending *h = b->bending;
    free(sim->hinge_pull); /* all close at once */
    sim->hinge_pull = NULL;
    if (!h)
        return;
    for (size_t i = 0; h->reach && i < sim->part_count; i++)
        free(h->reach[i].hinge);
    for (int k = 0; k < 4; k++)
        free(h->rest[k]);
    free_passes(&h->passes);
    free(h->corners);
    free(h->point);
    free(h->reach);
    free(h->range);
    free(h);
    b->bending = NULL;
}

struct pass {
    const struct sim_balloon *balloon;
    bool crushed;
};

static void pulls_of_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct pass *pass = context;
    if (part->balloon == pass->balloon)
        part->balloon->bending->kernels->hinges(sim, part, pass->crushed);
}

static void crushed_of_part(struct sim *sim, const struct sim_part *part, void *context)
{
    if (part->balloon == ((struct pass *)context)->balloon)
        part->balloon->bending->kernels->forces(sim, part, true);
}

/* The first pass is done, with the normals (kernels.h). */
static void apply(struct sim *sim, struct sim_balloon *b)
{
    struct pass pass = {b, false};
    if (!b->bending)
        return;
    for (size_t i = 0; i < sim->part_count; i++)
        pass.crushed |= sim->parts[i].balloon == b && b->bending->passes.crushed[i];
    sim_each_part(sim, pulls_of_part, &pass);
    b->bending->done = pass.crushed;
    if (pass.crushed)
        sim_each_part(sim, crushed_of_part, &pass);
}

/* Goes by tables of the passes alone, where nothing is crushed. */
static void finish(struct sim *sim, const struct sim_balloon *b, const struct sim_part *part)
{
    if (part->balloon == b && b->bending && !b->bending->done)
        b->bending->kernels->forces(sim, part, false);
}

struct job {
    const struct sim_balloon *balloon;
    struct jacobian_product product;
};

static void product_of_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct job *job = context;
    if (part->balloon == job->balloon)
        part->balloon->bending->kernels->product(sim, part, &job->product);
}

static void product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4])
{
    if (balloon->bending)
        sim_each_part(sim, product_of_part, &(struct job){balloon, {a, b, dx, dv, df}});
}

/*
 * With g the angle's gradient, dF/dx = -w (cos g g^T + sin dg/dx) is at most w (|cos| + |sin|) |g|^2 <= 1.42
 * w |g|^2 on the hinge's four points, dg/dx being no more than |g|^2; and dF/dv is w damping g g^T.
 */
static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    const struct bending *h = b->bending;
    if (!h)
        return;
    const struct bending_view view = bending_look(sim, b);
    for (uint32_t i = 0; i < h->count; i++) {
        if (!bending_holds(&view, b->edge_begin + i))
            continue;
        const double g = hypot(h->rest[0][i], h->rest[1][i]) * h->bounded / h->rest[3][i];
        uint32_t point[4];
        bending_points(&view, b->edge_begin + i, point);
        for (int k = 0; k < 4; k++) {
            const uint32_t p = point[k];
            rows->stiffness[p] += M_SQRT2 * g;
            rows->damping[p] += h->damping * g;
        }
    }
}

static void watch(struct sim *sim, struct sim_balloon *b)
{
    if (!b->bending)
        return;
    double most = 1;
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == b)
            most = fmax(most, b->bending->range[i]);
    if (most <= b->bending->bounded && b->bending->bounded <= too_much * spare * most)
        return;
    b->bending->bounded = spare * most;
    guard_bound_outdated(sim);
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *blocks)
{
    (void)sim;
    if (!b->bending)
        return 0;
    blocks[0] = (struct sim_block){"bending", &b->bending->bounded, sizeof b->bending->bounded};
    return 1;
}

static size_t left(struct sim *sim, struct sim_balloon *b, struct sim_block *blocks)
{
    const struct bending *h = b->bending;
    if (!h)
        return 0;
    blocks[0] = (struct sim_block){"hinges' range", h->range, sim->part_count * sizeof *h->range};
    return 1;
}

static struct bending_sums sums_of(const struct sim *sim, const struct sim_balloon *b)
{
    if (!b->bending)
        return (struct bending_sums){0};
    return b->bending->kernels->sums(sim, b, b->edge_begin, b->edge_begin + b->bending->count);
}

static double energy(struct sim *sim, struct sim_balloon *b)
{
    return sums_of(sim, b).energy;
}

static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    (void)work;
    if (b->scene->bending.damping > 0)
        *dissipated += sums_of(sim, b).power;
}

static double edge_energy(const struct sim *sim, const struct sim_balloon *b, uint32_t edge)
{
    return b->bending ? b->bending->kernels->sums(sim, b, edge, edge + 1).energy : 0;
}

static double triangle_energy(const struct sim *sim, const struct sim_balloon *b, uint32_t triangle)
{
    double energy = 0;
    for (int k = 0; k < 3; k++)
        energy += edge_energy(sim, b, sim->triangle_edge[triangle][k]);
    return energy;
}

const struct effect effect_bending = {.name = "bending",
                                      .phase = EFFECT_FORCES,
                                      .wanted = wanted,
                                      .open = open,
                                      .close = close,
                                      .apply = apply,
                                      .finish = finish,
                                      .after = watch,
                                      .left = left,
                                      .blocks = blocks,
                                      .product = product,
                                      .bound = bound,
                                      .energy = energy,
                                      .power = power,
                                      .edge_energy = edge_energy,
                                      .triangle_energy = triangle_energy,
                                      .damps = true,
                                      .source = "Grinspun et al. 2003; Seung and Nelson 1988"};
