/* What a surface costs, from a sculpture in memory to a mesh in memory, on one processor and on two. With
 * FILE.oct arguments these are measured instead. */
#include "common/random.h"
#include "support/bench.h"
#include "surface/surface.h"

#include <math.h>
#include <string.h>
#include <sys/resource.h>

enum { BALLS = 20 };

static bool in_a_ball(const double centre[BALLS][3], int count, double x, double y, double z)
{
    for (int i = 0; i < count; i++)
        if (hypot(hypot(x - centre[i][0], y - centre[i][1]), z - centre[i][2]) < 0.14)
            return true;
    return false;
}

static void make_balls(struct octree *tree, unsigned depth, int count)
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
                if (in_a_ball(centre, count, (x + 0.5) / side, (y + 0.5) / side, (z + 0.5) / side))
                    bench_check(octree_set(tree, x, y, z, 1, &err), &err);
}

/* Marching cubes alone: relaxation has its own table. */
static struct surface_options plain(void)
{
    struct surface_options options = surface_defaults();
    options.relax = 0;
    return options;
}

struct figures {
    double seconds, cube_size, angle_deg;
    uint32_t triangles;
    struct surface_stats stats;
};

static double smallest_angle(struct mesh *mesh)
{
    struct error err = {0};
    struct surface_shape shape;
    bench_check(mesh_connect(mesh, &err), &err);
    bench_check(surface_measure(mesh, &shape, &err), &err);
    return shape.smallest_angle_deg;
}

/* Repeats until a tenth of a second is spent and takes the best. */
static struct figures best_of(const struct octree *tree, const struct surface_options *options, int turns)
{
    struct figures best = {.seconds = 1e300};
    double begun = bench_seconds();
    for (int turn = 0; turn < turns || bench_seconds() - begun < 0.1; turn++) {
        struct mesh mesh = {0};
        struct error err = {0};
        double start = bench_seconds();
        bench_check(surface_make(tree, options, &mesh, &best.stats, &err), &err);
        best.seconds = fmin(best.seconds, bench_seconds() - start);
        best.triangles = mesh.triangle_count;
        if (turn == 0)
            best.angle_deg = smallest_angle(&mesh);
        mesh_clear(&mesh);
    }
    return best;
}

static void measure(const char *name, const struct octree *tree, struct surface_options options)
{
    options.threads = 1;
    struct figures one = best_of(tree, &options, 5);
    options.threads = 2;
    struct figures two = best_of(tree, &options, 5);
    printf("%-22s %7zu %9.6f %9u %8.4f %7.3f %7.3f %7.2f %7.2f %7.2f %6.0f\n", name,
           octree_measure(tree).full_leaves, one.stats.cube_size, one.triangles, one.seconds,
           1e-6 * one.triangles / one.seconds, 1e-6 * two.triangles / two.seconds, one.seconds / two.seconds,
           (double)one.stats.evaluations / one.triangles, (double)one.stats.samples / one.triangles,
           (double)one.stats.bytes / one.triangles);
    fflush(stdout);
}

/* The cube size for about this many triangles. */
static double size_for(const struct octree *tree, double triangles)
{
    struct octree_info info = octree_measure(tree);
    return sqrt(2 * (double)info.exposed_faces / (double)((uint64_t)1 << 2 * tree->depth) / triangles);
}

static void measure_sizes(const char *name, const struct octree *tree)
{
    for (double wanted = 5e3; wanted < 1e6; wanted *= 10) {
        struct surface_options options = plain();
        options.cube_size = size_for(tree, wanted);
        measure(name, tree, options);
    }
}

static void measure_dials(const struct octree *tree)
{
    struct surface_options options = plain();
    const long fields[] = {1, 8, 64, 512};
    for (int i = 0; i < 4; i++) {
        char name[32];
        options.field.fields_per_cube = fields[i];
        snprintf(name, sizeof name, "balls, %ld a cube", fields[i]);
        measure(name, tree, options);
    }
    options = plain();
    options.field.fields_per_area = 1e5;
    measure("balls, and 1e5 an area", tree, options);
    options = plain();
    options.field.sigma = 2;
    measure("balls, sigma 2", tree, options);
    options = plain();
    options.seeds = SURFACE_RANDOM;
    measure("balls, random seeds", tree, options);
}

