#include "common/threads.h"
#include "common/vec3.h"
#include "sim/cracks.h"
#include "sim/guard.h"
#include "sim/let_go.h"
#include "sim/measure.h"

#include <math.h>
#include <string.h>

/* W of an equal stretch both ways, neo-Hookean: (2 L^2 + L^-4 - 3)/2. */
double fracture_equal_energy(double stretch)
{
    const double squared = stretch * stretch;
    return (2 * squared + 1 / (squared * squared) - 3) / 2;
}

/* x = L^2 of x + 1/(2 x^2) = W + 3/2, whose left side rises and is convex from x = 1 on: Newton's method
 * comes down to it from any x that is too large, as W + 3/2 is. */
double fracture_equal_stretch(double energy)
{
    double squared = energy + 1.5, before;
    do {
        before = squared;
        const double slope = 1 - 1 / (squared * squared * squared);
        squared -= slope > 0 ? (squared + 1 / (2 * squared * squared) - energy - 1.5) / slope : 0;
        squared = fmax(squared, 1);
    } while (squared < before * (1 - 1e-15));
    return sqrt(squared);
}

/* Springs say nothing of how far a triangle is stretched across that is next to a line: it is taken for
 * stretched as much both ways as its longest side is. */
static void look_at_line(const struct sim *sim, const struct sim_balloon *b, const uint32_t *p,
                         struct membrane_state *s)
{
    double longest = 0, stretch = 0, side[3] = {0};
    for (int k = 0; k < 3; k++) {
        const uint32_t from = p[k], to = p[(k + 1) % 3];
        const double rest = vec3_distance(crack_rest(b, from), crack_rest(b, to));
        if (rest > longest) {
            longest = rest;
            vec3_sub(sim->position[to], sim->position[from], side);
            stretch = vec3_length(side) / rest;
        }
    }
    *s = (struct membrane_state){.stretch = {stretch, stretch}};
    vec3_unit(side);
    memcpy(s->direction, side, sizeof side);
    if (stretch <= 1)
        return;
    s->energy = fracture_equal_energy(stretch);
    s->stress[0] = s->stress[1] = stretch - pow(stretch, -5);
}

/* Principal stretches from F = [d1 d2] [(a, 0), (b, c)]^-1, whose columns are f1 and f2; then neo-Hookean,
 * with tension-field wrinkles (membrane.h). */
static void look_at_springs(const struct sim *sim, const struct sim_balloon *b, uint32_t triangle,
                            struct membrane_state *s)
{
    const double *shape = b->fracture->shape[triangle - b->triangle_begin];
    const uint32_t *p = sim->triangle_point[triangle];
    if (shape[2] == 0) {
        look_at_line(sim, b, p, s);
        return;
    }
    double d1[3], d2[3], f1[3], f2[3];
    sim_sides(sim, triangle, d1, d2);
    for (int i = 0; i < 3; i++) {
        f1[i] = d1[i] / shape[0];
        f2[i] = (d2[i] - shape[1] * f1[i]) / shape[2];
    }
    const double c11 = vec3_dot(f1, f1), c12 = vec3_dot(f1, f2), c22 = vec3_dot(f2, f2);
    const double mean = (c11 + c22) / 2, off = hypot((c11 - c22) / 2, c12);
    const double angle = off > 0 ? atan2(c12, (c11 - c22) / 2) / 2 : 0;
    const double l1 = sqrt(mean + off), l2 = sqrt(fmax(mean - off, 0));
    *s = (struct membrane_state){.stretch = {l1, l2}};
    for (int i = 0; i < 3; i++)
        s->direction[i] = l1 > 0 ? (cos(angle) * f1[i] + sin(angle) * f2[i]) / l1 : 0;
    if (l1 <= 1)
        return;
    const double across = fmax(l2, 1 / sqrt(l1)), thick = 1 / (l1 * across);
    s->energy = (l1 * l1 + across * across + thick * thick - 3) / 2;
    s->stress[0] = l1 - thick * thick / l1;
    s->stress[1] = l2 * l2 * l1 < 1 ? 0 : l2 - thick * thick / l2;
}

