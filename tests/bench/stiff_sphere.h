/* A sphere under pressure, one in twenty of whose springs is stiffer than the others by a contrast: what
 * implicit methods are for. */
#ifndef TESTS_BENCH_STIFF_SPHERE_H
#define TESTS_BENCH_STIFF_SPHERE_H

#include "sim/sim.h"
#include "support/bench.h"

static inline void stiff_sphere_open(const char *method, double contrast, const struct mesh *mesh,
                                     struct scene *scene, struct sim *sim)
{
    char integrator[64];
    struct error err = {0};
    const char *changes[] = {integrator, "time.guard=off", "balloons[0].pressure=2",
                             "balloons[0].point_mass=1", "balloons[0].threshold=100"};
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    bench_check(scene_from_mesh("sphere", scene, &err), &err);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        bench_check(scene_set(scene, changes[i], &err), &err);
    bench_check(scene_check(scene, &err), &err);
    bench_check(sim_open(sim, scene, mesh, 1, &err), &err);
    for (uint32_t e = 0; e < sim->edge_count; e += 20)
        sim->current_spring_const[e] *= contrast;
}

#endif
