/* What a surface costs, from a sculpture in memory to a mesh in memory, on one core. With FILE.oct
 * arguments these are measured too. */
#include "common/random.h"
#include "support/bench.h"
#include "surface/surface.h"

#include <math.h>
#include <string.h>

enum { BALLS = 20 };

static bool in_a_ball(const double centre[BALLS][3], double x, double y, double z)
{
    for (int i = 0; i < BALLS; i++)
        if (hypot(hypot(x - centre[i][0], y - centre[i][1]), z - centre[i][2]) < 0.14)
            return true;
    return false;
}

static void make_balls(struct octree *tree, unsigned depth)
{
    struct error err = {0};
    double centre[BALLS][3];
    uint64_t seed = 7;
    int side = 1 << depth;
    for (int i = 0; i < 3 * BALLS; i++)
        centre[i / 3][i % 3] = 0.2 + 0.6 * random_unit(&seed);
    bench_check(octree_init(tree, depth, 0, &err), &err);
    for (int x = 0; x < side; x++)
        for (int y = 0; y < side; y++)
            for (int z = 0; z < side; z++)
                if (in_a_ball(centre, (x + 0.5) / side, (y + 0.5) / side, (z + 0.5) / side))
                    bench_check(octree_set(tree, x, y, z, 1, &err), &err);
}

/* Repeats until a tenth of a second is spent and takes the best. */
static void measure(const char *name, const struct octree *tree, const struct surface_options *options)
{
    double best = 1e300, begun = bench_seconds();
    uint32_t triangles = 0;
    struct surface_stats stats;
    for (int turn = 0; turn < 3 || bench_seconds() - begun < 0.1; turn++) {
        struct mesh mesh = {0};
        struct error err = {0};
        double start = bench_seconds();
        bench_check(surface_make(tree, options, &mesh, &stats, &err), &err);
        double seconds = bench_seconds() - start;
        best = seconds < best ? seconds : best;
        triangles = mesh.triangle_count;
        mesh_clear(&mesh);
    }
    printf("%-24s %10.6f %10u %9.4f %8.3f %8.2f %8.2f %8.0f\n", name, stats.cube_size, triangles, best,
           1e-6 * triangles / best, (double)stats.evaluations / triangles, (double)stats.samples / triangles,
           (double)stats.bytes / triangles);
    fflush(stdout);
}

static void measure_sizes(const char *name, const struct octree *tree)
{
    const double wanted[] = {5e3, 5e4, 5e5};
    struct octree_info info = octree_measure(tree);
    for (int i = 0; i < 3; i++) {
        struct surface_options options = surface_defaults();
        double area = (double)info.exposed_faces /
                      (info.cells ? (double)((uint64_t)1 << 2 * tree->depth) : 1);
        options.cube_size = sqrt(2 * area / wanted[i]);
        measure(name, tree, &options);
    }
}

static void measure_dials(const struct octree *tree)
{
    struct surface_options options = surface_defaults();
    const long fields[] = {1, 8, 64, 512};
    for (int i = 0; i < 4; i++) {
        char name[32];
        options.field.fields_per_cube = fields[i];
        snprintf(name, sizeof name, "balls, %ld a cube", fields[i]);
        measure(name, tree, &options);
    }
    options = surface_defaults();
    options.field.fields_per_area = 1e5;
    measure("balls, and 1e5 an area", tree, &options);
    options = surface_defaults();
    options.field.sigma = 2;
    measure("balls, sigma 2", tree, &options);
    options = surface_defaults();
    options.seeds = SURFACE_RANDOM;
    measure("balls, random seeds", tree, &options);
}

int main(int argc, char **argv)
{
    struct octree tree = {0};
    struct error err = {0};
    printf("%-24s %10s %10s %9s %8s %8s %8s %8s\n", "sculpture", "cube", "triangles", "seconds", "Mtri/s",
           "points", "grid", "bytes");
    printf("%63s %8s %8s %8s\n", "", "evals/t", "evals/t", "a t");
    bench_check(octree_init(&tree, 0, 1, &err), &err);
    measure_sizes("a lone cube", &tree);
    octree_clear(&tree);
    make_balls(&tree, 6);
    measure_sizes("20 balls, 64 cells", &tree);
    measure_dials(&tree);
    octree_clear(&tree);
    for (int i = 1; i < argc; i++) {
        bench_check(octree_load(argv[i], &tree, &err), &err);
        measure_sizes(strrchr(argv[i], '/') ? strrchr(argv[i], '/') + 1 : argv[i], &tree);
        octree_clear(&tree);
    }
    return 0;
}
