/* What is asked of a membrane but seldom: one triangle's state, sums, and how stiff it can be. The loops
 * are membrane_kernels.c's. */
#include "sim/membrane.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/instructions.h"
#include "sim/measure.h"
#include "sim/membrane_kernels.h"

#include <string.h>

extern const struct membrane_kernels membrane_plain, membrane_avx2;

const struct membrane_kernels *membrane_kernels_find(void)
{
    return FOR_THIS_MACHINE(membrane);
}

/* F, column by column, in the plane's frame at rest. */
static void find_gradient(const struct sim *sim, const double rest[4], uint32_t triangle, double f[2][3])
{
    double d1[3], d2[3];
    sim_sides(sim, triangle, d1, d2);
    for (int i = 0; i < 3; i++) {
        f[0][i] = rest[0] * d1[i];
        f[1][i] = rest[1] * d1[i] + rest[2] * d2[i];
    }
}

/* The direction that the larger stretch has now: F times the eigenvector of C. */
static void find_direction(double f[2][3], const double c[3], double out[3])
{
    const double angle = atan2(2 * c[1], c[0] - c[2]) / 2, x = cos(angle), y = sin(angle);
    for (int i = 0; i < 3; i++)
        out[i] = x * f[0][i] + y * f[1][i];
    vec3_unit(out);
}

void membrane_look(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle,
                   struct membrane_state *state)
{
    const struct membrane *m = balloon->membrane;
    double f[2][3];
    find_gradient(sim, m->rest[triangle - balloon->triangle_begin], triangle, f);
    const double c[3] = {vec3_dot(f[0], f[0]), vec3_dot(f[0], f[1]), vec3_dot(f[1], f[1])};
    const double a = c[0] + c[2], r = hypot(c[0] - c[2], 2 * c[1]), d = c[0] * c[2] - c[1] * c[1];
    const struct membrane_response w = m->kernels->respond(&m->law, a, fmax(d, 0), r * r);
    const double q1 = (a + r) / 2, q2 = fmax((a - r) / 2, 0);
    *state = (struct membrane_state){.energy = w.energy, .stretch = {sqrt(q1), sqrt(q2)}};
    state->stress[0] = 2 * state->stretch[0] * (w.a + q2 * w.d);
    state->stress[1] = 2 * state->stretch[1] * (w.a + q1 * w.d);
    find_direction(f, c, state->direction);
}

double membrane_rest_area(const struct sim_balloon *balloon, uint32_t triangle)
{
    const struct membrane *m = balloon->membrane;
    return m->rest[triangle - balloon->triangle_begin][3] / (m->modulus * m->thickness);
}

/* -area grad N_i . grad N_j for the two ends of the side; the gradients of the second and third corner are
 * the rows of the triangle's matrix. */
double membrane_edge_share(const struct sim_balloon *balloon, uint32_t triangle, int side)
{
    const double *b = balloon->membrane->rest[triangle - balloon->triangle_begin];
    const double m11 = b[0] * b[0] + b[1] * b[1], m12 = b[1] * b[2], m22 = b[2] * b[2];
    const double product = side == 1 ? m12 : side == 0 ? -m11 - m12 : -m12 - m22;
    return b[3] > 0 ? -product / (2 * b[0] * b[2]) : 0;
}

double membrane_scale(const struct sim_balloon *balloon)
{
    double sum = 0;
    for (uint32_t t = 0; t < balloon->triangle_end - balloon->triangle_begin; t++)
        sum += balloon->membrane->rest[t][3];
    return sum;
}

double membrane_triangle_energy(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle)
{
    struct membrane_state state;
    membrane_look(sim, balloon, triangle, &state);
    return state.energy * balloon->membrane->rest[triangle - balloon->triangle_begin][3];
}

/* Sums are over this many shares of the triangles, whoever works on them. */
enum { SHARES = 64 };

struct sum {
    const struct sim *sim;
    const struct sim_balloon *balloon;
    double *each;     /* energies of all triangles; NULL: only sums */
    bool dissipation; /* instead */
    double share[SHARES];
};

static void sum_share(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sum *sum = context;
    const struct sim_balloon *b = sum->balloon;
    const struct membrane_kernels *kernels = b->membrane->kernels;
    const uint64_t count = b->triangle_end - b->triangle_begin;
    const uint32_t begin = (uint32_t)(count * index / SHARES), end = (uint32_t)(count * (index + 1) / SHARES);
    const uint32_t from = b->triangle_begin + begin, to = b->triangle_begin + end;
    sum->share[index] = sum->dissipation
                            ? kernels->dissipation(sum->sim, b, from, to)
                            : kernels->energy(sum->sim, b, from, to, sum->each ? sum->each + begin : NULL);
}

