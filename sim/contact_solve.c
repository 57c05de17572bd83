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
    const uint32_t *p;
    double from[4][3], to[4][3];
    double distance; /* at the start */
    struct ccd_touch touch;
};

/* The middle of the skin around a point as the step begins. */
static void middle_around(const struct sim *sim, uint32_t point, double middle[3])
{
    const struct contact *c = sim->contact;
    const uint32_t begin = point ? c->star_end[point - 1] : 0;
    double count = 0;
    memset(middle, 0, 3 * sizeof *middle);
    for (uint32_t s = begin; s < c->star_end[point]; s++)
        for (int k = 0; k < 3; k++, count++)
            for (int i = 0; i < 3; i++)
                middle[i] += sim->before[sim->triangle_point[c->star[s]][k]][i];
    for (int i = 0; i < 3 && count > 0; i++)
        middle[i] /= count;
}

/* Those that begin in one place, as the two lips of a cut do, are to go apart towards where the skin of each lies. */
static bool stays_together(const struct sim *sim, struct approach *a)
{
    double *n = a->touch.normal, middle[3], length;
    memset(n, 0, 3 * sizeof *n);
    for (int i = 0; i < 4; i++) {
        middle_around(sim, a->p[i], middle);
        for (int k = 0; k < 3; k++)
            n[k] += a->touch.weight[i] * middle[k];
    }
    length = vec3_length(n);
    if (!(length > 0))
        return false;
    double apart = 0;
    for (int k = 0; k < 3; k++) {
        n[k] /= length;
        for (int i = 0; i < 4; i++)
            apart += n[k] * a->touch.weight[i] * a->to[i][k];
    }
    a->touch.time = a->touch.distance = a->distance = 0;
    return apart < sim->contact->thickness / 8;
}

static bool approaches(const struct sim *sim, const struct contact_pair *pair, struct approach *a)
{
    const struct contact *c = sim->contact;
    a->p = pair->point;
    contact_gather(sim->before, a->p, a->from);
    contact_gather(sim->position, a->p, a->to);
    const enum ccd_kind kind = (enum ccd_kind)pair->kind;
    a->distance = ccd_distance(kind, a->from, &a->touch);
    if (a->distance <= 1e-9 * c->thickness)
        return stays_together(sim, a);
    const double gap = fmin(a->distance, c->thickness) / 2;
    if (ccd_apart(kind, &a->touch, a->to) > gap || a->distance - ccd_approach(kind, a->from, a->to) > gap)
        return false;
    return ccd_meet(kind, a->from, a->to, gap, &a->touch);
}

struct look {
    const struct sim *sim;
    bool zones;
    double growth, gone[2]; /* at the step's beginning and end */
};

static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Whether they may be near enough at all, by what is known of their lines and of how far the points strayed:
 * (a + b)^2 <= 2 (a^2 + b^2). Without branches, since nobody can guess. */
static inline bool may_touch(const struct look *look, const struct contact_pair *pair)
{
    const struct contact *c = look->sim->contact;
    const uint32_t *p = pair->point;
    const float *s = c->strayed, first = s[p[0]], second = s[p[1]], high = larger(s[p[2]], s[p[3]]);
    const bool edges = pair->kind == CCD_EDGES;
    const double approach = (double)pair->approach, gone = look->gone[approach > 0],
                 room = look->growth * ((double)pair->distance - gone * approach) - c->thickness / 2,
                 squares = (double)(larger(first, edges ? second : 0) + larger(high, edges ? 0 : second));
    return (room <= 0) | (room * room <= 2.00001 * squares);
}

/* Pairs of a kind that are worth a nearer look, some at a time. */
enum { PAIRS_AT_ONCE = 256, POINTS_AT_ONCE = 8 };

struct sieve {
    const struct look *look;
    uint32_t count[2];
    uint32_t pair[2][PAIRS_AT_ONCE], point[2][PAIRS_AT_ONCE][4];
};

/* Whether a pair surely does not approach, by how far it is apart along a line. It begins no nearer than that, and to rounding no further. */
static bool is_clear(const struct contact *c, const double apart[2])
{
    return apart[0] > 1e-6 * c->thickness && apart[1] > 0.500001 * fmin(apart[0], c->thickness);
}

static void look_closely(struct sieve *sieve, enum ccd_kind kind)
{
    const struct sim *sim = sieve->look->sim;
    struct contact *c = sim->contact;
    struct contact_flock flock = {kind, sim->before, sim->position, 0};
    double apart[PAIRS_AT_ONCE][2];
    c->tree.kernels->apart(&flock, sieve->point[kind], sieve->count[kind], apart);
    for (uint32_t i = 0; i < sieve->count[kind]; i++) {
        struct approach a;
        if (!is_clear(c, apart[i]) && approaches(sim, &c->pairs[sieve->pair[kind][i]], &a))
            c->hits[__atomic_fetch_add(&c->hit_count, 1, __ATOMIC_RELAXED)] = sieve->pair[kind][i];
    }
    sieve->count[kind] = 0;
}

