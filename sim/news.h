/* What a run tells as it happens, for those who read what a program says. */
#ifndef SIM_NEWS_H
#define SIM_NEWS_H

#include "sim/sim.h"

struct news {
    /* Hears each line, too, and from which time on it is true; NULL: nobody does. */
    void (*hear)(void *self, double time, const char *line);
    void *self;
    uint32_t parts;   /* of a split step, when that was said; 0: not yet */
    double passed;    /* by how much a step that was let go is too large, when that was said; 0: not yet */
    uint64_t choices; /* of methods, when they were said */
    struct {
        uint64_t step; /* number of the first of some in a row, */
        double time;   /* s: when it began, */
        double rest;   /* and how many were left when that was said; 0: not yet */
    } pace;            /* of a method that chooses its steps */
};

/* Notes on stderr, after a step: that steps are split, and why, or that time.guard = "off" lets one go that
 * is too large, and again when that is ten times as much; which method has been chosen, or that it takes
 * steps too short to see the end; what effects have told since it was asked last: that they wake, go to
 * sleep, or can do no more. *news begins with nothing said. */
void news_note(struct news *news, struct sim *sim);

#endif
