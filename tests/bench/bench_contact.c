/* What obstacles, needles and contact cost an icosphere of 20,480 triangles, in steps of springs and constant
 * pressure alone: while nothing is near, and stage by stage while the balloon is sucked empty and crumples,
 * or goes down on the ground and folds, as data/scenes/folded.cfg does; on one thread and on two, which come
 * to the same states. bench_contact */
#include "sim/contact.h"
#include "support/bench.h"
#include "support/shapes.h"

#include <inttypes.h>
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

/* Returns what a step of the first row took. */
static double bench(const struct setting *s, const struct mesh *mesh, unsigned workers, double springs)
{
    struct scene scene = {0};
    struct sim sim = {0};
    struct error err = {0};
    const char *changes[] = {"time.guard=off",        "time.step=0.01", "balloons[0].threshold=100",
                             "balloons[0].damping=2", s->pressure,      s->change};
    double first = 0;
    bench_check(scene_from_mesh("sphere", &scene, &err), &err);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0] && changes[i]; i++)
        bench_check(scene_set(&scene, changes[i], &err), &err);
    bench_check(scene_check(&scene, &err), &err);
    bench_check(sim_open(&sim, &scene, mesh, workers, &err), &err);
    stir(&sim);
    for (int row = 0; row < s->rows; row++) {
        const double began = bench_thread_seconds();
        for (int i = 0; i < s->steps; i++)
            bench_check(sim_step(&sim, &err), &err);
        const double each = (bench_thread_seconds() - began) / s->steps;
        first = row == 0 ? each : first;
        printf("%-11s %7u %5.2f s %9.0f us %6.1f %9u   %016" PRIx64 "\n", s->name, workers, sim.time,
               1e6 * each, each / (springs > 0 ? springs : first), sim.contact ? sim.contact->pair_count : 0,
               sim_hash(&sim));
    }
    sim_clear(&sim);
    scene_clear(&scene);
    return first;
}

/* Half seconds of a ball that goes down, with contact and without, in steps as short as they must be: what
 * contact adds to a step, in steps of springs. */
static void bench_going_down(const struct mesh *mesh, unsigned workers, double springs)
{
    enum { KEYS = 9, HALVES = 8, FIRST = 6 };
    static const char *changes[KEYS] = {"balloons[0].threshold=100",
                                        "balloons[0].damping=2",
                                        "balloons[0].pressure=-0.3",
                                        "balloons[0].bending.stiffness=20",
                                        "balloons[0].bending.damping=0.02",
                                        "time.step=0.01",
                                        "gravity.acceleration=[0,-6,0]",
                                        "ground.height=-50",
                                        "contact.thickness=0.15"};
    struct scene scene[2] = {0};
    struct sim sim[2] = {0};
    struct error err = {0};
    for (int with = 0; with < 2; with++) {
        bench_check(scene_from_mesh("sphere", &scene[with], &err), &err);
        bench_check(scene_set(&scene[with], "time.integrator=symplectic-euler", &err), &err);
        bench_check(scene_set(&scene[with], "time.guard=substep", &err), &err);
        for (int i = 0; i < KEYS - !with; i++)
            bench_check(scene_set(&scene[with], changes[i], &err), &err);
        bench_check(scene_check(&scene[with], &err), &err);
        bench_check(sim_open(&sim[with], &scene[with], mesh, workers, &err), &err);
    }
    for (int half = 1; half <= HALVES; half++) {
        double each[2];
        for (int with = 0; with < 2; with++) {
            const double began = bench_thread_seconds();
            const uint64_t steps = sim[with].steps;
            while (sim[with].time < 0.5 * half - 1e-9)
                bench_check(sim_step(&sim[with], &err), &err);
            each[with] = (bench_thread_seconds() - began) / (double)(sim[with].steps - steps);
        }
        if (half >= FIRST)
            printf("%-11s %7u %5.2f s %9.0f us %6.1f %9u   %016" PRIx64 "\n", "going down", workers,
                   sim[1].time, 1e6 * each[1], 1 + (each[1] - each[0]) / springs, sim[1].contact->pair_count,
                   sim_hash(&sim[1]));
    }
    for (int with = 0; with < 2; with++) {
        sim_clear(&sim[with]);
        scene_clear(&scene[with]);
    }
}

int main(void)
{
    static const struct setting settings[] = {
        {"springs", NULL, "balloons[0].pressure=3", 100, 2},
        {"ground", "ground.height=-200", "balloons[0].pressure=3", 100, 2},
        {"needle", "needles[0].from=[500,0,0]", "balloons[0].pressure=3", 100, 2},
        {"contact", "contact.thickness=0.15", "balloons[0].pressure=3", 100, 4},
        {"folding", NULL, "balloons[0].pressure=-1", 25, 2},
        {"folding, c.", "contact.thickness=0.15", "balloons[0].pressure=-1", 25, 8},
    };
    struct mesh mesh = {0};
    struct error err = {0};
    shape_icosphere(5, &mesh);
    bench_check(mesh_order(&mesh, &err), &err); /* as sim_load_meshes() does */
    printf("scene       threads   until       a step springs pairs near   state\n");
    for (unsigned workers = 1; workers <= 2; workers++) {
        double springs = 0; /* a step of them */
        for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++) {
            const double first = bench(&settings[i], &mesh, workers, springs);
            springs = i == 0 ? first : springs;
        }
        bench_going_down(&mesh, workers, springs);
    }
    mesh_clear(&mesh);
    return 0;
}
