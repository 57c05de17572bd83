/*
 * The forces of hinges whose triangles are not crushed (bending.h), four at a time and in three passes, so
 * that what three hinges of a triangle have in common is worked out once. All that they do to a triangle is
 * along its unit normal N, and with its cotangents k_i:
 *
 *     1  of each triangle   N and k_i = d_i.d_i'/|n|, d_i and d_i' the two sides that meet at corner i
 *     2  of each hinge      H = T/|e|, from cos t = N1.N2 and sin t = (N1 x N2).e/|e|
 *     3  on each triangle   the force c_i N on corner i; with H_i of the hinge across from it and i, j, k in turn,
 *                           c_i = k_k (H_i - H_j) + k_j (H_i - H_k)
 *
 * since T |e|/|n| on the far corner is H (k_j + k_k), and what balances it is -H k_k and -H k_j. The c_i add
 * up to nothing. Rates are the same sums the other way round: what a triangle adds to |e| dt/dt is -(k_k (w_i
 * - w_j) + k_j (w_i - w_k)), w = N.v of the corners.
 *
 * Where triangles are crushed, their hinges are left out here.
 */
#ifndef SIM_BENDING_PASSES_H
#define SIM_BENDING_PASSES_H

#include "sim/bending_facets.h"

/* Whether a triangle of the hinge is crushed. */
static bool is_crushed(const struct bending_view *v, const row *position, uint32_t edge)
{
    uint32_t p[4];
    bending_points(v, edge, p);
    const row e = position[p[1]] - position[p[0]],
              d[2] = {position[p[2]] - position[p[0]], position[p[3]] - position[p[0]]};
    double least = INFINITY;
    for (int i = 0; i < 2; i++) {
        const double x = e[1] * d[i][2] - e[2] * d[i][1], y = e[2] * d[i][0] - e[0] * d[i][2],
                     z = e[0] * d[i][1] - e[1] * d[i][0], square = x * x + y * y + z * z;
        least = square < least ? square : least;
    }
    return least * v->shrink[edge - v->first] < 1;
}

/* What the second pass works with; tables of edges begin with the balloon's first. */
struct hinge_work {
    const row *position, *normal;
    const uint32_t (*point)[2];
    const unsigned char *active;
    const struct bending_corners *corners;
    const double *cosine, *sine, *at_rest, *swing[3];
    double *pull;
    double damping;
    const double *shrink;
    unsigned char *crushed; /* becomes 1 of a hinge with a crushed triangle, else 0; NULL: no triangle is */
    bool cut;
};

INLINE struct hinge_work hinge_work_of(const struct sim *sim, const struct sim_balloon *b, bool crushed,
                                       bool cut)
{
    const struct bending *h = b->bending;
    const struct bending_passes *p = &h->passes;
    return (struct hinge_work){.position = sim->rows.position,
                               .normal = (const row *)p->normal,
                               .point = (const uint32_t(*)[2])sim->edge_point + b->edge_begin,
                               .active = sim->edge_active + b->edge_begin,
                               .corners = h->corners,
                               .cosine = h->rest[0],
                               .sine = h->rest[1],
                               .at_rest = h->rest[3],
                               .swing = {p->swing[0], p->swing[1], p->swing[2]},
                               .pull = sim->hinge_pull + b->edge_begin,
                               .damping = h->damping,
                               .shrink = h->rest[2],
                               .crushed = crushed ? p->hinge_crushed : NULL,
                               .cut = cut};
}

struct folds {
    lanes pull, slope;
    lane_mask doubtful; /* may be crushed; where any triangle is */
};

/* What damping takes from the pull: w damping dt/dt/|e|, where both triangles are there. */
INLINE lanes slowed(const struct hinge_work *w, const size_t hinge[4], lane_mask both, lanes cosine,
                    lanes sine, lanes inverse)
{
    lanes swing = lanes_all(0);
    for (int i = 0; i < 4; i++) {
        const struct bending_corners *c = &w->corners[hinge[i]];
        swing[i] = w->swing[c->corner[0]][c->triangle[0]] + w->swing[c->corner[1]][c->triangle[1]];
    }
    return lanes_select(both, w->damping * lanes_sqrt(cosine * cosine + sine * sine) * swing * inverse,
                        lanes_all(0));
}

