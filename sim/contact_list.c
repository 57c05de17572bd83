/* For which lines the list of pairs is made, and how long it holds. */
#include "common/vec3.h"
#include "sim/contact.h"
#include "sim/rows.h"
#include "sim/sweep.h"
#include "sim/topology.h"

#include <string.h>

/* A share of the mean edge as it is now: more, and neighbours in a sheet come onto the list; less, and it is
 * made more often. The more pairs there are, the more it matters. Of a sample of edges. */
static double choose_reach(const struct sim *sim)
{
    enum { SAMPLE = 512 };
    double least = INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const uint32_t stride = (b->edge_end - b->edge_begin) / SAMPLE + 1;
        double sum = 0, count = 0;
        for (uint32_t e = b->edge_begin; e < b->edge_end; e += stride, count++)
            sum += vec3_distance(sim->position[sim->edge_point[e][0]], sim->position[sim->edge_point[e][1]]);
        least = fmin(least, fmin(sum / count, 4 * b->mean_rest_length));
    }
    const struct contact_memory *memory = &sim->contact->memory;
    return least / (!memory->is_awake ? 10 : memory->pairs < 2 * (uint64_t)sim->point_count ? 14 : 24);
}

/* What is found again for this share of all points costs about as much as a list. While skins are
 * near each other, lists are made for so many steps that it is a part of that; where it is as
 * much, the list is given up. */
enum { AGAIN_LITTLE = 64, AGAIN_MUCH = 24, AGAIN_MOST = 10 };

/* As many steps as the last list held for; more where it came to its end with room to spare, fewer where
 * too much was found again. */
static uint64_t choose_horizon(const struct sim *sim)
{
    enum { HORIZON_FIRST = 4, HORIZON_MAX = 1024 };
    const struct contact_memory *memory = &sim->contact->memory;
    const uint64_t held = sim->steps - memory->made_in, horizon = memory->horizon;
    if (memory->made == 0 || held == 0)
        return 1;
    if (memory->made == 1) /* was of points at rest */
        return HORIZON_FIRST;
    if (held < horizon || horizon == 0)
        return held;
    if (memory->used > 0.5 && !memory->is_awake)
        return horizon;
    if (memory->is_awake && memory->again > sim->point_count / AGAIN_LITTLE)
        return memory->again > sim->point_count / AGAIN_MUCH ? horizon - horizon / 5 : horizon;
    const uint64_t more = memory->used < 0.2 && !memory->is_awake ? 2 * horizon : horizon + (horizon + 3) / 4;
    return more < HORIZON_MAX ? more : HORIZON_MAX;
}

double contact_list_gone(const struct sim *sim)
{
    const struct contact_memory *memory = &sim->contact->memory;
    return (double)(sim->steps - memory->made_in + 1) / (double)memory->horizon;
}

double contact_list_gone_before(const struct sim *sim)
{
    const struct contact_memory *memory = &sim->contact->memory;
    return (double)(sim->steps - memory->made_in) / (double)memory->horizon;
}

static inline double square_of(const row *way)
{
    const row squares = *way * *way;
    return squares[0] + squares[1] + squares[2];
}

/* Rounded up. */
static inline float root_above(double square)
{
    return (float)(1.000001 * sqrt(square));
}

struct laying {
    double steps,
        held; /* of the list to be made; of the one before, 0: there was none, or nothing moved yet */
};

/* A point that is drawn on evenly, by a x t^2/2, is least far from a straight line to this share of where it
 * will be: by .17 of that. */
static const double chord = 0.83;

/* As it moves now, and its speed changed since the last list was made. A point that strayed much
 * before may stray more. */
