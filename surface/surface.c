#include "surface/surface.h"

#include "surface/largest.h"
#include "surface/mesher.h"
#include "surface/relax.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

struct surface_options surface_defaults(void)
{
    return (struct surface_options){.field = {FIELDS_EXACT, 0, 0.35, 6}, .threshold = 0.5, .relax = 10};
}

/* What one sculpture's surface is made with. */
struct making {
    const struct octree *tree;
    const struct surface_options *options;
    struct octree_info info;
    struct field field;
    struct threads *pool;
    struct surface_stats *stats;
};

/* A surface of area A, of the sculpture's exposed faces, crosses A / h^2 edges of a grid of cubes h: each
 * face A / 3 of the edges across it, whatever way the true surface bends. Twice as many triangles. */
static double expected_points(const struct making *making, double cube)
{
    return (double)making->info.exposed_faces / (cube * cube);
}

/* Bytes at the peak for each point, two triangles with it: while the mesh is put together, its vertex and its
 * place in the mesh; while it is relaxed, where it is and where it goes. */
enum { POINT_BYTES = 240 };

static double usable_memory(void)
{
    double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? 0.8 * pages * page : 1e18;
}

static enum status check_memory(const struct making *making, double cube, struct error *err)
{
    double points = expected_points(making, cube), bytes = points * POINT_BYTES;
    /* Two triangles a point, whose numbers are of 32 bits, and some more after relaxation. */
    double numbers = 0.4 * MESH_NONE, memory = usable_memory() / POINT_BYTES;
    double most = making->options->force ? numbers : fmin(numbers, memory);
    if (points <= most)
        return STATUS_OK;
    if (making->options->cube_size <= 0 && making->options->triangles)
        return error_set(err, STATUS_RANGE, "%u triangles are too many: about %.2g GB of memory; %.0f work",
                         making->options->triangles, bytes / 1e9,
                         floor(1.6 * most)); /* some more are tried on the way */
    return error_set(err, STATUS_RANGE,
                     "a cube size of %g is too small: about %.2g triangles in %.2g GB of memory; %.2g works",
                     cube / making->field.side, 2 * points, bytes / 1e9,
                     1.05 * cube / making->field.side * sqrt(points / most)); /* and rounded */
}

static void add_stats(const struct mesher *m, struct surface_stats *stats)
{
    for (unsigned i = 0; i < threads_workers(m->pool); i++) {
        const struct worker *worker = m->worker[i];
        stats->samples += worker->samples;
        stats->evaluations += worker->evaluations + worker->probe.evaluations;
        stats->worst_residual = fmax(stats->worst_residual, worker->worst_residual);
    }
}

/* Progress of a part of the work as that of the whole: smoothing takes most of it. */
struct part {
    const struct surface_options *options;
    double from, to;
};

static const double found = 0.3;

static void tell_part(void *context, double done)
{
    const struct part *part = context;
    if (part->options->progress)
        part->options->progress(part->options->progress_context, part->from + (part->to - part->from) * done);
}

/* Finds the surface at a cube size given in cells; m is to be cleared when STATUS_OK. */
static enum status find(const struct making *making, double cube, bool count_only, struct mesher *m,
                        struct error *err)
{
    const struct surface_options *options = making->options;
    if (check_memory(making, cube, err) ||
        mesher_init(m, &making->field, options->threshold, cube, making->pool, err))
        return err->status;
    struct part part = {options, 0, options->relax ? found : 1};
    m->count_only = count_only;
    m->progress = count_only ? NULL : tell_part;
    m->progress_context = &part;
    making->stats->seeds_random = 0;
    if (options->seeds == SURFACE_RANDOM && !count_only) {
        seeds_random(m, options->seed);
        making->stats->seeds_random = m->follows;
    }
    seeds_descent(m);
    making->stats->seeds = m->follows;
    if (!mesher_failed(m))
        return STATUS_OK;
    mesher_clear(m);
    return error_no_memory(err, "the surface");
}

static enum status count_triangles(const struct making *making, double cube, size_t *count, struct error *err)
{
    struct mesher m;
    if (find(making, cube, true, &m, err))
        return err->status;
    *count = m.triangle_count;
    add_stats(&m, making->stats);
    mesher_clear(&m);
    return STATUS_OK;
}

static double default_cube(const struct making *making)
{
    return fmin(1.0 / 3, making->info.extent / 24.0);
}

/* The first of sigma / 2, / 4, ... with which the field reaches the threshold somewhere; 0: none does. */
static double sigma_that_reaches(const struct making *making)
{
    struct field_settings settings = making->options->field;
    double value = 0, point[3];
    while (value < making->options->threshold) {
        struct field field;
        settings.sigma /= 2;
        if (field_init(&field, making->tree, &settings, NULL) ||
            field_largest(&field, making->options->threshold, &value, point, NULL))
            return 0;
    }
    return settings.sigma;
}

/* STATUS_INPUT when no point of the field reaches the threshold. */
static enum status check_reached(const struct making *making, struct error *err)
{
    double value, point[3], threshold = making->options->threshold, side = making->field.side;
    if (field_largest(&making->field, threshold, &value, point, err))
        return err->status;
    if (value >= threshold)
        return STATUS_OK;
    char works[64] = "";
    const double sigma = sigma_that_reaches(making);
    if (sigma > 0)
        snprintf(works, sizeof works, " (a sigma of %.3g cells works)", sigma);
    return error_set(
        err, STATUS_INPUT,
        "no point reaches the threshold %g: the largest value of the field found is %.4g, at (%.4g, %.4g, "
        "%.4g); lower the threshold or sigma%s, or use more fields",
        threshold, value, point[0] / side, point[1] / side, point[2] / side, works);
}

