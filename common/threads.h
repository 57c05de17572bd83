/*
 * A few workers that share a job: opened once, used thousands of times a second, closed at the end.
 *
 *     struct threads *pool = NULL;
 *     if (threads_open(&pool, 0, err)) ...                  0: as many as the machine has
 *     threads_run(pool, count, mesh_a_brick, context);      one call an index, whoever is free takes the next
 *     threads_each(pool, sum_my_share, context);            one call a worker, all at once
 *     threads_close(pool);
 *
 * The caller is worker 0 and works too, so a pool of one starts no thread, and NULL is such a pool. Both
 * calls return when all is done; what the workers wrote is then visible to the caller, and what the caller
 * wrote before is visible to them. A pool serves one caller at a time, and a job must not use its own pool.
 *
 * Workers wait for the next job spinning, for about as long as a sleep and a wake would take, and then
 * sleep: two calls that follow each other closely cost a microsecond or two, an idle pool costs nothing.
 * Where others take the processors, they soon give spinning up for a while.
 *
 * Results that do not depend on the number of workers are the caller's business: write to places that belong
 * to the index, and add up in the order of the indices afterwards.
 */
#ifndef COMMON_THREADS_H
#define COMMON_THREADS_H

#include "common/status.h"

#include <stddef.h>

enum { THREADS_MAX = 256 };

struct threads;

/* Processors that this process may run on, 1 .. THREADS_MAX. */
unsigned threads_of_machine(void);

/* A pool of `workers` (0: threads_of_machine()), the caller among them. Errors: STATUS_RANGE for more than
 * THREADS_MAX, STATUS_NO_MEMORY, STATUS_RESOURCE when the system starts no more threads (naming its reason);
 * *pool is then as it was. */
enum status threads_open(struct threads **pool, unsigned workers, struct error *err);

/* Ends the threads and frees the pool. NULL is fine. */
void threads_close(struct threads *pool);

/* How many work, the caller among them: 1 for NULL. */
unsigned threads_workers(const struct threads *pool);

/* Calls function once for each index below `count`, in no order; worker is below threads_workers(). */
void threads_run(struct threads *pool, size_t count,
                 void (*function)(void *context, size_t index, unsigned worker), void *context);

/* Calls function once on each worker, all at the same time. */
void threads_each(struct threads *pool, void (*function)(void *context, unsigned worker, unsigned workers),
                  void *context);

#endif