static inline void take_in(struct sieve *sieve, uint32_t i)
{
    const struct contact_pair *pair = &sieve->look->sim->contact->pairs[i];
    const uint32_t *p = pair->point, *zone = sieve->look->sim->contact->zone;
    if (sieve->look->zones && zone[p[0]] == zone[p[1]] && zone[p[0]] == zone[p[2]] &&
        zone[p[0]] == zone[p[3]])
        return;
    const uint32_t place = sieve->count[pair->kind]++;
    sieve->pair[pair->kind][place] = i;
    memcpy(sieve->point[pair->kind][place], p, 4 * sizeof *p);
    for (int k = 0; k < 4; k++) { /* wanted soon */
        __builtin_prefetch(sieve->look->sim->before[p[k]]);
        __builtin_prefetch(sieve->look->sim->position[p[k]]);
    }
    if (place + 1 == PAIRS_AT_ONCE)
        look_closely(sieve, (enum ccd_kind)pair->kind);
}

static void end_look(struct sieve *sieve)
{
    look_closely(sieve, CCD_POINT_TRIANGLE);
    look_closely(sieve, CCD_EDGES);
}

static void begin_look(struct sieve *sieve, const struct look *look)
{
    sieve->look = look;
    sieve->count[0] = sieve->count[1] = 0;
}

static void look_at_some(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sieve sieve;
    begin_look(&sieve, context);
    const struct contact *c = sieve.look->sim->contact;
    const uint32_t begin = (uint32_t)index * PAIRS_AT_ONCE,
                   end = begin + PAIRS_AT_ONCE < c->pair_count ? begin + PAIRS_AT_ONCE : c->pair_count;
    uint32_t kept[PAIRS_AT_ONCE], count = 0;
    for (uint32_t i = begin; i < end; i++) {
        kept[count] = i;
        count += may_touch(sieve.look, &c->pairs[i]);
    }
    for (uint32_t i = 0; i < count; i++)
        take_in(&sieve, kept[i]);
    end_look(&sieve);
}

/* Each pair by the first of its points that have moved. */
static void look_at_links(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sieve sieve;
    begin_look(&sieve, context);
    const struct contact *c = sieve.look->sim->contact;
    const uint32_t begin = (uint32_t)index * POINTS_AT_ONCE,
                   end = begin + POINTS_AT_ONCE < c->moved_count ? begin + POINTS_AT_ONCE : c->moved_count;
    for (uint32_t i = begin; i < end; i++)
        for (uint32_t at = c->first[c->moved[i]]; at != UINT32_MAX; at = c->next[at / 4][at % 4]) {
            const uint32_t *p = c->pairs[at / 4].point;
            bool first = true;
            for (uint32_t k = 0; k < at % 4; k++)
                first &= !c->stirred[p[k]];
            if (first && may_touch(sieve.look, &c->pairs[at / 4]))
                take_in(&sieve, at / 4);
        }
    end_look(&sieve);
}

static bool is_before(const struct contact_pair *x, const struct contact_pair *y)
{
    if (x->kind != y->kind)
        return x->kind < y->kind;
    int k = 0;
    while (k < 3 && x->point[k] == y->point[k])
        k++;
    return x->point[k] < y->point[k];
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

/* Heapsort: in place. */
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

/* What was found twice (contact_tree_pairs_opened()) is one. */
static void drop_equal_hits(struct contact *c)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->hit_count; i++)
        if (i == 0 || is_before(&c->pairs[c->hits[count - 1]], &c->pairs[c->hits[i]]))
            c->hits[count++] = c->hits[i];
    c->hit_count = count;
}

static bool look(struct sim *sim, bool zones, size_t count,
                 void (*function)(void *context, size_t index, unsigned worker))
{
    struct contact *c = sim->contact;
    struct look look = {sim,
                        zones,
                        fmin(1, fmin(c->memory.began.growth, c->motion.growth)),
                        {contact_list_gone_before(sim), contact_list_gone(sim)}};
    c->hit_count = 0;
    threads_run(sim->pool, count, function, &look);
    sort_hits(c);
    drop_equal_hits(c);
    return c->hit_count > 0;
}

bool contact_look(struct sim *sim)
{
    return look(sim, false, (sim->contact->pair_count + PAIRS_AT_ONCE - 1) / PAIRS_AT_ONCE, look_at_some);
}

bool contact_look_at_moved(struct sim *sim, bool zones)
{
    contact_pairs_link(sim);
    return look(sim, zones, (sim->contact->moved_count + POINTS_AT_ONCE - 1) / POINTS_AT_ONCE, look_at_links);
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
        struct approach a;
        if (!approaches(sim, &c->pairs[c->hits[i]], &a)) /* an earlier push was enough */
            continue;
        push(sim, &a);
        for (int k = 0; k < 4; k++)
            contact_move(c, a.p[k]);
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
    for (int round = 0; hits && round < ROUNDS_MAX && !status; round++) {
        sim->changed = true;
        push_all(sim);
        turn_moved(sim);
        status = contact_list_follow_moved(sim, err);
        hits = contact_look_at_moved(sim, false);
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
