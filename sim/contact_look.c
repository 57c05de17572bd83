/* Which pairs touch on their ways: of all that the list has, or of those whose points
 * have just been pushed. */
#include "common/vec3.h"
#include "sim/contact_approach.h"
#include "sim/contact_links.h"
#include "sim/contact_shares.h"

#include <string.h>

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

/* Those that begin in one place, as the two lips of a cut do, are to go apart towards where
 * the skin of each lies. */
static bool stays_together(const struct sim *sim, struct contact_approach *a)
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

bool contact_approaches(const struct sim *sim, const struct contact_pair *pair, struct contact_approach *a)
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
    struct contact_sieve by;
};

/* Of a worker's job; those that are worth a nearer look are few, and looked at eight at a time. */
enum { PAIRS_AT_ONCE = 256, PAIRS_A_JOB = 4 * PAIRS_AT_ONCE, POINTS_A_JOB = 4 };

/* Pairs of a kind that are worth a nearer look, some at a time. */
struct sieve {
    const struct look *look;
    uint32_t count[2];
    uint32_t pair[2][PAIRS_AT_ONCE], point[2][PAIRS_AT_ONCE][4];
};

/* Those that are clear of each other. */
static void send_to_sleep(const struct sieve *sieve, enum ccd_kind kind, const float *clear)
{
    const struct contact *c = sieve->look->sim->contact;
    for (uint32_t i = 0; c->may_sleep && i < sieve->count[kind]; i++) {
        const uint32_t *p = sieve->point[kind][i];
        if (clear[i] > 0)
            c->pairs[sieve->pair[kind][i]].until = contact_until(
                c->path[p[0]] + c->path[p[1]] + c->path[p[2]] + c->path[p[3]], clear[i]);
    }
}

static void look_closely(struct sieve *sieve, enum ccd_kind kind)
{
    const struct sim *sim = sieve->look->sim;
    struct contact *c = sim->contact;
    const struct contact_flock flock = {kind, c->ways, 0};
    uint32_t open[PAIRS_AT_ONCE];
    float clear[PAIRS_AT_ONCE];
    const uint32_t count = c->tree.kernels->open(&flock, c->thickness, sieve->point[kind], sieve->count[kind],
                                                 open, clear);
    send_to_sleep(sieve, kind, clear);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t pair = sieve->pair[kind][open[i]];
        struct contact_approach a;
        if (contact_approaches(sim, &c->pairs[pair], &a))
            c->hits[__atomic_fetch_add(&c->hit_count, 1, __ATOMIC_RELAXED)] = pair;
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

/* Takes in those of them that may touch; `which` has room for a multiple of eight. */
static void take_some_in(struct sieve *sieve, uint32_t *which, uint32_t count)
{
    const struct contact *c = sieve->look->sim->contact;
    uint32_t near[PAIRS_AT_ONCE];
    for (uint32_t i = count; i % 8 != 0; i++)
        which[i] = which[count - 1];
    count = c->tree.kernels->sift(&sieve->look->by, c->pairs, which, count, near);
    for (uint32_t i = 0; i < count; i++)
        take_in(sieve, near[i]);
}

static void take_all_in(struct sieve *sieve, uint32_t begin, uint32_t end)
{
    const struct contact *c = sieve->look->sim->contact;
    uint32_t near[PAIRS_AT_ONCE];
    const uint32_t count = c->tree.kernels->sift(&sieve->look->by, &c->pairs[begin], NULL, end - begin, near);
    for (uint32_t i = 0; i < count; i++)
        take_in(sieve, begin + near[i]);
}

/* Where skin rests on skin most sleep, and most of the others are near: a look at each is the cheapest. */
static uint32_t leave_sleepers_out(const struct contact *c, uint32_t *which, uint32_t count)
{
    uint32_t awake = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t pair = which[i];
        which[awake] = pair;
        awake += !contact_sleeps(&c->pairs[pair], c->ahead);
    }
    return awake;
}

