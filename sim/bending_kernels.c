/*
 * Forces, energies and derivatives of hinges, four at a time (lanes.h). Compiled once for each set of
 * instructions: SIM_BENDING is the name of the table at the end. The formulas are in bending_hinge.h;
 * bending.h says what their letters mean.
 */
#include "sim/bending_kernels.h"
#include "sim/bending_hinge.h"
#include "sim/bending_passes.h"
#include "sim/topology.h"

/* Up to four hinges and their points, the last ones filled up with the first. */
struct group {
    uint32_t hinge[4], point[4][4];
    int count;
};

/* What a loop over hinges works with. */
struct work {
    const row *position, *velocity;
    const double *rest[4];
    double damping;
    uint32_t begin, own;          /* points of the part */
    const unsigned char *crushed; /* of the hinges only those; NULL: all that are there */
    row *out;
    const struct jacobian_product *product;
    struct bending_sums sums;
    lanes range;
};

INLINE struct work work_of(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct bending *b = balloon->bending;
    return (struct work){.position = sim->rows.position,
                         .velocity = sim->rows.velocity,
                         .rest = {b->rest[0], b->rest[1], b->rest[2], b->rest[3]},
                         .damping = b->damping};
}

INLINE struct spans spans_of(const row *rows, const struct group *g)
{
    row e[4], d2[4], d3[4];
    for (int i = 0; i < 4; i++) {
        const uint32_t *p = g->point[i];
        e[i] = rows[p[1]] - rows[p[0]];
        d2[i] = rows[p[2]] - rows[p[0]];
        d3[i] = rows[p[3]] - rows[p[0]];
    }
    return (struct spans){lanes_of_rows(e), lanes_of_rows(d2), lanes_of_rows(d3)};
}

/* factor times these. */
INLINE struct spans scaled_spans_of(double factor, const double (*rows)[4], const struct group *g)
{
    const struct spans s = spans_of((const row *)rows, g);
    const lanes f = lanes_all(factor);
    return (struct spans){times(f, s.e), times(f, s.d2), times(f, s.d3)};
}

INLINE void rest_of(const struct work *work, const struct group *g, lanes rest[4])
{
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 4; i++)
            rest[k][i] = work->rest[k][g->hinge[i]];
}

typedef uint32_t quad __attribute__((vector_size(4 * sizeof(uint32_t))));

/* Whether all the points are the part's. */
INLINE bool is_inner(const struct work *work, const struct group *g)
{
    quad outside = {0};
    for (int i = 0; i < 4; i++) {
        quad p;
        memcpy(&p, g->point[i], sizeof p);
        outside |= (quad)(p - work->begin >= work->own);
    }
    return (outside[0] | outside[1] | outside[2] | outside[3]) == 0;
}

/* Adds them to the rows of the points, one hinge after the other; other parts' points are left out. */
INLINE void add_to_points(const struct work *work, const struct group *g, const struct pulls *pulls)
{
    row f[3][4];
    for (int k = 0; k < 3; k++)
        lanes_to_rows(pulls->f[k], f[k]);
    if (g->count == 4 && is_inner(work, g)) {
        for (int i = 0; i < 4; i++) {
            const uint32_t *p = g->point[i];
            work->out[p[0]] -= f[0][i] + f[1][i] + f[2][i];
            for (int k = 0; k < 3; k++)
                work->out[p[k + 1]] += f[k][i];
        }
        return;
    }
    for (int i = 0; i < g->count; i++) {
        const uint32_t *p = g->point[i];
        if (p[0] - work->begin < work->own)
            work->out[p[0]] -= f[0][i] + f[1][i] + f[2][i];
        for (int k = 0; k < 3; k++)
            if (p[k + 1] - work->begin < work->own)
                work->out[p[k + 1]] += f[k][i];
    }
}

static void crushed_forces(struct work *work, const struct group *g)
{
    const struct spans s = spans_of(work->position, g), speed = spans_of(work->velocity, g);
    lanes rest[4];
    rest_of(work, g, rest);
    const struct hinge h = hinge_of(&s, rest);
    const lanes torque = h.sine + work->damping * weight_of(&h) * rate_of(&h, &speed);
    struct pulls pulls = torque_pulls(&h, h.kept * torque);
    add_pulls(&pulls, crushing_pulls(&h));
    add_to_points(work, g, &pulls);
    work->range = lanes_max(work->range, slope_of(&h));
}

static void group_product(struct work *work, const struct group *g)
{
    const struct jacobian_product *product = work->product;
    const struct spans s = spans_of(work->position, g),
                       d = scaled_spans_of(product->a, (const double(*)[4])product->dx, g);
    lanes rest[4];
    rest_of(work, g, rest);
    const struct hinge h = hinge_of(&s, rest);
    struct wing_change c[2];
    wing_changes(&h, &d, c);
    const lanes turned = c[0].rate + c[1].rate, r1 = h.wing[0].left, r2 = h.wing[1].left;
    const lanes kept = (2 - 2 * r1) * c[0].left * (r2 * (2 - r2)) +
                       (2 - 2 * r2) * c[1].left * (r1 * (2 - r1));
    lanes torque = h.sine, change = h.cosine * turned;
    if (work->damping > 0) {
        const lanes damping = work->damping * weight_of(&h);
        const struct spans speed = spans_of(work->velocity, g),
                           faster = scaled_spans_of(product->b, (const double(*)[4])product->dv, g);
        torque += damping * rate_of(&h, &speed);
        change += damping * (rate_of(&h, &faster) + rate_change(&h.wing[0], &c[0], speed.d2, speed.e) +
                             rate_change(&h.wing[1], &c[1], speed.d3, speed.e));
    }
    struct pulls pulls = torque_change(&h, c, h.kept * torque, h.kept * change + kept * torque);
    if (any_is_crushed(&s, h.shrink))
        add_pulls(&pulls, crushing_change(&h, c, &d, turned));
    add_to_points(work, g, &pulls);
}

