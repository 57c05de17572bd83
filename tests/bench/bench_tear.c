/* What a tear costs, at 5 thousand and 300 thousand triangles: a cut by itself, and steps before and while a
 * pricked balloon bursts. */
#include "common/vec3.h"
#include "sim/fracture.h"
#include "support/bench.h"
#include "support/rubber.h"
#include "support/shapes.h"

#include <math.h>

static void open_balloon(unsigned level, struct scene *scene, struct sim *sim)
{
    struct mesh mesh;
    struct error err = {0};
    shape_icosphere(level, &mesh);
    bench_check(mesh_order(&mesh, &err), &err);
    bench_check(scene_from_mesh("balloon.ply", scene, &err), &err);
    const double edge = sqrt(16 * 3.141592653589793 / (mesh.triangle_count * sqrt(3)));
    bench_check(rubber_keys(scene, 2, 0.02, &err), &err);
    bench_check(rubber_key(scene, "time.step", 0.02 * edge, &err), &err);
    bench_check(scene_set(scene, "balloons[0].fracture.mode=tear", &err), &err);
    bench_check(scene_check(scene, &err), &err);
    bench_check(sim_open(sim, scene, &mesh, 1, &err), &err);
    for (uint32_t p = 0; p < sim->balloons->point_end; p++)
        for (int i = 0; i < 3; i++)
            sim->position[p][i] *= 2;
    mesh_clear(&mesh);
}

static double seconds_a_step(struct sim *sim, int steps)
{
    struct error err = {0};
    const double began = bench_thread_seconds();
    for (int i = 0; i < steps; i++)
        bench_check(sim_step(sim, &err), &err);
    return (bench_thread_seconds() - began) / steps;
}

/* The rule and the cuts of some steps, without moving anything: time goes on so that no tip rests. */
static double seconds_an_event(struct sim *sim, uint32_t *events)
{
    struct sim_balloon *b = sim->balloons;
    const uint32_t before = b->fracture->now.events;
    const double began = bench_thread_seconds();
    for (int i = 0; i < 200; i++) {
        b->fracture->stamps++;
        fracture_tips(sim, b);
        sim->time += 0.01;
    }
    *events = b->fracture->now.events - before;
    return (bench_thread_seconds() - began) / *events;
}

static void measure(unsigned level)
{
    struct scene scene = {0};
    struct sim sim;
    open_balloon(level, &scene, &sim);
    const int steps = level > 5 ? 8 : 200;
    seconds_a_step(&sim, 2);
    const double before = seconds_a_step(&sim, steps);
    fracture_prick(&sim, sim.balloons, (const double[3]){0, 0, 2});
    const double during = seconds_a_step(&sim, steps);
    uint32_t events;
    const double event = seconds_an_event(&sim, &events);
    printf("%9u  %12.3f  %12.3f  %8.2f  %8u  %12.2f\n", sim.triangle_count, 1e3 * before, 1e3 * during,
           during / before, events, 1e6 * event);
    sim_clear(&sim);
    scene_clear(&scene);
}

int main(void)
{
    printf("triangles  step before  during tears     ratio    events  us an event\n");
    measure(4);
    measure(7);
    return 0;
}
