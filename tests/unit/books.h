/* The ledger of a balloon, for tests. */
#ifndef TESTS_UNIT_BOOKS_H
#define TESTS_UNIT_BOOKS_H

#include "balloon.h"
#include "sim/ledger.h"

static inline void open_books(struct balloon *b)
{
    struct error err = {0};
    assert_ok(ledger_open(&b->sim, &err), &err);
}

static inline struct ledger_balance balance(struct balloon *b)
{
    const struct sim_measures m = sim_measure(&b->sim);
    return ledger_balance(&b->sim, &m);
}

/* Of an icosphere of level 2 with these changes after .2 s, and what is measured of it then. */
static inline struct ledger_balance balance_of_run(const char *const *changes, struct sim_measures *end)
{
    struct balloon b;
    open_balloon(&b, 2, changes);
    open_books(&b);
    while (b.sim.time < 0.2 - 1e-6)
        steps(&b, 1);
    *end = sim_measure(&b.sim);
    const struct ledger_balance account = ledger_balance(&b.sim, end);
    close_balloon(&b);
    return account;
}

#endif
