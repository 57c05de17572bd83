/*
 * Skins that keep apart: after each step no edge passes through a triangle, of one balloon or of
 * two, if none did before.
 *
 * The ways of the points over a step, from sim->before to sim->position, are straight. Every point and
 * triangle and every two edges that come too near each other on them (ccd.h) get an impulse that ends their
 * approach, with friction, and are pushed to a distance at their end: equal and opposite, so that momentum is
 * kept (Bridson, Fedkiw & Anderson, "Robust treatment of collisions, contact and friction for cloth
 * animation", SIGGRAPH 2002). That is done again and again, since a push may cause the next approach. What is
 * still too near after many rounds goes on as one, with the velocity that its momentum asks for: a rigid
 * zone, that grows until nothing approaches any more (Provot 1997; there, section 7.5). The two lips of a new
 * cut begin in one place, where nothing says which is on what side: they are pushed apart towards the skin
 * that each belongs to, and are two skins like others from then on.
 *
 * Which pairs can come near each other is known from a list (contact_list.c). It is made for some steps to
 * come, on straight lines that the points are expected to go along, and holds for a point as long as it
 * strays no further from its line than it may, growth and motion of the balloon as a whole left aside.
 * Where one has strayed further, because contact has pushed it or for another reason, what is near it is
 * found anew, on a line of its own from there; all is found anew when the steps are over, or too many
 * points have strayed. How many steps, and which points may stray further, it learns from how the lists
 * before it went. While nothing is near a balloon it pays for a look at its points and nothing else:
 * contact sleeps while the list is empty.
 */
#ifndef SIM_CONTACT_H
#define SIM_CONTACT_H

#include "sim/contact_tree.h"

/* A worker's pairs on trial, of each kind, until there are some to try at once; and cells that it has made,
 * since leaves come again and again: each in a place of its number's, the last one for a leaf whose place is
 * in use. */
enum { CONTACT_TAKEN = 128, CONTACT_CELLS = 128 };
struct contact_taken {
    uint32_t count[2];
    uint32_t point[2][CONTACT_TAKEN][4];
    uint32_t leaf[CONTACT_CELLS + 1]; /* of each cell; UINT32_MAX: none yet */
    struct contact_cell cells[CONTACT_CELLS + 1];
};

/* How a balloon has moved against the lines as a whole: x = middle + growth x (the
 * place on the line - from). */
struct contact_motion {
    double middle[3], from[3], growth;
};

struct contact {
    double thickness, friction; /* skins are kept between half of it and all of it apart */
    struct contact_tree tree;

    /* The lines that the list was made for, gone along from one end to the other in so many steps; the state,
     * since other lists could find other touches first. */
    double (*from)[4], (*to)[4]; /* [point_count] owned */
    float *reach; /* [point_count] how far a point may be from its line while the list holds for it; owned */
    float *off;   /* [point_count] the farthest that it was from it; owned */
    float (*speed)[4]; /* [point_count] when the list was made, a step; owned */
    struct contact_memory {
        uint64_t made, found;        /* lists made so far; and how often some of one was found */
        uint64_t made_in;            /* the step, from 1; the lines begin where it did */
        uint64_t horizon;            /* steps for which it was made */
        uint64_t torn;               /* points that cuts had doubled by then */
        uint64_t pairs;              /* that were near each other then, or since */
        uint64_t again;              /* points around which it was found anew since */
        uint64_t is_awake;           /* 1: the last step had pairs to look at */
        uint64_t wakes, zones;       /* so far: wakes; steps that needed a rigid zone */
        double reach;                /* of most points */
        struct contact_motion began; /* at the present step's beginning */
        double stray;                /* of the point that had strayed furthest by then, */
        double used;                 /* and the share of what most may */
        double pace;                 /* the longest way that a line takes in a step */
    } memory;
    struct contact_motion motion; /* in the present step, where there is one balloon alone */
    double stray, used;           /* at its end */
    uint64_t listed;              /* memory.found of the list at hand; another number: to be found again */

    /* sim->broken when leaves and stars were found, and when all pairs were; UINT32_MAX: not yet, or some of
     * the skin is about to vanish. */
    uint32_t shared_broken, listed_broken;
    uint32_t *star_end,
        *star; /* [point_count], [3 triangle_count] the active triangles around p end at star_end[p]; owned */

    /* Lines and ways as the inner loops take them (contact_kernels.h): lines from `origin`, ways from where
     * the first point's begins. */
    double origin[3];
    float (*lines)[8], (*ways)[8]; /* [point_count] owned */

