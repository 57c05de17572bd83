#include "sim/areas.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/jacobian_kernels.h"
#include "sim/kernels.h"
#include "sim/measure.h"
#include "sim/vectors.h"

struct volume {
    const struct sim_balloon *balloon;
    const unsigned char *held;
    const double *origin, *along;
};

static double volume_of_held(const struct sim *sim, uint32_t begin, uint32_t end, const struct volume *volume)
{
    double sum = 0;
    for (uint32_t p = begin; p < end; p++)
        for (int i = 0; i < 3 && volume->held[p - volume->balloon->point_begin]; i++)
            sum += (sim->position[p][i] - volume->origin[i]) * sim->normal[p][i];
    return sum;
}

static double volume_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct volume *volume = context;
    const struct sim_balloon *b = volume->balloon;
    begin = begin < b->point_begin ? b->point_begin : begin;
    end = end > b->point_end ? b->point_end : end;
    if (begin >= end)
        return 0;
    return volume->held ? volume_of_held(sim, begin, end, volume)
                        : sim->kernels->sum_volume(sim, begin, end, volume->origin);
}

double areas_volume(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                    const double origin[4])
{
    return vector_sum(sim, volume_block, &(struct volume){balloon, held, origin, NULL}) / 18;
}

/* The divergence of (d . y)^2 d/(2 d . d) is d . y: a triangle's share is that of its corners' mean over its
 * area, so that a closed surface's moment does not depend on where it is seen from. */
static double moment_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct volume *volume = context;
    const struct sim_balloon *b = volume->balloon;
    const double seen = vec3_dot(volume->along, volume->origin);
    double sum = 0;
    begin = begin < b->point_begin ? b->point_begin : begin;
    end = end > b->point_end ? b->point_end : end;
    for (uint32_t p = begin; p < end; p++) {
        const double height = vec3_dot(volume->along, sim->position[p]) - seen;
        if (!volume->held || volume->held[p - b->point_begin])
            sum += height * height * vec3_dot(volume->along, sim->normal[p]);
    }
    return sum;
}

double areas_moment(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                    const double origin[4], const double along[3])
{
    return vector_sum(sim, moment_block, &(struct volume){balloon, held, origin, along}) /
           (12 * vec3_dot(along, along));
}

struct push {
    const struct sim_balloon *balloon;
    const unsigned char *held;
    const struct areas_pressure *pressure;
};

static void push_held(struct sim *sim, const struct sim_part *part, const struct push *push)
{
    const double *d = push->pressure->gradient;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 3 && push->held[p - push->balloon->point_begin]; i++)
            sim->force[p][i] += (push->pressure->constant + vec3_dot(d, sim->position[p])) / 6 *
                                sim->normal[p][i];
}

static void push_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct push *push = context;
    if (part->balloon != push->balloon)
        return;
    if (push->held)
        push_held(sim, part, push);
    else
        sim->kernels->push_areas(sim, part, push->pressure->constant, push->pressure->gradient);
}

void areas_push(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                const struct areas_pressure *pressure)
{
    sim_each_part(sim, push_part, &(struct push){balloon, held, pressure});
}

/* Sums are over this many shares of the triangles, whoever works on them. */
enum { SHARES = 64 };

struct change {
    const struct sim *sim;
    const struct sim_balloon *balloon;
    const unsigned char *held;
    const double *origin, *along; /* along NULL: without moments */
    double (*dx)[4];
    struct areas_change share[SHARES];
};

