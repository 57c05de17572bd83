/* How fast chips, undo, smoothing and rays are, and what bounds each. */
#include "common/random.h"
#include "sculpt/bricks.h"
#include "sculpt/history.h"
#include "sculpt/sculpt.h"
#include "support/bench.h"

#include <math.h>

/* One line of the table. */
static void report(const char *what, const char *unit, double rate, double target, const char *bound)
{
    printf("%-40s %12.4g %-10s %9.4g   %s\n", what, rate, unit, target, bound);
    fflush(stdout);
}

static void make(struct octree *tree, unsigned depth, unsigned material)
{
    struct error err = {0};
    bench_check(octree_init(tree, depth, material, &err), &err);
}

/* Balls with centres on a ball's surface of radius 0.35 round the middle, as a hand
 * moves over a sculpture. */
static struct chip brush(enum chip_kind kind, double radius, uint64_t *seed)
{
    struct chip chip = {.kind = kind, .shape = CHIP_SPHERE};
    double direction[3], length = 0;
    while (!(length > 0.1 && length <= 1)) {
        length = 0;
        for (int k = 0; k < 3; k++) {
            direction[k] = 2 * random_unit(seed) - 1;
            length += direction[k] * direction[k];
        }
    }
    for (int k = 0; k < 3; k++)
        chip.value[k] = 0.5 + 0.35 * direction[k] / sqrt(length);
    chip.value[3] = radius;
    return chip;
}

/* Chips and fills in turn, so that there is always something to change. */
static double chip_seconds(struct octree *tree, double radius, int count, struct history *history)
{
    uint64_t seed = 1;
    struct error err = {0};
    double start = bench_seconds();
    for (int i = 0; i < count; i++) {
        struct chip chip = brush(CHIP_CARVE, radius, &seed);
        chip.material = (unsigned)i % 2;
        if (history)
            history_begin(history, tree);
        bench_check(sculpt_chip(tree, &chip, &err), &err);
        if (history)
            history_end(history, tree, NULL);
    }
    return (bench_seconds() - start) / count;
}

static void bench_chips(unsigned depth, double cells, int count, double target, const char *bound)
{
    struct octree tree = {0};
    struct history history;
    char what[64];
    const double radius = ldexp(cells, -(int)depth);
    make(&tree, depth, 1);
    double plain = chip_seconds(&tree, radius, count, NULL);
    snprintf(what, sizeof what, "chips, %d a side, radius %g", 1 << depth, cells);
    report(what, "a second", 1 / plain, target, bound);
    octree_clear(&tree);

    make(&tree, depth, 1);
    history_init(&history, SIZE_MAX);
    double recorded = chip_seconds(&tree, radius, count, &history);
    snprintf(what, sizeof what, "the same, recorded for undo");
    report(what, "a second", 1 / recorded, target, "the chip; the bytes it keeps, which go to memory");
    size_t steps = history.count;
    double start = bench_seconds();
    while (history_undo(&history, &tree, NULL))
        continue;
    double undo = (bench_seconds() - start) / (double)steps;
    report("undo of these", "a second", 1 / undo, 1 / plain, "memory: a word read and written a change");
    start = bench_seconds();
    while (history_redo(&history, &tree, NULL))
        continue;
    report("redo of these", "a second", (double)steps / (bench_seconds() - start), 1 / plain,
           "the same, forwards");
    report("bytes kept a step", "bytes", (double)history.bytes / (double)steps, 0,
           "8 a node that was written");
    report("bytes a leaf", "bytes", (double)octree_measure(&tree).bytes / (double)octree_leaf_count(&tree),
           10, "32 a block of 8 nodes, and room to grow");
    history_clear(&history);
    octree_clear(&tree);
}

static void bench_tool(enum chip_kind kind, unsigned depth, double cells, int count)
{
    uint64_t seed = 3;
    struct octree tree = {0};
    struct error err = {0};
    char what[64];
    make(&tree, depth, 0);
    const struct chip ball = {.shape = CHIP_SPHERE, .material = 1, .value = {0.5, 0.5, 0.5, 0.35}};
    bench_check(sculpt_chip(&tree, &ball, &err), &err);
    double start = bench_seconds();
    for (int i = 0; i < count; i++) {
        const struct chip chip = brush(kind, ldexp(cells, -(int)depth), &seed);
        bench_check(sculpt_chip(&tree, &chip, &err), &err);
    }
    snprintf(what, sizeof what, "%s, %d a side, radius %g", chip_kind_names[kind].name, 1 << depth, cells);
    report(what, "a second", count / (bench_seconds() - start), 60, "rows of the tiles around the ball");
    octree_clear(&tree);
}

