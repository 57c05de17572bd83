/* What each effect adds to a step of 20,480 triangles with springs under constant pressure. Steps with and
 * without it take turns, so that other programs weigh on both alike; the best of each counts. */
#include "common/threads.h"
#include "sim/explain.h"
#include "sim/sim.h"
#include "support/bench.h"
#include "support/shapes.h"

#include <inttypes.h>
#include <string.h>

enum { LEVEL = 5, STEPS = 20, TURNS = 15, KEYS_MAX = 8 };

struct row {
    const char *name, *target;
    const char *keys[KEYS_MAX];
};

static const struct row rows[] = {
    {"pressure on areas", "", {"balloons[0].pressure_on=areas", "balloons[0].pressure=0.01"}},
    {"gas", "5 %", {"balloons[0].gas.ambient=10", "balloons[0].gas.fill=1.001"}},
    {"gas, adiabatic, open",
     "5 %",
     {"balloons[0].gas.ambient=10", "balloons[0].gas.fill=1.1", "balloons[0].gas.process=adiabatic",
      "balloons[0].gas.neck=0.001"}},
    {"pins", "5 %", {"balloons[0].pins.reach=20"}},
    {"string", "", {"balloons[0].string.reach=5"}},
    {"gravity", "15 %", {"gravity.acceleration=[0.0, -0.001, 0.0]"}},
    {"drag", "15 %", {"drag.air_density=0.001"}},
    {"bending", "100 %", {"balloons[0].bending.stiffness=1"}},
    {"viscosity", "", {"balloons[0].viscosity.ratio=0.5"}},
    {"plasticity", "", {"balloons[0].plasticity.yield=1e6"}},
    {"ground, far", "", {"ground.height=-1000"}},
    {"needle, far", "", {"needles[0].from=[500, 0, 0]"}},
    {"contact, nothing near", "10 %", {"contact.friction=0.3"}},
    {"fracture, whole skin", "", {"balloons[0].fracture.strength=100"}},
    {"neo-Hookean membrane",
     "150 %",
     {"balloons[0].membrane.thickness=0.1", "balloons[0].membrane.law=neo-hookean"}},
    {"Mooney-Rivlin membrane",
     "150 %",
     {"balloons[0].membrane.thickness=0.1", "balloons[0].membrane.law=mooney-rivlin"}},
    {"Gent membrane", "150 %", {"balloons[0].membrane.thickness=0.1", "balloons[0].membrane.law=gent"}},
    {"Ogden membrane", "150 %", {"balloons[0].membrane.thickness=0.1", "balloons[0].membrane.law=ogden"}},
};

static const char *const all[] = {"balloons[0].pressure=0.001",
                                  "balloons[0].spring=1000",
                                  "balloons[0].point_mass=10",
                                  "balloons[0].radius=45",
                                  "balloons[0].threshold=1e6",
                                  "time.integrator=symplectic-euler",
                                  "time.step=0.001"};

struct bench {
    struct scene scene;
    struct sim sim;
    double best; /* s a step */
};

/* False where the keys are not there. */
static bool open_bench(struct bench *b, const struct mesh *mesh, const char *const *keys, unsigned workers)
{
    struct error err = {0};
    *b = (struct bench){.best = 1e9};
    bench_check(scene_from_mesh("sphere", &b->scene, &err), &err);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (i > 0 || !keys || !keys[0] || strncmp(keys[0], "balloons[0].gas", 15))
            bench_check(scene_set(&b->scene, all[i], &err), &err);
    for (int i = 0; keys && i < KEYS_MAX && keys[i]; i++)
        if (scene_set(&b->scene, keys[i], &err)) {
            scene_clear(&b->scene);
            return false;
        }
    bench_check(scene_check(&b->scene, &err), &err);
    bench_check(sim_open(&b->sim, &b->scene, mesh, workers, &err), &err);
    return true;
}

static void turn(struct bench *b, unsigned workers)
{
    struct error err = {0};
    const double began = workers == 1 ? bench_thread_seconds() : bench_seconds();
    for (int i = 0; i < STEPS; i++)
        bench_check(sim_step(&b->sim, &err), &err);
    const double now = workers == 1 ? bench_thread_seconds() : bench_seconds();
    b->best = (now - began) / STEPS < b->best ? (now - began) / STEPS : b->best;
}

/* By counted work (explain.h), of all that the scene calls for. */
static double expected(const struct scene *scene)
{
    double share = 0;
    for (const struct effect *const *effect = effects; *effect; effect++)
        share += explain_share(*effect, scene);
    return 100 * share;
}

static uint64_t close_bench(struct bench *b)
{
    const uint64_t hash = sim_hash(&b->sim);
    sim_clear(&b->sim);
    scene_clear(&b->scene);
    return hash;
}

static void measure(const struct row *row, const struct mesh *mesh)
{
    double share[2], by_count = 0;
    uint64_t hash[2];
    size_t bytes = 0;
    for (unsigned workers = 1; workers <= 2; workers++) {
        struct bench plain, with;
        if (!open_bench(&with, mesh, row->keys, workers))
            return;
        open_bench(&plain, mesh, NULL, workers);
        for (int i = 0; i < TURNS; i++) {
            turn(&plain, workers);
            turn(&with, workers);
        }
        share[workers - 1] = with.best / plain.best - 1;
        by_count = expected(&with.scene);
        bytes = with.sim.bytes - plain.sim.bytes;
        hash[workers - 1] = close_bench(&with);
        close_bench(&plain);
    }
    printf("%-22s %9s %9.0f %11.1f %12.1f %12.1f  %s\n", row->name, row->target, by_count, 100 * share[0],
           100 * share[1], (double)(ptrdiff_t)bytes / mesh->triangle_count,
           hash[0] == hash[1] ? "equal" : "DIFFERENT");
}

int main(void)
{
    struct error err = {0};
    struct mesh mesh = {0};
    shape_icosphere(LEVEL, &mesh);
    bench_check(mesh_order(&mesh, &err), &err);
    printf("What effects add to a step of %u triangles, in %% of it with springs and constant pressure\n",
           mesh.triangle_count);
    printf("effect                    at most  expected  one thread  two threads  bytes/tri.   hashes\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        measure(&rows[i], &mesh);
    mesh_clear(&mesh);
    return 0;
}