static void lay_lines(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct laying *job = context;
    struct contact *c = sim->contact;
    const row *position = (const row *)sim->position, *before = (const row *)sim->before,
              *velocity = (const row *)sim->velocity;
    const double base = c->memory.reach, bend = job->held > 0 ? chord / 2 * job->steps / job->held : 0;
    struct contact_share *share = &c->share[part - sim->parts];
    *share = (struct contact_share){0};
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const row speed = sim->taken * velocity[p],
                  then = {(double)c->speed[p][0], (double)c->speed[p][1], (double)c->speed[p][2], 0};
        row turn = bend * (speed - then);
        const double size = sqrt(square_of(&turn)) * job->steps, most = 8 * base;
        turn *= size > most ? most / size : 1;
        const row way = speed + turn, off = position[p] - before[p] - way;
        ((row *)c->from)[p] = before[p];
        ((row *)c->to)[p] = before[p] + job->steps * way;
        const double square = square_of(&off),
                     past = job->held > 0 ? 1.25 * (double)c->off[p] * job->steps / job->held : 0;
        c->reach[p] = (float)fmax(fmax(base, fmin(past, 4 * base)), 2 * sqrt(square));
        c->off[p] = root_above(square);
        for (int i = 0; i < 4; i++)
            c->speed[p][i] = (float)speed[i];
        share->stray = fmax(share->stray, square);
        share->pace = fmax(share->pace, square_of(&way));
    }
}

static uint64_t torn_points(const struct sim *sim)
{
    uint64_t count = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        count += b->topology ? b->topology->now.points : 0;
    return count;
}

static enum status make(struct sim *sim, uint64_t horizon, struct error *err)
{
    struct contact *c = sim->contact;
    struct laying job = {(double)horizon, 0};
    if (c->memory.made > 1)
        job.held = (double)(sim->steps - c->memory.made_in);
    c->memory.horizon = horizon;
    c->memory.made_in = sim->steps;
    c->memory.made++;
    c->memory.found++;
    c->memory.again = 0;
    c->memory.torn = torn_points(sim);
    c->memory.reach = choose_reach(sim);
    c->memory.began = c->motion = (struct contact_motion){.growth = 1};
    sim_each_part(sim, lay_lines, &job);
    double stray = 0, pace = 0;
    for (size_t i = 0; i < sim->part_count; i++) {
        stray = fmax(stray, c->share[i].stray);
        pace = fmax(pace, c->share[i].pace);
    }
    c->stray = sqrt(stray);
    c->used = c->stray / c->memory.reach;
    c->memory.pace = sqrt(pace);
    enum status status = contact_pairs_find(sim, err);
    c->memory.pairs = c->pair_count;
    return status;
}

/* Where too much would come near in many steps, for one. */
enum status contact_list_make(struct sim *sim, struct error *err)
{
    const uint64_t horizon = choose_horizon(sim);
    enum status status = make(sim, horizon, err);
    return status && horizon > 1 ? make(sim, 1, err) : status;
}

static inline void on_line(const struct contact *c, uint32_t p, double gone, row *place)
{
    const row from = *(const row *)c->from[p];
    *place = from + gone * (*(const row *)c->to[p] - from);
}

/* A balloon that moves and grows as a whole brings nothing nearer to itself. Of a sample of points, since
 * any such motion will do. */
static struct contact_motion motion_of(const struct sim *sim, const struct sim_balloon *b, double gone)
{
    enum { SAMPLE = 256 };
    const row *x = (const row *)sim->position;
    struct contact_motion m = {.growth = 1};
    const uint32_t count = b->point_end - b->point_begin, stride = count / SAMPLE + 1;
    double sampled = 0, along = 0, square = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride, sampled++) {
        row at;
        on_line(sim->contact, p, gone, &at);
        for (int i = 0; i < 3; i++) {
            m.middle[i] += x[p][i];
            m.from[i] += at[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        m.middle[i] /= sampled;
        m.from[i] /= sampled;
    }
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride) {
        row at;
        on_line(sim->contact, p, gone, &at);
        for (int i = 0; i < 3; i++) {
            along += (x[p][i] - m.middle[i]) * (at[i] - m.from[i]);
            square += (at[i] - m.from[i]) * (at[i] - m.from[i]);
        }
    }
    if (square > 0 && along > 0)
        m.growth = along / square;
    return m;
}

