/*
 * Putting the points in order that cuts have made.
 *
 *     reorder_step(sim)                         before each step; asleep while nothing is torn
 *     reorder_moved(sim)                        once it has moved the points: who ends it before that begins it anew
 *
 * A cut appends its points behind all others, where a part of its own works on them (topology.h): a
 * triangle that has one is worked out twice, and it and what follows it in its chunk one by one, where
 * others go four at a time. So once it has rested from tearing, or what that has cost adds up to what
 * putting things in order takes, each new point moves to a place right behind the old one that it was made
 * from, its family's; the points between move up, and all that tells points by numbers follows. Edges and
 * triangles keep theirs: they are in the order of families still, so that parts and chunks have the ones
 * that they had, and none is late any more.
 *
 * A name is the number that a point had when it was made, less the balloon's first: what
 * files and people go by.
 */
#ifndef SIM_REORDER_H
#define SIM_REORDER_H

#include "sim/topology.h"

/* topology->now.awake; it stirs until it has told so. */
enum { REORDER_SLEEPS, REORDER_STIRS, REORDER_AWAKE };

/* Points of one balloon get other numbers. */
struct reorder {
    const struct sim_balloon *balloon;
    const uint32_t *place; /* [points with room] the new number, by the old one less the balloon's first */
    /* Room to turn rows in; NULL: rows are in their places already, as blocks that were put back, and only
     * what is no state follows. */
    void *spare;
};

/* For struct effect's hook of that name. The numbers of these points, of whatever
 * balloon, become the new ones. */
void reorder_points(const struct reorder *reorder, uint32_t *points, size_t count);

/* Rows of the balloon's points with room, from its first on, `size` bytes each, 32 at the most. */
void reorder_rows(const struct reorder *reorder, void *rows, size_t size);

void reorder_step(struct sim *sim);
void reorder_moved(struct sim *sim);

/* A cut was made: wakes it. */
void reorder_wake(const struct sim *sim, struct sim_balloon *balloon);

/* After the names were put back: what goes by them. */
void reorder_restored(struct sim *sim, struct sim_balloon *balloon);

/* Whether what came from a file can be names. */
bool reorder_is_sound(const struct sim_balloon *balloon);

/* The point that a balloon calls so; and what it calls a point. */
static inline uint32_t reorder_point(const struct sim_balloon *balloon, uint32_t name)
{
    return balloon->point_begin + (balloon->topology ? balloon->topology->named[name] : name);
}

static inline uint32_t reorder_name(const struct sim_balloon *balloon, uint32_t point)
{
    const uint32_t p = point - balloon->point_begin;
    return balloon->topology ? balloon->topology->name[p] : p;
}

#endif
