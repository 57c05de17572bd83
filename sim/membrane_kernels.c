/*
 * A membrane's forces, energies and derivatives, four triangles at a time (lanes.h). Compiled once for each
 * set of instructions: SIM_MEMBRANE is the name of the table at the end. The formulas are in membrane.h.
 */
#include "sim/membrane_kernels.h"
#include "sim/membrane_response.h"

#include <string.h>

/* Up to four active triangles, the last ones filled up with the first. */
struct group {
    uint32_t triangle[4];
    int count;
};

struct tables {
    const row *position, *velocity;
    const uint32_t (*point)[3];
    const unsigned char *active;
    const row *rest;
    uint32_t first; /* the triangle that rest begins with */
    const struct membrane_law *law;
    double viscosity; /* over mu */
};

INLINE struct tables tables_of(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct membrane *m = balloon->membrane;
    return (struct tables){sim->rows.position,
                           sim->rows.velocity,
                           (const uint32_t(*)[3])sim->triangle_point,
                           sim->triangle_active,
                           (const row *)m->rest,
                           balloon->triangle_begin,
                           &m->law,
                           m->viscosity / m->modulus};
}

/* The sides of four triangles from their first corners, by any rows of points. */
struct sides {
    struct lanes3 d1, d2;
};

INLINE struct sides sides_of(const struct tables *t, const row *rows, const struct group *g)
{
    row d1[4], d2[4];
    for (int i = 0; i < 4; i++) {
        const uint32_t *p = t->point[g->triangle[i]];
        d1[i] = rows[p[1]] - rows[p[0]];
        d2[i] = rows[p[2]] - rows[p[0]];
    }
    return (struct sides){lanes_of_rows(d1), lanes_of_rows(d2)};
}

/* A symmetric 2 x 2 matrix. */
struct square {
    lanes xx, xy, yy;
};

/* Four triangles as they are. */
struct skin {
    struct square g, m;  /* G and M of membrane.h */
    lanes det_m, volume; /* volume: mu V */
    struct stretched stretched;
};

INLINE struct skin skin_of(const struct tables *t, const struct group *g, const struct sides *d)
{
    row in[4], rest[4];
    for (int i = 0; i < 4; i++)
        in[i] = t->rest[g->triangle[i] - t->first];
    lanes_turn(in, rest);
    const lanes b0 = (lanes)rest[0], b1 = (lanes)rest[1], b2 = (lanes)rest[2];
    struct skin s = {.g = {lanes_dot(d->d1, d->d1), lanes_dot(d->d1, d->d2), lanes_dot(d->d2, d->d2)},
                     .m = {b0 * b0 + b1 * b1, b1 * b2, b2 * b2},
                     .det_m = b0 * b0 * (b2 * b2),
                     .volume = (lanes)rest[3]};
    const lanes c11 = b0 * b0 * s.g.xx, c12 = b0 * (b1 * s.g.xx + b2 * s.g.xy),
                c22 = b1 * (b1 * s.g.xx + 2 * b2 * s.g.xy) + b2 * b2 * s.g.yy;
    s.stretched = (struct stretched){.a = c11 + c22,
                                     .d = s.det_m * (s.g.xx * s.g.yy - s.g.xy * s.g.xy),
                                     .gap = (c11 - c22) * (c11 - c22) + 4 * c12 * c12};
    return s;
}

/* dG/dt, or its change along a direction: e are the changes of the sides d. */
INLINE struct square change_of_g(const struct sides *d, const struct sides *e)
{
    return (struct square){2 * lanes_dot(d->d1, e->d1), lanes_dot(d->d1, e->d2) + lanes_dot(d->d2, e->d1),
                           2 * lanes_dot(d->d2, e->d2)};
}

INLINE struct square between(struct square m, struct square h) /* M H M */
{
    const lanes xx = m.xx * h.xx + m.xy * h.xy, xy = m.xx * h.xy + m.xy * h.yy,
                yx = m.xy * h.xx + m.yy * h.xy, yy = m.xy * h.xy + m.yy * h.yy;
    return (struct square){xx * m.xx + xy * m.xy, xx * m.xy + xy * m.yy, yx * m.xy + yy * m.yy};
}