/* As moment_block() has it. */
static void add_moment(const struct change *c, const uint32_t *p, const double twice[3],
                       struct areas_change *sum)
{
    double(*x)[4] = c->sim->position, (*dx)[4] = c->dx, squares = 0, change = 0, from[3], to[3], to_dx[3],
    from_dx[3], turned[2][3];
    for (int k = 0; k < 3; k++) {
        vec3_sub(x[p[k]], c->origin, from);
        const double height = vec3_dot(c->along, from);
        squares += height * height;
        change += 2 * height * vec3_dot(c->along, dx[p[k]]);
    }
    vec3_sub(x[p[1]], x[p[0]], from);
    vec3_sub(x[p[2]], x[p[0]], to);
    vec3_sub(dx[p[1]], dx[p[0]], from_dx);
    vec3_sub(dx[p[2]], dx[p[0]], to_dx);
    vec3_cross(from_dx, to, turned[0]);
    vec3_cross(from, to_dx, turned[1]);
    sum->moment += squares * vec3_dot(c->along, twice);
    sum->moment_change += change * vec3_dot(c->along, twice) +
                          squares * (vec3_dot(c->along, turned[0]) + vec3_dot(c->along, turned[1]));
}

/* Of all the cones, x0 . x1 x x2/6; a triangle's change is that of its prism. What the moving rim adds
 * is the holes' business. */
static void change_share(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct change *c = context;
    double(*x)[4] = c->sim->position, (*dx)[4] = c->dx;
    const uint64_t count = c->balloon->triangle_end - c->balloon->triangle_begin;
    const uint32_t begin = c->balloon->triangle_begin + (uint32_t)(count * index / SHARES),
                   end = c->balloon->triangle_begin + (uint32_t)(count * (index + 1) / SHARES);
    struct areas_change sum = {0};
    for (uint32_t t = begin; t < end; t++) {
        const uint32_t *p = c->sim->triangle_point[t];
        if (!c->sim->triangle_active[t] || (c->held && !c->held[p[0] - c->balloon->point_begin]))
            continue;
        double twice[3];
        vec3_triangle(x[p[0]], x[p[1]], x[p[2]], twice);
        for (int i = 0; i < 3; i++) {
            sum.volume += twice[i] * (x[p[0]][i] - c->origin[i]);
            sum.change += twice[i] * (dx[p[0]][i] + dx[p[1]][i] + dx[p[2]][i]);
        }
        if (c->along)
            add_moment(c, p, twice, &sum);
    }
    c->share[index] = sum;
}

struct areas_change areas_change(const struct sim *sim, const struct sim_balloon *balloon,
                                 const double origin[4], const double along[3], const unsigned char *held,
                                 double (*dx)[4])
{
    struct change c = {
        .sim = sim, .balloon = balloon, .held = held, .origin = origin, .along = along, .dx = dx};
    const double twelfth = along ? 1 / (12 * vec3_dot(along, along)) : 0;
    threads_run(sim->pool, SHARES, change_share, &c);
    struct areas_change sum = {0};
    for (int i = 0; i < SHARES; i++) {
        sum.volume += c.share[i].volume / 6;
        sum.change += c.share[i].change / 6;
        sum.moment += c.share[i].moment * twelfth;
        sum.moment_change += c.share[i].moment_change * twelfth;
    }
    return sum;
}

static void product_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct areas_product *product = context;
    if (part->balloon == product->balloon)
        sim->jacobian->kernels->areas(sim, part, product);
}

void areas_product(struct sim *sim, const struct sim_balloon *balloon, const struct areas_pressure *pressure,
                   const struct areas_pressure *change, const unsigned char *held, double a, double (*dx)[4],
                   double (*df)[4])
{
    sim_each_part(sim, product_part, &(struct areas_product){balloon, *pressure, *change, held, a, dx, df});
}

double areas_size(const struct sim *sim, uint32_t triangle)
{
    return sim->triangle_active[triangle] ? sim_area(sim, triangle) : 0;
}

void areas_bound(const struct sim *sim, const struct sim_balloon *balloon, double pressure,
                 const struct guard_rows *rows)
{
    for (uint32_t t = balloon->triangle_begin; t < balloon->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t];
        const double area = areas_size(sim, t);
        double length = 0;
        for (int k = 0; k < 3; k++)
            length += vec3_distance(sim->position[p[k]], sim->position[p[(k + 1) % 3]]);
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++) {
            rows->stiffness[p[k]] += fabs(pressure) / 6 * length;
            rows->push[p[k]] += fabs(pressure) / 3 * area;
        }
    }
}
