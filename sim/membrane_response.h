/*
 * W(a, D) of a law (membrane_law.h) and its derivatives, of four triangles at once, with wrinkling
 * (membrane.h). For the membrane's kernels, which are compiled once for each set of instructions.
 */
#ifndef SIM_MEMBRANE_RESPONSE_H
#define SIM_MEMBRANE_RESPONSE_H

#include "sim/lanes_math.h"
#include "sim/membrane_law.h"

/* How a triangle is stretched: a, D and (L1^2 - L2^2)^2, which a^2 - 4 D would give with few
 * digits where L1 is near L2. */
struct stretched {
    lanes a, d, gap;
};

/* What of a response is asked for: at compile time, so that nothing else is worked out. */
enum { RESPONSE_ENERGY = 1, RESPONSE_FIRST = 2, RESPONSE_SECOND = 4 };

struct response {
    lanes energy;     /* W / mu */
    lanes a, d;       /* dW/da, dW/dD */
    lanes aa, ad, dd; /* and the second derivatives */
};

INLINE struct response mooney_response(const struct membrane_law *law, struct stretched s, int asked)
{
    const double c1 = law->c1 / 2, c2 = law->c2 / 2;
    const lanes i = 1 / s.d;
    struct response w = {.a = c1 + c2 * i, .d = c2 - (c1 + c2 * s.a) * (i * i)};
    if (asked & RESPONSE_ENERGY)
        w.energy = c1 * (s.a + i - 3) + c2 * (s.d + s.a * i - 3);
    if (asked & RESPONSE_SECOND) {
        w.ad = -c2 * i * i;
        w.dd = 2 * (c1 + c2 * s.a) * (i * i * i);
    }
    return w;
}

/* Past 99 % of its limit W goes on as a parabola in I1: a trial state may be anywhere. */
INLINE struct response gent_response(const struct membrane_law *law, struct stretched s, int asked)
{
    const double last = .99, slope = 1 / (1 - last);
    const lanes i = 1 / s.d, y = (s.a + i - 3) * (1 / law->limit);
    const lanes inner = lanes_min(y, lanes_all(last)), past = y - inner, ratio = 1 / (1 - inner);
    const lanes first = .5 * (ratio + slope * slope * past), second = (.5 / law->limit) * (ratio * ratio);
    struct response w = {.a = first, .d = -first * (i * i)};
    if (asked & RESPONSE_ENERGY)
        w.energy = (.5 * law->limit) * (past * (ratio + .5 * slope * slope * past) - lanes_log(1 - inner));
    if (asked & RESPONSE_SECOND) {
        w.aa = second;
        w.ad = -second * (i * i);
        w.dd = second * (i * i * i * i) + 2 * first * (i * i * i);
    }
    return w;
}

/* T(x) = cosh(v arcosh x), Chebyshev's polynomial with a degree v that need not be whole, and its
 * derivatives. Near x = 1 by its series, whose k-th coefficient is that before times (v^2 - (k-1)^2)/(k (2k -
 * 1)); elsewhere by T' = v sinh(v y)/sinh y and (x^2 - 1) T'' = v^2 T - x T'. z = x - 1, y = arcosh x. */
struct chebyshev {
    lanes value, first, second;
};

INLINE struct chebyshev chebyshev_series(const double *coefficient, lanes z)
{
    const lanes last = lanes_all(coefficient[MEMBRANE_SERIES - 1]);
    struct chebyshev t = {last * z + coefficient[MEMBRANE_SERIES - 2], last, lanes_all(0)};
    for (int k = MEMBRANE_SERIES - 3; k >= 0; k--) { /* Horner's scheme, three at once */
        t.second = t.second * z + 2 * t.first;
        t.first = t.first * z + t.value;
        t.value = t.value * z + coefficient[k];
    }
    return t;
}

/* Up to this z the series will do: what it leaves out is about (2 v^2 z)^9/18!, below 1e-20 for v <= 10. */
#define CHEBYSHEV_NEAR 1e-3

INLINE struct chebyshev chebyshev_far(double v, lanes z, lanes y)
{
    const lanes x = 1 + z, above = lanes_max(z * (2 + z), lanes_all(CHEBYSHEV_NEAR)),
                root = lanes_sqrt(above);
    const lanes grown = lanes_exp(v * y), shrunk = 1 / grown;
    struct chebyshev t = {.value = .5 * (grown + shrunk), .first = (.5 * v) * (grown - shrunk) / root};
    t.second = (v * v * t.value - x * t.first) / above;
    return t;
}

