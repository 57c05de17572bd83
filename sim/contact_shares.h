/*
 * Jobs shared out among the workers, each of whom begins with jobs of its own, that follow each other:
 * neighbours in the skin, and those that it had in the step before, so that what they look at is in its
 * caches. Who is done takes from the others.
 */
#ifndef SIM_CONTACT_SHARES_H
#define SIM_CONTACT_SHARES_H

#include "common/threads.h"

/* threads_run(), but for who takes what. */
void contact_share_out(struct threads *pool, size_t count,
                       void (*function)(void *context, size_t index, unsigned worker), void *context);

#endif