/* How time and memory grow with the surface: the exponent in 1 / cube size, by least
 * squares of the logarithms. */
static void measure_growth(const struct octree *tree)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    printf("\n%9s %9s %8s %7s %7s\n", "cube", "triangles", "seconds", "Mtri/s", "rss a t");
    for (double wanted = 1e4; wanted < 2e7; wanted *= pow(10, 0.5)) {
        struct surface_options options = plain();
        options.threads = 1;
        options.cube_size = size_for(tree, wanted);
        struct figures figures = best_of(tree, &options, wanted < 3e6 ? 3 : 1);
        struct rusage usage;
        getrusage(RUSAGE_SELF, &usage);
        printf("%9.6f %9u %8.4f %7.3f %7.0f\n", options.cube_size, figures.triangles, figures.seconds,
               1e-6 * figures.triangles / figures.seconds,
               1024.0 * (double)usage.ru_maxrss / figures.triangles);
        fflush(stdout);
        double log_size = -log(options.cube_size), log_seconds = log(figures.seconds);
        n++;
        x += log_size;
        y += log_seconds;
        xx += log_size * log_size;
        xy += log_size * log_seconds;
    }
    printf("seconds grow with 1 / cube size to the power %.2f\n", (n * xy - x * y) / (n * xx - x * x));
}

/* What relaxation adds: with it and without, on one processor and on two; in us a triangle, on one. */
static void measure_relaxation(const struct octree *tree, double most)
{
    printf("\n%9s %9s %9s %9s %9s %9s %9s %8s\n", "triangles", "plain", "on two", "relaxed", "on two",
           "us a t", "bytes a t", "degrees");
    for (double wanted = 6e3; wanted <= most; wanted *= 8) {
        struct figures figures[2][2];
        struct surface_options options = plain();
        options.field.sigma = 1;
        options.cube_size = size_for(tree, wanted);
        for (int relaxed = 0; relaxed < 2; relaxed++)
            for (unsigned threads = 1; threads <= 2; threads++) {
                options.relax = relaxed ? surface_defaults().relax : 0;
                options.threads = threads;
                figures[relaxed][threads - 1] = best_of(tree, &options, 2);
            }
        double added = figures[1][0].seconds - figures[0][0].seconds;
        printf("%9u %9.4f %9.4f %9.4f %9.4f %9.2f %9.0f %8.1f\n", figures[1][0].triangles,
               figures[0][0].seconds, figures[0][1].seconds, figures[1][0].seconds, figures[1][1].seconds,
               1e6 * added / figures[1][0].triangles,
               (double)figures[1][0].stats.bytes / figures[1][0].triangles, figures[1][0].angle_deg);
        fflush(stdout);
    }
}

static void measure_file(const char *path)
{
    struct octree tree = {0};
    struct error err = {0};
    bench_check(octree_load(path, &tree, &err), &err);
    measure_sizes(strrchr(path, '/') ? strrchr(path, '/') + 1 : path, &tree);
    measure_relaxation(&tree, 1e6);
    octree_clear(&tree);
}

int main(int argc, char **argv)
{
    struct octree tree = {0};
    struct error err = {0};
    printf("%-22s %7s %9s %9s %8s %7s %7s %7s %7s %7s %6s\n", "sculpture", "leaves", "cube", "triangles",
           "seconds", "Mtri/s", "on two", "times", "points", "grid", "bytes");
    printf("%82s %7s %7s %6s\n", "", "evals/t", "evals/t", "a t");
    for (int i = 1; i < argc; i++)
        measure_file(argv[i]);
    if (argc > 1)
        return 0;
    bench_check(octree_init(&tree, 0, 1, &err), &err);
    measure_sizes("a lone cube", &tree);
    octree_clear(&tree);
    make_balls(&tree, 4, 8);
    measure_sizes("8 balls, 16 cells", &tree);
    octree_clear(&tree);
    make_balls(&tree, 6, BALLS);
    measure_sizes("20 balls, 64 cells", &tree);
    measure_dials(&tree);
    octree_clear(&tree);
    make_balls(&tree, 4, 8);
    measure_growth(&tree);
    measure_relaxation(&tree, 4e6);
    octree_clear(&tree);
    return 0;
}