/* Rays from one place row by row, as a picture or a pointer has them, or from all around towards somewhere
 * in the cube, at random. */
static void ray_at(int i, bool random, uint64_t *seed, double origin[3], double direction[3])
{
    const struct chip from = random ? brush(CHIP_CARVE, 1, seed) : (struct chip){.value = {0.6, 0.7, 0.85}};
    const double column = i % 1000 / 1000.0, row = i / 1000 % 1000 / 1000.0;
    const double towards[3] = {random ? random_unit(seed) : column, random ? random_unit(seed) : row,
                               random ? random_unit(seed) : 0.5};
    for (int k = 0; k < 3; k++) {
        origin[k] = 0.5 + 5 * (from.value[k] - 0.5);
        direction[k] = 0.2 + 0.6 * towards[k] - origin[k];
    }
}

static void bench_rays(unsigned depth, bool random, int count, double target)
{
    uint64_t seed = 2;
    struct octree tree = {0};
    struct error err = {0};
    char what[64];
    make(&tree, depth, 0);
    const struct chip ball = {.shape = CHIP_SPHERE, .material = 1, .value = {0.5, 0.5, 0.5, 0.35}};
    bench_check(sculpt_chip(&tree, &ball, &err), &err);
    chip_seconds(&tree, ldexp(8, -(int)depth), 3000, NULL);
    struct ray {
        double origin[3], direction[3];
    } *rays = malloc((size_t)count * sizeof *rays);
    for (int i = 0; rays && i < count; i++)
        ray_at(i, random, &seed, rays[i].origin, rays[i].direction);
    int hits = 0;
    double start = bench_seconds();
    for (int i = 0; rays && i < count; i++) {
        struct octree_hit hit;
        hits += octree_ray(&tree, rays[i].origin, rays[i].direction, &hit);
    }
    snprintf(what, sizeof what, "rays%s, %d a side, %.0f %% hit", random ? " at random" : " of a picture",
             1 << depth, 100.0 * hits / count);
    report(what, "a second", count / (bench_seconds() - start), target,
           random ? "blocks that are not in the cache, branches"
                  : "empty leaves on the way, some 40 ns each");
    free(rays);
    octree_clear(&tree);
}

/* After a chip: the faces of the bricks that it changed, as a window would hand them to the graphics card. */
static void bench_faces(unsigned depth, double cells, int count)
{
    struct error err = {0};
    struct octree tree = {0};
    struct history history;
    struct octree_regions regions;
    struct brick_faces faces = {0};
    uint64_t seed = 9;
    double spent = 0, worst = 0;
    make(&tree, depth, 1);
    history_init(&history, 64 << 20);
    for (int i = 0; i < count; i++) {
        const struct chip chip = brush(CHIP_CARVE, cells / (1 << depth), &seed);
        history_begin(&history, &tree);
        bench_check(sculpt_chip(&tree, &chip, &err), &err);
        history_end(&history, &tree, &regions);
        const double began = bench_seconds();
        for (int k = 0; k < regions.count; k++) {
            int first[3], last[3], at[3];
            bricks_of_region(&tree, &regions.items[k], first, last);
            for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
                for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
                    for (at[0] = first[0]; at[0] <= last[0]; at[0]++)
                        bench_check(brick_find_faces(&tree, at, &faces, &err), &err);
        }
        const double took = bench_seconds() - began;
        spent += took;
        worst = took > worst ? took : worst;
    }
    printf(
        "%u^3, radius %g: faces ready after a chip in %.2f ms (worst %.2f ms), target 5 ms; bound by the cells of the "
        "bricks it meets\n",
        1u << depth, cells, 1e3 * spent / count, 1e3 * worst);
    free(faces.items);
    history_clear(&history);
    octree_clear(&tree);
}

int main(void)
{
    printf("%-40s %12s %-10s %9s   %s\n", "sculpt", "", "", "target", "bound by");
    bench_chips(8, 8, 100000, 100000, "cells on the ball's surface: 8 to a call of its shape");
    bench_chips(10, 32, 3000, 5000, "the same, with misses of the cache");
    bench_tool(CHIP_SANDPAPER, 8, 8, 2000);
    bench_tool(CHIP_SANDPAPER, 10, 32, 400);
    bench_tool(CHIP_HEAT, 8, 8, 2000);
    bench_tool(CHIP_HEAT, 10, 32, 400);
    bench_rays(8, false, 1000000, 1.5e6);
    bench_rays(8, true, 1000000, 1.5e6);
    bench_rays(10, false, 1000000, 0);
    bench_faces(8, 8, 500);
    bench_faces(10, 32, 200);
    return 0;
}