INLINE lanes no_less(lanes a) /* a divisor, also where all corners meet */
{
    return lanes_max(a, lanes_all(1e-12));
}

/* K = s M + u cof G. */
INLINE struct square stiffness_of(const struct skin *k, lanes s, lanes u)
{
    return (struct square){s * k->m.xx + u * k->g.yy, s * k->m.xy - u * k->g.xy, s * k->m.yy + u * k->g.xx};
}

INLINE struct square viscous_of(const struct tables *t, const struct skin *k, struct square rate)
{
    const lanes c = -t->viscosity * k->volume / no_less(k->stretched.a);
    const struct square n = between(k->m, rate);
    return (struct square){c * n.xx, c * n.xy, c * n.yy};
}

INLINE void add(struct square *a, struct square b)
{
    a->xx += b.xx;
    a->xy += b.xy;
    a->yy += b.yy;
}

/* Whose points are added to: a part's; or any, since all are. */
struct reach {
    bool all;
    uint32_t begin, count;
};

INLINE struct reach reach_of(const struct sim_part *part)
{
    return (struct reach){false, part->point_begin, part->point_end - part->point_begin};
}

INLINE bool reaches(const struct reach *to, uint32_t point)
{
    return to->all || point - to->begin < to->count;
}

/* Adds K d to the rows of the triangles' corners, one triangle after the other; those of other parts' points
 * are left out, unless it is known when this is compiled that there are none. */
INLINE void add_to_corners(const struct tables *t, const struct group *g, struct lanes3 f1, struct lanes3 f2,
                           const struct reach *to, row *out)
{
    row at1[4], at2[4];
    lanes_to_rows(f1, at1);
    lanes_to_rows(f2, at2);
    for (int i = 0; i < g->count; i++) {
        const uint32_t *p = t->point[g->triangle[i]];
        const size_t a = p[0], b = p[1], c = p[2];
        if (reaches(to, p[0]))
            out[a] -= at1[i] + at2[i];
        if (reaches(to, p[1]))
            out[b] += at1[i];
        if (reaches(to, p[2]))
            out[c] += at2[i];
    }
}

/* What all the loops go by: forces of a group, or something else of it. `kind` and `viscous` are
 * known when it is compiled. */
INLINE void group_forces(const struct tables *t, const struct group *g, enum membrane_kind kind, bool viscous,
                         const struct reach *to, row *force, struct stretched *range)
{
    const struct sides d = sides_of(t, t->position, g);
    const struct skin k = skin_of(t, g, &d);
    const struct response w = membrane_response(t->law, kind, k.stretched, RESPONSE_FIRST);
    struct square stiff = stiffness_of(&k, -2 * k.volume * w.a, -2 * k.volume * k.det_m * w.d);
    if (viscous) {
        const struct sides v = sides_of(t, t->velocity, g);
        add(&stiff, viscous_of(t, &k, change_of_g(&d, &v)));
    }
    add_to_corners(t, g, lanes_sum(stiff.xx, d.d1, stiff.xy, d.d2), lanes_sum(stiff.xy, d.d1, stiff.yy, d.d2),
                   to, force);
    range->a = lanes_max(range->a, k.stretched.a);
    range->d = lanes_min(range->d, k.stretched.d);
}

/* A way through triangles: first those of a list, then those from `next` on. */
struct walk {
    const uint32_t *list;
    uint32_t listed, next, end;
};

/* The next four triangles that are active; false when there are none. */
INLINE bool next_group(struct walk *walk, const unsigned char *active, struct group *g)
{
    g->count = 0;
    while (g->count < 4 && (walk->listed || walk->next < walk->end)) {
        uint32_t triangle;
        if (walk->listed) {
            triangle = *walk->list++;
            walk->listed--;
        } else {
            triangle = walk->next++;
        }
        if (active[triangle])
            g->triangle[g->count++] = triangle;
    }
    for (int i = g->count; i < 4; i++)
        g->triangle[i] = g->triangle[0];
    return g->count > 0;
}

/* The forces of the triangles on such a way, one by one where they lie anyhow. */
static void walk_forces(struct sim *sim, const struct sim_part *part, struct walk walk,
                        struct stretched *range)
{
    const struct tables t = tables_of(sim, part->balloon);
    const struct reach own = reach_of(part);
    struct group g;
    while (next_group(&walk, t.active, &g))
        group_forces(&t, &g, t.law->kind, t.viscosity > 0, &own, sim->rows.force, range);
}

