/* The bound on the stable step (guard.h), as it is computed. */
#ifndef SIM_GUARD_BOUND_H
#define SIM_GUARD_BOUND_H

#include "sim/guard.h"

enum guard_cause {
    GUARD_SPRINGS,
    GUARD_DAMPERS,
    GUARD_PRESSURE,
    GUARD_FOLLOW,
    GUARD_EFFECTS /* the first of sim->hooks[EFFECT_FORCES]; those after it follow */
};

/* What is up to date. */
enum guard_known { GUARD_UNKNOWN, GUARD_KNOWN, GUARD_REACH_KNOWN, GUARD_KNOWN_BUT_FOR_CUTS };

/* All arrays are [point_count] and owned. */
struct guard {
    double *x;                 /* the numbers of Collatz and Wielandt */
    double *springs, *dampers; /* sum of k_s (x_p + x_q) and of k_d (x_p + x_q) over a point's edges */
    struct guard_rows rows;    /* of pressure and effects */

    /* What the future depends on; no padding, since it is written and hashed as bytes. */
    struct guard_memory {
        double stable;     /* s: the bound, by the x at hand; */
        double sharp;      /*    and as iterations have found it last */
        double push;       /* sqrt(sum P^2/m) */
        double reach;      /* the most that sqrt(2 E) can be by now */
        double least;      /* and the least that counts: rounding moves points too */
        uint64_t broken;   /* edges, when the bound was found */
        uint32_t point;    /* where it is tightest; where it follows what is none, the first of its balloon */
        uint32_t cause;    /* enum guard_cause, or after: what asks for most of it there */
        uint64_t is_known; /* enum guard_known */
    } memory;
};

/* Finds the bound, its point, its cause and the push anew. */
void guard_find_bound(struct sim *sim);

#endif
