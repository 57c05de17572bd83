/*
 * Formulas of hinges (bending.h), of four at once: for their kernels, which are compiled once for
 * each set of instructions.
 */
#ifndef SIM_BENDING_HINGE_H
#define SIM_BENDING_HINGE_H

#include "sim/lanes.h"

INLINE struct lanes3 times(lanes factor, struct lanes3 a)
{
    return (struct lanes3){factor * a.x, factor * a.y, factor * a.z};
}

INLINE struct lanes3 plus(struct lanes3 a, struct lanes3 b)
{
    return (struct lanes3){a.x + b.x, a.y + b.y, a.z + b.z};
}

/* a - factor b */
INLINE struct lanes3 less(struct lanes3 a, lanes factor, struct lanes3 b)
{
    return (struct lanes3){a.x - factor * b.x, a.y - factor * b.y, a.z - factor * b.z};
}

/* From x0 to x1, x2 and x3, of places, speeds or changes. */
struct spans {
    struct lanes3 e, d2, d3;
};

/* One side of four hinges: its triangle. */
struct wing {
    struct lanes3 n;
    lanes inverse; /* 1/|n|^2 */
    lanes lever;   /* |e|/|n|^2: the gradient of the angle is -lever n */
    lanes along;   /* a2 or a3 */
    lanes left;    /* r, at most 1 */
};

/* Four hinges as they are. */
struct hinge {
    struct spans at;
    struct wing wing[2];
    lanes square, inverse_square; /* |e|^2 and 1 over it */
    lanes rest_cosine, rest_sine; /* w times those of t0 */
    lanes cosine, sine;           /* w times those of t - t0 */
    lanes kept;                   /* r (2 - r) of both */
    lanes shrink, at_rest;        /* dr/d|n|^2; 1/slope at rest */
};

INLINE lanes no_less(lanes a) /* a divisor, also where points meet */
{
    return lanes_max(a, lanes_all(1e-90));
}

INLINE bool any_is_crushed(const struct spans *s, lanes shrink)
{
    const struct lanes3 n1 = lanes_cross(s->e, s->d2), n2 = lanes_cross(s->d3, s->e);
    return lanes_any((lane_mask)(lanes_min(lanes_dot(n1, n1), lanes_dot(n2, n2)) * shrink < 1));
}

/* `rest` is what struct bending keeps of each. */
INLINE struct hinge hinge_of(const struct spans *s, const lanes rest[4])
{
    struct hinge h = {.at = *s,
                      .square = no_less(lanes_dot(s->e, s->e)),
                      .rest_cosine = rest[0],
                      .rest_sine = rest[1],
                      .shrink = rest[2],
                      .at_rest = rest[3]};
    const struct lanes3 n1 = lanes_cross(s->e, s->d2), n2 = lanes_cross(s->d3, s->e);
    const lanes q1 = no_less(lanes_dot(n1, n1)), q2 = no_less(lanes_dot(n2, n2));
    const lanes r1 = lanes_min(q1 * h.shrink, lanes_all(1)), r2 = lanes_min(q2 * h.shrink, lanes_all(1));
    h.kept = r1 * (2 - r1) * (r2 * (2 - r2));
    const lanes product = q1 * q2, i = 1 / (product * h.square), i12 = i * h.square; /* one division */
    const lanes i1 = i12 * q2, i2 = i12 * q1, inverse = lanes_sqrt(i12), length = lanes_sqrt(h.square);
    h.inverse_square = i * product;
    h.wing[0] = (struct wing){n1, i1, length * i1, lanes_dot(s->d2, s->e) * h.inverse_square, r1};
    h.wing[1] = (struct wing){n2, i2, length * i2, lanes_dot(s->d3, s->e) * h.inverse_square, r2};
    const lanes cosine = lanes_dot(n1, n2) * inverse, sine = -length * lanes_dot(n1, s->d3) * inverse;
    h.cosine = cosine * h.rest_cosine + sine * h.rest_sine;
    h.sine = sine * h.rest_cosine - cosine * h.rest_sine;
    return h;
}

