/* Needles: points that move on their own and start a tear where they meet the skin,
 * whichever of the two moves. */
#include "common/vec3.h"
#include "sim/ccd.h"
#include "sim/effects.h"
#include "sim/lanes.h"
#include "sim/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene *scene)
{
    return scene->needles_count > 0;
}

/* What is remembered from step to step. */
struct needles {
    double room;           /* how much nearer any needle and any point may come before they can meet; state */
    struct search *search; /* [part_count] owned */
};

/* A needle's way over the last step, and the box around it. */
struct prick {
    double from[3], to[3];
    lanes low, high;
};

/* Where the skin is met next. */
struct hole {
    double time; /* 0 to 1; INFINITY: nowhere */
    uint32_t triangle;
};

/* By how much the needle's way is beside that of the triangle, along one of the axes: so much they
 * must come nearer to meet. */
static double apart(const struct sim *sim, const uint32_t *p, const struct prick *prick)
{
    const row *before = (const row *)sim->before, *now = sim->rows.position;
    lanes low = (lanes)before[p[0]], high = low;
    for (int k = 0; k < 3; k++) {
        const lanes first = (lanes)before[p[k]], last = (lanes)now[p[k]];
        low = lanes_min(lanes_min(first, last), low);
        high = lanes_max(lanes_max(first, last), high);
    }
    const lanes beside = lanes_max(low - prick->high, prick->low - high);
    const double most = beside[0] > beside[1] ? beside[0] : beside[1];
    return beside[2] > most ? beside[2] : most;
}

/* On the way from a to b. */
static void place_at(double time, const double *a, const double *b, double place[3])
{
    for (int i = 0; i < 3; i++)
        place[i] = a[i] + time * (b[i] - a[i]);
}

/* When the needle comes to the triangle, `since` or later; INFINITY: it does not. */
static double meeting(const struct sim *sim, uint32_t triangle, const struct prick *prick, double since,
                      double gap)
{
    const uint32_t *p = sim->triangle_point[triangle];
    double from[4][3], to[4][3];
    struct ccd_touch touch;
    place_at(since, prick->from, prick->to, from[0]);
    memcpy(to[0], prick->to, sizeof to[0]);
    for (int k = 0; k < 3; k++) {
        place_at(since, sim->before[p[k]], sim->position[p[k]], from[k + 1]);
        memcpy(to[k + 1], sim->position[p[k]], sizeof to[k]);
    }
    if (ccd_distance(CCD_POINT_TRIANGLE, from, &touch) <= gap)
        return since;
    if (!ccd_meet(CCD_POINT_TRIANGLE, from, to, gap / 2, &touch))
        return INFINITY;
    return since + touch.time * (1 - since);
}

/* Among the triangles of a part. */
struct search {
    struct hole first;
    double room;
};

struct job {
    const struct prick *prick;
    double since; /* 0 to 1 */
    struct search *search;
};

static void search_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct job *job = context;
    const double gap = part->balloon->mean_rest_length / 1000;
    struct search found = {{INFINITY, 0}, INFINITY};
    for (uint32_t t = part->triangle_begin; t < part->triangle_end; t++) {
        if (!sim->triangle_active[t])
            continue;
        const double beside = apart(sim, sim->triangle_point[t], job->prick) - gap;
        found.room = beside < found.room ? beside : found.room;
        const double time = beside > 0 ? INFINITY : meeting(sim, t, job->prick, job->since, gap);
        if (time < found.first.time)
            found.first = (struct hole){time, t};
    }
    job->search[part - sim->parts] = found;
}

/* The first of all; of two at once the one with the lower number. */
static struct search search_all(struct sim *sim, const struct prick *prick, double since)
{
    struct search *parts = sim->needles->search, all = {{INFINITY, 0}, INFINITY};
    sim_each_part(sim, search_part, &(struct job){prick, since, parts});
    for (size_t i = 0; i < sim->part_count; i++) {
        all.room = fmin(all.room, parts[i].room);
        if (parts[i].first.time < all.first.time)
            all.first = parts[i].first;
    }
    return all;
}