void fracture_look(const struct sim *sim, const struct sim_balloon *b, uint32_t triangle,
                   struct membrane_state *state)
{
    if (b->membrane)
        membrane_look(sim, b, triangle, state);
    else
        look_at_springs(sim, b, triangle, state);
}

enum { SHARES = 64 };

struct look {
    const struct sim *sim;
    const struct sim_balloon *balloon;
};

static void look_share(void *context, size_t share, unsigned worker)
{
    (void)worker;
    const struct look *look = context;
    const struct sim_balloon *b = look->balloon;
    const uint64_t count = b->triangle_end - b->triangle_begin;
    const uint32_t end = b->triangle_begin + (uint32_t)(count * (share + 1) / SHARES);
    for (uint32_t t = b->triangle_begin + (uint32_t)(count * share / SHARES); t < end; t++) {
        struct membrane_state s;
        fracture_look(look->sim, b, t, &s);
        b->fracture->energy[t - b->triangle_begin] = s.energy;
    }
}

static void find_energies(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    if (b->membrane)
        membrane_energies(sim, b, f->energy);
    else
        threads_run(sim->pool, SHARES, look_share, &(struct look){sim, b});
    memset(f->patch_sum, 0, f->patch_count * sizeof *f->patch_sum);
    for (uint32_t t = 0; t < b->triangle_end - b->triangle_begin; t++)
        f->patch_sum[f->patch[t]] += f->energy[t] * b->topology->rest_area[t];
}

/* What the patch around a triangle holds, and what it bears. */
static double patch_energy(const struct fracture *f, uint32_t t)
{
    return f->patch_sum[f->patch[t]] / f->patch_area[f->patch[t]];
}

static double patch_bears(const struct sim_balloon *b, uint32_t t)
{
    const struct fracture *f = b->fracture;
    const double again = f->now.births > 0 ? 1.5 : 1;
    return again * f->whole_energy * (1 + b->scene->fracture.weakness * f->noise[t]);
}

static double patch_strength(const struct sim_balloon *b, uint32_t triangle)
{
    const uint32_t t = triangle - b->triangle_begin;
    return patch_energy(b->fracture, t) / patch_bears(b, t);
}

bool fracture_nearest(const struct sim_balloon *b, double *held, double *borne)
{
    double most = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const double strength = patch_strength(b, t);
        if (strength <= most)
            continue;
        most = strength;
        *held = patch_energy(b->fracture, t - b->triangle_begin);
        *borne = patch_bears(b, t - b->triangle_begin);
    }
    return most > 0;
}

static bool is_near_birth(const struct sim_balloon *b, const double place[3], double distance)
{
    for (uint32_t i = 0; i < b->fracture->now.births; i++)
        if (vec3_distance(b->fracture->births[i], place) < distance * b->fracture->radius)
            return true;
    return false;
}

/* The weakest triangle of whole skin, in the sense of its patch; MESH_NONE: none is weak enough. */
static uint32_t weakest(const struct sim *sim, const struct sim_balloon *b)
{
    const struct fracture *f = b->fracture;
    double most = 1;
    uint32_t found = MESH_NONE;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const double strength = patch_strength(b, t);
        if (strength < most || (found != MESH_NONE && strength == most))
            continue;
        bool rim = false;
        for (int k = 0; k < 3; k++)
            rim |= fracture_is_rim(sim, b, sim->triangle_point[t][k]);
        if (is_near_birth(b, f->middle[t - b->triangle_begin], rim ? 0.25 : 0.6))
            continue;
        most = strength;
        found = t;
    }
    return found;
}

