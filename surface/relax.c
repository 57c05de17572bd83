#include "surface/relax.h"

#include "surface/relax_edges.h"
#include "surface/relax_settle.h"
#include "surface/relax_smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CURES = 8 }; /* turns at what is left of narrow angles after the rounds */

/* Edges are kept between these lengths over the mean; the promise is 0.5 to 1.6. */
#define EDGE_LEAST 0.6
#define EDGE_MOST  1.45
#define EDGE_LONG  1.52 /* at the end, where edges were stretched as points settled */

/* Angles that turns at the end begin with: some degrees more than the 25 promised,
 * since points still move. */
#define ANGLE_WANTED 29

/* How far from where it is a point may settle at the end, in mean edges: never seen to matter but for cubes
 * larger than the sculpture's detail. */
#define REACH 4

/* A point is on the surface where |f - T| is not above this. */
#define ON_SURFACE 1e-9

struct relax {
    const struct relax_settings *settings;
    struct remesh r;
    struct smoothing smoothing;
    struct probe *probe; /* [workers] */
    double *worst;       /* [workers] residual */
    double mean;
    int turn; /* at the end */
};

/* Turns at the end take about as long as the rounds; how many it needs is not known before, so that each
 * goes half of the way that is left. */
static void tell(const struct relax *x, double rounds, double turns)
{
    const double most = fmax(1, x->settings->rounds), done = rounds / most + 1 - exp2(-turns);
    if (x->settings->progress)
        x->settings->progress(x->settings->progress_context, done / 2);
}

static void settle_points(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    const struct point_range range = smoothing_range(&x->r, block);
    for (uint32_t p = range.begin; p < range.end; p++) {
        if (x->r.corner[p] == MESH_NONE)
            continue;
        double residual = relax_settle(&x->probe[worker], x->settings->threshold, REACH * x->mean,
                                       x->r.position[p], x->r.normal[p]);
        x->worst[worker] = fmax(x->worst[worker], residual);
    }
    if (worker == 0)
        tell(x, x->settings->rounds, x->turn + (double)range.end / x->r.point_count);
}

/* Points that found no way to the surface, since the field around them is flat, merge into neighbours.
 * They are few where there are any, and the order counts: one thread. */
static void merge_strays(struct relax *x)
{
    const unsigned workers = threads_workers(x->settings->pool);
    double worst = 0;
    for (unsigned i = 0; i < workers; i++)
        worst = fmax(worst, x->worst[i]);
    if (worst <= ON_SURFACE)
        return;
    memset(x->worst, 0, workers * sizeof *x->worst);
    for (uint32_t p = 0; p < x->r.point_count; p++) {
        double residual = 0;
        do
            residual = x->r.corner[p] == MESH_NONE
                           ? 0
                           : relax_settle(&x->probe[0], x->settings->threshold, REACH * x->mean,
                                          x->r.position[p], x->r.normal[p]);
        while (residual > ON_SURFACE && edges_merge(&x->r, p));
        x->worst[0] = fmax(x->worst[0], residual);
    }
}

static bool smooth(struct relax *x)
{
    x->smoothing.mean = x->mean;
    return smoothing_round(&x->smoothing);
}

/* Brings the number of triangles to the one wanted: the shortest edges collapse, the longest are split. */
static bool steer(struct relax *x)
{
    struct remesh *r = &x->r;
    double wanted = x->settings->triangles;
    if (wanted <= 0)
        return true;
    double off = (r->triangles_alive - wanted) / 2;
    uint32_t count = (uint32_t)fabs(off);
    if (count == 0)
        return true;
    if (off > 0)
        edges_collapse(r, edges_quantile(r, x->mean, 2 * count, true), EDGE_MOST * x->mean, count);
    else
        return edges_split(r, edges_quantile(r, x->mean, count, false), count);
    return true;
}