/* Another balloon near it is brought nearer by such a motion. */
static bool is_alone(const struct sim *sim)
{
    return sim->balloon_count == 1;
}

/* Points as the motion has them. */
struct watch {
    const struct contact *contact;
    struct contact_motion motion;
    row shift;
    double gone;
    double growth, lost; /* a point may stray growth x its reach - lost */
};

/* Distances between images of points under a motion grow with it, but the room that is wanted does not: what
 * shrinks has less to stray. */
static struct watch watch_of(const struct contact *c, const struct contact_motion *m, double gone)
{
    const double growth = fmin(m->growth, 1);
    const row shift = {m->middle[0] - m->growth * m->from[0], m->middle[1] - m->growth * m->from[1],
                       m->middle[2] - m->growth * m->from[2], 0};
    return (struct watch){c, *m, shift, gone, growth, (1 - growth) * c->thickness / 2};
}

static inline double stray_of(const struct watch *w, uint32_t p, double (*x)[4])
{
    row off;
    on_line(w->contact, p, w->gone, &off);
    off = *(const row *)x[p] - w->motion.growth * off - w->shift;
    return square_of(&off);
}

/* Whether a point may not have strayed as far as that square says. */
static inline bool is_too_far(const struct watch *w, uint32_t p, double square)
{
    const double most = w->growth * (double)w->contact->reach[p] - w->lost;
    return most < 0 || square > most * most;
}

/* A point's path goes on to where it is, in this step, rounded up: adding is off by no more than 6e-8 of it.
 * Returns how far that was. */
static inline float follow_path(struct contact *c, uint32_t p, const double x[4])
{
    row *seen = (row *)c->seen[p];
    const row way = *(const row *)x - *seen;
    const double square = square_of(&way);
    if (square == 0)
        return 0;
    const float length = root_above(square);
    c->path[p] = 1.0000002F * (c->path[p] + length);
    c->ahead[p] = 1.0000002F * (c->ahead[p] + 2 * length);
    *seen = *(const row *)x;
    return length;
}

/* Most pairs that are near have less than half of the thickness to spare: where points go a share of it in a
 * step, four of them, none sleeps for long; and what is folded and rests is a small part of the skin. */
enum { SLOW = 32, FEW_SLOW = 16 };

static void watch_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct watch *w = context;
    struct contact *c = sim->contact;
    struct contact_share share = {0};
    const float slow = (float)c->thickness / SLOW;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const double square = stray_of(w, p, sim->position);
        const float above = root_above(square);
        c->off[p] = above > c->off[p] ? above : c->off[p];
        if (c->pair_count > 0 || c->memory.is_awake) {
            follow_path(c, p, sim->before[p]); /* where something has moved it since it was seen */
            c->ahead[p] = c->path[p];
            share.slow += follow_path(c, p, sim->position[p]) < slow;
        }
        share.stray = square > share.stray ? square : share.stray;
        if (is_too_far(w, p, square))
            c->again[part->point_begin + share.count++] = p;
    }
    c->share[part - sim->parts] = share;
}

/* Where nothing is near, the point that has strayed most may since have gone a step's longest way to one
 * side, and its line to the other, which growth makes no more than twice as long. */
static bool surely_holds(struct sim *sim)
{
    struct contact *c = sim->contact;
    if (c->memory.is_awake || sim->changed)
        return false;
    const double growth = fmin(c->memory.began.growth, 1),
                 allowed = growth * c->memory.reach - (1 - growth) * c->thickness / 2,
                 most = c->memory.stray + sweep_saw_farthest(sim) + 2 * c->memory.pace;
    if (!(most < allowed / 2))
        return false;
    c->motion = c->memory.began;
    c->stray = most;
    c->used = most / allowed;
    return true;
}

/* From where it is, as it moves now; it may stray further than before. Its way of this
 * step begins where it did. */