/* Chooses the cube size for a number of triangles. Their number falls like 1/h^2, though in steps: each
 * turn corrects by that law, halving instead where that would leave the sizes known to give too many and
 * too few. */
static enum status choose_cube(const struct making *making, double *cube, struct error *err)
{
    double wanted = making->options->triangles, low = 0, high = INFINITY, best = INFINITY;
    double near = making->options->relax ? 0.08 : 0.02; /* relaxation brings the number to the one wanted */
    double size = sqrt(2 * expected_points(making, 1) / wanted);
    *cube = size;
    for (int turn = 0; turn < 24 && best > near; turn++) {
        size_t count = 0;
        if (count_triangles(making, size, &count, err))
            return err->status;
        if (count == 0 && check_reached(making, err))
            return err->status;
        double off = fabs((double)count / wanted - 1);
        if (off < best) {
            best = off;
            *cube = size;
        }
        *((double)count > wanted ? &low : &high) = size;
        double next = size * sqrt((double)count / wanted);
        if (!(next > low && next < high))
            next = low > 0 && isfinite(high) ? sqrt(low * high) : low > 0 ? 1.5 * low : high / 1.5;
        size = next;
    }
    return STATUS_OK;
}

/* Cubes smaller than this share of sigma are not tried, but some are in any case. */
#define SMALLEST_SHARE 0.01

/* Says why there is no surface. What is said to work was tried as it is written. */
static enum status explain_nothing(const struct making *making, double cube, struct error *err)
{
    if (check_reached(making, err))
        return err->status;
    const double side = making->field.side;
    double works = fmin(cube, 2 * (side + making->field.reach)) / side;
    const double least = fmin(SMALLEST_SHARE * making->field.sigma / side, works / 4);
    size_t count = 0;
    enum status status = STATUS_OK;
    while (count == 0 && !status && works > least) {
        char written[32];
        snprintf(written, sizeof written, "%.4g", works / 1.25);
        const double smaller = strtod(written, NULL);
        struct error why;
        status = count_triangles(making, smaller * side, &count, &why);
        works = status ? works : smaller;
    }
    if (status == STATUS_NO_MEMORY)
        return error_no_memory(err, "the surface");
    if (count == 0)
        return error_set(err, STATUS_RANGE,
                         "a cube size of %g is too large: no corner of a cube falls inside the surface, nor "
                         "of any smaller one that was tried, down to %.4g; lower the threshold",
                         cube / side, works);
    return error_set(
        err, STATUS_RANGE,
        "a cube size of %g is too large: no corner of a cube falls inside the surface; %.4g works",
        cube / side, works);
}

static enum status relax(const struct making *making, struct mesh *mesh, struct error *err)
{
    const struct surface_options *o = making->options;
    struct part part = {o, found, 1};
    const struct relax_settings settings = {.field = &making->field,
                                            .threshold = o->threshold,
                                            .rounds = o->relax,
                                            .triangles = o->triangles,
                                            .pool = making->pool,
                                            .progress = tell_part,
                                            .progress_context = &part};
    struct relax_stats stats;
    enum status status = relax_mesh(mesh, &settings, &stats, err);
    making->stats->evaluations += stats.evaluations;
    making->stats->worst_residual = stats.worst_residual;
    if (stats.bytes > making->stats->bytes)
        making->stats->bytes = stats.bytes;
    return status;
}

static enum status make_at(const struct making *making, double cube, struct mesh *mesh, struct error *err)
{
    struct mesher m;
    if (find(making, cube, false, &m, err))
        return err->status;
    enum status status = m.vertex_count ? mesher_assemble(&m, mesh, err) : explain_nothing(making, cube, err);
    add_stats(&m, making->stats);
    making->stats->bytes = m.bytes;
    mesher_clear(&m);
    return status == STATUS_OK && making->options->relax ? relax(making, mesh, err) : status;
}

static enum status check_options(const struct surface_options *o, struct error *err)
{
    if (!(o->threshold > 0 && isfinite(o->threshold)))
        return error_set(err, STATUS_RANGE, "a threshold of %g: must be above 0", o->threshold);
    if (!(o->cube_size >= 0 && o->cube_size <= 1e6))
        return error_set(err, STATUS_RANGE, "a cube size of %g: must be above 0 and at most 1e6",
                         o->cube_size);
    return STATUS_OK;
}

enum status surface_make(const struct octree *tree, const struct surface_options *options, struct mesh *mesh,
                         struct surface_stats *stats, struct error *err)
{
    *stats = (struct surface_stats){0};
    struct making making = {.tree = tree, .options = options, .stats = stats};
    if (check_options(options, err) || field_init(&making.field, tree, &options->field, err))
        return err->status;
    making.info = octree_measure(tree);
    if (making.info.full_leaves == 0)
        return error_set(err, STATUS_INPUT, "the sculpture is empty: there is no surface around nothing");
    if (threads_open(&making.pool, options->threads, err))
        return err->status;
    /* With a wide sigma that is soon known, and looking for the surface first could take for ever. */
    enum { WIDE = 4 }; /* in cells */
    enum status status = options->field.sigma >= WIDE ? check_reached(&making, err) : STATUS_OK;
    double cube = options->cube_size > 0 ? options->cube_size * making.field.side : default_cube(&making);
    if (!status && options->cube_size <= 0 && options->triangles)
        status = choose_cube(&making, &cube, err);
    stats->cube_size = cube / making.field.side;
    if (status == STATUS_OK)
        status = make_at(&making, cube, mesh, err);
    threads_close(making.pool);
    return status;
}
