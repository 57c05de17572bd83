#include "sim/live_hand.h"
#include "common/array.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/pins.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

/* A patch has this radius, in mean rest lengths of its balloon; its springs are this many times
 * the balloon's: strong enough to tear the skin of the paper's balloons, weak enough to leave a
 * step that is stable so. */
static const double patch_radius = 2.5, stiffness_ratio = 1;

/* Where the ray meets the triangle: Moller and Trumbore, J. Graphics Tools 2 (1997) 21. */
static bool meets(const struct sim *sim, uint32_t t, const double origin[3], const double direction[3],
                  double *distance)
{
    const uint32_t *corner = sim->triangle_point[t];
    double a[3], b[3], from[3], cross[3], other[3];
    vec3_sub(sim->position[corner[1]], sim->position[corner[0]], a);
    vec3_sub(sim->position[corner[2]], sim->position[corner[0]], b);
    vec3_sub(origin, sim->position[corner[0]], from);
    vec3_cross(direction, b, cross);
    const double volume = vec3_dot(a, cross);
    if (!(fabs(volume) > 0))
        return false;
    const double u = vec3_dot(from, cross) / volume;
    vec3_cross(from, a, other);
    const double v = vec3_dot(direction, other) / volume;
    *distance = vec3_dot(b, other) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && *distance > 0;
}

bool hand_find(const struct sim *sim, const double origin[3], const double direction[3], struct hand_hit *hit)
{
    bool found = false;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        double distance;
        if (!sim->triangle_active[t] || !meets(sim, t, origin, direction, &distance) ||
            (found && distance >= hit->distance))
            continue;
        found = true;
        hit->triangle = t;
        hit->distance = distance;
    }
    for (int i = 0; i < 3 && found; i++)
        hit->place[i] = origin[i] + hit->distance * direction[i];
    return found;
}

static bool never(const struct scene_balloon *balloon)
{
    (void)balloon;
    return false;
}

/* How far a finger's point is from where the hand wants it. */
static void find_pull(const struct hand *hand, const struct sim *sim, const struct hand_finger *finger,
                      double pull[3])
{
    for (int i = 0; i < 3; i++)
        pull[i] = finger->place[i] + hand->by[i] - sim->position[finger->point][i];
}

static void apply(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    const struct hand *hand = sim->hand;
    for (uint32_t f = 0; f < hand->count; f++) {
        double pull[3];
        find_pull(hand, sim, &hand->finger[f], pull);
        for (int i = 0; i < 3; i++)
            sim->force[hand->finger[f].point][i] += hand->finger[f].stiffness * pull[i];
    }
    pins_hold(sim, sim->force); /* which had their turn before the hand */
}

static void product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4])
{
    (void)balloon, (void)b, (void)dv;
    for (const struct hand_finger *f = sim->hand->finger; f < sim->hand->finger + sim->hand->count; f++)
        for (int i = 0; i < 3; i++)
            df[f->point][i] -= a * f->stiffness * dx[f->point][i];
    pins_hold(sim, df);
}

static void bound(const struct sim *sim, const struct sim_balloon *balloon, const struct guard_rows *rows)
{
    (void)balloon;
    const struct hand *hand = sim->hand;
    for (uint32_t f = 0; f < hand->count; f++) {
        double pull[3];
        find_pull(hand, sim, &hand->finger[f], pull);
        rows->stiffness[hand->finger[f].point] += hand->finger[f].stiffness;
        rows->push[hand->finger[f].point] += hand->finger[f].stiffness * vec3_length(pull);
    }
}

/* Both fingers together are as strong as the one was, each by its point's mass. */
static void copied(struct sim *sim, struct sim_balloon *balloon, uint32_t point, uint32_t copy, double share)
{
    (void)balloon;
    struct hand *hand = sim->hand;
    for (uint32_t f = 0; f < hand->count; f++)
        if (hand->finger[f].point == point) {
            struct hand_finger *other = &hand->finger[hand->count++];
            *other = hand->finger[f];
            other->point = copy;
            other->stiffness *= share;
            hand->finger[f].stiffness -= other->stiffness;
            return;
        }
}

static void reorder(struct sim *sim, struct sim_balloon *balloon, const struct reorder *how)
{
    (void)balloon;
    for (struct hand_finger *f = sim->hand->finger; f < sim->hand->finger + sim->hand->count; f++)
        reorder_points(how, &f->point, 1);
}

