/*
 * A string that is tied to a patch of the skin, as to a balloon's neck: while it is longer than its length L
 * it pulls with k (|l| - L) + d v . l/|l|, but never pushes, at the mean of the patch's points, alike on
 * each. Its other end is held, or carries a weight, which is no point of the skin: its place and speed are
 * scalars, integrated along.
 */
#include "sim/effect_string.h"
#include "common/vec3.h"
#include "sim/bodies.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/patch.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

struct string {
    const struct scene_string *scene;
    struct patch patch;
    double length;
    double end[3]; /* where it is held, without a weight */
    double weight; /* at that end; 0 where the string, which never pulls, carries none */
    uint32_t scalar;
    uint64_t bounded; /* 1: the guard's bound counts it, which may be taut soon; state */
};

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->string.on;
}

/* Of a row a point: of those that cuts made of one, by their shares. */
static void mean_of(const struct sim *sim, const struct string *string, double (*rows)[4], double mean[3])
{
    const struct patch *patch = &string->patch;
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t k = 0; k < patch->count; k++) {
        const double share = patch_share(sim, patch, k);
        for (int i = 0; i < 3; i++)
            mean[i] += share * rows[patch->point[k]][i] / patch->first;
    }
}

/* rows += the force at that mean, alike on each point. */
static void add_to_patch(const struct sim *sim, const struct string *string, const double force[3],
                         double (*rows)[4])
{
    const struct patch *patch = &string->patch;
    for (uint32_t k = 0; k < patch->count; k++) {
        const double share = patch_share(sim, patch, k);
        for (int i = 0; i < 3; i++)
            rows[patch->point[k]][i] += share * force[i] / patch->first;
    }
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    struct string *string = b->string = calloc(1, sizeof *string);
    if (!string)
        return error_no_memory(err, "the string");
    string->scene = &b->scene->string;
    if (string->scene->stiffness > 0 || string->scene->damping > 0)
        string->weight = string->scene->weight;
    enum status status = patch_open(sim, b, string->scene->place, string->scene->reach, "the string",
                                    &string->patch, err);
    if (!status && string->weight > 0)
        status = sim_add_body(sim, b, &string->scalar, err);
    if (status)
        return status;
    double mean[3];
    mean_of(sim, string, sim->position, mean);
    for (int i = 0; i < 3; i++)
        string->end[i] = b->centre[i] + string->scene->to[i] * b->radius;
    string->length = string->scene->slack * vec3_distance(mean, string->end);
    if (string->weight > 0)
        memcpy(&sim->scalar[string->scalar + SIM_BODY_PLACE], string->end, sizeof string->end);
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->string)
        patch_clear(&b->string->patch);
    free(b->string);
    b->string = NULL;
}

/* From the end to the patch. */
struct pull {
    double along[3], speed[3]; /* unit; of the patch, seen from the end */
    double length, tension;    /* 0 while it is slack */
};

static struct pull pull_of(const struct sim *sim, const struct string *string)
{
    const bool weight = string->weight > 0;
    const double *end = weight ? &sim->scalar[string->scalar + SIM_BODY_PLACE] : string->end;
    struct pull pull;
    double l[3];
    mean_of(sim, string, sim->position, l);
    mean_of(sim, string, sim->velocity, pull.speed);
    vec3_sub(l, end, l);
    pull.length = vec3_length(l);
    for (int i = 0; i < 3; i++) {
        pull.speed[i] -= weight ? sim->scalar[string->scalar + SIM_BODY_SPEED + (uint32_t)i] : 0;
        pull.along[i] = pull.length > 0 ? l[i] / pull.length : 0;
    }
    pull.tension = 0;
    if (pull.length > string->length)
        pull.tension = fmax(0, string->scene->stiffness * (pull.length - string->length) +
                                   string->scene->damping * vec3_dot(pull.speed, pull.along));
    return pull;
}

bool string_ends(const struct sim *sim, const struct sim_balloon *b, double skin[3], double end[3])
{
    const struct string *string = b->string;
    if (!string)
        return false;
    mean_of(sim, string, sim->position, skin);
    memcpy(end, string->weight > 0 ? &sim->scalar[string->scalar + SIM_BODY_PLACE] : string->end,
           sizeof string->end);
    return true;
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    const struct string *string = b->string;
    const struct pull pull = pull_of(sim, string);
    double force[3];
    for (int i = 0; i < 3; i++)
        force[i] = -(pull.tension * pull.along[i]);
    add_to_patch(sim, string, force, sim->force);
    if (string->weight == 0)
        return;
    double *rate = &sim->scalar_rate[string->scalar], *scalar = &sim->scalar[string->scalar];
    for (int i = 0; i < 3; i++) {
        const double falling = sim->scene->gravity.on ? sim->scene->gravity.acceleration[i] : 0;
        rate[SIM_BODY_PLACE + i] = scalar[SIM_BODY_SPEED + i];
        rate[SIM_BODY_SPEED + i] = falling + pull.tension * pull.along[i] / string->weight;
    }
}

/* F = -T u: dF = -(dT u + T du), du = (dl - u (u . dl))/|l|, dT = k u . dl + d (u . dv + v . du). The weight
 * is taken to stay where it is. */