    struct contact_taken *taken; /* [workers] owned */
    struct contact_pair *pairs;  /* [pair_capacity + 8] owned */
    uint32_t pair_count, pair_capacity;
    uint32_t pair_most; /* the capacity to which it grows when it must */
    /* Which pairs a point is in (contact_links.h): of the first so many by an index, of
     * those after them by chains. */
    uint32_t indexed, linked;
    uint32_t *link;     /* [4 pair_capacity] owned */
    uint32_t *link_end; /* [point_count] where those of p in the index end, and those of p + 1 begin; owned */
    uint32_t *chain;    /* [point_count] the first in its chain; UINT32_MAX: none; owned */
    /* A pair that cannot touch before its points have gone so far sleeps until they have, and is not looked
     * at (contact_apart.h). None would be found to touch, so that nothing depends on who sleeps, and none
     * of this is a part of the state. */
    float *path;       /* [point_count] how far each has gone since the step in which all was found; owned */
    float *ahead;      /* [point_count] the same, this step's way counted twice; owned */
    double (*seen)[4]; /* [point_count] up to there; owned */
    bool may_sleep;    /* in this step: some points are so slow that it is worth while */
    uint32_t *hits;    /* [pair_capacity] pairs that touch, by the last look; owned */
    uint32_t hit_count;
    uint32_t *moved; /* [point_count] points moved since the last look, in order; owned */
    uint32_t moved_count;
    uint32_t *again; /* [point_count] points that have strayed too far; owned */
    uint32_t again_count;
    uint32_t *around;       /* [triangle_count] the triangles around them; owned */
    unsigned char *stirred; /* [point_count] 1: in moved; owned */
    unsigned char *marked;  /* [point_count] 1: in again; owned */
    unsigned char *held;    /* [point_count] by pins, as if their mass were infinite; owned */
    uint32_t *zone;         /* [point_count] a point of the same zone; owned */
    /* [point_count] of the zone at its root: mass x way, mass, mass x velocity, 1 if it is held; owned. */
    double (*drift)[8];
    struct contact_share {
        double stray, pace; /* the largest squares */
        uint32_t count;     /* of points that have strayed too far */
        uint32_t slow;      /* of those that went so little that their pairs may sleep for some steps */
    } * share;              /* [part_count] owned */
};

/* contact_pairs.c, contact_again.c: find the pairs for the lines and the reaches at hand, from the present
 * step's beginning on: all, or those of the points in c->again, in place of those that are known.
 * STATUS_RANGE when more is near than there is room for. */
enum status contact_pairs_find(struct sim *sim, struct error *err);
enum status contact_pairs_find_again(struct sim *sim, struct error *err);

/* effect_contact.c: tables for so many pairs in place of those there are; what is in them is lost. False: not
 * enough memory, and they stay. */
bool contact_make_room(struct sim *sim, struct contact *c, uint32_t pairs);

/* contact_list.c: makes the list anew, for this step and those that would follow on the same lines.
 * Errors: those of finding. */
enum status contact_list_make(struct sim *sim, struct error *err);
/* Sees to it that the list holds for the present step's ways: of all points; of those in c->moved, where
 * it held for the others. */
enum status contact_list_follow(struct sim *sim, struct error *err);
enum status contact_list_follow_moved(struct sim *sim, struct error *err);
/* How much of its lines is gone at the end of the present step, and at its beginning:
 * 0 to 1 while it holds. */
double contact_list_gone(const struct sim *sim);
double contact_list_gone_before(const struct sim *sim);

/* Rounds the lines or ways of all points. */
void contact_round(struct sim *sim, struct contact_rounding *job);

/* Where four points are. */
void contact_gather(double (*x)[4], const uint32_t points[4], double places[4][3]);

/* contact_look.c: finds the pairs that touch, in an order of their own: among all, or (and not in one zone,
 * where zones is true) among those of the points in c->moved. True if there are any. */
bool contact_look(struct sim *sim);
bool contact_look_at_moved(struct sim *sim, bool zones);
/* contact_solve.c. c->moved: from now on nothing; and a point. */
void contact_rest(struct contact *c);
void contact_move(struct contact *c, uint32_t point);
/* The whole: after a step. */
enum status contact_settle(struct sim *sim, struct error *err);

/* contact_zones.c: ends what pushes could not. */
enum status contact_freeze(struct sim *sim, struct error *err);

#endif
