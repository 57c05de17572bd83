/*
 * The air's resistance, triangle by triangle: what comes at it with the speed q along its normal pushes with
 * r C q |q| A/2 along that normal, a third on each corner. With N twice the area vector and w the wind less
 * the mean of the corners' speeds,
 *     F = r C/4 (w . N) |w . N| N/|N|^2.
 * A plate square to the wind has the drag coefficient C, and so has a sphere, whose two halves count: its sum
 * of |cos|^3 over the area is that of its cross-section. Forces are worked out where the triangles' normals
 * are (forces.c), which brings nearly half of the work.
 */
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/sweep.h"

#include <math.h>
#include <stdlib.h>

struct air_drag {
    /* The fastest that skin and air were taken to pass each other, for the guard's bound; state. */
    double bound_speed;
};

static bool wanted(const struct scene *scene)
{
    return scene->drag.on;
}

static bool is_felt(const struct sim *sim)
{
    return sim->scene->drag.air_density * sim->scene->drag.coefficient > 0;
}

static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    (void)balloon;
    sim->drag = calloc(1, sizeof *sim->drag);
    if (!sim->drag)
        return error_no_memory(err, "the drag");
    sim->bytes += sizeof *sim->drag;
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    free(sim->drag);
    sim->drag = NULL;
}

static size_t blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *list)
{
    (void)balloon;
    list[0] = (struct sim_block){"drag", sim->drag, sizeof *sim->drag};
    return is_felt(sim);
}

struct flow {
    double twice[3], wind[3];       /* N and w */
    double across, squared, factor; /* w . N, |N|^2, r C/4 */
};

static struct flow flow_at(const struct sim *sim, const uint32_t *p)
{
    const struct scene_drag *drag = &sim->scene->drag;
    struct flow flow = {.factor = drag->air_density * drag->coefficient / 4};
    vec3_triangle(sim->position[p[0]], sim->position[p[1]], sim->position[p[2]], flow.twice);
    for (int i = 0; i < 3; i++)
        flow.wind[i] = drag->wind[i] -
                       (sim->velocity[p[0]][i] + sim->velocity[p[1]][i] + sim->velocity[p[2]][i]) / 3;
    flow.across = vec3_dot(flow.wind, flow.twice);
    flow.squared = vec3_dot(flow.twice, flow.twice);
    return flow;
}

static void add_to_own(const struct sim_part *part, double (*to)[4], const uint32_t *p, double factor,
                       const double add[3])
{
    for (int k = 0; k < 3; k++)
        if (p[k] - part->point_begin < part->point_end - part->point_begin)
            for (int i = 0; i < 3; i++)
                to[p[k]][i] += factor * add[i];
}

struct product {
    double a, b;
    double (*dx)[4], (*dv)[4], (*df)[4];
};

/* With Q = w . N: dF = r C/4 [2 |Q| dQ N + Q |Q| (dN - 2 N (N . dN)/|N|^2)]/|N|^2, dQ = w . dN - dv . N,
 * dN = d1 x s2 + s1 x d2. */
static void product_at(struct sim *sim, const struct sim_part *part, const struct product *product,
                       uint32_t t)
{
    double(*x)[4] = sim->position, (*dx)[4] = product->dx, (*dv)[4] = product->dv;
    const uint32_t *p = sim->triangle_point[t];
    const struct flow flow = flow_at(sim, p);
    if (!sim->triangle_active[t] || !(flow.squared > 0))
        return;
    double s1[3], s2[3], d1[3], d2[3], turn1[3], turn2[3], turn[3], change[3];
    vec3_sub(x[p[1]], x[p[0]], s1);
    vec3_sub(x[p[2]], x[p[0]], s2);
    vec3_sub(dx[p[1]], dx[p[0]], d1);
    vec3_sub(dx[p[2]], dx[p[0]], d2);
    vec3_cross(d1, s2, turn1);
    vec3_cross(s1, d2, turn2);
    double dq = 0;
    for (int i = 0; i < 3; i++) {
        turn[i] = product->a * (turn1[i] + turn2[i]);
        dq += flow.wind[i] * turn[i] -
              product->b * (dv[p[0]][i] + dv[p[1]][i] + dv[p[2]][i]) / 3 * flow.twice[i];
    }
    const double along = 2 * vec3_dot(flow.twice, turn) / flow.squared, size = fabs(flow.across);
    for (int i = 0; i < 3; i++)
        change[i] = 2 * size * dq * flow.twice[i] + flow.across * size * (turn[i] - along * flow.twice[i]);
    add_to_own(part, product->df, p, flow.factor / flow.squared / 3, change);
}

