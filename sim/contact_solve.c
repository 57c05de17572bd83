/* Which pairs touch on their ways, and the pushes that keep them from it. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/contact.h"
#include "sim/obstacles.h"
#include "sim/pins.h"

#include <string.h>

enum { ROUNDS_MAX = 40 };

/* Ways that a pair may go, and how near. */
struct approach {
    uint32_t p[4];
    double from[4][3], to[4][3];
    double distance; /* at the start */
    struct ccd_touch touch;
};

/* False also where they were together from the start, as the two lips of a cut are: those go apart in their own time. */
static bool approaches(const struct sim *sim, const struct contact_pair *pair, struct approach *a)
{
    const struct contact *c = sim->contact;
    contact_points(sim, pair, a->p);
    contact_gather(sim->before, a->p, a->from);
    contact_gather(sim->position, a->p, a->to);
    const enum ccd_kind kind = (enum ccd_kind)pair->kind;
    a->distance = ccd_distance(kind, a->from, &a->touch);
    const double gap = fmin(a->distance, c->thickness) / 2;
    if (a->distance <= 1e-9 * c->thickness || a->distance - ccd_approach(kind, a->from, a->to) > gap)
        return false;
    return ccd_meet(kind, a->from, a->to, gap, &a->touch);
}

struct look {
    const struct sim *sim;
    bool zones;
    uint32_t *hit_count;
    double growth, gone, far; /* pairs that are further from each other do not touch */
};

enum { PAIRS_AT_ONCE = 256 };

static void look_at(void *context, size_t index, unsigned worker)
{
    (void)worker;
    const struct look *look = context;
    const struct sim *sim = look->sim;
    const struct contact *c = sim->contact;
    const uint32_t begin = (uint32_t)index * PAIRS_AT_ONCE,
                   end = begin + PAIRS_AT_ONCE < c->pair_count ? begin + PAIRS_AT_ONCE : c->pair_count;
    for (uint32_t i = begin; i < end; i++) {
        struct approach a;
        uint32_t p[4];
        if (((double)c->pairs[i].distance - look->gone * (double)c->pairs[i].approach) * look->growth >
            look->far)
            continue;
        contact_points(sim, &c->pairs[i], p);
        if (!(c->stirred[p[0]] | c->stirred[p[1]] | c->stirred[p[2]] | c->stirred[p[3]]))
            continue;
        if (look->zones && c->zone[p[0]] == c->zone[p[1]] && c->zone[p[0]] == c->zone[p[2]] &&
            c->zone[p[0]] == c->zone[p[3]])
            continue;
        if (approaches(sim, &c->pairs[i], &a))
            c->hits[__atomic_fetch_add(look->hit_count, 1, __ATOMIC_RELAXED)] = i;
    }
}

static bool is_before(const struct contact_pair *x, const struct contact_pair *y)
{
    if (x->kind != y->kind)
        return x->kind < y->kind;
    return x->a != y->a ? x->a < y->a : x->b < y->b;
}

static void sift(const struct contact_pair *pairs, uint32_t *hits, uint32_t root, uint32_t count)
{
    for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && is_before(&pairs[hits[child]], &pairs[hits[child + 1]]))
            child++;
        if (!is_before(&pairs[hits[root]], &pairs[hits[child]]))
            return;
        const uint32_t swap = hits[root];
        hits[root] = hits[child];
        hits[child] = swap;
    }
}

/* Heapsort: in place, and no two pairs are equal. */
static void sort_hits(struct contact *c)
{
    for (uint32_t i = c->hit_count / 2; i-- > 0;)
        sift(c->pairs, c->hits, i, c->hit_count);
    for (uint32_t i = c->hit_count; i-- > 1;) {
        const uint32_t swap = c->hits[0];
        c->hits[0] = c->hits[i];
        c->hits[i] = swap;
        sift(c->pairs, c->hits, 0, i);
    }
}

