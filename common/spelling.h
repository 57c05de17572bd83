/*
 * What a misspelt name was meant to be:
 *
 *     struct spelling guess = spelling_of("presure");
 *     for each name that would have been right: spelling_consider(&guess, name);
 *     if (guess.nearest) ...
 */
#ifndef COMMON_SPELLING_H
#define COMMON_SPELLING_H

#include <stddef.h>

struct spelling {
    const char *wrong;   /* borrowed, */
    const char *nearest; /* as this is; NULL while no name is alike in half of its letters */
    size_t distance;
};

struct spelling spelling_of(const char *wrong);

/* The first of equally near names stays. */
void spelling_consider(struct spelling *guess, const char *name);

#endif
