/* The skin as a membrane, in place of its springs (membrane.h): what is made of the scene's block when a
 * simulation is opened, and what the guard and the implicit methods ask. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/measure.h"
#include "sim/membrane_kernels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->membrane.on;
}

static double next_coefficient(double before, double v, int k)
{
    return before * (v * v - (k - 1) * (k - 1)) / (k * (2 * k - 1));
}

static bool is_whole(double power)
{
    return fabs(power) <= MEMBRANE_WHOLE_MOST && power == floor(power);
}

static void add_ogden_term(struct membrane_law *law, double weight, double power)
{
    const int p = law->terms++;
    law->power[p] = power;
    law->weight[p] = weight;
    law->series[p][0] = 1;
    for (int k = 1; k < MEMBRANE_SERIES; k++)
        law->series[p][k] = next_coefficient(law->series[p][k - 1], power / 2, k);
}

/* Those with whole powers first. */
static void set_ogden(struct membrane_law *law, const struct scene_profile *rows)
{
    double modulus = 0;
    for (size_t p = 0; p < rows->count; p++)
        modulus += rows->row[p][0] * rows->row[p][1] / 2;
    for (int whole = 1; whole >= 0; whole--) {
        for (size_t p = 0; p < rows->count; p++)
            if (is_whole(rows->row[p][1]) == whole)
                add_ogden_term(law, rows->row[p][0] / modulus / rows->row[p][1], rows->row[p][1]);
        law->whole = whole ? law->terms : law->whole;
    }
}

static struct membrane_law law_of(const struct scene_membrane *block)
{
    struct membrane_law law = {.kind = (enum membrane_kind)block->law,
                               .c1 = 1,
                               .limit = block->gent_limit,
                               .compression = block->compression};
    if (law.kind == MEMBRANE_MOONEY_RIVLIN) {
        law.c1 = 1 / (1 + block->mooney_ratio);
        law.c2 = 1 - law.c1;
    } else if (law.kind == MEMBRANE_OGDEN) {
        set_ogden(&law, &block->ogden);
    }
    return law;
}

/* A triangle's frame at rest: the first axis along its first side. A triangle without area resists
 * nothing and weighs nothing. */
static void set_rest(struct sim *sim, const struct sim_balloon *b, uint32_t t, double rest[4])
{
    double r1[3], r2[3], cross[3];
    sim_sides(sim, t, r1, r2);
    vec3_cross(r1, r2, cross);
    const double length = vec3_length(r1), twice = vec3_length(cross);
    if (!(twice > 0))
        return;
    const struct membrane *m = b->membrane;
    rest[0] = 1 / length;
    rest[1] = -vec3_dot(r1, r2) / (length * twice);
    rest[2] = length / twice;
    rest[3] = m->modulus * m->thickness * twice / 2;
}

/* Whether the kernels find a triangle at rest, to a hundredth: tr C = 2 and det C = 1 (membrane_kernels.c,
 * skin_of). Of one that is h times as wide as long rounding leaves them 1e-16/h^2. */
static bool is_resolved(const struct sim *sim, uint32_t t, const double rest[4])
{
    double d1[3], d2[3];
    sim_sides(sim, t, d1, d2);
    const double xx = vec3_dot(d1, d1), xy = vec3_dot(d1, d2), yy = vec3_dot(d2, d2), b0 = rest[0],
                 b1 = rest[1], b2 = rest[2];
    const double a = b0 * b0 * xx + b1 * (b1 * xx + 2 * b2 * xy) + b2 * b2 * yy,
                 d = b0 * b0 * (b2 * b2) * (xx * yy - xy * xy);
    return fabs(a - 2) <= 0.01 && fabs(d - 1) <= 0.01;
}

static enum status too_thin(const struct sim *sim, const struct sim_balloon *b, uint32_t t, struct error *err)
{
    const double *x = sim->position[sim->triangle_point[t][0]];
    return error_set(
        err, STATUS_INPUT,
        "%s: balloons[%zu].membrane: a triangle near (%g, %g, %g) is so thin that rounding says "
        "how far it is stretched; take another mesh, as balloon-surface makes, or leave out membrane",
        sim->scene->path, (size_t)(b - sim->balloons), x[0], x[1], x[2]);
}

/* A third of each triangle's mass at its corners. What carries no skin keeps the mass that
 * the scene gives points. */
static void set_masses(struct sim *sim, const struct sim_balloon *b)
{
    const double density = b->scene->membrane.density, thickness = b->membrane->thickness;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        if (membrane_rest_area(b, t) > 0)
            for (int k = 0; k < 3; k++)
                sim->mass[sim->triangle_point[t][k]] = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            sim->mass[sim->triangle_point[t][k]] += density * thickness * membrane_rest_area(b, t) / 3;
}

/* With these the sum of w |x_p - x_q|^2 over the edges is that of area |dF|^2 over the triangles (Pinkall and
 * Polthier, Experimental Mathematics 2, 1993). Leaving out negative ones only makes it larger. */
