#include "common/threads.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Looks at the other side this often before going to sleep: for 50 to 200 microseconds, by how long the
 * machine pauses. What one does alone between two shares of contact's work is shorter, and to be woken takes
 * as long where the machine is a virtual one. */
enum { SPINS = 5000 };

/* How one who waits goes about it. What has not come after SPINS is held up by other programs, or by more
 * workers than processors, and spinning takes the processor from it: after each try in vain four times as
 * many waits go by without one, up to RESTS_MOST, and half as many after one that was not. */
struct patience {
    unsigned rests, left; /* waits without spinning; of these still to come */
};
enum { RESTS_MOST = 255 };

struct worker {
    struct threads *pool;
    pthread_t thread;
    unsigned number;
};

struct threads {
    unsigned workers;
    struct patience patience; /* the caller's */
    void (*function)(void *context, unsigned worker, unsigned workers);
    void *context;
    /* Each on a cache line of its own: they are watched by those who wait. */
    _Alignas(64) atomic_uint job;    /* number of the job at hand */
    _Alignas(64) atomic_uint busy;   /* workers that have not finished it */
    _Alignas(64) atomic_uint asleep; /* workers, and the caller, that wait for `changed` */
    atomic_bool ending;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct worker worker[]; /* [workers - 1] */
};

unsigned threads_of_machine(void)
{
    cpu_set_t set;
    long count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set)
                                                             : sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

static void relax(void)
{
#if defined __x86_64__ || defined __i386__
    __builtin_ia32_pause();
#endif
}

/* Until *value is no longer (while_equal) or has become (!while_equal) `what`. */
static bool spin(struct patience *patience, atomic_uint *value, unsigned what, bool while_equal)
{
    if (patience->left > 0) {
        patience->left--;
        return false;
    }
    int spins = 0;
    for (; spins < SPINS && (atomic_load(value) == what) == while_equal; spins++)
        relax();
    const bool come = spins < SPINS;
    patience->rests = come                               ? patience->rests / 2
                      : 4 * patience->rests < RESTS_MOST ? 4 * patience->rests + 1
                                                         : RESTS_MOST;
    patience->left = patience->rests;
    return come;
}

/* A sleeper counts itself before it looks for the last time, and who changes the value counts sleepers after
 * that: both in one order for all, so no wake is lost. */
static void wait_for(struct threads *pool, struct patience *patience, atomic_uint *value, unsigned what,
                     bool while_equal)
{
    if (spin(patience, value, what, while_equal))
        return;
    pthread_mutex_lock(&pool->lock);
    atomic_fetch_add(&pool->asleep, 1);
    while ((atomic_load(value) == what) == while_equal)
        pthread_cond_wait(&pool->changed, &pool->lock);
    atomic_fetch_sub(&pool->asleep, 1);
    pthread_mutex_unlock(&pool->lock);
}

static void wake(struct threads *pool)
{
    if (atomic_load(&pool->asleep) == 0)
        return;
    pthread_mutex_lock(&pool->lock);
    pthread_cond_broadcast(&pool->changed);
    pthread_mutex_unlock(&pool->lock);
}

static void *work(void *argument)
{
    struct worker *me = argument;
    struct threads *pool = me->pool;
    struct patience patience = {0, 0};
    for (unsigned job = 0;; job++) {
        wait_for(pool, &patience, &pool->job, job, true);
        if (atomic_load(&pool->ending))
            return NULL;
        pool->function(pool->context, me->number, pool->workers);
        if (atomic_fetch_sub(&pool->busy, 1) == 1)
            wake(pool);
    }
}

/* Ends and joins the first `started` threads. */
static void end(struct threads *pool, unsigned started)
{
    atomic_store(&pool->ending, true);
    atomic_fetch_add(&pool->job, 1);
    wake(pool);
    for (unsigned i = 0; i < started; i++)
        pthread_join(pool->worker[i].thread, NULL);
    pthread_cond_destroy(&pool->changed);
    pthread_mutex_destroy(&pool->lock);
    free(pool);
}

enum status threads_open(struct threads **pool, unsigned workers, struct error *err)
{
    if (workers > THREADS_MAX)
        return error_set(err, STATUS_RANGE, "%u threads: must be at most %d", workers, THREADS_MAX);
    workers = workers ? workers : threads_of_machine();
    size_t size = sizeof(struct threads) + (workers - 1) * sizeof(struct worker);
    struct threads *made = aligned_alloc(64, (size + 63) / 64 * 64);
    if (!made)
        return error_no_memory(err, "the threads");
    memset(made, 0, size);
    made->workers = workers;
    pthread_mutex_init(&made->lock, NULL);
    pthread_cond_init(&made->changed, NULL);
    for (unsigned i = 0; i + 1 < workers; i++) {
        made->worker[i] = (struct worker){.pool = made, .number = i + 1};
        int failed = pthread_create(&made->worker[i].thread, NULL, work, &made->worker[i]);
        if (failed) {
            end(made, i);
            return error_set(err, STATUS_RESOURCE, "cannot start thread %u of %u: %s; ask for fewer", i + 2,
                             workers, strerror(failed));
        }
    }
    *pool = made;
    return STATUS_OK;
}

void threads_close(struct threads *pool)
{
    if (pool)
        end(pool, pool->workers - 1);
}

unsigned threads_workers(const struct threads *pool)
{
    return pool ? pool->workers : 1;
}

void threads_each(struct threads *pool, void (*function)(void *context, unsigned worker, unsigned workers),
                  void *context)
{
    if (threads_workers(pool) == 1) {
        function(context, 0, 1);
        return;
    }
    pool->function = function;
    pool->context = context;
    atomic_store(&pool->busy, pool->workers - 1);
    atomic_fetch_add(&pool->job, 1);
    wake(pool);
    function(context, 0, pool->workers);
    wait_for(pool, &pool->patience, &pool->busy, 0, false);
}

struct run {
    void (*function)(void *context, size_t index, unsigned worker);
    void *context;
    size_t count;
    atomic_size_t next;
};

static void take_turns(void *context, unsigned worker, unsigned workers)
{
    struct run *run = context;
    (void)workers;
    for (size_t index; (index = atomic_fetch_add_explicit(&run->next, 1, memory_order_relaxed)) < run->count;)
        run->function(run->context, index, worker);
}

void threads_run(struct threads *pool, size_t count,
                 void (*function)(void *context, size_t index, unsigned worker), void *context)
{
    struct run run = {.function = function, .context = context, .count = count};
    if (count == 1)
        function(context, 0, 0);
    else
        threads_each(pool, take_turns, &run);
}