static double total(struct sim *sim, struct sum sum)
{
    double whole = 0;
    sum.sim = sim;
    threads_run(sim->pool, SHARES, sum_share, &sum);
    for (int i = 0; i < SHARES; i++)
        whole += sum.share[i];
    return whole;
}

void membrane_energies(struct sim *sim, const struct sim_balloon *balloon, double *energy)
{
    total(sim, (struct sum){.balloon = balloon, .each = energy});
}

double membrane_elastic(struct sim *sim, const struct sim_balloon *balloon)
{
    return total(sim, (struct sum){.balloon = balloon});
}

double membrane_dissipation(struct sim *sim, const struct sim_balloon *balloon)
{
    return balloon->membrane->viscosity > 0
               ? total(sim, (struct sum){.balloon = balloon, .dissipation = true})
               : 0;
}

/* The largest eigenvalue of the second derivative at one state, L1 >= L2: in the plane along both stretches,
 * in shear and in rotation; out of the plane, across which the stress alone resists. */
static double stiffness_at(const struct membrane_law *law, double q1, double q2)
{
    const double gap = (q1 - q2) * (q1 - q2), l1 = sqrt(q1), l2 = sqrt(q2);
    const struct membrane_response w = membrane_kernels_find()->respond(law, q1 + q2, q1 * q2, gap);
    const double p1 = 2 * (w.a + q2 * w.d), p2 = 2 * (w.a + q1 * w.d); /* stress over stretch */
    const double h11 = p1 + 4 * q1 * (w.aa + 2 * q2 * w.ad + q2 * q2 * w.dd),
                 h22 = p2 + 4 * q2 * (w.aa + 2 * q1 * w.ad + q1 * q1 * w.dd),
                 h12 = 4 * l1 * l2 * (w.d + w.aa + (q1 + q2) * w.ad + q1 * q2 * w.dd);
    const double along = (h11 + h22) / 2 + hypot((h11 - h22) / 2, h12);
    const double shear = 2 * (w.a + fabs(w.d) * l1 * l2);
    return fmax(fmax(along, shear), fmax(p1, p2));
}

double membrane_stiffness(const struct membrane_law *law, const double range[2])
{
    enum { STATES = 48 };
    /* Between the states that are asked W is smooth: 1 % more covers what is missed. */
    const double margin = 1.01, least = sqrt(range[1]), most = fmax(range[0], 1 + least);
    double stiffest = 0;
    for (int i = 0; i <= STATES; i++) {
        const double q1 = least * pow(most / least, i / (double)STATES), low = range[1] / q1;
        for (int j = 0; j <= STATES; j++)
            stiffest = fmax(stiffest,
                            stiffness_at(law, q1, fmin(low * pow(q1 / low, j / (double)STATES), q1)));
    }
    return margin * stiffest;
}

/* Springs k in equilateral triangles have the modulus 3 sqrt 3/4 k along a line;
 * edge_weight is 1/sqrt 3 there. */
static const double springs_share = 4 / 3.0;

/* As if the skin were stretched both ways as much as the edge. What is shorter than at rest counts as at
 * rest, and there is an end. */
static void stand_in_for_edge(const struct membrane *m, double stretch, double weight, const double u[3],
                              double row[8])
{
    const double q = pow(fmin(fmax(stretch, 1), 1e3), 2), scale = weight * m->modulus * m->thickness;
    const struct membrane_response w = m->kernels->respond(&m->law, 2 * q, q * q, 0);
    const double across = scale * fmax(2 * (w.a + q * w.d), 0),
                 along = springs_share * scale * fmax(4 * q * (w.aa + 2 * q * w.ad + q * q * w.dd), 0);
    for (int i = 0; i < 3; i++) {
        row[i] = u[i];
        row[4 + i] = along * u[i];
    }
    row[3] = across;
    row[7] = springs_share * weight * m->viscosity * m->thickness;
}

void membrane_stand_in(const struct sim *sim, const struct sim_part *part, double (*edge)[8])
{
    const struct sim_balloon *b = part->balloon;
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++) {
        const uint32_t *p = sim->edge_point[e];
        double u[3];
        vec3_sub(sim->position[p[0]], sim->position[p[1]], u);
        const double length = vec3_length(u);
        memset(edge[e], 0, sizeof edge[e]);
        if (!sim->edge_active[e] || length == 0)
            continue;
        for (int i = 0; i < 3; i++)
            u[i] /= length;
        stand_in_for_edge(b->membrane, length / sim->rest_length[e],
                          b->membrane->edge_weight[e - b->edge_begin], u, edge[e]);
    }
}
