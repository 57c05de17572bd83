/* Torn skin whose new points are put in order, with all that keeps something by points. */
#ifndef TESTS_BURST_ORDERED_H
#define TESTS_BURST_ORDERED_H

#include "burst/cuts.h"
#include "sim/cracks.h"
#include "sim/reorder.h"

#include <string.h>

/* All that keeps something by points, in rubber that holds gas and in springs. */
static const struct inflation all_of_rubber = {
    .level = 3,
    .stretch = 1.5,
    .keys = {"balloons[0].bending.stiffness=0.01", "balloons[0].bending.damping=0.1",
             "balloons[0].gas.neck=0.1", "balloons[0].pins.place=[1,0,0]", "balloons[0].pins.reach=20",
             "gravity.acceleration=[0,-1,0]", "drag.air_density=0.1", "balloons[0].gas.leak=0.01"}};
static const struct inflation all_of_springs = {
    .level = 3,
    .stretch = 1.5,
    .springs = true,
    .keys = {"balloons[0].string.place=[0,-1,0]", "balloons[0].string.reach=30",
             "balloons[0].string.to=[0,-3,0]", "balloons[0].string.weight=1",
             "balloons[0].string.stiffness=5", "gravity.acceleration=[0,-1,0]"}};

/* Skin that keeps apart, its fresh lips among it. */
static const struct inflation touching = {
    .level = 3, .stretch = 1.5, .springs = true, .keys = {"contact.thickness=0.02", "contact.friction=0.3"}};

/* Cuts that the gas is told of. */
static inline void tear(struct inflated *it, uint64_t seed, int count)
{
    cut_anywhere(it, seed, count);
    fracture_tell_gas(&it->sim, it->balloon);
    gas_let_go(&it->sim, it->balloon, it->sim.triangle_point[100], 3 * 20); /* as if they had fallen off */
}

/* Until put_in_order(). */
static inline void let_wait(struct inflated *it)
{
    it->balloon->topology->now.awake = REORDER_SLEEPS;
}

/* As if it had rested: at its next step it puts points in order, and sleeps. */
static inline void put_in_order(struct inflated *it)
{
    it->balloon->topology->now.awake = REORDER_AWAKE;
    it->balloon->topology->now.last_cut = -INFINITY;
    reorder_step(&it->sim);
    assert_int_equal(it->balloon->topology->now.settled, it->balloon->topology->now.points);
    assert_int_equal(it->balloon->topology->now.awake, REORDER_SLEEPS);
}

static inline void steps(struct inflated *it, int count)
{
    struct error err = {0};
    for (int i = 0; i < count; i++)
        assert_ok(sim_step(&it->sim, &err), &err);
}

/* A state, as whoever rewinds keeps it. */
struct kept {
    uint64_t hash; /* ten steps later */
    size_t count;
    struct {
        void *data;
        size_t size;
    } block[64];
};

static inline void keep(struct inflated *it, struct kept *kept)
{
    const struct sim_block *blocks = sim_blocks(&it->sim, &kept->count);
    assert_true(kept->count <= 64);
    for (size_t i = 0; i < kept->count; i++) {
        kept->block[i].size = blocks[i].size;
        kept->block[i].data = malloc(blocks[i].size + 1);
        if (blocks[i].size)
            memcpy(kept->block[i].data, blocks[i].data, blocks[i].size);
    }
}

static inline void forget(struct kept *kept)
{
    for (size_t i = 0; i < kept->count; i++)
        free(kept->block[i].data);
}

#endif
