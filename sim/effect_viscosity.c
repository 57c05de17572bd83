/*
 * Viscoelastic springs: beside each spring k_s with its damper (the unit of Kelvin and Voigt) an arm of a
 * spring and a dashpot in series (that of Maxwell), of the units of the paper's figure 1. The arm pulls with
 * f = c k_s (|l| - r - s), c the scene's ratio, where the dashpot has given way by s and goes on doing so as
 * ds/dt = (|l| - r - s)/T. Held at a length, the pull falls from (1 + c) to 1 times the spring's as
 * exp(-t/T); under a steady force it creeps. s is integrated along with the positions (sim->scalar). Pulls
 * and rates are worked out where the springs' lengths are (forces_edges.h).
 */
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/guard.h"

#include <math.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->viscosity.on;
}

/* Arms that pull at nothing are left out: methods would follow how they give way. */
static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    if (b->scene->viscosity.ratio == 0)
        return STATUS_OK;
    b->arm_count = b->edge_end - b->edge_begin;
    return sim_add_scalars(sim, b->arm_count, &b->arms, err);
}

struct arm {
    double u[3];                         /* from the second point to the first */
    double length, constant, elongation; /* the spring's in the arm */
};

static struct arm arm_of(const struct sim *sim, const struct sim_balloon *b, uint32_t e)
{
    struct arm arm = {.constant = b->scene->viscosity.ratio * sim->current_spring_const[e]};
    vec3_sub(sim->position[sim->edge_point[e][0]], sim->position[sim->edge_point[e][1]], arm.u);
    arm.length = vec3_length(arm.u);
    arm.elongation = arm.length - sim->rest_length[e] - sim->scalar[b->arms + e - b->edge_begin];
    for (int i = 0; i < 3; i++)
        arm.u[i] = arm.length > 0 ? arm.u[i] / arm.length : 0;
    return arm;
}

/* Adds +-f to those ends that are the part's. */
static void add_to_ends(const struct sim *sim, const struct sim_part *part, uint32_t e, const double f[3],
                        double (*rows)[4])
{
    for (int k = 0; k < 2; k++) {
        const uint32_t p = sim->edge_point[e][k];
        if (p - part->point_begin < part->point_end - part->point_begin)
            for (int i = 0; i < 3; i++)
                rows[p][i] += k ? f[i] : -f[i];
    }
}

/* An arm's share, for each of those that reach into the part: first of lower parts, then its own. */
static void each_arm(struct sim *sim, const struct sim_part *part,
                     void (*work)(struct sim *sim, const struct sim_part *part, uint32_t edge, void *context),
                     void *context)
{
    const struct sim_balloon *b = part->balloon;
    for (uint32_t i = 0; i < part->edge_in_count; i++)
        if (sim->edge_active[part->edge_in[i]] && part->edge_in[i] - b->edge_begin < b->arm_count)
            work(sim, part, part->edge_in[i], context);
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++)
        if (sim->edge_active[e] && e - b->edge_begin < b->arm_count)
            work(sim, part, e, context);
}

struct direction {
    const struct sim_balloon *balloon;
    double a, (*dx)[4], (*df)[4];
};

/* As of any spring that is stretched (jacobian_kernels.c): df = k u (u . dl) + T/|l| (dl - u (u . dl)). */
static void turn(struct sim *sim, const struct sim_part *part, uint32_t e, void *context)
{
    const struct direction *d = context;
    const struct arm arm = arm_of(sim, part->balloon, e);
    if (arm.length == 0)
        return;
    const double t = arm.constant * arm.elongation / arm.length;
    double dl[3], f[3], along = 0;
    vec3_sub(d->dx[sim->edge_point[e][0]], d->dx[sim->edge_point[e][1]], dl);
    along = vec3_dot(arm.u, dl);
    for (int i = 0; i < 3; i++)
        f[i] = d->a * ((arm.constant - t) * along * arm.u[i] + t * dl[i]);
    add_to_ends(sim, part, e, f, d->df);
}

static void turn_part(struct sim *sim, const struct sim_part *part, void *context)
{
    if (part->balloon == ((struct direction *)context)->balloon)
        each_arm(sim, part, turn, context);
}

static void product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4])
{
    (void)b, (void)dv;
    sim_each_part(sim, turn_part, &(struct direction){balloon, a, dx, df});
}

static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    for (uint32_t e = b->edge_begin; e < b->edge_begin + b->arm_count; e++)
        if (sim->edge_active[e])
            for (int k = 0; k < 2; k++)
                rows->stiffness[sim->edge_point[e][k]] += 2 * b->scene->viscosity.ratio *
                                                          sim->current_spring_const[e];
}

/* Arms are moved by their rates, whatever the method does with the points: over T an arm comes to where it
 * pulls at nothing, and over more it would overshoot that. */
static double follow(const struct sim *sim, const struct sim_balloon *b)
{
    (void)sim;
    return b->arm_count > 0 ? b->scene->viscosity.time : INFINITY;
}

static double edge_energy(const struct sim *sim, const struct sim_balloon *b, uint32_t e)
{
    if (e - b->edge_begin >= b->arm_count)
        return 0;
    const struct arm arm = arm_of(sim, b, e);
    return arm.constant * arm.elongation * arm.elongation / 2;
}

static double energy(struct sim *sim, struct sim_balloon *b)
{
    double sum = 0;
    for (uint32_t e = b->edge_begin; e < b->edge_begin + b->arm_count; e++)
        if (sim->edge_active[e])
            sum += edge_energy(sim, b, e);
    return sum;
}

/* The dashpots': force times rate, 2/T of what the arms' springs hold. */
static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    (void)work;
    *dissipated += 2 * energy(sim, b) / b->scene->viscosity.time;
}

const struct effect effect_viscosity = {.name = "viscosity",
                                        .phase = EFFECT_FORCES,
                                        .wanted = wanted,
                                        .open = open,
                                        .product = product,
                                        .bound = bound,
                                        .follow = follow,
                                        .follows = "the creep",
                                        .follows_why = "which is as fast as its viscosity.time says",
                                        .energy = energy,
                                        .power = power,
                                        .edge_energy = edge_energy,
                                        .source = "paper, figure 1; Terzopoulos and Fleischer 1988"};