static void needle_at(const struct scene_needles *needle, double time, double x[3])
{
    for (int i = 0; i < 3; i++)
        x[i] = needle->from[i] + needle->velocity[i] * (time - needle->at);
}

/* Before its time it is where it will begin. */
static struct prick prick_of(const struct sim *sim, const struct scene_needles *needle)
{
    struct prick prick;
    needle_at(needle, fmax(sim->time - sim->taken, needle->at), prick.from);
    needle_at(needle, fmax(sim->time, needle->at), prick.to);
    const lanes from = {prick.from[0], prick.from[1], prick.from[2]},
                to = {prick.to[0], prick.to[1], prick.to[2]};
    prick.low = lanes_min(from, to);
    prick.high = lanes_max(from, to);
    return prick;
}

/* What the last step took of the room, and rounding with it. */
static double come_nearer(const struct sim *sim)
{
    double way = 0;
    for (size_t i = 0; i < sim->scene->needles_count; i++) {
        const struct prick prick = prick_of(sim, &sim->scene->needles[i]);
        way = fmax(way, vec3_distance(prick.from, prick.to));
    }
    return (1 + 1e-9) * (sweep_saw_farthest(sim) + way);
}

static void start_tear(struct sim *sim, const struct prick *prick, const struct hole *hole)
{
    double place[3];
    place_at(hole->time, prick->from, prick->to, place);
    sim_prick(sim, hole->triangle, place);
}

/* When it has gone so far beyond a hole that the next skin it meets is another wall, or another balloon: only
 * the fastest needles do so within a step. */
static double time_beyond(const struct sim *sim, const struct prick *prick, const struct hole *hole)
{
    const double beyond = 0.15 * sim_balloon_of(sim, hole->triangle)->radius;
    return hole->time + beyond / vec3_distance(prick->from, prick->to);
}

/* Tears the skin wherever the needle has met it in the last step. */
static void follow_needle(struct sim *sim, const struct scene_needles *needle)
{
    const struct prick prick = prick_of(sim, needle);
    for (double since = 0; since < 1;) {
        const struct search found = search_all(sim, &prick, since);
        sim->needles->room = fmin(sim->needles->room, found.room);
        if (sim->time < needle->at || isinf(found.first.time))
            return;
        start_tear(sim, &prick, &found.first);
        const double beyond = time_beyond(sim, &prick, &found.first);
        since = beyond > found.first.time ? beyond : 1; /* 1: it is so fast that both are one number */
    }
}

/* Nothing is looked at while needles are further from all of the skin than they and it have
 * moved since they were. */
static void apply(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    struct needles *needles = sim->needles;
    const double nearer = come_nearer(sim);
    if (nearer < needles->room) {
        needles->room -= nearer;
        return;
    }
    needles->room = INFINITY;
    for (size_t i = 0; i < sim->scene->needles_count; i++)
        follow_needle(sim, &sim->scene->needles[i]);
}

static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    (void)balloon;
    sim->needles = calloc(1, sizeof *sim->needles);
    if (!sim->needles)
        return error_no_memory(err, "the needles");
    sim->bytes += sizeof *sim->needles;
    sim->needles->search = sim_table(sim, sim->part_count, sizeof *sim->needles->search);
    return sim->needles->search ? sim_keep_before(sim, err) : error_no_memory(err, "the needles");
}

static void close(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    if (sim->needles)
        free(sim->needles->search);
    free(sim->needles);
    sim->needles = NULL;
}

static size_t blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *list)
{
    (void)balloon;
    list[0] = (struct sim_block){"needles", &sim->needles->room, sizeof sim->needles->room};
    return 1;
}

const struct effect effect_needles = {.name = "needles",
                                      .phase = EFFECT_AFTER_STEP,
                                      .scene_wanted = wanted,
                                      .open = open,
                                      .close = close,
                                      .blocks = blocks,
                                      .apply = apply,
                                      .source = "the skin's triangle that the point meets lets go"};