static void product(struct sim *sim, struct sim_balloon *b, double a, double (*dx)[4], double f,
                    double (*dv)[4], double (*df)[4])
{
    const struct string *string = b->string;
    const struct pull pull = pull_of(sim, string);
    if (pull.tension == 0)
        return;
    double dl[3], ds[3], du[3], change[3];
    mean_of(sim, string, dx, dl);
    mean_of(sim, string, dv, ds);
    const double stretch = vec3_dot(pull.along, dl);
    for (int i = 0; i < 3; i++)
        du[i] = (dl[i] - pull.along[i] * stretch) / pull.length;
    const double dt = a * (string->scene->stiffness * stretch +
                           string->scene->damping * vec3_dot(pull.speed, du)) +
                      f * string->scene->damping * vec3_dot(pull.along, ds);
    for (int i = 0; i < 3; i++)
        change[i] = -(dt * pull.along[i] + a * pull.tension * du[i]);
    add_to_patch(sim, string, change, df);
}

/* By how much of its length a string may be shorter and be taut soon. */
static const double near = 0.1, far = 0.2;

/* As long as it may be two steps on, whichever way its ends move: one that came taut within a long step would
 * be stretched by all of that before anybody asked for shorter ones. */
static double soon(const struct sim *sim, const struct pull *pull)
{
    return pull->length + 2 * sim->whole_step * vec3_length(pull->speed);
}

/* A point feels its share, and what is stretched already pulls; and a weight that swings faster than the
 * point would is made up for by more of it. What hangs slack asks for nothing. */
static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    struct string *string = b->string;
    const struct pull pull = pull_of(sim, string);
    const double stretched = fmax(0, pull.length - string->length);
    string->bounded = soon(sim, &pull) >= (1 - near) * string->length;
    if (!string->bounded)
        return;
    for (uint32_t k = 0; k < string->patch.count; k++) {
        const uint32_t p = string->patch.point[k];
        const double share = patch_share(sim, &string->patch, k) / string->patch.first,
                     more = string->weight > 0 ? sim->mass[p] / string->weight : 0;
        rows->stiffness[p] += 2 * string->scene->stiffness * (share + more);
        rows->damping[p] += 2 * string->scene->damping * (share + more);
        rows->push[p] += string->scene->stiffness * stretched * share;
    }
}

/* A weight that bounces on its string comes taut anywhere within a step, and bounces higher, time and again,
 * where a step is not well below the time of a bounce; methods that solve equations have no derivatives of
 * it, and come to its place by turns with the skin's; one that chooses its steps goes by how the skin
 * moves. */
static double follow(const struct sim *sim, const struct sim_balloon *b)
{
    const struct string *string = b->string;
    (void)sim;
    if (string->weight == 0 || !string->bounded)
        return INFINITY;
    const double k = string->scene->stiffness / string->weight, d = string->scene->damping / string->weight;
    return 0.25 / (d + sqrt(d * d + k / 2)); /* d h + k h^2 is an eighth at most */
}

static void after(struct sim *sim, struct sim_balloon *b)
{
    const struct string *string = b->string;
    const double least = 1 - (string->bounded ? far : near);
    const struct pull pull = pull_of(sim, string);
    if ((soon(sim, &pull) >= least * string->length) != string->bounded)
        guard_bound_outdated(sim);
}

static void copied(struct sim *sim, struct sim_balloon *b, uint32_t point, uint32_t copy, double share)
{
    (void)sim;
    (void)point;
    (void)share;
    patch_copied(&b->string->patch, b, copy);
}

static void reorder(struct sim *sim, struct sim_balloon *b, const struct reorder *how)
{
    (void)sim;
    if (how->balloon == b)
        patch_reorder(&b->string->patch, b);
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *list)
{
    (void)sim;
    list[0] = (struct sim_block){"string", &b->string->bounded, sizeof b->string->bounded};
    return 1;
}

static double energy(struct sim *sim, struct sim_balloon *b)
{
    const struct string *string = b->string;
    const double stretched = fmax(0, pull_of(sim, string).length - string->length);
    double sum = string->scene->stiffness * stretched * stretched / 2;
    const double weight = string->weight, *scalar = weight > 0 ? &sim->scalar[string->scalar] : NULL;
    for (int i = 0; i < 3 && weight > 0; i++) {
        const double falling = sim->scene->gravity.on ? sim->scene->gravity.acceleration[i] : 0;
        sum += weight * (scalar[SIM_BODY_SPEED + i] * scalar[SIM_BODY_SPEED + i] / 2 -
                         falling * scalar[SIM_BODY_PLACE + i]);
    }
    return sum;
}

/* Whatever the tension is beyond the spring's. */
static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    (void)work;
    const struct pull pull = pull_of(sim, b->string);
    const double spring = b->string->scene->stiffness * fmax(0, pull.length - b->string->length);
    *dissipated += (pull.tension - spring) * vec3_dot(pull.speed, pull.along);
}

/* A weight whose place is no number pulls at nothing: the skin goes on without a word. */
static enum status check(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    const struct string *string = b->string;
    double sum = 0; /* no number where one of them is none */
    for (int i = 0; string->weight > 0 && i < SIM_BODY_SCALARS; i++)
        sum += 0 * sim->scalar[string->scalar + (uint32_t)i];
    if (sum == 0)
        return STATUS_OK;
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): the weight on the string of balloons[%zu] has run away; take "
        "a shorter step, another integrator, or a softer string",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, (size_t)(b - sim->balloons));
}

const struct effect effect_string = {.name = "string",
                                     .phase = EFFECT_FORCES,
                                     .wanted = wanted,
                                     .open = open,
                                     .close = close,
                                     .apply = apply,
                                     .after = after,
                                     .blocks = blocks,
                                     .copied = copied,
                                     .reorder = reorder,
                                     .product = product,
                                     .bound = bound,
                                     .follow = follow,
                                     .follows = "the weight on the string",
                                     .follows_why = "which pulls it back so fast; a heavier one or a softer "
                                                    "string would ask for less",
                                     .check = check,
                                     .energy = energy,
                                     .power = power,
                                     .damps = true,
                                     .source = "Hooke 1678"};
