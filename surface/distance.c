/* How far a mesh is from the surface. */
#include "common/array.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "surface/census.h"
#include "surface/probe.h"

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 256, NEWTON_TURNS = 12 };

/* Sums of one block: added up in the blocks' order, so that they do not depend on the threads. */
struct sums {
    double residual, worst_residual, square, largest, weight;
};

struct comparison {
    struct field field;
    double threshold;
    const struct mesh *mesh;
    uint32_t stride; /* every so-manieth triangle */
    struct probe *probe;
    struct sums *sums; /* [blocks] */
};

/* From a place to where Newton's method along the gradient meets the surface. */
static double distance_from(const struct comparison *c, struct probe *probe, const double place[3],
                            double *residual)
{
    double side = c->field.side, point[3], start[3], gradient[3];
    for (int axis = 0; axis < 3; axis++)
        start[axis] = point[axis] = place[axis] * side;
    for (int turn = 0; turn < NEWTON_TURNS; turn++) {
        double excess = probe_value(probe, point, gradient) - c->threshold;
        double square = vec3_dot(gradient, gradient);
        if (turn == 0)
            *residual = fabs(excess);
        if (!(square > 0) || excess * excess <= 1e-24 * square)
            break;
        /* No further than a cell at once, where the field is flat. */
        double step = excess / square, most = 1 / sqrt(square);
        step = copysign(fmin(fabs(step), most), step);
        for (int axis = 0; axis < 3; axis++)
            point[axis] -= step * gradient[axis];
    }
    return vec3_distance(point, start) / side;
}

static void add_sums(struct sums *sums, double distance, double weight)
{
    sums->square += weight * distance * distance;
    sums->weight += weight;
    sums->largest = fmax(sums->largest, distance);
}

static void compare_points(void *context, size_t block, unsigned worker)
{
    struct comparison *c = context;
    struct sums sums = {0};
    for (uint32_t p = (uint32_t)(block * BLOCK); p < c->mesh->point_count && p < (block + 1) * BLOCK; p++) {
        double residual = 0;
        add_sums(&sums, distance_from(c, &c->probe[worker], c->mesh->position[p], &residual), 1);
        sums.residual += residual;
        sums.worst_residual = fmax(sums.worst_residual, residual);
    }
    c->sums[block] = sums;
}

static void compare_triangle(struct comparison *c, struct probe *probe, uint32_t t, struct sums *sums)
{
    /* In twelfths of the way to each corner, and their weights in sixtieths. */
    static const double rule[7][4] = {{12, 0, 0, 3}, {0, 12, 0, 3}, {0, 0, 12, 3}, {6, 6, 0, 8},
                                      {0, 6, 6, 8},  {6, 0, 6, 8},  {4, 4, 4, 27}};
    const double *corner[3];
    double across[3], residual;
    for (int k = 0; k < 3; k++)
        corner[k] = c->mesh->position[c->mesh->triangle[t][k]];
    vec3_triangle(corner[0], corner[1], corner[2], across);
    double area = vec3_length(across) / 2;
    for (int i = 0; i < 7; i++) {
        double place[3];
        for (int axis = 0; axis < 3; axis++)
            place[axis] = (rule[i][0] * corner[0][axis] + rule[i][1] * corner[1][axis] +
                           rule[i][2] * corner[2][axis]) /
                          12;
        add_sums(sums, distance_from(c, probe, place, &residual), area * rule[i][3] / 60);
    }
}

static void compare_triangles(void *context, size_t block, unsigned worker)
{
    struct comparison *c = context;
    struct sums sums = {0};
    for (size_t i = block * BLOCK; i < (block + 1) * BLOCK; i++)
        if (i * c->stride < c->mesh->triangle_count)
            compare_triangle(c, &c->probe[worker], (uint32_t)(i * c->stride), &sums);
    c->sums[block] = sums;
}

static struct sums total(const struct comparison *c, size_t blocks)
{
    struct sums all = {0};
    for (size_t i = 0; i < blocks; i++) {
        all.residual += c->sums[i].residual;
        all.worst_residual = fmax(all.worst_residual, c->sums[i].worst_residual);
        all.square += c->sums[i].square;
        all.weight += c->sums[i].weight;
        all.largest = fmax(all.largest, c->sums[i].largest);
    }
    return all;
}

static void run(struct comparison *c, struct threads *pool, struct surface_distance *distance)
{
    size_t blocks = (c->mesh->point_count + BLOCK - 1) / BLOCK;
    threads_run(pool, blocks, compare_points, c);
    struct sums sums = total(c, blocks);
    *distance = (struct surface_distance){.worst_residual = sums.worst_residual,
                                          .mean_residual = sums.residual / c->mesh->point_count,
                                          .point_rms = sqrt(sums.square / sums.weight),
                                          .point_largest = sums.largest};
    blocks = (c->mesh->triangle_count / c->stride) / BLOCK + 1;
    threads_run(pool, blocks, compare_triangles, c);
    sums = total(c, blocks);
    distance->rms = sqrt(sums.square / sums.weight);
    distance->largest = sums.largest;
}

enum status surface_compare(const struct octree *tree, const struct surface_options *options,
                            const struct mesh *mesh, struct surface_distance *distance, struct error *err)
{
    struct comparison c = {.threshold = options->threshold,
                           .mesh = mesh,
                           .stride = 1 + mesh->triangle_count / COMPARE_TRIANGLES};
    struct threads *pool = NULL;
    if (field_init(&c.field, tree, &options->field, err) || threads_open(&pool, options->threads, err))
        return err->status;
    unsigned workers = threads_workers(pool);
    c.probe = calloc(workers, sizeof *c.probe);
    c.sums = calloc(mesh->triangle_count / BLOCK + 2, sizeof *c.sums);
    enum status status = c.probe && c.sums ? STATUS_OK : error_no_memory(err, "the distances");
    for (unsigned i = 0; i < workers && status == STATUS_OK; i++)
        status = probe_init(&c.probe[i], &c.field, err);
    if (status == STATUS_OK)
        run(&c, pool, distance);
    for (unsigned i = 0; c.probe && i < workers; i++) {
        if (c.probe[i].failed)
            status = error_no_memory(err, "the distances");
        if (c.probe[i].field)
            probe_clear(&c.probe[i]);
    }
    threads_close(pool);
    free(c.probe);
    free(c.sums);
    return status;
}