/* The same of a chunk's own, most of which follow each other by fours that are active and have
 * all points in the part. */
INLINE void chunk_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                         enum membrane_kind kind, bool viscous, struct stretched *range)
{
    const struct tables t = tables_of(sim, part->balloon);
    const struct reach all = {.all = true};
    const uint32_t inner_end = chunk->triangle_inner_end;
    uint32_t i = chunk->triangle_begin;
    for (; inner_end - i >= 4; i += 4)
        if (four_are_set(&t.active[i])) {
            const struct group g = {.triangle = {i, i + 1, i + 2, i + 3}, .count = 4};
            group_forces(&t, &g, kind, viscous, &all, sim->rows.force, range);
        } else {
            walk_forces(sim, part, (struct walk){.next = i, .end = i + 4}, range);
        }
    walk_forces(sim, part, (struct walk){.next = i, .end = chunk->triangle_end}, range);
}

static void coming_forces(struct sim *sim, const struct sim_part *part)
{
    struct stretched range = {.d = lanes_all(INFINITY)}; /* their own part takes it down */
    walk_forces(sim, part, (struct walk){.list = part->triangle_in, .listed = part->triangle_in_count},
                &range);
    double *kept = part->balloon->membrane->range[part - sim->parts];
    kept[0] = 0;
    kept[1] = INFINITY;
}

static void forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    const struct membrane *m = part->balloon->membrane;
    const bool viscous = m->viscosity > 0;
    double *kept = m->range[part - sim->parts];
    struct stretched range = {.a = lanes_all(kept[0]), .d = lanes_all(kept[1])};
    if (m->law.kind == MEMBRANE_OGDEN)
        chunk_forces(sim, part, chunk, MEMBRANE_OGDEN, viscous, &range);
    else if (m->law.kind == MEMBRANE_GENT)
        chunk_forces(sim, part, chunk, MEMBRANE_GENT, viscous, &range);
    else if (viscous)
        chunk_forces(sim, part, chunk, MEMBRANE_NEO_HOOKEAN, true, &range);
    else
        chunk_forces(sim, part, chunk, MEMBRANE_NEO_HOOKEAN, false, &range);
    kept[0] = fmax(fmax(range.a[0], range.a[1]), fmax(range.a[2], range.a[3]));
    kept[1] = fmin(fmin(range.d[0], range.d[1]), fmin(range.d[2], range.d[3]));
}

/* With df = K dd + dK d: dK = ds M + du cof G + u cof dG, and that of the damping, c N: c =
 * -V eta/a, N = M dG/dt M. */
INLINE void group_product(const struct tables *t, const struct group *g, enum membrane_kind kind,
                          const struct reach *to, const struct jacobian_product *product)
{
    const struct sides d = sides_of(t, t->position, g);
    struct sides e = sides_of(t, (const row *)product->dx, g);
    const lanes a = lanes_all(product->a), none = lanes_all(0);
    e = (struct sides){lanes_sum(a, e.d1, none, e.d1), lanes_sum(a, e.d2, none, e.d2)};
    const struct skin k = skin_of(t, g, &d);
    const struct response w = membrane_response(t->law, kind, k.stretched, RESPONSE_SECOND);
    const struct square dg = change_of_g(&d, &e);
    const lanes da = k.m.xx * dg.xx + 2 * k.m.xy * dg.xy + k.m.yy * dg.yy,
                dd = k.det_m * (k.g.yy * dg.xx - 2 * k.g.xy * dg.xy + k.g.xx * dg.yy);
    const lanes v2 = -2 * k.volume, u = v2 * k.det_m * w.d;
    struct square stiff = stiffness_of(&k, v2 * w.a, u);
    struct square change = stiffness_of(&k, v2 * (w.aa * da + w.ad * dd),
                                        v2 * k.det_m * (w.ad * da + w.dd * dd));
    add(&change, (struct square){u * dg.yy, -u * dg.xy, u * dg.xx});
    if (t->viscosity > 0) {
        const struct sides v = sides_of(t, t->velocity, g);
        struct sides r = sides_of(t, (const row *)product->dv, g);
        const lanes b = lanes_all(product->b);
        r = (struct sides){lanes_sum(b, r.d1, none, r.d1), lanes_sum(b, r.d2, none, r.d2)};
        const struct square now = viscous_of(t, &k, change_of_g(&d, &v));
        const lanes fall = -da / no_less(k.stretched.a);
        struct square rate = change_of_g(&d, &r);
        add(&rate, change_of_g(&e, &v));
        add(&stiff, now);
        add(&change, viscous_of(t, &k, rate));
        add(&change, (struct square){fall * now.xx, fall * now.xy, fall * now.yy});
    }
    struct lanes3 f1 = lanes_sum(stiff.xx, e.d1, stiff.xy, e.d2),
                  f2 = lanes_sum(stiff.xy, e.d1, stiff.yy, e.d2);
    const struct lanes3 more1 = lanes_sum(change.xx, d.d1, change.xy, d.d2),
                        more2 = lanes_sum(change.xy, d.d1, change.yy, d.d2);
    const lanes one = lanes_all(1);
    f1 = lanes_sum(one, f1, one, more1);
    f2 = lanes_sum(one, f2, one, more2);
    add_to_corners(t, g, f1, f2, to, (row *)product->out);
}