/* x < 1, with cosines: only where both stretches of a crushed triangle are small. One by
 * one, since it is seldom. */
static __attribute__((noinline)) struct chebyshev chebyshev_below(double v, lanes z)
{
    struct chebyshev t = {lanes_all(0), lanes_all(0), lanes_all(0)};
    for (int i = 0; i < 4; i++) {
        const double x = 1 + fmin(z[i], -CHEBYSHEV_NEAR), above = x * x - 1, angle = acos(x);
        t.value[i] = cos(v * angle);
        t.first[i] = v * sin(v * angle) / sqrt(-above);
        t.second[i] = (v * v * t.value[i] - x * t.first[i]) / above;
    }
    return t;
}

INLINE struct chebyshev chebyshev_select(lane_mask mask, struct chebyshev a, struct chebyshev b)
{
    return (struct chebyshev){lanes_select(mask, a.value, b.value), lanes_select(mask, a.first, b.first),
                              lanes_select(mask, a.second, b.second)};
}

INLINE struct chebyshev chebyshev(double v, const double *coefficient, lanes z, lane_mask far, lanes y)
{
    const lane_mask below = (lane_mask)(z < -CHEBYSHEV_NEAR);
    if (!lanes_any(far | below))
        return chebyshev_series(coefficient, z);
    struct chebyshev t = chebyshev_series(coefficient, lanes_select(far | below, lanes_all(0), z));
    if (lanes_any(far))
        t = chebyshev_select(far, chebyshev_far(v, z, y), t);
    if (lanes_any(below))
        t = chebyshev_select(below, chebyshev_below(v, z), t);
    return t;
}

/* What Ogden's terms go by: P = L1 L2, S = L1 + L2, and 1 over them. */
struct sums {
    lanes p, s, by_p, by_s;
};

INLINE struct sums sums_of(struct stretched at)
{
    const lanes p = lanes_sqrt(at.d), s = lanes_sqrt(at.a + 2 * p), inverse = 1 / (p * s);
    return (struct sums){p, s, inverse * s, inverse * p};
}

/* Of a function of S and P: itself and its derivatives. */
struct by_sums {
    lanes value, s, p, ss, sp, pp;
};

/* For a whole n, with U_k = (L1^k - L2^k)/(L1 - L2) = S U_(k-1) - P U_(k-2) and V_k = dU_k/dS: U_n and
 * U_(n-1); V_n, V_(n-1) and V_(n-2); L1^n + L2^n = S U_n - 2 P U_(n-1); P^-n and P^(n-1). */
struct multiplied {
    lanes u, u1, v, v1, v2, both, shrunk, grown;
};

INLINE struct multiplied multiply_out(const struct sums *at, int n)
{
    const lanes none = lanes_all(0), one = lanes_all(1);
    struct multiplied m = {
        .u = one, .u1 = none, .v = none, .v1 = none, .v2 = none, .shrunk = at->by_p, .grown = one};
    for (int k = 1; k < n; k++) {
        const lanes u = at->s * m.u - at->p * m.u1, v = m.u + at->s * m.v - at->p * m.v1;
        m.v2 = m.v1;
        m.v1 = m.v;
        m.v = v;
        m.u1 = m.u;
        m.u = u;
        m.shrunk *= at->by_p;
        m.grown *= at->p;
    }
    m.both = at->s * m.u - 2 * (at->p * m.u1);
    return m;
}

/* L1^n + L2^n + L3^n - 3, times a weight: the sum's derivatives by S and P are n U_n and -n U_(n-1),
 * and dU_k/dP is -V_(k-1). */
INLINE void add_positive(struct by_sums *f, const struct sums *at, int n, double weight)
{
    const struct multiplied m = multiply_out(at, n);
    const double slope = n * weight;
    const lanes third = m.shrunk * at->by_p;
    f->value += weight * (m.both + m.shrunk - 3);
    f->s += slope * m.u;
    f->p -= slope * (m.u1 + third);
    f->ss += slope * m.v;
    f->sp -= slope * m.v1;
    f->pp += slope * (m.v2 + (n + 1) * third * at->by_p);
}

/* The same of -n: L1^-n + L2^-n is the sum of n times P^-n. */
INLINE void add_negative(struct by_sums *f, const struct sums *at, int n, double weight)
{
    const struct multiplied m = multiply_out(at, n);
    const double slope = n * weight;
    const lanes shrunk = slope * m.shrunk, each = m.both * at->by_p;
    f->value += weight * (m.both * m.shrunk + m.grown * at->p - 3);
    f->s += shrunk * m.u;
    f->p += slope * m.grown - shrunk * (m.u1 + each);
    f->ss += shrunk * m.v;
    f->sp -= shrunk * (m.v1 + n * m.u * at->by_p);
    f->pp += shrunk * (m.v2 + (2 * n * m.u1 + (n + 1) * each) * at->by_p) +
             slope * (n - 1) * m.grown * at->by_p;
}

