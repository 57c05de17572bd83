/* The simulator alone: full steps of springs, dampers and constant pressure, on one thread and on all; on the
 * mesh that is given and on icospheres. Bytes a triangle are those of the tables; bytes an edge those that a
 * step moves, and GB/s at what rate on one thread. bench_step [MESH] */
#include "common/threads.h"
#include "sim/sim.h"
#include "support/bench.h"
#include "support/shapes.h"

#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

/* The best of five runs: other programs only ever add to the time. One thread's time is its own on its
 * processor, unless by the clock; that of several is the clock's. */
static double time_step(struct sim *sim, bool by_clock, long steps)
{
    struct error err = {0};
    double best = 1e9;
    for (int run = 0; run < 5; run++) {
        const double began = by_clock ? bench_seconds() : bench_thread_seconds();
        for (long i = 0; i < steps; i++)
            bench_check(sim_step(sim, &err), &err);
        const double now = by_clock ? bench_seconds() : bench_thread_seconds();
        best = (now - began) / (double)steps < best ? (now - began) / (double)steps : best;
    }
    return best;
}

struct timing {
    double seconds, bytes; /* of a step; of the tables */
    uint32_t broken;
};

static struct timing measure(const struct mesh *mesh, unsigned workers, bool by_clock)
{
    static const char *const settings[] = {"balloons[0].pressure=0.001", /* nothing breaks at any size */
                                           "balloons[0].radius=0", "balloons[0].spring=1000",
                                           "balloons[0].point_mass=10", "time.integrator=symplectic-euler"};
    struct error err = {0};
    struct scene scene = {0};
    struct sim sim;
    bench_check(scene_from_mesh("sphere", &scene, &err), &err);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        bench_check(scene_set(&scene, settings[i], &err), &err);
    bench_check(scene_check(&scene, &err), &err);
    bench_check(sim_open(&sim, &scene, mesh, workers, &err), &err);
    const double seconds = time_step(&sim, by_clock, 4000000 / mesh->triangle_count + 2);
    const struct timing timing = {seconds, (double)sim.bytes, sim.broken};
    sim_clear(&sim);
    scene_clear(&scene);
    return timing;
}

/* What one step must bring from memory or take there where nothing stays in a cache, once each: places and
 * speeds both ways, masses, forces and normals out, and what edges and triangles are. */
static double bytes_moved(const struct mesh *mesh)
{
    const struct sim *sim = NULL;
    const double point = 2 * (sizeof *sim->position + sizeof *sim->velocity) + sizeof *sim->mass +
                         sizeof *sim->force + sizeof *sim->normal,
                 edge = sizeof *sim->edge_point + sizeof *sim->rest_length +
                        sizeof *sim->current_spring_const + sizeof *sim->edge_active,
                 triangle = sizeof *sim->triangle_point + sizeof *sim->triangle_active;
    return mesh->point_count * point + mesh->edge_count * edge + mesh->triangle_count * triangle;
}

static void bench(struct mesh *mesh)
{
    struct error err = {0};
    bench_check(mesh_order(mesh, &err), &err); /* as sim_load_meshes() does */
    const struct timing one = measure(mesh, 1, false), all = measure(mesh, threads_of_machine(), true);
    const double moved = bytes_moved(mesh);
    printf("%9u  %6u  %12.0f  %10.1f  %16.1f  %13.2f  %16.1f  %13.0f  %4.1f\n", mesh->triangle_count,
           one.broken, 1 / one.seconds, 1e9 * one.seconds / mesh->edge_count,
           1e9 * all.seconds / mesh->edge_count, one.seconds / all.seconds, one.bytes / mesh->triangle_count,
           moved / mesh->edge_count, 1e-9 * moved / one.seconds);
    mesh_clear(mesh);
}

/* A program of common priority that takes all that it gets of a processor, until it or this one is killed. */
static pid_t start_other(void)
{
    const pid_t parent = getpid(), child = fork();
    if (child == 0) {
        sched_setscheduler(0, SCHED_OTHER, &(struct sched_param){0});
        while (getppid() == parent)
            ;
        _exit(0);
    }
    return child;
}

/* A step by the clock, in microseconds, while others want half the processors, or all. */
static void bench_beside_others(void)
{
    enum { OTHERS_MAX = 64 };
    struct mesh mesh;
    struct error err = {0};
    pid_t other[OTHERS_MAX];
    const unsigned machine = threads_of_machine(), half = machine / 2,
                   most = machine < OTHERS_MAX ? machine : OTHERS_MAX;
    shape_icosphere(4, &mesh);
    bench_check(mesh_order(&mesh, &err), &err);
    printf("\nBeside other programs, each of which takes a processor: %u triangles, us a step\n"
           "others  1 thread  2 threads  %u threads\n",
           mesh.triangle_count, machine + 1);
    for (unsigned others = 0, i = 0; i < 3; i++) {
        for (; others < (unsigned[]){0, half, most}[i]; others++)
            other[others] = start_other();
        printf("%6u", others);
        for (unsigned k = 0; k < 3; k++)
            printf("  %8.0f", 1e6 * measure(&mesh, (unsigned[]){1, 2, machine + 1}[k], true).seconds);
        printf("\n");
    }
    for (unsigned i = 0; i < most; i++) {
        kill(other[i], SIGKILL);
        waitpid(other[i], NULL, 0);
    }
    mesh_clear(&mesh);
}

int main(int argc, char **argv)
{
    struct error err = {0};
    struct mesh mesh = {0};
    printf("Full steps of springs and pressure; all is %u threads\n", threads_of_machine());
    printf("triangles  broken  steps/second  ns an edge  ns, all threads  times as fast  bytes a triangle  "
           "bytes an edge  GB/s\n");
    if (argc > 1) {
        bench_check(mesh_load(argv[1], &mesh, &err), &err);
        bench_check(mesh_connect(&mesh, &err), &err);
        bench(&mesh);
    }
    for (unsigned level = 3; level <= 8; level++) { /* 1280 to 1.3 million triangles */
        shape_icosphere(level, &mesh);
        bench(&mesh);
    }
    bench_beside_others();
    return 0;
}