bool contact_look(struct sim *sim, bool zones)
{
    struct contact *c = sim->contact;
    c->hit_count = 0;
    const struct contact_drift *a = &c->memory.began, *b = &c->now;
    struct look look = {sim,
                        zones,
                        &c->hit_count,
                        fmin(a->growth, b->growth),
                        contact_list_gone(sim),
                        2 * fmax(a->stray, b->stray) + c->thickness / 2};
    threads_run(sim->pool, (c->pair_count + PAIRS_AT_ONCE - 1) / PAIRS_AT_ONCE, look_at, &look);
    sort_hits(c);
    return c->hit_count > 0;
}

static double inverse_mass(const struct sim *sim, uint32_t p)
{
    return sim->contact->held[p] ? 0 : 1 / sim->mass[p];
}

/* Adds amount x weight / mass along the direction to the four rows of x: no momentum comes or goes. */
static void give(const struct sim *sim, const struct approach *a, double (*x)[4], const double direction[3],
                 double amount)
{
    for (int i = 0; i < 4; i++) {
        const double share = amount * a->touch.weight[i] * inverse_mass(sim, a->p[i]);
        for (int k = 0; k < 3; k++)
            x[a->p[i]][k] += share * direction[k];
    }
}

/* The weighted sum of four rows: how the first feature stands, or moves, against the second. */
static void against(const struct approach *a, double (*x)[4], double sum[3])
{
    for (int k = 0; k < 3; k++) {
        sum[k] = 0;
        for (int i = 0; i < 4; i++)
            sum[k] += a->touch.weight[i] * x[a->p[i]][k];
    }
}

/* Friction: what moves along the touch loses up to `most` of it. */
static void rub(const struct sim *sim, const struct approach *a, double (*x)[4], double v[3], double most,
                double inverse)
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
 * With the weights and the normal n at the touch held, g(t) = n . sum w x(t) is the gap at time t. It must not end below a target, and not be smaller on the
 * way than what lets the next look pass. The velocity loses its approach.
 */
static void push(struct sim *sim, const struct approach *a)
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

void contact_push(struct sim *sim)
{
    struct contact *c = sim->contact;
    memset(c->stirred, 0, sim->point_count);
    for (uint32_t i = 0; i < c->hit_count; i++) {
        struct approach a;
        if (!approaches(sim, &c->pairs[c->hits[i]], &a)) /* an earlier push was enough */
            continue;
        push(sim, &a);
        for (int k = 0; k < 4; k++)
            c->stirred[a.p[k]] = 1;
    }
}

/* Sleeps while no pair is near. */
static void note_awake(struct sim *sim)
{
    struct contact_memory *memory = &sim->contact->memory;
    const bool awake = sim->contact->pair_count > 0;
    if (awake && !memory->is_awake) {
        memory->wakes++;
        sim_tell(sim, sim->balloons, "contact", "wakes: skins come near each other");
    } else if (!awake && memory->is_awake) {
        sim_tell(sim, sim->balloons, "contact", "sleeps: nothing is near anything");
    }
    memory->is_awake = awake;
}

/* The list, for the ways as they now are. */
static enum status renew(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    if (!contact_list_holds(sim))
        return contact_list_make(sim, err);
    return c->listed == c->memory.made ? STATUS_OK : contact_list_find(sim, err);
}

/* Pushing ends at nothing that stands in the way. */
static void turn_stirred(struct sim *sim)
{
    struct contact *c = sim->contact;
    for (uint32_t p = 0; sim->obstacles && p < sim->point_count; p++)
        if (c->stirred[p])
            obstacles_turn(sim->obstacles, sim->before[p], sim->position[p], sim->velocity[p]);
}

enum status contact_settle(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    sim->changed |= sim->obstacles && obstacles_settle(sim);
    enum status status = renew(sim, err);
    if (status)
        return status;
    note_awake(sim);
    if (c->pair_count > 0) {
        memset(c->stirred, 1, sim->point_count);
        memset(c->held, 0, sim->point_count);
        pins_mark(sim, c->held);
    }
    bool hits = c->pair_count > 0 && contact_look(sim, false);
    for (int round = 0; hits && round < ROUNDS_MAX && !status; round++) {
        sim->changed = true;
        contact_push(sim);
        turn_stirred(sim);
        status = renew(sim, err);
        hits = contact_look(sim, false);
    }
    if (hits && !status)
        status = contact_freeze(sim, err);
    c->memory.began = c->now;
    c->memory.used = c->used;
    return status;
}