static void set_weights(const struct sim *sim, const struct sim_balloon *b)
{
    double *weight = b->membrane->edge_weight;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            weight[sim->triangle_edge[t][k] - b->edge_begin] += membrane_edge_share(b, t, k);
    for (uint32_t e = 0; e < b->edge_end - b->edge_begin; e++)
        weight[e] = fmax(weight[e], 0);
}

/* The edges go on telling when they are overlong, but pull no more. */
static void let_springs_go(struct sim *sim, struct sim_balloon *b)
{
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        sim->init_spring_const[e] = sim->current_spring_const[e] = 0;
    b->now->damping = 0;
}

/* What it is taken to be stretched to at first: a and D are 2 and 1 at rest. */
static const double first_range[2] = {2.5, 0.8};

/* Springs and dampers that are at least as stiff: |F dC/dt| / tr C <= 2 |dF/dt|. */
static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    (void)sim, (void)rows;
    const struct membrane *m = b->membrane;
    b->now->membrane_stiffness = m->modulus * m->thickness *
                                 membrane_stiffness(&m->law, b->now->membrane_range);
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    const struct scene_membrane *block = &b->scene->membrane;
    const uint32_t triangles = b->triangle_end - b->triangle_begin, edges = b->edge_room - b->edge_begin;
    struct membrane *m = b->membrane = calloc(1, sizeof *m);
    if (!m)
        return error_no_memory(err, "the membrane");
    m->law = law_of(block);
    m->modulus = block->shear_modulus;
    m->thickness = block->thickness;
    m->viscosity = block->viscosity;
    m->damping = 2 * m->viscosity * m->thickness;
    m->kernels = membrane_kernels_find();
    m->rest = sim_table(sim, triangles, sizeof *m->rest);
    m->edge_weight = sim_table(sim, edges, sizeof *m->edge_weight);
    m->range = sim_table(sim, sim->part_count, sizeof *m->range);
    if (!m->rest || !m->edge_weight || !m->range)
        return error_no_memory(err, "the membrane");
    for (uint32_t t = 0; t < triangles; t++) {
        set_rest(sim, b, b->triangle_begin + t, m->rest[t]);
        if (m->rest[t][0] > 0 && !is_resolved(sim, b->triangle_begin + t, m->rest[t]))
            return too_thin(sim, b, b->triangle_begin + t, err);
    }
    set_masses(sim, b);
    set_weights(sim, b);
    let_springs_go(sim, b);
    memcpy(b->now->membrane_range, first_range, sizeof first_range);
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (!b->membrane)
        return;
    free(b->membrane->rest);
    free(b->membrane->edge_weight);
    free(b->membrane->range);
    free(b->membrane);
    b->membrane = NULL;
}

static void product_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct membrane *m = part->balloon->membrane;
    if (m)
        m->kernels->product(sim, part, context);
}

/* One call does the parts of all balloons that have a membrane: the first of them makes it. */
static void product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4])
{
    for (const struct sim_balloon *other = sim->balloons; other < balloon; other++)
        if (other->membrane)
            return;
    sim_each_part(sim, product_part, &(struct jacobian_product){a, b, dx, dv, df});
}

/* Beyond these no law of rubber holds, or gets any stiffer. */
static const double most_a = 1e6, least_d = MEMBRANE_CRUSHED / 2;

/* The guard's range around a strain, which must hold what there is: with so much room that it is seldom asked
 * again, and moved back only where it has become far too wide. Near a law's limit a little more of stretch is
 * a lot more of stiffness. */
static const double room[2] = {1.15, 1.3}, too_wide = 2;

static void watch(struct sim *sim, struct sim_balloon *b)
{
    double *range = b->now->membrane_range, most = 0, least = INFINITY;
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == b) {
            most = fmax(most, b->membrane->range[i][0]);
            least = fmin(least, b->membrane->range[i][1]);
        }
    const double wanted[2] = {fmin(room[0] * fmax(most, first_range[0] / room[0]), most_a),
                              fmax(fmin(least, first_range[1] * room[1]) / room[1], least_d)};
    const bool narrow = fmin(most, most_a) > range[0] || fmax(least, least_d) < range[1];
    const bool wide = wanted[0] * too_wide < range[0] || wanted[1] > range[1] * too_wide;
    if (!narrow && !wide)
        return;
    memcpy(range, wanted, sizeof wanted);
    guard_bound_outdated(sim);
}

static size_t left(struct sim *sim, struct sim_balloon *b, struct sim_block *blocks)
{
    const struct membrane *m = b->membrane;
    blocks[0] = (struct sim_block){"membrane's range", m->range, sim->part_count * sizeof *m->range};
    return 1;
}

static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    (void)work;
    *dissipated += membrane_dissipation(sim, b);
}

const struct effect effect_membrane = {.name = "membrane",
                                       .phase = EFFECT_FORCES,
                                       .wanted = wanted,
                                       .open = open,
                                       .close = close,
                                       .after = watch,
                                       .left = left,
                                       .power = power,
                                       .triangle_energy = membrane_triangle_energy,
                                       .product = product,
                                       .bound = bound,
                                       .damps = true,
                                       .source = "Bonet and Wood 2008; Pipkin 1986"};