/* Of four hinges. The slope is that of slope_of(): of a side l of three, (1 + 2 a^2 + 2 (1 - a)^2) l^2/|n|^2
 * = (2 S - l^2)/|n|^2 - 4/l^2, S the sum of the squares of all three. */
INLINE struct folds folds_of(const struct hinge_work *w, const size_t hinge[4], bool damped)
{
    row side[4], one[4], other[4], n1[4], n2[4];
    for (int i = 0; i < 4; i++) {
        const size_t h = hinge[i];
        side[i] = w->position[w->point[h][1]] - w->position[w->point[h][0]];
        one[i] = w->normal[w->corners[h].triangle[0]];
        other[i] = w->normal[w->corners[h].triangle[1]];
    }
    lanes_turn(one, n1);
    lanes_turn(other, n2);
    const struct lanes3 e = lanes_of_rows(side), a = {(lanes)n1[0], (lanes)n1[1], (lanes)n1[2]},
                        b = {(lanes)n2[0], (lanes)n2[1], (lanes)n2[2]};
    const lanes cosine = of_four(w->cosine, hinge), sine = of_four(w->sine, hinge),
                square = no_less(lanes_dot(e, e)), inverse = 1 / square;
    struct folds f = {.pull = lanes_dot(lanes_cross(a, b), e) * inverse * cosine -
                              lanes_dot(a, b) * lanes_sqrt(inverse) * sine};
    const lanes high1 = packed_high((lanes)n1[3]), high2 = packed_high((lanes)n2[3]),
                low = packed_low((lanes)n1[3]) + packed_low((lanes)n2[3]);
    const lane_mask both = lanes_min(high1, high2) > 0;
    if (damped)
        f.pull -= slowed(w, hinge, both, cosine, sine, inverse);
    f.slope = lanes_select(both, (low - square * (high1 + high2) - 8 * inverse) * of_four(w->at_rest, hinge),
                           lanes_all(0));
    if (w->crushed)
        f.doubtful = (lanes_min(high1, high2) == 0) |
                     (lanes_max(high1, high2) > 0.999 * of_four(w->shrink, hinge));
    return f;
}

/* Those of the hinges from `first` on that are not there, or crushed, pull at nothing, and what only fills up
 * the four of them is none: the guard must not go by it, which is another one for each number of parts. */
static __attribute__((noinline)) void leave_out(const struct hinge_work *w, const struct bending_view *v,
                                                uint32_t first, size_t count, struct folds *f)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t edge = v->first + first + i;
        const bool holds = bending_holds(v, edge),
                   crushed = holds && w->crushed && is_crushed(v, w->position, edge);
        if (!holds || crushed)
            f->pull[i] = f->slope[i] = 0;
        if (w->crushed)
            w->crushed[first + i] = crushed;
    }
    for (size_t i = count; i < 4; i++)
        f->slope[i] = 0;
}

/* Returns the slopes. */
INLINE lanes put_pulls(const struct hinge_work *w, const struct bending_view *v, size_t first, size_t count,
                       bool damped)
{
    size_t hinge[4];
    list_four(first, count, hinge);
    struct folds f = folds_of(w, hinge, damped);
    if (w->cut || count < 4 || !four_are_set(&w->active[first]) || (w->crushed && lanes_any(f.doubtful)))
        leave_out(w, v, (uint32_t)first, count, &f);
    else if (w->crushed)
        memset(w->crushed + first, 0, count);
    put_four(f.pull, w->pull + first, count);
    return f.slope;
}

INLINE double put_all_pulls(struct sim *sim, const struct sim_part *part, bool crushed, bool damped)
{
    const struct bending_view view = bending_look(sim, part->balloon);
    const struct hinge_work w = hinge_work_of(sim, part->balloon, crushed, view.cut);
    const uint32_t all = part->edge_end - view.first;
    const size_t end = all < view.count ? all : view.count;
    size_t h = part->edge_begin - view.first;
    lanes most = lanes_all(0);
    for (; h + 4 <= end; h += 4)
        most = lanes_max(put_pulls(&w, &view, h, 4, damped), most);
    if (h < end)
        most = lanes_max(put_pulls(&w, &view, h, end - h, damped), most);
    return lanes_largest(most);
}

