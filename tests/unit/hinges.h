/* The balloon of hinges that the tests of bending begin with, its shapes, and cuts through it. */
#ifndef TESTS_UNIT_HINGES_H
#define TESTS_UNIT_HINGES_H

#include "balloon.h"
#include "differences.h"
#include "sim/topology.h"

/* A balloon of radius 1 that nothing but its hinges acts on. */
#define HINGES(...)                                                                                   \
    SETTINGS("balloons[0].radius=1", "balloons[0].pressure=0", "balloons[0].threshold=1e300",         \
             "balloons[0].spring=0", "balloons[0].damping=0", "balloons[0].point_mass=1",             \
             "balloons[0].bending.stiffness=1", "time.integrator=symplectic-euler", "time.step=0.01", \
             "time.end=1e6" __VA_OPT__(, ) __VA_ARGS__)

/* Blown up; out of shape; crumpled, with folds past a right angle; flattened, with
 * triangles that are crushed. */
static const struct {
    double factor[3], size;
} shapes[] = {
    {{1.7, 1.5, 1.6}, 0.02}, {{2.5, 0.8, 0.7}, 0.05}, {{0.8, 0.7, 0.9}, 0.25}, {{0.5, 0.4, 0.05}, 0.03}};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

/* Cuts from a point on around the balloon, each along a side of a triangle that is still joined. */
static inline void cut_some(struct sim *sim, int cuts)
{
    struct sim_balloon *b = sim->balloons;
    for (uint32_t t = 40; t < sim->triangle_count && cuts > 0; t += 1)
        if (b->topology->neighbour[t][0] != MESH_NONE && topology_can_cut(sim, b)) {
            topology_cut(sim, b, t, 0);
            cuts--;
        }
}

#endif