/* The terms with whole powers, by a and D: dS/da = 1/(2 S), dS/dP = 1/S at the same a, dP/dD = 1/(2 P). */
INLINE struct response whole_response(const struct membrane_law *law, const struct sums *at, int asked)
{
    const lanes none = lanes_all(0);
    struct by_sums f = {none, none, none, none, none, none};
    for (int t = 0; t < law->whole; t++) {
        const int n = (int)law->power[t];
        if (n > 0)
            add_positive(&f, at, n, law->weight[t]);
        else
            add_negative(&f, at, -n, law->weight[t]);
    }
    const lanes half_p = .5 * at->by_p, half_s = .5 * at->by_s, by_p = f.p + f.s * at->by_s;
    struct response w = {.energy = f.value, .a = half_s * f.s, .d = half_p * by_p};
    if (asked & RESPONSE_SECOND) {
        const lanes bend = (f.ss - f.s * at->by_s) * at->by_s;
        w.aa = half_s * half_s * bend * at->s;
        w.ad = half_p * half_s * (f.sp + bend);
        w.dd = half_p * half_p * (f.pp + 2 * f.sp * at->by_s + bend * at->by_s - by_p * at->by_p);
    }
    return w;
}

/* Adds those with any powers. With x = a/(2 P), L1^alpha + L2^alpha = 2 D^(alpha/4) T(x) of the degree
 * alpha/2, and L3^alpha = D^(-alpha/2). */
INLINE void add_powers(struct response *w, const struct membrane_law *law, struct stretched s,
                       const struct sums *at, int asked)
{
    const lanes i = at->by_p * at->by_p, z = .5 * s.gap * at->by_p * (at->by_s * at->by_s), x = 1 + z;
    const lane_mask far = (lane_mask)(z > CHEBYSHEV_NEAR);
    const lanes log_d = lanes_log(s.d),
                y = lanes_any(far) ? lanes_log(x + lanes_sqrt(lanes_max(z, lanes_all(0)) * (2 + z)))
                                   : lanes_all(0);
    const lanes xa = .5 * at->by_p, xd = -.5 * x * i; /* derivatives of x */
    const lanes xad = -.5 * xa * i, xdd = .75 * x * i * i;
    for (int p = law->whole; p < law->terms; p++) {
        const double v = law->power[p] / 2, h = v / 2, weight = law->weight[p];
        const struct chebyshev t = chebyshev(v, law->series[p], z, far, y);
        const lanes power = lanes_exp(h * log_d), e = (2 * weight) * power, third = weight / (power * power);
        const lanes ed = h * e * i;
        w->a += e * t.first * xa;
        w->d += (h * e * t.value - .5 * x * (e * t.first) - v * third) * i;
        if (asked & RESPONSE_ENERGY)
            w->energy += e * t.value + third - 3 * weight;
        if (asked & RESPONSE_SECOND) {
            w->aa += e * t.second * xa * xa;
            w->ad += ed * t.first * xa + e * (t.second * xa * xd + t.first * xad);
            w->dd += (h - 1) * ed * i * t.value + 2 * ed * t.first * xd +
                     e * (t.second * xd * xd + t.first * xdd) + v * (v + 1) * third * i * i;
        }
    }
}

INLINE struct response ogden_response(const struct membrane_law *law, struct stretched s, int asked)
{
    const struct sums at = sums_of(s);
    struct response w = whole_response(law, &at, asked);
    if (law->whole < law->terms)
        add_powers(&w, law, s, &at, asked);
    return w;
}

INLINE struct response law_response(const struct membrane_law *law, enum membrane_kind kind,
                                    struct stretched s, int asked)
{
    return kind == MEMBRANE_OGDEN  ? ogden_response(law, s, asked)
           : kind == MEMBRANE_GENT ? gent_response(law, s, asked)
                                   : mooney_response(law, s, asked);
}