static void hinge_pulls(struct sim *sim, const struct sim_part *part, bool crushed)
{
    struct bending *b = part->balloon->bending;
    b->range[part - sim->parts] = b->damping > 0 ? put_all_pulls(sim, part, crushed, true)
                                                 : put_all_pulls(sim, part, crushed, false);
}

/* What the third pass works with; tables of triangles begin with the balloon's first. */
struct pull_work {
    row *force;
    const row *normal;
    const double *cotangent[3];
    const uint32_t (*point)[3], (*edge)[3];
    const double *pull;
};

INLINE struct pull_work pull_work_of(const struct sim *sim, const struct sim_balloon *b)
{
    const struct bending_passes *p = &b->bending->passes;
    return (struct pull_work){.force = sim->rows.force,
                              .normal = (const row *)p->normal,
                              .cotangent = {p->cotangent[0], p->cotangent[1], p->cotangent[2]},
                              .point = (const uint32_t(*)[3])sim->triangle_point + b->triangle_begin,
                              .edge = (const uint32_t(*)[3])sim->triangle_edge + b->triangle_begin,
                              .pull = sim->hinge_pull};
}

/* Of one triangle, the force on those of its points that are the part's. Corner k is
 * across from side k + 1. */
INLINE void add_to_own_corners(const struct pull_work *w, const struct sim_part *part, size_t t)
{
    const double h0 = w->pull[w->edge[t][1]], h1 = w->pull[w->edge[t][2]], h2 = w->pull[w->edge[t][0]];
    const double g0 = w->cotangent[0][t] * (h1 - h2), g1 = w->cotangent[1][t] * (h2 - h0),
                 g2 = w->cotangent[2][t] * (h0 - h1);
    const double c[3] = {g2 - g1, g0 - g2, g1 - g0};
    const row unit = unit_of(w->normal[t]);
    for (int k = 0; k < 3; k++)
        if (w->point[t][k] - part->point_begin < part->point_end - part->point_begin)
            w->force[w->point[t][k]] += c[k] * unit;
}

/* The same of four that follow each other, and all of whose points are the part's. */
INLINE void add_to_corners(const struct pull_work *w, size_t t)
{
    lanes h[3];
    for (int k = 0; k < 3; k++) {
        const int side = (k + 1) % 3;
        h[k] = (lanes){w->pull[w->edge[t][side]], w->pull[w->edge[t + 1][side]],
                       w->pull[w->edge[t + 2][side]], w->pull[w->edge[t + 3][side]]};
    }
    const lanes g0 = lanes_at(w->cotangent[0] + t) * (h[1] - h[2]),
                g1 = lanes_at(w->cotangent[1] + t) * (h[2] - h[0]),
                g2 = lanes_at(w->cotangent[2] + t) * (h[0] - h[1]);
    const lanes c[3] = {g2 - g1, g0 - g2, g1 - g0};
    for (size_t i = 0; i < 4; i++) {
        const row unit = unit_of(w->normal[t + i]);
        for (int k = 0; k < 3; k++)
            w->force[w->point[t + i][k]] += c[k][i] * unit;
    }
}

/* First of triangles that come in from lower parts, then of the part's own: in the same order however
 * points are shared out. */
static void add_forces(struct sim *sim, const struct sim_part *part)
{
    const uint32_t first = part->balloon->triangle_begin;
    const struct pull_work w = pull_work_of(sim, part->balloon);
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        add_to_own_corners(&w, part, part->triangle_in[i] - first);
    for (const struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
        const size_t inner_end = c->triangle_inner_end - first, end = c->triangle_end - first;
        size_t t = c->triangle_begin - first;
        for (; t + 4 <= inner_end; t += 4)
            add_to_corners(&w, t);
        for (; t < end; t++)
            add_to_own_corners(&w, part, t);
    }
}

#endif