INLINE lanes weight_of(const struct hinge *h) /* w */
{
    return lanes_sqrt(h->rest_cosine * h->rest_cosine + h->rest_sine * h->rest_sine);
}

/* w (1 - cos(t - t0)), to all its digits also where that is small. */
INLINE lanes bent(const struct hinge *h)
{
    const lanes w = weight_of(h);
    return lanes_select((lane_mask)(h->cosine > 0), h->sine * h->sine / (w + h->cosine), w - h->cosine);
}

/* Of one wing: its own part of dt/dt, as its points move with these speeds. */
INLINE lanes wing_rate(const struct wing *w, struct lanes3 d, struct lanes3 e)
{
    return -w->lever * lanes_dot(w->n, less(d, w->along, e));
}

INLINE lanes rate_of(const struct hinge *h, const struct spans *speed)
{
    return wing_rate(&h->wing[0], speed->d2, speed->e) + wing_rate(&h->wing[1], speed->d3, speed->e);
}

/* The sum of squares of the angle's gradients, at the most, over that at rest. */
INLINE lanes slope_of(const struct hinge *h)
{
    lanes slope = lanes_all(0);
    for (int i = 0; i < 2; i++) {
        const struct wing *w = &h->wing[i];
        slope += w->inverse * (3 + 4 * w->along * (w->along - 1)); /* 1 + 2 a^2 + 2 (1 - a)^2 */
    }
    return h->kept * slope * (h->at_rest * h->square);
}

/* What acts on x1, x2 and x3; on x0 what balances it. */
struct pulls {
    struct lanes3 f[3];
};

INLINE void add_pulls(struct pulls *pulls, struct pulls more)
{
    for (int k = 0; k < 3; k++)
        pulls->f[k] = plus(pulls->f[k], more.f[k]);
}

/* Of a torque. */
INLINE struct pulls torque_pulls(const struct hinge *h, lanes torque)
{
    const struct wing *a = &h->wing[0], *b = &h->wing[1];
    const struct lanes3 f2 = times(torque * a->lever, a->n), f3 = times(torque * b->lever, b->n);
    return (struct pulls){{lanes_sum(-a->along, f2, -b->along, f3), f2, f3}};
}

/* Twice -dE/d|n|^2 of a wing, from its r and the other's. */
INLINE lanes push_of(const struct hinge *h, lanes energy, lanes left, lanes other)
{
    return -2 * energy * (other * (2 - other)) * (2 - 2 * left) * h->shrink;
}

/* The forces by which r (2 - r) changes: d|n1|^2 = 2 (n1 x e).d(d2) + 2 (d2 x n1).de, and
 * likewise of n2 = d3 x e. */
INLINE struct pulls crushing_pulls(const struct hinge *h)
{
    const lanes energy = bent(h), a = push_of(h, energy, h->wing[0].left, h->wing[1].left),
                b = push_of(h, energy, h->wing[1].left, h->wing[0].left);
    const struct lanes3 n1 = h->wing[0].n, n2 = h->wing[1].n;
    return (struct pulls){{lanes_sum(a, lanes_cross(h->at.d2, n1), b, lanes_cross(n2, h->at.d3)),
                           times(a, lanes_cross(n1, h->at.e)), times(b, lanes_cross(h->at.e, n2))}};
}

/* How a wing changes as its points move. */
struct wing_change {
    struct lanes3 n;
    lanes lever, along, left, rate; /* rate: of its part of the angle */
    lanes growth;                   /* d|n|/|n| */
};

INLINE struct wing_change change_of(const struct wing *w, struct lanes3 n, struct lanes3 d, struct lanes3 e,
                                    struct lanes3 dd, struct lanes3 de, lanes inverse_square, lanes longer)
{
    struct wing_change c = {.n = n, .growth = lanes_dot(w->n, n) * w->inverse};
    c.lever = w->lever * (longer - 2 * c.growth);
    c.along = (lanes_dot(dd, e) + lanes_dot(d, de)) * inverse_square - 2 * w->along * longer;
    c.left = lanes_select((lane_mask)(w->left < 1), 2 * w->left * c.growth, lanes_all(0));
    c.rate = wing_rate(w, dd, de);
    return c;
}

