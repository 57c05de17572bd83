/* Skins that are cut as it comes. */
#ifndef TESTS_BURST_CUTS_H
#define TESTS_BURST_CUTS_H

#include "burst/inflated.h"
#include "common/random.h"

static inline void give_speeds(struct inflated *it)
{
    uint64_t state = 5;
    for (uint32_t p = 0; p < it->balloon->point_end; p++)
        for (int i = 0; i < 3; i++)
            it->sim.velocity[p][i] = random_unit(&state) - 0.5;
}

/* Cuts `count` sides of triangles that come as they may. */
static inline void cut_anywhere(struct inflated *it, uint64_t seed, int count)
{
    uint64_t state = seed;
    for (int done = 0; done < count;) {
        const uint32_t t = (uint32_t)(random_unit(&state) * it->balloon->triangle_end);
        const int side = (int)(random_unit(&state) * 3);
        if (it->balloon->topology->neighbour[t][side] == MESH_NONE)
            continue;
        assert_true(topology_can_cut(&it->sim, it->balloon));
        topology_cut(&it->sim, it->balloon, t, side);
        done++;
    }
}

#endif
