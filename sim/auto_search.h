/*
 * What "auto" (auto.c) knows of the methods that it chooses among, and its search for the one to choose
 * (auto_search.c).
 */
#ifndef SIM_AUTO_SEARCH_H
#define SIM_AUTO_SEARCH_H

#include "sim/trial.h"

enum { AUTO_CANDIDATES = 6, AUTO_STIFF = 6 };
extern const struct integrator *const auto_candidates[AUTO_CANDIDATES];

/* In sim->scratch: what no candidate uses. */
enum { AUTO_GUARD_ROW = 10, AUTO_TRIAL_ROWS };

/* sim->method of auto. */
struct auto_method {
    void *own[AUTO_CANDIDATES];
    bool is_open[AUTO_CANDIDATES];
    /* What the future depends on; no padding. */
    struct {
        uint64_t choices;          /* so far */
        uint64_t steps;            /* of the scene, taken since it was opened */
        uint64_t next;             /* of them, before which to choose again */
        uint64_t broken;           /* edges, at the last choice */
        uint64_t change;           /* of the schedule, that was to come then */
        uint64_t candidate;        /* that was chosen, and in how many parts */
        double parts, error, work; /* as its trial had it */
        double stable;             /* s: by the guard's bound for the first candidate, when it was opened */
        /* Work that each took in its last trial for the last choice, 0 where there was none: it will not take
         * less than half of that in the next one, so that what was far too dear is not tried again. */
        double spent[AUTO_CANDIDATES];
    } memory;
};

/* A candidate in a number of parts, with what its trial said, or before that with the least
 * work that it can take. */
struct auto_option {
    int candidate;
    double parts;
    struct trial_result result;
    double last_error; /* of its last trial, in an eighth of the parts; INFINITY: there was none */
    bool is_vain;      /* in so many more parts that error had not fallen */
};

/* The candidate, and its parts, that is the cheapest of those that keep time.tolerance, or what comes near.
 * It leaves nothing changed but sim->acting, the guard's bound, and memory.spent. */
struct auto_option auto_search(struct sim *sim);

#endif
