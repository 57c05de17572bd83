/* What obstacles, needles and contact add to a step of an icosphere of 20,480 triangles over springs and constant pressure, on one core: while
 * nothing is near, and stage by stage while the balloon is sucked empty and folds. bench_contact */
#include "sim/contact.h"
#include "support/bench.h"
#include "support/shapes.h"

#include <math.h>

struct setting {
    const char *name, *change, *pressure;
    int steps, rows;
};

/* A swirl, so that it folds unevenly. */
static void stir(struct sim *sim)
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            sim->velocity[p][i] = 3 * sin(sim->position[p][(i + 1) % 3] / 8 + i);
}

static void bench(const struct setting *s, const struct mesh *mesh)
{
    struct scene scene = {0};
    struct sim sim = {0};
    struct error err = {0};
    const char *changes[] = {"time.guard=off",        "time.step=0.01", "balloons[0].threshold=100",
                             "balloons[0].damping=2", s->pressure,      s->change};
    bench_check(scene_from_mesh("sphere", &scene, &err), &err);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0] && changes[i]; i++)
        bench_check(scene_set(&scene, changes[i], &err), &err);
    bench_check(scene_check(&scene, &err), &err);
    bench_check(sim_open(&sim, &scene, mesh, 1, &err), &err);
    stir(&sim);
    for (int row = 0; row < s->rows; row++) {
        const double began = bench_thread_seconds();
        for (int i = 0; i < s->steps; i++)
            bench_check(sim_step(&sim, &err), &err);
        const double each = (bench_thread_seconds() - began) / s->steps;
        printf("%-11s %5.2f s  %9.0f us  %7u pairs\n", s->name, sim.time, 1e6 * each,
               sim.contact ? sim.contact->pair_count : 0);
    }
    sim_clear(&sim);
    scene_clear(&scene);
}

int main(void)
{
    static const struct setting settings[] = {
        {"springs", NULL, "balloons[0].pressure=3", 100, 4},
        {"ground", "ground.height=-200", "balloons[0].pressure=3", 100, 4},
        {"needle", "needles[0].from=[500,0,0]", "balloons[0].pressure=3", 100, 4},
        {"contact", "contact.thickness=0.15", "balloons[0].pressure=3", 100, 4},
        {"folding", NULL, "balloons[0].pressure=-1", 25, 2},
        {"folding, c.", "contact.thickness=0.15", "balloons[0].pressure=-1", 25, 8},
    };
    struct mesh mesh = {0};
    shape_icosphere(5, &mesh);
    printf("scene        until    us a step            near\n");
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        bench(&settings[i], &mesh);
    mesh_clear(&mesh);
    return 0;
}