/* Direction of the largest tension around a point, as it lies in the skin at rest. */
static void tension_at(const struct sim *sim, const struct sim_balloon *b, uint32_t point,
                       double direction[3])
{
    /* the direction is taken back to rest by the triangle's corners, which keep their
     * barycentric coordinates */
    struct fan fan;
    struct membrane_state s, best = {.energy = -1};
    topology_first(sim, b, point, &fan);
    const uint32_t first = fan.triangle;
    uint32_t at = first;
    do {
        fracture_look(sim, b, fan.triangle, &s);
        if (s.stress[0] > best.stress[0] || best.energy < 0) {
            best = s;
            at = fan.triangle;
        }
    } while (topology_next(sim, b, &fan) && fan.triangle != first);
    const uint32_t *p = sim->triangle_point[at];
    double d1[3], d2[3];
    sim_sides(sim, at, d1, d2);
    const double g11 = vec3_dot(d1, d1), g12 = vec3_dot(d1, d2), g22 = vec3_dot(d2, d2);
    const double x = vec3_dot(best.direction, d1), y = vec3_dot(best.direction, d2);
    const double det = g11 * g22 - g12 * g12;
    const double u = det > 0 ? (g22 * x - g12 * y) / det : 1, v = det > 0 ? (g11 * y - g12 * x) / det : 0;
    double(*rest)[3] = b->topology->rest;
    for (int i = 0; i < 3; i++)
        direction[i] = u * (rest[p[1] - b->point_begin][i] - rest[p[0] - b->point_begin][i]) +
                       v * (rest[p[2] - b->point_begin][i] - rest[p[0] - b->point_begin][i]);
}

/* A slit at a point across the largest tension. Returns the cuts. */
static uint32_t open_at(struct sim *sim, struct sim_balloon *b, uint32_t point, double half_length)
{
    struct fracture *f = b->fracture;
    double tension[3], across[3], twice[3];
    const uint32_t *p = sim->triangle_point[b->topology->triangle_at[point - b->point_begin]];
    double(*rest)[3] = b->topology->rest;
    tension_at(sim, b, point, tension);
    vec3_triangle(rest[p[0] - b->point_begin], rest[p[1] - b->point_begin], rest[p[2] - b->point_begin],
                  twice);
    vec3_cross(twice, tension, across);
    if (f->now.births < BIRTHS_MAX)
        memcpy(f->births[f->now.births++], rest[point - b->point_begin], sizeof *f->births);
    return fracture_slit(sim, b, point, across, half_length);
}

const char *fracture_prick(struct sim *sim, struct sim_balloon *b, const double place[3])
{
    uint32_t nearest = b->point_begin;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        if (vec3_distance(sim->position[p], place) < vec3_distance(sim->position[nearest], place))
            nearest = p;
    if (is_near_birth(b, b->topology->rest[nearest - b->point_begin], 0.15))
        return "A hole began within 0.15 radii of here: click further from it."; /* a needle is still in it */
    if (!topology_can_cut(sim, b))
        return "The skin has no room for further cuts: give fracture.reserve more radii.";
    b->fracture->stamps++;
    const uint32_t cuts = open_at(sim, b, nearest, 0.075 * b->fracture->radius);
    fracture_tell_gas(sim, b);
    if (cuts > 0)
        return NULL;
    if (!b->fracture->told_whole)
        sim_tell(sim, b, "fracture",
                 "is pricked where nothing can be cut: too little skin is left there, or too many triangles "
                 "meet");
    b->fracture->told_whole = true;
    return "Nothing can be cut here: too little skin is left, or too many triangles meet.";
}

/* At the point at rest that lies most nearly in the direction of place. */
uint32_t fracture_rip(struct sim *sim, struct sim_balloon *b)
{
    const struct scene_rip *rip = &b->scene->rip;
    uint32_t nearest = b->point_begin;
    double most = -INFINITY;
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        double from_centre[3];
        vec3_sub(b->topology->rest[p - b->point_begin], b->centre, from_centre);
        const double along = vec3_dot(from_centre, rip->place) / vec3_length(from_centre);
        if (along > most) {
            most = along;
            nearest = p;
        }
    }
    b->fracture->stamps++;
    const uint32_t cuts = fracture_slit(sim, b, nearest, rip->direction, rip->length / 2 * b->radius);
    fracture_tell_gas(sim, b);
    return cuts;
}

