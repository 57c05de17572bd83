/* Every integrator on one core: what a step costs in forces and time, and what a simulated second costs at
 * which error. The paper's sphere with 1 as its points' mass, under pressure, until 1 s, before anything
 * breaks; errors are RMS of positions over the radius, against rk4 in steps of half a millisecond.
 * bench_integrators MESH */
#include "sim/sim.h"
#include "support/bench.h"
#include "support/shapes.h"

#include <math.h>
#include <string.h>

static void open_scene(const struct mesh *mesh, const char *method, const char *dial, struct scene *scene,
                       struct sim *sim)
{
    char integrator[64];
    struct error err = {0};
    const char *changes[] = {integrator,
                             dial,
                             "time.guard=off",
                             "time.end=1",
                             "balloons[0].point_mass=1",
                             "balloons[0].threshold=100"};
    snprintf(integrator, sizeof integrator, "time.integrator=%s", method);
    bench_check(scene_from_mesh("sphere", scene, &err), &err);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        bench_check(scene_set(scene, changes[i], &err), &err);
    bench_check(scene_check(scene, &err), &err);
    bench_check(sim_open(sim, scene, mesh, 1, &err), &err);
    if (sim->integrator->flags & INTEGRATOR_ADAPTIVE)
        sim->step = sim->whole_step = 1; /* no limit but its own */
}

static double difference(const struct sim *a, const struct sim *b)
{
    double sum = 0;
    for (uint32_t p = 0; p < a->point_count; p++)
        for (int i = 0; i < 3; i++)
            sum += pow(a->position[p][i] - b->position[p][i], 2);
    return sqrt(sum / a->point_count) / a->balloons[0].radius;
}

/* Runs to the end; the best of five, since other programs only ever add to the time. */
static double run(const struct mesh *mesh, const char *method, const char *dial, int times,
                  struct scene *scene, struct sim *sim)
{
    struct error err = {0};
    double best = INFINITY;
    for (int i = 0; i < times; i++) {
        if (i > 0) {
            sim_clear(sim);
            scene_clear(scene);
            *scene = (struct scene){0};
        }
        open_scene(mesh, method, dial, scene, sim);
        const double began = bench_thread_seconds();
        while (!sim_at_end(sim))
            bench_check(sim_step(sim, &err), &err);
        best = fmin(best, bench_thread_seconds() - began);
    }
    return best;
}

static void bench(const struct mesh *mesh, const struct sim *reference, const char *method, const char *dial)
{
    struct scene scene = {0};
    struct sim sim;
    const double spent = run(mesh, method, dial, 5, &scene, &sim);
    const double steps = (double)sim.steps, forces = (double)sim.evaluations - 1; /* the first look */
    printf("%-18s  %-20s  %6.0f  %8.1f  %10.1f  %12.1f  %9.2f  %9.1e\n", method, dial, steps, forces / steps,
           1e9 * spent / steps / mesh->edge_count, 1e9 * spent / forces / mesh->edge_count, 1e3 * spent,
           difference(&sim, reference));
    fflush(stdout);
    sim_clear(&sim);
    scene_clear(&scene);
}

int main(int argc, char **argv)
{
    static const char *const steps[] = {"time.step=0.025", "time.step=0.005"}, *const tolerances[] = {
                                                                                   "time.tolerance=1e-4",
                                                                                   "time.tolerance=1e-6",
                                                                                   "time.tolerance=1e-8"};
    struct error err = {0};
    struct mesh mesh = {0};
    struct scene scene = {0};
    struct sim reference;
    if (argc > 1)
        bench_check(mesh_load(argv[1], &mesh, &err), &err);
    else
        shape_icosphere(4, &mesh);
    bench_check(mesh_connect(&mesh, &err), &err);
    run(&mesh, "rk4", "time.step=0.0005", 1, &scene, &reference);
    printf(
        "%u triangles, 1 s                               forces  ns an edge    ns an edge\n"
        "method              setting                steps   a step    and step     and force     ms 1 s      error\n",
        mesh.triangle_count);
    for (size_t k = 0; integrators[k]; k++) {
        const bool adaptive = integrators[k]->flags & INTEGRATOR_ADAPTIVE;
        if (!strcmp(integrators[k]->name, "auto")) /* whatever it chooses is in the list */
            continue;
        for (size_t i = 0; i < (adaptive ? sizeof tolerances : sizeof steps) / sizeof steps[0]; i++)
            bench(&mesh, &reference, integrators[k]->name, adaptive ? tolerances[i] : steps[i]);
    }
    sim_clear(&reference);
    scene_clear(&scene);
    mesh_clear(&mesh);
    return 0;
}