static void group_sums(struct work *work, const struct group *g)
{
    const struct spans s = spans_of(work->position, g), speed = spans_of(work->velocity, g);
    lanes rest[4];
    rest_of(work, g, rest);
    const struct hinge h = hinge_of(&s, rest);
    const lanes rate = rate_of(&h, &speed), energy = h.kept * bent(&h),
                power = work->damping * h.kept * weight_of(&h) * rate * rate;
    for (int i = 0; i < g->count; i++) {
        work->sums.energy += energy[i];
        work->sums.power += power[i];
    }
}

typedef void group_handler(struct work *work, const struct group *g);

/* Puts a hinge into the group, if it is there, and hands the group over when it is full. */
INLINE void take(const struct bending_view *view, struct group *g, uint32_t edge, struct work *work,
                 group_handler *handle)
{
    const uint32_t hinge = edge - view->first;
    if (work->crushed ? hinge >= view->count || !work->crushed[hinge] : !bending_holds(view, edge))
        return;
    g->hinge[g->count] = hinge;
    bending_points(view, edge, g->point[g->count++]);
    if (g->count == 4) {
        handle(work, g);
        g->count = 0;
    }
}

/* What is left of them. */
INLINE void take_last(struct group *g, struct work *work, group_handler *handle)
{
    for (int i = g->count; i < 4; i++) {
        g->hinge[i] = g->hinge[0];
        for (int k = 0; k < 4; k++)
            g->point[i][k] = g->point[0][k];
    }
    if (g->count > 0)
        handle(work, g);
}

/* The last part's hinges are those of its triangles' sides, each once: with its first triangle, or with the
 * second where that one alone has new points. */
static void each_late_group(const struct sim *sim, const struct sim_part *part, struct work *work,
                            group_handler *handle)
{
    const struct sim_balloon *b = part->balloon;
    const struct bending_view view = bending_look(sim, b);
    struct group g = {.count = 0};
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t triangle = part->triangle_in[i] - b->triangle_begin,
                           edge = view.triangle_edge[triangle][k], hinge = edge - b->edge_begin;
            if (hinge >= b->bending->count)
                continue;
            const uint32_t first = b->bending->corners[hinge].triangle[0];
            if (triangle == first || !b->topology->late_triangle[first])
                take(&view, &g, edge, work, handle);
        }
    take_last(&g, work, handle);
}

/* All the hinges that reach into the part, in an order that does not depend on how points are shared out. */
INLINE void each_group(const struct sim *sim, const struct sim_part *part, struct work *work,
                       group_handler *handle)
{
    const struct sim_balloon *b = part->balloon;
    work->begin = part->point_begin;
    work->own = part->point_end - part->point_begin;
    if (b->topology && part == b->topology->tail) {
        each_late_group(sim, part, work, handle);
        return;
    }
    const struct bending_reach *reach = &b->bending->reach[part - sim->parts];
    const struct bending_view view = bending_look(sim, b);
    struct group g = {.count = 0};
    for (uint32_t i = 0; i < reach->before; i++)
        take(&view, &g, reach->hinge[i], work, handle);
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++)
        take(&view, &g, e, work, handle);
    for (uint32_t i = reach->before; i < reach->count; i++)
        take(&view, &g, reach->hinge[i], work, handle);
    take_last(&g, work, handle);
}

static void forces(struct sim *sim, const struct sim_part *part, bool crushed)
{
    double *range = &part->balloon->bending->range[part - sim->parts];
    add_forces(sim, part);
    if (!crushed)
        return;
    struct work work = work_of(sim, part->balloon);
    work.out = sim->rows.force;
    work.crushed = part->balloon->bending->passes.hinge_crushed;
    each_group(sim, part, &work, crushed_forces);
    *range = fmax(*range, lanes_largest(work.range));
}

static void product(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product)
{
    struct work work = work_of(sim, part->balloon);
    work.out = (row *)product->out;
    work.product = product;
    each_group(sim, part, &work, group_product);
}

static struct bending_sums sums(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin,
                                uint32_t end)
{
    struct work work = work_of(sim, balloon);
    const struct bending_view view = bending_look(sim, balloon);
    struct group g = {.count = 0};
    for (uint32_t e = begin; e < end; e++)
        take(&view, &g, e, &work, group_sums);
    take_last(&g, &work, group_sums);
    return work.sums;
}

extern const struct bending_kernels SIM_BENDING;
const struct bending_kernels SIM_BENDING = {chunk_triangles, hinge_pulls, forces, product, sums};
