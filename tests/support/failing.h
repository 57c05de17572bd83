/*
 * Whole programs whose calls fail: what failing.c, which is loaded into the program (LD_PRELOAD), shares with
 * whoever runs it. The variable FAILING names a file that holds this.
 */
#ifndef TESTS_SUPPORT_FAILING_H
#define TESTS_SUPPORT_FAILING_H

#include <stdatomic.h>
#include <stdbool.h>

enum {
    FAILING_MEMORY =
        1, /* malloc, calloc, realloc, aligned_alloc, strdup, strndup, asprintf, open_memstream, realpath */
    FAILING_STARTS = 2, /* threads, programs, pipes, files in memory, drawing contexts */
    FAILING_FILES = 4,  /* system calls upon the files of the case: see ../fault/supervise.h */
};

struct failing {
    unsigned kinds;    /* of calls that count */
    long number;       /* of the call that fails, from 1 on; 0: none does */
    bool lasting;      /* all calls after it fail too */
    atomic_long count; /* calls so far */
    char failed[80];   /* what failed first; "": nothing has */
};

/* Counts a call; true when it is to fail. */
static inline bool failing_counts(struct failing *failing, unsigned kind)
{
    if (!(failing->kinds & kind))
        return false;
    const long number = atomic_fetch_add(&failing->count, 1) + 1;
    return failing->number > 0 &&
           (number == failing->number || (failing->lasting && number > failing->number));
}

#endif