INLINE void wing_changes(const struct hinge *h, const struct spans *d, struct wing_change c[2])
{
    const struct spans *s = &h->at;
    const lanes longer = lanes_dot(s->e, d->e) * h->inverse_square;
    const struct lanes3 n1 = plus(lanes_cross(d->e, s->d2), lanes_cross(s->e, d->d2)),
                        n2 = plus(lanes_cross(d->d3, s->e), lanes_cross(s->d3, d->e));
    c[0] = change_of(&h->wing[0], n1, s->d2, s->e, d->d2, d->e, h->inverse_square, longer);
    c[1] = change_of(&h->wing[1], n2, s->d3, s->e, d->d3, d->e, h->inverse_square, longer);
}

/* By how much wing_rate() changes while the speeds stay. */
INLINE lanes rate_change(const struct wing *w, const struct wing_change *c, struct lanes3 d, struct lanes3 e)
{
    const struct lanes3 across = less(d, w->along, e);
    return -c->lever * lanes_dot(w->n, across) -
           w->lever * (lanes_dot(c->n, across) - c->along * lanes_dot(w->n, e));
}

/* Changes of crushing_pulls(); `turned` is that of the angle. */
INLINE struct pulls crushing_change(const struct hinge *h, const struct wing_change c[2],
                                    const struct spans *d, lanes turned)
{
    const lanes energy = bent(h), gain = h->sine * turned;
    lanes push[2], change[2];
    for (int i = 0; i < 2; i++) {
        const lanes left = h->wing[i].left, other = h->wing[1 - i].left;
        push[i] = push_of(h, energy, left, other);
        change[i] = push_of(h, gain, left, other) - 2 * energy * h->shrink *
                                                        ((2 - 2 * other) * c[1 - i].left * (2 - 2 * left) -
                                                         other * (2 - other) * 2 * c[i].left);
    }
    const struct spans *at = &h->at;
    const struct lanes3 n1 = h->wing[0].n, n2 = h->wing[1].n;
    const struct lanes3 by_n1 = plus(lanes_cross(d->d2, n1), lanes_cross(at->d2, c[0].n)),
                        by_n2 = plus(lanes_cross(c[1].n, at->d3), lanes_cross(n2, d->d3));
    return (struct pulls){
        {plus(lanes_sum(change[0], lanes_cross(at->d2, n1), change[1], lanes_cross(n2, at->d3)),
              lanes_sum(push[0], by_n1, push[1], by_n2)),
         lanes_sum(change[0], lanes_cross(n1, at->e), push[0],
                   plus(lanes_cross(c[0].n, at->e), lanes_cross(n1, d->e))),
         lanes_sum(change[1], lanes_cross(at->e, n2), push[1],
                   plus(lanes_cross(d->e, n2), lanes_cross(at->e, c[1].n)))}};
}

/* Changes of torque_pulls() as the torque changes, and the points move. */
INLINE struct pulls torque_change(const struct hinge *h, const struct wing_change c[2], lanes torque,
                                  lanes change)
{
    const struct pulls now = torque_pulls(h, torque);
    struct pulls out;
    for (int i = 0; i < 2; i++)
        out.f[i + 1] = lanes_sum(change * h->wing[i].lever + torque * c[i].lever, h->wing[i].n,
                                 torque * h->wing[i].lever, c[i].n);
    const struct lanes3 shifted = lanes_sum(-c[0].along, now.f[1], -c[1].along, now.f[2]);
    out.f[0] = plus(shifted, lanes_sum(-h->wing[0].along, out.f[1], -h->wing[1].along, out.f[2]));
    return out;
}

#endif
