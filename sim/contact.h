/*
 * Skins that keep apart: after each step no edge passes through a triangle, of one balloon or of two, if none did before.
 *
 * The ways of the points over a step, from sim->before to sim->position, are straight. Every point and triangle and every two edges that come too near each
 * other on them (ccd.h) get an impulse that ends their approach, with friction, and are pushed to a distance at their end: equal and
 * opposite, so that momentum is kept (Bridson, Fedkiw & Anderson, "Robust treatment of collisions, contact and friction for cloth animation",
 * SIGGRAPH 2002). That is done again and again, since a push may cause the next approach. What is still too near after many rounds goes on
 * as one, with the velocity that its momentum asks for: a rigid zone, that grows until nothing approaches any more (Provot 1997; there,
 * section 7.5).
 *
 * Which pairs can come near each other is known from a list (contact_list.c). It is made for some steps to come, on the lines that the points
 * are going along, and holds for as long as no point strays further than a tenth of an edge from its line, growth and motion of the
 * balloon as a whole left aside: a balloon with nothing near it pays for a look at its points and nothing else. How many steps, it learns from how
 * the lists before it went. Contact sleeps while the list is empty.
 */
#ifndef SIM_CONTACT_H
#define SIM_CONTACT_H

#include "sim/ccd.h"
#include "sim/contact_tree.h"

/* A point and a triangle, or two edges. */
struct contact_pair {
    uint32_t a, b;            /* point and triangle; edges, a < b */
    uint32_t kind;            /* enum ccd_kind */
    float distance, approach; /* on the list's lines no nearer than distance - gone x approach */
};

/* How points have moved against the list's lines: as a whole, and from that. A pair is no nearer than growth x (its distance - gone x
 * its approach) - 2 stray. */
struct contact_drift {
    double growth; /* the least of all balloons, no more than 1 */
    double stray;  /* the largest of all points */
};

struct contact {
    double thickness, friction; /* skins are kept between half of it and all of it apart */
    struct contact_tree tree;

    /* The lines that the list was made for, gone along from one end to the other in so many steps; the state, since other lists could find
     * other touches first. */
    double (*from)[4], (*to)[4]; /* [point_count] owned */
    struct contact_memory {
        uint64_t made;              /* lists made so far */
        uint64_t made_in;           /* the step, from 1; the lines begin where it did */
        uint64_t horizon;           /* steps for which it was made */
        uint64_t is_awake;          /* 1: the last step had pairs to look at */
        double stray;               /* how far a point may be from its line while the list holds */
        uint64_t wakes, zones;      /* so far: wakes; steps that needed a rigid zone */
        struct contact_drift began; /* at the present step's beginning */
        double used;                /* share of what may be strayed, at its end */
        double pace;                /* the longest way that a line takes in a step */
    } memory;
    struct contact_drift now; /* by the last contact_list_holds(), */
    double used;              /* and the share of what may be strayed */
    uint64_t listed;          /* memory.made of the list at hand; another number: to be made again */
    uint32_t owned_broken;    /* sim->broken when `owned` was found; UINT32_MAX: not yet */
    unsigned char
        *owned; /* [triangle_count] of its corners and edges those that it stands for: bits 0-2 and 3-5 */
    unsigned char *point_taken, *edge_taken; /* [point_count], [edge_count] for finding that */

    struct contact_pair *pairs; /* [pair_capacity] owned */
    uint32_t pair_count, pair_capacity;
    uint32_t *hits; /* [pair_capacity] pairs that touch, by the last look; owned */
    uint32_t hit_count;
    unsigned char *held;    /* [point_count] by pins, as if their mass were infinite; owned */
    unsigned char *stirred; /* [point_count] moved since the last look; owned */
    uint32_t *zone;         /* [point_count] a point of the same zone; owned */
    double (*drift)
        [8]; /* [point_count] of the zone at its root: mass x way, mass, mass x velocity, 1 if it is held; owned */
    double *strayed; /* [part_count] the largest square; owned */
};

/* contact_pairs.c: finds the pairs for the lines and the stray at hand. STATUS_RANGE when more is near than there is room for. */
enum status contact_list_find(struct sim *sim, struct error *err);

/* contact_list.c: makes the list anew, for this step and those that would follow on the same lines. Errors: those of finding. */
enum status contact_list_make(struct sim *sim, struct error *err);
/* Whether the list at hand holds for the present step's ways. */
bool contact_list_holds(struct sim *sim);
/* How much of its lines is gone at the end of the present step: 0 to 1 while it holds. */
double contact_list_gone(const struct sim *sim);

/* The four points of a pair. */
void contact_points(const struct sim *sim, const struct contact_pair *pair, uint32_t points[4]);
void contact_gather(double (*x)[4], const uint32_t points[4], double places[4][3]);

/* contact_solve.c: finds the pairs that touch, in an order of their own, among those that have a stirred point (and are not in one zone,
 * where zones is true); true if there are any. */
bool contact_look(struct sim *sim, bool zones);
/* Takes the approach from each that contact_look() has found. */
void contact_push(struct sim *sim);
/* The whole: after a step. */
enum status contact_settle(struct sim *sim, struct error *err);

/* contact_zones.c: ends what contact_push() could not. */
enum status contact_freeze(struct sim *sim, struct error *err);

#endif