double fracture_wave_speed(const struct sim_balloon *b)
{
    return b->membrane ? b->fracture->wave_speed : b->fracture->wave_speed * sqrt(b->now->spring_factor);
}

bool fracture_is_sound(const struct sim *sim, const struct sim_balloon *b)
{
    const struct fracture *f = b->fracture;
    bool sound = topology_is_sound(sim, b) && f->now.tips <= TIPS_MAX && f->now.births <= BIRTHS_MAX;
    for (uint32_t i = 0; sound && i < f->now.tips; i++)
        sound = f->tips[i].point >= b->point_begin &&
                f->tips[i].point < b->topology->old_points + b->topology->now.points;
    return sound;
}

void fracture_restored(struct sim *sim, struct sim_balloon *b)
{
    topology_restored(sim, b);
    fracture_tell_gas(sim, b);
}

const char *sim_prick(struct sim *sim, uint32_t triangle, const double place[3])
{
    struct sim_balloon *b = sim_balloon_of(sim, triangle);
    if (b->fracture)
        return fracture_prick(sim, b, place);
    for (int k = 0; k < 3; k++)
        if (sim->edge_active[sim->triangle_edge[triangle][k]])
            sim_break_edge(sim, sim->triangle_edge[triangle][k]);
    return NULL;
}

static void births(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    const uint32_t t = weakest(sim, b);
    if (t == MESH_NONE || !topology_can_cut(sim, b))
        return;
    if (f->now.births == BIRTHS_MAX) {
        if (f->now.refused_births++ == 0)
            sim_tell(sim, b, "fracture", "has begun to tear in 128 places: it does in no further one");
        return;
    }
    const uint32_t *p = sim->triangle_point[t];
    uint32_t point = p[0];
    for (int k = 1; k < 3; k++)
        if (fracture_is_rim(sim, b, point) && !fracture_is_rim(sim, b, p[k]))
            point = p[k];
    open_at(sim, b, point, 0.05 * f->radius);
}

/* Near a cut that is so young that the waves it made are not yet gone: there is more
 * tension there than will stay. */
static bool is_near_cut(const struct sim *sim, const struct sim_balloon *b, const double place[3])
{
    const struct fracture *f = b->fracture;
    const double reach = 0.15 * f->radius;
    for (uint32_t i = 0; i < f->now.tips; i++)
        if (sim->time < f->tips[i].since + reach / fracture_wave_speed(b) &&
            vec3_distance(crack_rest(b, f->tips[i].point), place) < reach)
            return true;
    return false;
}

/* Strands between pieces hold twice what whole skin does, and then snap: the most stretched first. Within a
 * look one does, so that the others learn of it. */
static void snap_strands(struct sim *sim, struct sim_balloon *b)
{
    enum { TRIES = 16 };
    const struct fracture *f = b->fracture;
    double below = INFINITY;
    for (int i = 0; i < TRIES && f->now.births > 0; i++) {
        double most = 2 * f->whole_energy;
        uint32_t found = MESH_NONE;
        for (uint32_t t = 0; t < b->triangle_end - b->triangle_begin; t++)
            if (f->energy[t] >= most && f->energy[t] < below && !is_near_cut(sim, b, f->middle[t])) {
                most = f->energy[t];
                found = t;
            }
        if (found == MESH_NONE || fracture_snap(sim, b, b->triangle_begin + found))
            return;
        below = most;
    }
}

void fracture_step(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    const uint32_t cuts = b->topology->now.edges;
    const double speed = fracture_wave_speed(b);
    f->stamps++;
    if (speed == 0)
        return;
    if (sim->time >= f->now.next_look) {
        f->now.next_look = sim->time + 0.02 * f->radius / speed;
        find_energies(sim, b);
        births(sim, b);
        snap_strands(sim, b);
    }
    fracture_tips(sim, b);
    const uint32_t now = b->topology->now.edges;
    if (now == cuts)
        return;
    fracture_tell_gas(sim, b);
    /* The number has a digit more: the bound on the step is looked at again, a dozen times in all. */
    if ((now ^ cuts) > cuts)
        guard_bound_outdated(sim);
}
