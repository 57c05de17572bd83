/* Implicit methods on one core: what a step costs, in forces, products with their derivatives, and time, for
 * springs that are all alike and for one in twenty a thousand and a million times stiffer; on the mesh that
 * is given and an icosphere of 20 thousand triangles. The step is in units of the longest that velocity
 * Verlet is stable with. bench_implicit MESH */
#include "stiff_sphere.h"
#include "support/shapes.h"

#include <math.h>
#include <string.h>

struct setting {
    const char *method;
    double contrast, times_limit;
};

/* Twice over the root of the largest k / m that two points and a spring have, or of a mesh of equal springs
 * (7.07 k / m on the paper's sphere). */
static double explicit_limit(double spring, double contrast)
{
    return 2 / sqrt(spring * fmax(7.07, 2 * contrast));
}

static void bench(const struct setting *s, const struct mesh *mesh)
{
    struct error err = {0};
    struct scene scene = {0};
    struct sim sim;
    stiff_sphere_open(s->method, s->contrast, mesh, &scene, &sim);
    sim.step = sim.whole_step = s->times_limit * explicit_limit(scene.balloons[0].spring, s->contrast);
    enum status status = sim_step(&sim, &err); /* the first finds a balloon at rest, which is easy */
    const uint64_t evaluations = sim.evaluations, products = sim.products;
    const int steps = mesh->triangle_count > 10000 ? 5 : 20;
    const double began = bench_thread_seconds();
    for (int i = 0; i < steps && !status; i++)
        status = sim_step(&sim, &err);
    const double spent = (bench_thread_seconds() - began) / steps;
    printf("%9u  %-18s  %8.0e  %10.0f  ", mesh->triangle_count, s->method, s->contrast, s->times_limit);
    if (status)
        printf("%s\n", err.text);
    else
        printf("%9.3f  %8.1f  %8.1f  %10.1f\n", 1e3 * spent, (double)(sim.evaluations - evaluations) / steps,
               (double)(sim.products - products) / steps, 1e9 * spent / mesh->edge_count);
    sim_clear(&sim);
    scene_clear(&scene);
}

static void bench_mesh(struct mesh *mesh)
{
    static const char *const methods[] = {"backward-euler", "implicit-midpoint", "bdf2", "xpbd"};
    static const double contrast[] = {1, 1e3, 1e6}, times[] = {1, 10, 100, 1000};
    for (size_t c = 0; c < 3; c++)
        for (size_t t = 0; t < 4; t++)
            for (size_t m = 0; m < 4; m++)
                if (times[t] * explicit_limit(20, contrast[c]) < 2) /* else a step is a whole run */
                    bench(&(struct setting){methods[m], contrast[c], times[t]}, mesh);
    mesh_clear(mesh);
}

int main(int argc, char **argv)
{
    struct error err = {0};
    struct mesh mesh = {0};
    printf(
        "triangles  method              contrast  step/limit    ms/step    forces  products  ns an edge\n");
    if (argc > 1) {
        bench_check(mesh_load(argv[1], &mesh, &err), &err);
        bench_check(mesh_connect(&mesh, &err), &err);
        bench_mesh(&mesh);
    }
    shape_icosphere(5, &mesh);
    bench_mesh(&mesh);
    return 0;
}