static void product_part(struct sim *sim, const struct sim_part *part, void *context)
{
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        product_at(sim, part, context, part->triangle_in[i]);
    for (uint32_t t = part->triangle_begin; t < part->triangle_end; t++)
        product_at(sim, part, context, t);
}

static void product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4])
{
    (void)balloon;
    sim_each_part(sim, product_part, &(struct product){a, b, dx, dv, df});
}

/* Slower than a thousandth of an edge a step does not matter. */
static double least_speed(const struct sim *sim)
{
    return 1e-3 * sim->balloons[0].mean_rest_length / sim->whole_step;
}

/* How fast any point and the air pass each other. */
static double fastest(const struct sim *sim)
{
    const double *wind = sim->scene->drag.wind;
    double most = least_speed(sim) * least_speed(sim);
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++) {
            double w[3];
            vec3_sub(wind, sim->velocity[p], w);
            most = fmax(most, vec3_dot(w, w));
        }
    return sqrt(most);
}

/* |dF/dv| = r C A |w . n| on a triangle, a third of it at each corner, at twice the speed that any has: until
 * then it is asked no more. What moves no faster than the wind is pushed by r C/2 A |2 wind|^2 at the most;
 * what moves faster is held back. */
static void bound(const struct sim *sim, const struct sim_balloon *balloon, const struct guard_rows *rows)
{
    (void)balloon;
    const double speed = sim->drag->bound_speed = fastest(sim);
    const double *wind = sim->scene->drag.wind;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const uint32_t *p = sim->triangle_point[t];
        if (!sim->triangle_active[t])
            continue;
        const struct flow flow = flow_at(sim, p);
        const double area = sqrt(flow.squared);
        for (int k = 0; k < 3; k++) {
            rows->damping[p[k]] += 2 * 2 * flow.factor * area * speed / 3;
            rows->push[p[k]] += 4 * flow.factor * area * vec3_dot(wind, wind) / 3;
        }
    }
}

static bool is_bounded(const struct sim *sim, double least, double most)
{
    return most <= 2 * sim->drag->bound_speed && least >= sim->drag->bound_speed / 8;
}

/* Where the sweep has seen how far points moved in this step, and so how fast they are, mostly without a look
 * at each: with v the fastest of them and w the wind's speed, the fastest that any passes the air is from |v
 * - w| to v + w. The margin is for rounding. */
static bool is_surely_bounded(const struct sim *sim)
{
    const double v = sweep_saw_farthest(sim) / sim->taken, w = vec3_length(sim->scene->drag.wind);
    return v < INFINITY && is_bounded(sim, fmax((1 - 1e-6) * fabs(v - w), least_speed(sim)),
                                      fmax((1 + 1e-6) * (v + w), least_speed(sim)));
}

static void after(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    if (!is_felt(sim) || is_surely_bounded(sim))
        return;
    const double speed = fastest(sim);
    if (!is_bounded(sim, speed, speed))
        guard_bound_outdated(sim);
}

/* The wind's work is F . wind; what the air takes of the relative motion is F . w, never below 0. */
static void power(struct sim *sim, struct sim_balloon *balloon, double *dissipated, double *work)
{
    (void)balloon;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        const struct flow flow = flow_at(sim, sim->triangle_point[t]);
        if (!(flow.squared > 0))
            continue;
        const double size = flow.factor * flow.across * fabs(flow.across) / flow.squared;
        *dissipated += size * flow.across;
        *work += size * vec3_dot(flow.twice, sim->scene->drag.wind);
    }
}

const struct effect effect_drag = {.name = "drag",
                                   .phase = EFFECT_FORCES,
                                   .scene_wanted = wanted,
                                   .open = open,
                                   .close = close,
                                   .after = after,
                                   .blocks = blocks,
                                   .product = product,
                                   .bound = bound,
                                   .power = power,
                                   .damps = true,
                                   .source = "Hoerner, Fluid-Dynamic Drag, 1965"};