static void product(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product)
{
    const struct tables t = tables_of(sim, part->balloon);
    const struct reach own = reach_of(part);
    struct walk walk = {part->triangle_in, part->triangle_in_count, part->triangle_begin, part->triangle_end};
    struct group g;
    while (next_group(&walk, t.active, &g))
        group_product(&t, &g, t.law->kind, &own, product);
}

INLINE lanes group_energy(const struct tables *t, const struct group *g)
{
    const struct sides d = sides_of(t, t->position, g);
    const struct skin k = skin_of(t, g, &d);
    return membrane_response(t->law, t->law->kind, k.stretched, RESPONSE_ENERGY).energy;
}

static double energy(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin, uint32_t end,
                     double *each)
{
    const struct tables t = tables_of(sim, balloon);
    struct walk walk = {.next = begin, .end = end};
    struct group g;
    double sum = 0;
    if (each)
        memset(each, 0, (end - begin) * sizeof *each);
    while (next_group(&walk, t.active, &g)) {
        const lanes w = group_energy(&t, &g);
        double four = 0;
        for (int i = 0; i < g.count; i++) {
            four += w[i] * t.rest[g.triangle[i] - t.first][3];
            if (each)
                each[g.triangle[i] - begin] = w[i];
        }
        sum += four;
    }
    return sum;
}

/* V eta |dC/dt|^2 / (2 a), |dC/dt|^2 = the trace of H M H M, H = dG/dt. */
static double take_dissipation(const struct tables *t, const struct group *g)
{
    const struct sides d = sides_of(t, t->position, g), v = sides_of(t, t->velocity, g);
    const struct skin k = skin_of(t, g, &d);
    const struct square h = change_of_g(&d, &v), stress = viscous_of(t, &k, h);
    const lanes power = -.5 * (stress.xx * h.xx + 2 * stress.xy * h.xy + stress.yy * h.yy);
    double sum = 0;
    for (int i = 0; i < g->count; i++)
        sum += power[i];
    return sum;
}

static double dissipation(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin,
                          uint32_t end)
{
    const struct tables t = tables_of(sim, balloon);
    struct walk walk = {.next = begin, .end = end};
    struct group g;
    double sum = 0;
    while (next_group(&walk, t.active, &g))
        sum += take_dissipation(&t, &g);
    return sum;
}

static struct membrane_response respond(const struct membrane_law *law, double a, double d, double gap)
{
    const struct stretched s = {lanes_all(a), lanes_all(d), lanes_all(gap)};
    const struct response w = membrane_response(law, law->kind, s,
                                                RESPONSE_ENERGY | RESPONSE_FIRST | RESPONSE_SECOND);
    return (struct membrane_response){w.energy[0], w.a[0], w.d[0], w.aa[0], w.ad[0], w.dd[0]};
}

extern const struct membrane_kernels SIM_MEMBRANE;
const struct membrane_kernels SIM_MEMBRANE = {coming_forces, forces, product, energy, dissipation, respond};
