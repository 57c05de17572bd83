/* The pushes that keep skins apart, and the rounds of looking and pushing after a step. */
#include "common/vec3.h"
#include "sim/contact_approach.h"
#include "sim/ledger.h"
#include "sim/obstacles.h"
#include "sim/pins.h"
#include "sim/sweep.h"

#include <string.h>

enum { ROUNDS_MAX = 40 };

static double inverse_mass(const struct sim *sim, uint32_t p)
{
    return sim->contact->held[p] ? 0 : 1 / sim->mass[p];
}

/* Adds amount x weight / mass along the direction to the four rows of x: no momentum comes or goes. */
static void give(const struct sim *sim, const struct contact_approach *a, double (*x)[4],
                 const double direction[3], double amount)
{
    for (int i = 0; i < 4; i++) {
        const double share = amount * a->touch.weight[i] * inverse_mass(sim, a->p[i]);
        for (int k = 0; k < 3; k++)
            x[a->p[i]][k] += share * direction[k];
    }
}

/* The weighted sum of four rows: how the first feature stands, or moves, against the second. */
static void against(const struct contact_approach *a, double (*x)[4], double sum[3])
{
    for (int k = 0; k < 3; k++) {
        sum[k] = 0;
        for (int i = 0; i < 4; i++)
            sum[k] += a->touch.weight[i] * x[a->p[i]][k];
    }
}

/* Friction: what moves along the touch loses up to `most` of it. */
static void rub(const struct sim *sim, const struct contact_approach *a, double (*x)[4], double v[3],
                double most, double inverse)
{
    const double into = vec3_dot(v, a->touch.normal);
    for (int k = 0; k < 3; k++)
        v[k] -= into * a->touch.normal[k];
    const double along = vec3_length(v);
    if (!(along > 0) || !(most > 0))
        return;
    for (int k = 0; k < 3; k++)
        v[k] /= along;
    give(sim, a, x, v, -fmin(most, along) / inverse);
}

/*
 * With the weights and the normal n at the touch held, g(t) = n . sum w x(t) is the gap at time t. It
 * must not end below a target, and not be smaller on the way than what lets the next look pass. The
 * velocity loses its approach.
 */
static void push(struct sim *sim, const struct contact_approach *a)
{
    const struct contact *c = sim->contact;
    const double *n = a->touch.normal, gap = fmin(a->distance, c->thickness) / 2;
    double inverse = 0, end[3], v[3];
    for (int i = 0; i < 4; i++)
        inverse += a->touch.weight[i] * a->touch.weight[i] * inverse_mass(sim, a->p[i]);
    if (!(inverse > 0)) /* all are held */
        return;
    against(a, sim->position, end);
    const double target = fmin(c->thickness, a->distance + c->thickness / 4),
                 at_end = target - vec3_dot(end, n),
                 midway = (gap + (a->distance - gap) / 2 - a->touch.distance) / fmax(a->touch.time, 0.1),
                 far = fmax(at_end, midway);
    give(sim, a, sim->position, n, far / inverse);
    if (c->friction > 0) {
        double way[3], start[3];
        against(a, sim->before, start);
        against(a, sim->position, end);
        vec3_sub(end, start, way);
        rub(sim, a, sim->position, way, c->friction * fmax(at_end, 0), inverse);
    }
    against(a, sim->velocity, v);
    const double closing = -vec3_dot(v, n);
    if (closing > 0) {
        give(sim, a, sim->velocity, n, closing / inverse);
        rub(sim, a, sim->velocity, v, c->friction * closing, inverse);
    }
}

void contact_rest(struct contact *c)
{
    for (uint32_t i = 0; i < c->moved_count; i++)
        c->stirred[c->moved[i]] = 0;
    c->moved_count = 0;
}

void contact_move(struct contact *c, uint32_t point)
{
    if (!c->stirred[point])
        c->moved[c->moved_count++] = point;
    c->stirred[point] = 1;
}

/* Takes the approach from each pair that a look has found. */
static void push_all(struct sim *sim)
{
    struct contact *c = sim->contact;
    contact_rest(c);
    for (uint32_t i = 0; i < c->hit_count; i++) {
        struct contact_approach a;
        if (!contact_approaches(sim, &c->pairs[c->hits[i]], &a)) /* an earlier push was enough */
            continue;
        push(sim, &a);
        for (int k = 0; k < 4; k++)
            contact_move(c, a.p[k]);
    }
}

/* Sleeps while no pair is near, by the list as it was made: one that is found anew, as where a run is
 * resumed, is without those that have gone apart. */
static void note_awake(struct sim *sim)
{
    struct contact_memory *memory = &sim->contact->memory;
    const bool awake = memory->pairs > 0;
    if (awake && !memory->is_awake) {
        memory->wakes++;
        sim_tell(sim, sim->balloons, "contact", "wakes: skins come near each other");
    } else if (!awake && memory->is_awake) {
        sim_tell(sim, sim->balloons, "contact", "sleeps: nothing is near anything");
    }
    memory->is_awake = awake;
}

/* Pushing ends at nothing that stands in the way. */
static void turn_moved(struct sim *sim)
{
    struct contact *c = sim->contact;
    for (uint32_t i = 0; sim->obstacles && i < c->moved_count; i++) {
        const uint32_t p = c->moved[i];
        obstacles_turn(sim->obstacles, sim->before[p], sim->position[p], sim->velocity[p]);
    }
}

static enum status keep_apart(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    enum status status = STATUS_OK;
    memset(c->held, 0, sim->point_count);
    pins_mark(sim, c->held);
    bool hits = contact_look(sim);
    if (hits) {
        sim->pushed = sweep_sees_pushes(sim);
        ledger_note(sim);
    }
    for (int round = 0; hits && round < ROUNDS_MAX && !status; round++) {
        sim->changed = true;
        push_all(sim);
        turn_moved(sim);
        status = contact_list_follow_moved(sim, err);
        hits = !status && contact_look_at_moved(sim, false);
    }
    return hits && !status ? contact_freeze(sim, err) : status;
}

enum status contact_settle(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    sim->changed |= sim->obstacles && obstacles_settle(sim);
    enum status status = contact_list_follow(sim, err);
    if (status)
        return status;
    note_awake(sim);
    if (c->pair_count > 0)
        status = keep_apart(sim, err);
    c->memory.began = c->motion;
    c->memory.stray = c->stray;
    c->memory.used = c->used;
    return status;
}
