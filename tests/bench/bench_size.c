/* What a large balloon takes of memory: a sphere is meshed, simulates 10 steps of the paper's settings, and a
 * frame of it is rendered, each by its program; its peak of memory in all and for each triangle.
 *
 *     bench_size BALLOON-SURFACE BALLOON-SIM SPHERE.OCT TRIANGLES...
 *
 * What does not grow with the mesh is in the least of the sizes: the last lines go on along the line
 * through the last two to 20 million triangles, which must fit in 24 GB. On a machine that has them, give
 * 20000000 as a size of its own. */
#include "support/bench_program.h"

enum { STAGES = 3, SIZES_MAX = 16 };

static const char *const stage_names[STAGES] = {"meshed", "10 steps", "10 steps, drawn"};

struct size {
    double triangles, bytes[STAGES];
};

/* The number of triangles that the header of a .ply promises. */
static double count_triangles(const char *path)
{
    char line[256];
    double count = 0;
    FILE *stream = fopen(path, "r");
    while (stream && count == 0 && fgets(line, sizeof line, stream))
        sscanf(line, "element face %lf", &count);
    if (stream)
        fclose(stream);
    return count;
}

static struct size measure(char **programs, char *wanted)
{
    struct size size = {0};
    char *const commands[STAGES][16] = {
        {programs[0], "-q", programs[2], "-o", "a.ply", "--triangles", wanted, NULL},
        {programs[1], "-q", "a.ply", "--set", "time.end=0.25", "--hash", NULL},
        {programs[1], "-q", "a.ply", "--set", "time.end=0.25", "--set", "view.rate=4", "--frames", "frames",
         NULL},
    };
    for (int i = 0; i < STAGES; i++) {
        const struct bench_run run = bench_run(".", commands[i]);
        size.bytes[i] = run.peak_bytes;
        size.triangles = count_triangles("a.ply");
        printf("%-18s%12.0f%12.1f%12.1f%12.0f\n", stage_names[i], size.triangles, run.seconds,
               size.bytes[i] / 1e6, size.bytes[i] / size.triangles);
        fflush(stdout);
    }
    return size;
}

/* Along the line through two sizes. */
static void extrapolate(const struct size *small, const struct size *large)
{
    const double wanted = 20e6;
    for (int i = 0; i < STAGES; i++) {
        const double each = (large->bytes[i] - small->bytes[i]) / (large->triangles - small->triangles);
        printf("%-18s%12.0f%12s%12.1f%12.0f  expected\n", stage_names[i], wanted, "",
               (large->bytes[i] + each * (wanted - large->triangles)) / 1e6, each);
    }
}

int main(int argc, char **argv)
{
    char folder[] = "/tmp/balloon-size-XXXXXX", *programs[3];
    struct size sizes[SIZES_MAX];
    const int count = argc - 4;
    if (count < 1 || count > SIZES_MAX)
        return 2;
    for (int i = 0; i < 3; i++)
        if (!(programs[i] = realpath(argv[1 + i], NULL)))
            return 2;
    if (!mkdtemp(folder) || chdir(folder))
        return 1;
    printf("%-18s%12s%12s%12s%12s\n", "", "triangles", "seconds", "peak MB", "bytes each");
    for (int i = 0; i < count; i++)
        sizes[i] = measure(programs, argv[4 + i]);
    if (count > 1)
        extrapolate(&sizes[count - 2], &sizes[count - 1]);
    for (int i = 0; i < 3; i++)
        free(programs[i]);
    bench_remove_folder(folder);
    return 0;
}
