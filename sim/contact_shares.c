#include "sim/contact_shares.h"

struct shares {
    void (*function)(void *context, size_t index, unsigned worker);
    void *context;
    size_t count;
    /* Jobs that are taken of each worker's share; a line of the cache each. */
    struct {
        _Alignas(64) size_t taken;
    } of[THREADS_MAX];
};

static void take(void *context, unsigned worker, unsigned workers)
{
    struct shares *s = context;
    for (unsigned i = 0; i < workers; i++) {
        const size_t share = (worker + i) % workers, begin = s->count * share / workers,
                     end = s->count * (share + 1) / workers;
        for (size_t at; (at = begin + __atomic_fetch_add(&s->of[share].taken, 1, __ATOMIC_RELAXED)) < end;)
            s->function(s->context, at, worker);
    }
}

void contact_share_out(struct threads *pool, size_t count,
                       void (*function)(void *context, size_t index, unsigned worker), void *context)
{
    if (count == 0)
        return;
    struct shares shares;
    shares.function = function;
    shares.context = context;
    shares.count = count;
    for (unsigned i = 0; i < threads_workers(pool); i++)
        shares.of[i].taken = 0;
    threads_each(count == 1 ? NULL : pool, take, &shares);
}
