/* The simulator alone: full steps of springs, dampers and pressure on one core, and the bytes of its tables; on the mesh that
 * is given and on icospheres. bench_step MESH */
#include "sim/sim.h"
#include "support/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void check(enum status status, const struct error *err)
{
    if (!status)
        return;
    fprintf(stderr, "bench_step: %s\n", err->text);
    exit(status_exit_code(status));
}

/* The best of five runs: other programs only ever add to the time. */
static double time_step(struct sim *sim, long steps)
{
    struct error err = {0};
    double best = 1e9;
    for (int run = 0; run < 5; run++) {
        const double began = seconds();
        for (long i = 0; i < steps; i++)
            check(sim_step(sim, &err), &err);
        const double spent = (seconds() - began) / (double)steps;
        best = spent < best ? spent : best;
    }
    return best;
}

static void bench(struct mesh *mesh)
{
    struct error err = {0};
    struct scene scene = {0};
    struct sim sim;
    check(scene_from_mesh("sphere", &scene, &err), &err);
    check(scene_set(&scene, "balloons[0].pressure=0.001", &err), &err); /* nothing breaks at any size */
    check(scene_set(&scene, "balloons[0].radius=0", &err), &err);
    check(scene_set(&scene, "balloons[0].spring=1000", &err), &err);
    check(scene_set(&scene, "balloons[0].point_mass=10", &err), &err);
    check(scene_check(&scene, &err), &err);
    check(sim_open(&sim, &scene, mesh, &err), &err);
    const long steps = 4000000 / mesh->triangle_count + 2;
    const double step = time_step(&sim, steps);
    printf("%9u  %8u  %12.0f  %10.1f  %14.2f  %16.1f\n", mesh->triangle_count, sim.broken, 1 / step,
           1e9 * step / mesh->edge_count, 1e-6 * mesh->triangle_count / step,
           (double)sim.bytes / mesh->triangle_count);
    sim_clear(&sim);
    scene_clear(&scene);
    mesh_clear(mesh);
}

int main(int argc, char **argv)
{
    struct error err = {0};
    struct mesh mesh = {0};
    printf("triangles    broken  steps/second  ns an edge  Mtriangles/s    bytes a triangle\n");
    if (argc > 1) {
        check(mesh_load(argv[1], &mesh, &err), &err);
        check(mesh_connect(&mesh, &err), &err);
        bench(&mesh);
    }
    for (unsigned level = 3; level <= 8; level++) { /* 1280 to 1.3 million triangles */
        shape_icosphere(level, &mesh);
        bench(&mesh);
    }
    return 0;
}