static void lay_again(struct sim *sim, const struct watch *w, const struct watch *began, uint32_t p)
{
    struct contact *c = sim->contact;
    const struct contact_motion *m = &w->motion;
    const row place = (((const row *)sim->position)[p] - w->shift) / m->growth,
              way = (double)c->memory.horizon * sim->taken * ((const row *)sim->velocity)[p];
    ((row *)c->from)[p] = place - w->gone * way;
    ((row *)c->to)[p] = place + (1 - w->gone) * way;
    const double square = stray_of(began, p, sim->before), growth = fmin(w->growth, began->growth),
                 wanted = (2 * sqrt(square) + fmax(w->lost, began->lost)) / growth;
    c->off[p] = root_above(square);
    c->reach[p] = (float)fmax(fmin(2 * (double)c->reach[p], 4 * c->memory.reach), wanted);
}

static void note_again(struct contact *c, uint32_t p)
{
    c->again[c->again_count++] = p;
}

/* Of the points that strayed too far what is near them is found anew; where they are many, everything. */
static enum status mend(struct sim *sim, const struct watch *w, struct error *err)
{
    struct contact *c = sim->contact;
    const struct watch began = watch_of(c, &c->memory.began, contact_list_gone_before(sim));
    c->memory.again += c->again_count;
    if (!c->memory.is_awake || c->memory.again > sim->point_count / AGAIN_MOST)
        return contact_list_make(sim, err);
    for (uint32_t i = 0; i < c->again_count; i++)
        lay_again(sim, w, &began, c->again[i]);
    c->memory.found++;
    return contact_pairs_find_again(sim, err) ? contact_list_make(sim, err) : STATUS_OK;
}

enum status contact_list_follow(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    if (sim->steps - c->memory.made_in >= c->memory.horizon || c->memory.torn != torn_points(sim))
        return contact_list_make(sim, err);
    if (c->listed != c->memory.found || c->listed_broken != sim->broken) { /* skin may have vanished */
        enum status status = contact_pairs_find(sim, err);
        if (status)
            return status;
        if (c->memory.pairs == 0) /* patches with a new hole may be near themselves */
            c->memory.pairs = c->pair_count;
    }
    if (surely_holds(sim))
        return STATUS_OK;
    c->motion = (struct contact_motion){.growth = 1};
    if (is_alone(sim) && c->memory.made_in != sim->steps)
        c->motion = motion_of(sim, sim->balloons, contact_list_gone(sim));
    struct watch w = watch_of(c, &c->motion, contact_list_gone(sim));
    sim_each_part(sim, watch_part, &w);
    double largest = 0;
    uint32_t slow = 0;
    for (size_t i = 0; i < sim->part_count; i++) {
        largest = fmax(largest, c->share[i].stray);
        slow += c->share[i].slow;
    }
    c->may_sleep = slow > sim->point_count / FEW_SLOW;
    c->stray = sqrt(largest);
    c->used = c->stray / (w.growth * c->memory.reach - w.lost);
    c->again_count = 0;
    for (size_t i = 0; i < sim->part_count;
         i++) /* each part has noted them from its first point's place on */
        for (uint32_t k = 0; k < c->share[i].count; k++)
            note_again(c, c->again[sim->parts[i].point_begin + k]);
    return c->again_count ? mend(sim, &w, err) : STATUS_OK;
}

enum status contact_list_follow_moved(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    const struct watch w = watch_of(c, &c->motion, contact_list_gone(sim));
    c->again_count = 0;
    for (uint32_t i = 0; i < c->moved_count; i++) {
        const uint32_t p = c->moved[i];
        const double square = stray_of(&w, p, sim->position);
        sweep_see_pushed(sim, 0, p);
        c->off[p] = fmaxf(c->off[p], root_above(square));
        follow_path(c, p, sim->position[p]);
        c->stray = fmax(c->stray, sqrt(square));
        if (is_too_far(&w, p, square))
            note_again(c, p);
    }
    return c->again_count ? mend(sim, &w, err) : STATUS_OK;
}