static void take_awake_in(struct sieve *sieve, uint32_t begin, uint32_t end)
{
    uint32_t which[PAIRS_AT_ONCE];
    for (uint32_t i = begin; i < end; i++)
        which[i - begin] = i;
    const uint32_t count = leave_sleepers_out(sieve->look->sim->contact, which, end - begin);
    for (uint32_t i = 0; i < count; i++)
        take_in(sieve, which[i]);
}

static void look_at_some(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sieve sieve;
    begin_look(&sieve, context);
    const struct contact *c = sieve.look->sim->contact;
    const uint32_t begin = (uint32_t)index * PAIRS_A_JOB,
                   end = begin + PAIRS_A_JOB < c->pair_count ? begin + PAIRS_A_JOB : c->pair_count;
    for (uint32_t i = begin; i < end; i += PAIRS_AT_ONCE)
        (c->may_sleep ? take_awake_in : take_all_in)(&sieve, i,
                                                     i + PAIRS_AT_ONCE < end ? i + PAIRS_AT_ONCE : end);
    end_look(&sieve);
}

static void take_links_in(struct sieve *sieve, uint32_t *links, uint32_t count)
{
    const struct contact *c = sieve->look->sim->contact;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t pair = links[i] / 4, place = links[i] % 4;
        links[kept] = pair;
        kept += contact_is_first(c->stirred, c->pairs[pair].point, place);
    }
    if (!c->may_sleep) {
        take_some_in(sieve, links, kept);
        return;
    }
    kept = leave_sleepers_out(c, links, kept);
    for (uint32_t i = 0; i < kept; i++)
        take_in(sieve, links[i]);
}

static void look_at_links(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sieve sieve;
    begin_look(&sieve, context);
    const struct contact *c = sieve.look->sim->contact;
    const uint32_t begin = (uint32_t)index * POINTS_A_JOB,
                   end = begin + POINTS_A_JOB < c->moved_count ? begin + POINTS_A_JOB : c->moved_count;
    uint32_t kept[PAIRS_AT_ONCE], count = 0;
    for (uint32_t i = begin; i < end; i++) {
        struct contact_links links = contact_links_of(c, c->moved[i]);
        for (uint32_t at; (at = contact_links_next(&links)) != UINT32_MAX;) {
            kept[count++] = at;
            if (count == PAIRS_AT_ONCE) {
                take_links_in(&sieve, kept, count);
                count = 0;
            }
        }
    }
    take_links_in(&sieve, kept, count);
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
    const struct contact_sieve by = {c->off,
                                     (float)fmin(1, fmin(c->memory.began.growth, c->motion.growth)),
                                     {(float)contact_list_gone_before(sim), (float)contact_list_gone(sim)},
                                     (float)(c->thickness * 0.5000001)};
    struct look look = {sim, zones, by};
    c->hit_count = 0;
    contact_share_out(sim->pool, count, function, &look);
    sort_hits(c);
    drop_equal_hits(c);
    return c->hit_count > 0;
}

static struct contact_rounding round_ways(const struct sim *sim)
{
    const struct contact *c = sim->contact;
    return (struct contact_rounding){sim->before, sim->position, sim->before[0], NULL, c->ways};
}

bool contact_look(struct sim *sim)
{
    struct contact *c = sim->contact;
    struct contact_rounding ways = round_ways(sim);
    contact_round(sim, &ways);
    return look(sim, false, (c->pair_count + PAIRS_A_JOB - 1) / PAIRS_A_JOB, look_at_some);
}

bool contact_look_at_moved(struct sim *sim, bool zones)
{
    struct contact *c = sim->contact;
    struct contact_rounding ways = round_ways(sim);
    ways.points = c->moved;
    c->tree.kernels->round(&ways, 0, c->moved_count);
    contact_links_make(sim);
    return look(sim, zones, (sim->contact->moved_count + POINTS_A_JOB - 1) / POINTS_A_JOB, look_at_links);
}