static const struct effect effect_hand = {.name = "hand",
                                          .phase = EFFECT_FORCES,
                                          .wanted = never, /* by no scene: it is there while it holds */
                                          .apply = apply,
                                          .product = product,
                                          .bound = bound,
                                          .copied = copied,
                                          .reorder = reorder,
                                          .source = "a spring a point"};

enum status hand_open(struct hand *hand, struct sim *sim, struct error *err)
{
    const size_t hooks = sim->hook_count[EFFECT_FORCES] + 1;
    *hand = (struct hand){.finger = array_new(sim->point_count, sizeof *hand->finger),
                          .capacity = sim->point_count};
    struct effect_hook *longer = realloc(sim->hooks[EFFECT_FORCES], hooks * sizeof *longer);
    if (longer)
        sim->hooks[EFFECT_FORCES] = longer;
    if (!longer || !hand->finger) {
        free(hand->finger);
        *hand = (struct hand){0};
        return error_no_memory(err, "the hand");
    }
    return STATUS_OK;
}

void hand_close(struct hand *hand, struct sim *sim)
{
    if (hand->finger)
        hand_let_go(hand, sim);
    free(hand->finger);
    *hand = (struct hand){0};
}

/* What a stretch along one line is resisted with, force/length, so that a hand is as strong as the skin. */
static double skin_stiffness(const struct scene_balloon *balloon)
{
    const struct scene_membrane *membrane = &balloon->membrane;
    return membrane->on ? membrane->shear_modulus * membrane->thickness : balloon->spring;
}

/* Weights fall as (1 - r^2)^2 from the hit to the patch's edge; the hit's own corners are
 * held however far they are. */
static void add_finger(struct hand *hand, const struct sim *sim, const struct sim_balloon *balloon,
                       const struct hand_hit *hit, uint32_t p)
{
    const double ratio = vec3_distance(sim->position[p], hit->place) /
                         (patch_radius * balloon->mean_rest_length);
    const uint32_t *corner = sim->triangle_point[hit->triangle];
    const bool own = p == corner[0] || p == corner[1] || p == corner[2];
    double weight = ratio < 1 ? (1 - ratio * ratio) * (1 - ratio * ratio) : 0;
    if (own)
        weight = fmax(weight, 0.5);
    if (weight == 0 || hand->count == hand->capacity)
        return;
    struct hand_finger *finger = &hand->finger[hand->count++];
    finger->point = p;
    finger->stiffness = weight * stiffness_ratio * skin_stiffness(balloon->scene);
    memcpy(finger->place, sim->position[p], sizeof finger->place);
}

void hand_take(struct hand *hand, struct sim *sim, const struct hand_hit *hit)
{
    hand_let_go(hand, sim);
    struct sim_balloon *balloon = sim_balloon_of(sim, hit->triangle);
    for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++)
        add_finger(hand, sim, balloon, hit, p);
    memcpy(hand->from, hit->place, sizeof hand->from);
    hand->triangle = hit->triangle;
    sim->hooks[EFFECT_FORCES][sim->hook_count[EFFECT_FORCES]++] = (struct effect_hook){&effect_hand, balloon};
    sim->hand = hand;
    sim->changed = true;
    guard_outdated(sim);
}

void hand_move(struct hand *hand, struct sim *sim, const double place[3])
{
    guard_outdated(sim); /* what it pulls with is another now */
    vec3_sub(place, hand->from, hand->by);
}

void hand_let_go(struct hand *hand, struct sim *sim)
{
    if (!sim->hand)
        return;
    sim->hook_count[EFFECT_FORCES]--; /* it was the last one */
    sim->hand = NULL;
    sim->changed = true;
    guard_outdated(sim);
    hand->count = 0;
    memset(hand->by, 0, sizeof hand->by);
}

double hand_energy(const struct hand *hand, const struct sim *sim)
{
    double energy = 0;
    for (uint32_t f = 0; f < hand->count; f++) {
        double pull[3];
        find_pull(hand, sim, &hand->finger[f], pull);
        energy += hand->finger[f].stiffness * vec3_dot(pull, pull) / 2;
    }
    return energy;
}
