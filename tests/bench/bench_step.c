/* The simulator alone: full steps of springs, dampers and pressure on one core, and the bytes of its tables; on the mesh that
 * is given and on icospheres. bench_step MESH */
#include "sim/sim.h"
#include "support/bench.h"
#include "support/shapes.h"

/* The best of five runs: other programs only ever add to the time. */
static double time_step(struct sim *sim, long steps)
{
    struct error err = {0};
    double best = 1e9;
    for (int run = 0; run < 5; run++) {
        const double began = bench_thread_seconds();
        for (long i = 0; i < steps; i++)
            bench_check(sim_step(sim, &err), &err);
        const double spent = (bench_thread_seconds() - began) / (double)steps;
        best = spent < best ? spent : best;
    }
    return best;
}

static void bench(struct mesh *mesh)
{
    struct error err = {0};
    struct scene scene = {0};
    struct sim sim;
    bench_check(scene_from_mesh("sphere", &scene, &err), &err);
    bench_check(scene_set(&scene, "balloons[0].pressure=0.001", &err), &err); /* nothing breaks at any size */
    bench_check(scene_set(&scene, "balloons[0].radius=0", &err), &err);
    bench_check(scene_set(&scene, "balloons[0].spring=1000", &err), &err);
    bench_check(scene_set(&scene, "balloons[0].point_mass=10", &err), &err);
    bench_check(scene_check(&scene, &err), &err);
    bench_check(mesh_order(mesh, &err), &err); /* as sim_load_meshes() does */
    bench_check(sim_open(&sim, &scene, mesh, 1, &err), &err);
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
        bench_check(mesh_load(argv[1], &mesh, &err), &err);
        bench_check(mesh_connect(&mesh, &err), &err);
        bench(&mesh);
    }
    for (unsigned level = 3; level <= 8; level++) { /* 1280 to 1.3 million triangles */
        shape_icosphere(level, &mesh);
        bench(&mesh);
    }
    return 0;
}
