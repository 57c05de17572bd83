/* What a tear costs, at 5 thousand and 300 thousand triangles: a cut by itself, steps before and while a
 * pricked balloon bursts, and steps of the torn skin (the smaller one's shreds) while its new points wait
 * behind the others, and once they are in their places. */
#include "common/vec3.h"
#include "sim/fracture.h"
#include "sim/reorder.h"
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

/* While new points wait: it is kept from waking. */
static double seconds_while_waiting(struct sim *sim, int steps)
{
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        sim->balloons->topology->now.awake = REORDER_SLEEPS;
        sum += seconds_a_step(sim, 1);
    }
    return sum / steps;
}

/* As if it had rested; the step in which that is found. */
static double seconds_of_ordering(struct sim *sim)
{
    sim->balloons->topology->now.awake = REORDER_AWAKE;
    sim->balloons->topology->now.last_cut = -INFINITY;
    return seconds_a_step(sim, 1);
}

static void measure(unsigned level)
{
    struct scene scene = {0};
    struct sim sim;
    open_balloon(level, &scene, &sim);
    const int steps = level > 5 ? 40 : 200;
    seconds_a_step(&sim, 2);
    const double before = seconds_a_step(&sim, steps);
    fracture_prick(&sim, sim.balloons, (const double[3]){0, 0, 2});
    const double during = seconds_a_step(&sim, steps);
    uint32_t events;
    const double event = seconds_an_event(&sim, &events);
    seconds_while_waiting(&sim, level > 5 ? 0 : 4000);
    const double waiting = seconds_while_waiting(&sim, steps), ordering = seconds_of_ordering(&sim),
                 ordered = seconds_a_step(&sim, steps);
    printf("%9u  %8.3f  %8.3f  %6.2f  %8u  %12.2f  %8.3f  %8.3f  %8.3f\n", sim.triangle_count, 1e3 * before,
           1e3 * during, during / before, events, 1e6 * event, 1e3 * waiting, 1e3 * ordering, 1e3 * ordered);
    sim_clear(&sim);
    scene_clear(&scene);
}

int main(void)
{
    printf(
        "ms a step: whole, as it tears, torn with new points behind the others, the step in which they come to "
        "their places, and after it\n");
    printf("triangles     whole     tears   ratio    events   us an event   waiting  ordering   ordered\n");
    measure(4);
    measure(7);
    return 0;
}
