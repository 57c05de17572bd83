/* Needles: points that move on their own and start a tear where they meet the skin, whichever of the two moves. */
#include "sim/ccd.h"
#include "sim/effects.h"

#include <math.h>
#include <string.h>

static bool wanted(const struct scene *scene)
{
    return scene->needles_count > 0;
}

static enum status open(struct sim *sim, struct sim_balloon *balloon, struct error *err)
{
    (void)balloon;
    return sim_keep_before(sim, err);
}

/* A needle's way over the last step. */
struct prick {
    double from[3], to[3];
};

/* Where the skin is met first. */
struct hole {
    double time; /* 0 to 1; INFINITY: nowhere */
    uint32_t triangle;
};

static bool is_far(const struct sim *sim, const uint32_t *p, const struct prick *prick, double gap)
{
    for (int i = 0; i < 3; i++) {
        const double low = fmin(prick->from[i], prick->to[i]) - gap,
                     high = fmax(prick->from[i], prick->to[i]) + gap;
        bool below = true, above = true;
        for (int k = 0; k < 3; k++) {
            below &= sim->before[p[k]][i] < low && sim->position[p[k]][i] < low;
            above &= sim->before[p[k]][i] > high && sim->position[p[k]][i] > high;
        }
        if (below || above)
            return true;
    }
    return false;
}

/* When the needle comes to the triangle; INFINITY: it does not. */
static double meeting(const struct sim *sim, uint32_t triangle, const struct prick *prick, double gap)
{
    const uint32_t *p = sim->triangle_point[triangle];
    double from[4][3], to[4][3];
    struct ccd_touch touch;
    if (is_far(sim, p, prick, gap))
        return INFINITY;
    memcpy(from[0], prick->from, sizeof from[0]);
    memcpy(to[0], prick->to, sizeof to[0]);
    for (int k = 0; k < 3; k++) {
        memcpy(from[k + 1], sim->before[p[k]], sizeof from[k]);
        memcpy(to[k + 1], sim->position[p[k]], sizeof to[k]);
    }
    if (ccd_distance(CCD_POINT_TRIANGLE, from, &touch) <= gap)
        return 0;
    return ccd_meet(CCD_POINT_TRIANGLE, from, to, gap / 2, &touch) ? touch.time : INFINITY;
}

/* The first of all; of two at once the one with the lower number. */
static struct hole first_meeting(const struct sim *sim, const struct prick *prick)
{
    struct hole first = {INFINITY, 0};
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const double gap = b->mean_rest_length / 1000;
        for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
            const double time = sim->triangle_active[t] ? meeting(sim, t, prick, gap) : INFINITY;
            if (time < first.time)
                first = (struct hole){time, t};
        }
    }
    return first;
}

static void needle_at(const struct scene_needles *needle, double time, double x[3])
{
    for (int i = 0; i < 3; i++)
        x[i] = needle->from[i] + needle->velocity[i] * (time - needle->at);
}

static void apply(struct sim *sim, struct sim_balloon *balloon)
{
    (void)balloon;
    for (size_t i = 0; i < sim->scene->needles_count; i++) {
        const struct scene_needles *needle = &sim->scene->needles[i];
        struct prick prick;
        if (sim->time < needle->at)
            continue;
        needle_at(needle, fmax(sim->time - sim->taken, needle->at), prick.from);
        needle_at(needle, sim->time, prick.to);
        const struct hole hole = first_meeting(sim, &prick);
        double place[3];
        for (int k = 0; k < 3 && hole.time < INFINITY; k++)
            place[k] = prick.from[k] + hole.time * (prick.to[k] - prick.from[k]);
        if (hole.time < INFINITY)
            sim_prick(sim, hole.triangle, place);
    }
}

const struct effect effect_needles = {.name = "needles",
                                      .phase = EFFECT_AFTER_STEP,
                                      .scene_wanted = wanted,
                                      .open = open,
                                      .apply = apply,
                                      .source = "the skin's triangle that the point meets lets go"};
