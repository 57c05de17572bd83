/* Rigid zones: what pushes alone cannot keep apart moves on as one, until the next step. */
#include "sim/contact.h"
#include "sim/obstacles.h"

#include <string.h>

static uint32_t find(uint32_t *zone, uint32_t p)
{
    while (zone[p] != p)
        p = zone[p] = zone[zone[p]];
    return p;
}

static void join_hits(struct sim *sim)
{
    struct contact *c = sim->contact;
    for (uint32_t i = 0; i < c->hit_count; i++) {
        const uint32_t *p = c->pairs[c->hits[i]].point;
        for (int k = 1; k < 4; k++) {
            const uint32_t a = find(c->zone, p[0]), b = find(c->zone, p[k]);
            c->zone[a > b ? a : b] = a > b ? b : a;
        }
    }
}

/* Of each zone, at its root: mass, and mass times way and velocity. */
static void add_up(struct sim *sim)
{
    struct contact *c = sim->contact;
    memset(c->drift, 0, sim->point_count * sizeof *c->drift);
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const uint32_t root = c->zone[p] = find(c->zone, p);
        double *sum = c->drift[root];
        for (int i = 0; i < 3; i++) {
            sum[i] += sim->mass[p] * (sim->position[p][i] - sim->before[p][i]);
            sum[i + 4] += sim->mass[p] * sim->velocity[p][i];
        }
        sum[3] += sim->mass[p];
        sum[7] += root != p; /* alone: no zone */
    }
}

/* A zone that pins hold, or that would run into an obstacle, stays where it was: there it
 * was clear of everything. */
static void hold(struct sim *sim)
{
    struct contact *c = sim->contact;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        double *sum = c->drift[c->zone[p]], to[3], ignored[3] = {0};
        if (sum[7] == 0)
            continue;
        for (int i = 0; i < 3; i++)
            to[i] = sim->before[p][i] + sum[i] / sum[3];
        if (c->held[p] || (sim->obstacles && obstacles_turn(sim->obstacles, sim->before[p], to, ignored)))
            memset(sum, 0, 3 * sizeof *sum);
    }
}

static void drift(struct sim *sim)
{
    struct contact *c = sim->contact;
    contact_rest(c);
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double *sum = c->drift[c->zone[p]];
        if (sum[7] == 0)
            continue;
        const bool held = sum[0] == 0 && sum[1] == 0 && sum[2] == 0;
        for (int i = 0; i < 3; i++) {
            sim->position[p][i] = sim->before[p][i] + sum[i] / sum[3];
            sim->velocity[p][i] = held ? 0 : sum[i + 4] / sum[3];
        }
        contact_move(c, p);
    }
}

/* Each round joins at least two zones, so that there is an end: at the latest when all is one. */
enum status contact_freeze(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    enum status status = STATUS_OK;
    c->memory.zones++;
    for (uint32_t p = 0; p < sim->point_count; p++)
        c->zone[p] = p;
    for (bool hits = true; hits && !status;) {
        join_hits(sim);
        add_up(sim);
        hold(sim);
        drift(sim);
        status = contact_list_follow_moved(sim, err);
        hits = !status && contact_look_at_moved(sim, true);
    }
    return status;
}