static bool change_edges(struct relax *x)
{
    struct remesh *r = &x->r;
    x->mean = edges_mean(r);
    edges_collapse(r, EDGE_LEAST * x->mean, EDGE_MOST * x->mean, UINT32_MAX);
    if (!edges_split(r, EDGE_MOST * x->mean, UINT32_MAX) || !steer(x))
        return false;
    edges_flip(r, 1.1 * EDGE_MOST * x->mean);
    return true;
}

/* Edges change in the first two thirds of the rounds; then points settle. */
static bool run(struct relax *x)
{
    bool good = true;
    for (unsigned round = 0; round < x->settings->rounds && good; round++) {
        if (3 * round < 2 * x->settings->rounds)
            good = change_edges(x);
        good = good && smooth(x);
        tell(x, round + 1, 0);
    }
    for (int turn = 0; turn <= CURES && good; turn++) {
        x->turn = turn;
        memset(x->worst, 0, threads_workers(x->settings->pool) * sizeof *x->worst);
        smoothing_blocks(&x->r, x->settings->pool, settle_points, x);
        merge_strays(x);
        x->mean = edges_mean(&x->r);
        uint32_t points = x->r.point_count;
        size_t narrow = turn < CURES ? edges_cure(&x->r, x->mean, ANGLE_WANTED, &good) : 0;
        good = good && (turn == CURES || edges_split(&x->r, EDGE_LONG * x->mean, UINT32_MAX));
        if (narrow == 0 && x->r.point_count == points)
            break;
        good = good && smooth(x);
    }
    return good;
}

static enum status open(struct relax *x, struct error *err)
{
    const struct relax_settings *settings = x->settings;
    unsigned workers = threads_workers(settings->pool);
    x->probe = calloc(workers, sizeof *x->probe);
    x->worst = calloc(workers, sizeof *x->worst);
    if (!x->probe || !x->worst)
        return error_no_memory(err, "relaxing the mesh");
    double mean = edges_mean(&x->r);
    for (unsigned i = 0; i < workers; i++) {
        if (probe_init(&x->probe[i], settings->field, err))
            return err->status;
        probe_expect(&x->probe[i], mean * settings->field->side);
    }
    return smoothing_open(&x->smoothing, &x->r, settings->field, settings->threshold, settings->pool, err);
}

static void close_relax(struct relax *x)
{
    for (unsigned i = 0; x->probe && i < threads_workers(x->settings->pool); i++)
        probe_clear(&x->probe[i]);
    free(x->probe);
    free(x->worst);
    smoothing_close(&x->smoothing);
    remesh_clear(&x->r);
}

static bool collect(const struct relax *x, struct relax_stats *stats)
{
    bool good = true;
    for (unsigned i = 0; i < threads_workers(x->settings->pool); i++) {
        good = good && !x->probe[i].failed && !x->smoothing.probe[i].failed;
        stats->evaluations += x->probe[i].evaluations + x->smoothing.probe[i].evaluations;
        stats->worst_residual = fmax(stats->worst_residual, x->worst[i]);
    }
    return good;
}

static size_t bytes_of(const struct relax *x)
{
    const struct remesh *r = &x->r;
    size_t point = sizeof *r->position + sizeof *r->normal + sizeof *r->degree + sizeof *r->corner;
    return r->point_room * point + smoothing_bytes(&x->smoothing) +
           (r->point_room - r->first_new) * sizeof *r->beside +
           r->triangle_room * (sizeof *r->triangle + sizeof *r->across);
}

enum status relax_mesh(struct mesh *mesh, const struct relax_settings *settings, struct relax_stats *stats,
                       struct error *err)
{
    struct relax x = {.settings = settings};
    *stats = (struct relax_stats){0};
    enum status status = remesh_open(&x.r, mesh, err);
    if (status == STATUS_OK)
        status = open(&x, err);
    if (status == STATUS_OK && !(run(&x) && collect(&x, stats)))
        status = error_no_memory(err, "relaxing the mesh");
    stats->bytes = bytes_of(&x);
    smoothing_close(&x.smoothing);
    if (status == STATUS_OK)
        status = remesh_close(&x.r, mesh, err);
    close_relax(&x);
    if (status != STATUS_OK)
        mesh_clear(mesh);
    return status;
}
