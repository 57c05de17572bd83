/* A balloon that holds gas, for tests. */
#ifndef TESTS_PHYSICS_GAS_H
#define TESTS_PHYSICS_GAS_H

#include "sim/effect_gas.h"
#include "unit/books.h"

/* Gas of 10 around, in the paper's balloon at level 2: 162 points. */
#define GAS(...)                                                                                             \
    SETTINGS("balloons[0].gas.ambient=10", "balloons[0].threshold=100", "time.guard=off", "time.step=0.005", \
             __VA_ARGS__)

static inline struct gas_look look(struct balloon *b)
{
    return gas_look(&b->sim, &b->sim.balloons[0]);
}

#endif