/* Where some triangles are crushed (MEMBRANE_CRUSHED). Seldom, and so not compiled into every loop. */
static __attribute__((noinline)) struct response crushed_response(const struct membrane_law *law,
                                                                  struct stretched s)
{
    const double least = MEMBRANE_CRUSHED;
    const lane_mask crushed = (lane_mask)(s.d < least);
    const lanes slope = lanes_select(crushed, s.d * (1 / least), lanes_all(1));
    const lanes bend = lanes_select(crushed, lanes_all(1 / least), lanes_all(0));
    const lanes d = lanes_select(crushed, .5 * (least + s.d * slope), s.d);
    const lanes gap = lanes_select(crushed, s.a * s.a - 4 * d, s.gap);
    struct response w = law_response(law, law->kind, (struct stretched){s.a, d, gap},
                                     RESPONSE_ENERGY | RESPONSE_FIRST | RESPONSE_SECOND);
    w.dd = w.dd * slope * slope + w.d * bend;
    w.ad *= slope;
    w.d *= slope;
    return w;
}

/* The least r by which second derivatives are divided, twice and thrice: what cancels there leaves rounding
 * errors of 1e-16/r^2, the size of the derivatives themselves at rest, where r is rounding. Where the
 * stretches are nearer to each other than this they come out too small. */
#define WRINKLED_APART 1e-5

/*
 * The energy of a pull along L1 alone, w(q) = W(q + q^-1/2, q^1/2) with q = L1^2, the larger eigenvalue (a +
 * r)/2, r = L1^2 - L2^2:
 *     w' = W_a + q2 W_D (since L2 is where W is least),   w'' = dw'/dq + dw'/dq2 dq2/dq,   q2 = q^-1/2,
 * and dq/da = q/r, dq/dD = -1/r. Nothing is held where q < 1.
 */
INLINE struct response wrinkled_response(const struct membrane_law *law, enum membrane_kind kind,
                                         struct stretched s, lanes r, int asked)
{
    const lanes true_q = .5 * (s.a + r), q = lanes_max(true_q, lanes_all(1)), root = lanes_sqrt(q),
                q2 = 1 / root;
    const lanes gap = (q - q2) * (q - q2);
    const struct response w = law_response(law, kind, (struct stretched){q + q2, root, gap}, asked);
    /* What is slack has r > q - q2 > 0 or q < 1, but rounding has not, and over an r of 0
     * it would not be small. */
    const lane_mask taut = (lane_mask)(true_q > 1);
    const lanes i = 1 / lanes_max(lanes_max(r, q - q2), lanes_all(1e-100));
    const lanes first = lanes_select(taut, w.a + q2 * w.d, lanes_all(0));
    struct response out = {.energy = w.energy, .a = first * true_q * i, .d = -first * i};
    if (asked & RESPONSE_SECOND) {
        const lanes by_q = w.aa + q2 * (2 * w.ad + q2 * w.dd);
        const lanes by_q2 = w.aa + (q + q2) * w.ad + root * w.dd + w.d;
        const lanes second = lanes_select(taut, by_q - .5 * q2 * (1 / q) * by_q2, lanes_all(0));
        const lanes j = lanes_min(i, lanes_all(1 / WRINKLED_APART)), i2 = j * j, turning = first * i2 * j;
        out.aa = second * true_q * true_q * i2 - 2 * turning * s.d;
        out.ad = -second * true_q * i2 + turning * s.a;
        out.dd = second * i2 - 2 * turning;
    }
    return out;
}

static inline lanes blend(lane_mask mask, double share, lanes b, lanes a)
{
    return lanes_select(mask, share * a + (1 - share) * b, a);
}

/* The law with wrinkling: taut where L2 >= L1^-1/2, which is D^2 >= q, and surely where D^2 >= a. */
INLINE struct response membrane_response(const struct membrane_law *law, enum membrane_kind kind,
                                         struct stretched s, int asked)
{
    struct response w = lanes_any((lane_mask)(s.d < MEMBRANE_CRUSHED)) ? crushed_response(law, s)
                                                                       : law_response(law, kind, s, asked);
    const lanes square = s.d * s.d;
    if (law->compression == 1 || !lanes_any((lane_mask)(square < s.a)))
        return w;
    const lanes r = lanes_sqrt(s.gap);
    const lane_mask slack = (lane_mask)(square < .5 * (s.a + r));
    if (!lanes_any(slack))
        return w;
    const struct response pull = wrinkled_response(law, kind, s, r, asked);
    const double share = law->compression;
    w.energy = blend(slack, share, pull.energy, w.energy);
    w.a = blend(slack, share, pull.a, w.a);
    w.d = blend(slack, share, pull.d, w.d);
    w.aa = blend(slack, share, pull.aa, w.aa);
    w.ad = blend(slack, share, pull.ad, w.ad);
    w.dd = blend(slack, share, pull.dd, w.dd);
    return w;
}

#endif
