/* The inner loops of contact, once for each set of instructions: which boxes meet, and
 * how far pairs are apart. */
#ifndef SIM_CONTACT_KERNELS_H
#define SIM_CONTACT_KERNELS_H

#include "sim/ccd.h"
#include "sim/contact_box.h"

#include <stdint.h>

/* Ways of points, as seen from one place, in single precision: x, y, z, 0 where they begin and x,
 * y, z, 0 where they end. */
struct contact_rounding {
    double (*from)[4], (*to)[4]; /* [point_count] */
    const double *origin;        /* x, y, z */
    const uint32_t *points;      /* which; NULL: all */
    float (*ends)[8];            /* [point_count] aligned to eight; what becomes of them */
};

/* Pairs of one kind whose points go straight from some places to others. */
struct contact_flock {
    enum ccd_kind kind;
    float (*ends)[8]; /* [point_count] */
    float gone;       /* the first places are so far on the way */
};

/* A point and a triangle, or two edges. With `gone` from 0 where the lines begin to 1 at their ends they
 * are, on the lines, no nearer than distance - gone x approach, which is a hair too small, for what
 * single precision rounds. */
struct contact_pair {
    _Alignas(32) uint32_t
        point[4];  /* the point and the triangle's corners, or the ends of one edge and of the other */
    uint32_t kind; /* enum ccd_kind */
    float distance, approach;
    /* Its points' paths since the list was made, all four together and this step's way twice, must be longer
     * before it can touch: until then it sleeps. */
    float until;
};

/* What is known of the pairs' points, when some of them are to be told from those that cannot touch. */
struct contact_sieve {
    const float *off;      /* [point_count] how far each may be from its line */
    float growth, gone[2]; /* of the balloon, no more than 1; at the step's beginning and end */
    float gap;             /* half the thickness */
};

/* Where the points go, how far each may stray from that, and how much room is wanted around it. */
struct contact_ways {
    double (*from)[4], (*to)[4]; /* [point_count] */
    const float *reach;          /* [point_count] */
    double room;
};

/* Boxes that are looked at together, no more than 255; and one that they are all in. */
struct contact_group {
    const struct contact_box *box; /* [count] */
    uint32_t count;
    const struct contact_box *all;
};

/* Until when a pair sleeps whose points have gone so far together, and may go so much further: rounded
 * down, since each sum of four paths is off by up to 2e-7 of it. */
static inline float contact_until(float gone, float further)
{
    return gone + 0.999F * further - 1e-6F * gone;
}

/* Whether it does; ahead as in sim/contact.h. */
static inline bool contact_sleeps(const struct contact_pair *pair, const float *ahead)
{
    const uint32_t *p = pair->point;
    return ahead[p[0]] + ahead[p[1]] + ahead[p[2]] + ahead[p[3]] <= pair->until;
}

struct contact_kernels {
    /* Of a box of each of two groups those that meet: couples[i] becomes their numbers in a and b; returns
     * how many there are. There is room for all. Of a group and itself each two boxes are a couple once. */
    uint32_t (*meet)(const struct contact_group *a, const struct contact_group *b, uint8_t (*couples)[2]);

    /* The ways of points[begin] to points[end - 1]. */
    void (*round)(const struct contact_rounding *job, uint32_t begin, uint32_t end);

    /*
     * apart[i][0] and [1] become how far pair i is apart at least at the first places and at the last, along
     * the direction in which its features are nearest at the first (ccd_apart()): on the way they are never
     * nearer than what lies in between. points has room for a multiple of eight; so has apart.
     */
    void (*apart)(const struct contact_flock *flock, uint32_t (*points)[4], uint32_t count,
                  float (*apart)[2]);

    /*
     * Which of the pairs may come nearer on their way than half of `thickness`, or of their distance at
     * first where that is less: open becomes their numbers, in order, and the call returns how many. All
     * others surely do not. clear[i] becomes how far the points of pair i may go, together, before it must be
     * looked at again, from the end of this way on, with all that they go in the step that is then at hand
     * counted twice: be it this one or a later one. No more than 0 where that is not known. points as above;
     * open has room for `count`, clear for a multiple of eight.
     */
    uint32_t (*open)(const struct contact_flock *flock, double thickness, uint32_t (*points)[4],
                     uint32_t count, uint32_t *open, float *clear);

    /*
     * Which of pairs[which[0]] to pairs[which[count - 1]] may touch, by how far their points are from their
     * lines: near becomes which ones, in order, and the call returns how many. which NULL: the pairs from the
     * first on. There is room for a multiple of eight in all but near, and pairs have points there too.
     */
    uint32_t (*sift)(const struct contact_sieve *sieve, const struct contact_pair *pairs,
                     const uint32_t *which, uint32_t count, uint32_t *near);

    /* sides[t] becomes, for `count` of the triangles, a bit for each of 26 directions that its normal looks
     * to all the way, whatever its points stray. */
    void (*sides)(const struct contact_ways *ways, uint32_t (*triangle_point)[3], const uint32_t *triangles,
                  uint32_t count, uint32_t *sides);
};

#endif
