#include "surface/relax.h"

#include "common/array.h"
#include "common/vec3.h"
#include "surface/probe.h"
#include "surface/relax_edges.h"
#include "surface/relax_settle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK = 2048, /* points that a worker takes at a time */
    CURES = 8     /* turns at what is left of narrow angles after the rounds */
};

/* Edges are kept between these lengths over the mean; the promise is 0.5 to 1.6. */
#define EDGE_LEAST 0.6
#define EDGE_MOST  1.45
#define EDGE_LONG  1.52 /* at the end, where edges were stretched as points settled */

/* Angles that turns at the end begin with: some degrees more than the 25 promised, since points still move. */
#define ANGLE_WANTED 29

/* A point does not go further in a round than this share of the mean edge, and is left alone where it would go less
 * than STILL of it. */
#define STEP_MOST 0.3
#define STILL     0.002

/* How far from where it is a point may settle at the end, in mean edges: never seen to matter but for cubes larger
 * than the sculpture's detail. */
#define REACH 4

struct relax {
    const struct relax_settings *settings;
    struct remesh r;
    struct probe *probe;  /* [workers] */
    double (*place)[3];   /* [point_room] where points go in this round */
    double (*normal)[3];  /* [point_room] */
    uint8_t *keep;        /* [point_room] the point stays where it was */
    uint8_t *turned;      /* [point_room] and was found to have to */
    size_t *turned_count; /* [workers] */
    uint32_t room;
    double *worst; /* [workers] residual */
    double mean;
};

static size_t block_count(const struct relax *x)
{
    return (x->r.point_count + BLOCK - 1) / BLOCK;
}

/* Calls what_to_do for each block of points. */
static void for_points(struct relax *x, void (*what_to_do)(void *, size_t, unsigned))
{
    threads_run(x->settings->pool, block_count(x), what_to_do, x);
}

static uint32_t block_end(const struct relax *x, size_t block)
{
    size_t end = (block + 1) * BLOCK;
    return end < x->r.point_count ? (uint32_t)end : x->r.point_count;
}

/* From a point to the mean of its triangles' centres, weighted by area, in its tangent plane. */
static void find_way(const struct remesh *r, uint32_t point, double way[3])
{
    const double *place = r->position[point], *normal = r->normal[point];
    double sum[3] = {0}, weight = 0, a[3], b[3], across[3];
    uint32_t corner = r->corner[point], start = corner;
    do {
        vec3_sub(r->position[side_point(r, side_next(side_next(corner)))], place, b);
        vec3_sub(r->position[side_point(r, side_next(corner))], place, a);
        vec3_cross(a, b, across);
        double area = vec3_length(across);
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += area * (a[axis] + b[axis]);
        weight += area;
        corner = corner_around(r, corner);
    } while (corner != start);
    weight = weight > 0 ? 1 / (3 * weight) : 0;
    double up = vec3_dot(sum, normal);
    for (int axis = 0; axis < 3; axis++)
        way[axis] = weight * (sum[axis] - up * normal[axis]);
}

/* One step of Newton's method along the gradient. False where there is none, or it is longer than `most`. */
static bool newton_step(struct relax *x, struct probe *probe, double place[3], double normal[3], double most)
{
    double point[3], gradient[3], side = x->settings->field->side;
    for (int axis = 0; axis < 3; axis++)
        point[axis] = place[axis] * side;
    double excess = probe_value(probe, point, gradient) - x->settings->threshold;
    double square = vec3_dot(gradient, gradient), length = sqrt(square);
    if (!(square > 0) || fabs(excess) > most * side * length)
        return false;
    for (int axis = 0; axis < 3; axis++) {
        place[axis] -= excess * gradient[axis] / square / side;
        normal[axis] = -gradient[axis] / length;
    }
    return true;
}

static void move_points(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    struct remesh *r = &x->r;
    for (uint32_t p = (uint32_t)(block * BLOCK); p < block_end(x, block); p++) {
        x->keep[p] = true;
        if (r->corner[p] == MESH_NONE)
            continue;
        double way[3];
        find_way(r, p, way);
        double length = vec3_length(way), share = fmin(1, STEP_MOST * x->mean / length);
        if (length < STILL * x->mean)
            continue;
        for (int axis = 0; axis < 3; axis++)
            x->place[p][axis] = r->position[p][axis] + share * way[axis];
        x->keep[p] = !newton_step(x, &x->probe[worker], x->place[p], x->normal[p], STEP_MOST * x->mean) ||
                     vec3_dot(x->normal[p], r->normal[p]) < 0.5;
    }
}

static const double *place_of(const struct relax *x, uint32_t p)
{
    return x->keep[p] ? x->r.position[p] : x->place[p];
}

static const double *normal_of(const struct relax *x, uint32_t p)
{
    return x->keep[p] ? x->r.normal[p] : x->normal[p];
}

static double facing(const double a[3], const double b[3], const double c[3], const double normal[3])
{
    double across[3];
    vec3_triangle(a, b, c, across);
    double length = vec3_length(across);
    return length > 0 ? vec3_dot(across, normal) / length : -1;
}

/* Whether a triangle round a point that moves would turn from its normal further than it was, or than about 70
 * degrees. */
static bool turns_over(const struct relax *x, uint32_t point)
{
    const struct remesh *r = &x->r;
    uint32_t corner = r->corner[point];
    do {
        uint32_t p = side_point(r, side_next(corner)), q = side_point(r, side_next(side_next(corner)));
        double now = facing(place_of(x, point), place_of(x, p), place_of(x, q), normal_of(x, point));
        if (now < 0.35 && now < facing(r->position[point], r->position[p], r->position[q], r->normal[point]))
            return true;
        corner = corner_around(r, corner);
    } while (corner != r->corner[point]);
    return false;
}

static void mark_turned(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    for (uint32_t p = (uint32_t)(block * BLOCK); p < block_end(x, block); p++) {
        x->turned[p] = !x->keep[p] && turns_over(x, p);
        x->turned_count[worker] += x->turned[p];
    }
}

static void keep_turned(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    (void)worker;
    for (uint32_t p = (uint32_t)(block * BLOCK); p < block_end(x, block); p++)
        x->keep[p] |= x->turned[p];
}

static void take_moved(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    (void)worker;
    for (uint32_t p = (uint32_t)(block * BLOCK); p < block_end(x, block); p++) {
        if (x->keep[p])
            continue;
        memcpy(x->r.position[p], x->place[p], sizeof x->place[p]);
        memcpy(x->r.normal[p], x->normal[p], sizeof x->normal[p]);
    }
}

static void settle_points(void *context, size_t block, unsigned worker)
{
    struct relax *x = context;
    for (uint32_t p = (uint32_t)(block * BLOCK); p < block_end(x, block); p++) {
        if (x->r.corner[p] == MESH_NONE)
            continue;
        double residual = relax_settle(&x->probe[worker], x->settings->threshold, REACH * x->mean,
                                       x->r.position[p], x->r.normal[p]);
        x->worst[worker] = fmax(x->worst[worker], residual);
    }
}

static void free_rooms(struct relax *x)
{
    free(x->place);
    free(x->normal);
    free(x->keep);
    free(x->turned);
    x->place = x->normal = NULL;
    x->keep = x->turned = NULL;
}

static bool make_room(struct relax *x)
{
    uint32_t room = x->r.point_room;
    if (room <= x->room)
        return true;
    free_rooms(x);
    x->place = array_new(room, sizeof *x->place);
    x->normal = array_new(room, sizeof *x->normal);
    x->keep = array_new(room, sizeof *x->keep);
    x->turned = array_new(room, sizeof *x->turned);
    x->room = x->place && x->normal && x->keep && x->turned ? room : 0;
    return x->room;
}

/* All points move, but for those whose triangles would turn over; these stay, which may turn others, and so on: at
 * most until all stay. */
static bool smooth(struct relax *x)
{
    unsigned workers = threads_workers(x->settings->pool);
    if (!make_room(x))
        return false;
    for_points(x, move_points);
    for (size_t turned = 1; turned;) {
        turned = 0;
        memset(x->turned_count, 0, workers * sizeof *x->turned_count);
        for_points(x, mark_turned);
        for (unsigned i = 0; i < workers; i++)
            turned += x->turned_count[i];
        if (turned)
            for_points(x, keep_turned);
    }
    for_points(x, take_moved);
    return true;
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

static void tell(const struct relax *x, unsigned round)
{
    if (x->settings->progress)
        x->settings->progress(x->settings->progress_context, (double)round / (x->settings->rounds + 2));
}

/* Edges change in the first two thirds of the rounds; then points settle. */
static bool run(struct relax *x)
{
    bool good = true;
    for (unsigned round = 0; round < x->settings->rounds && good; round++) {
        if (3 * round < 2 * x->settings->rounds)
            good = change_edges(x);
        good = good && smooth(x);
        tell(x, round + 1);
    }
    for (int turn = 0; turn <= CURES && good; turn++) {
        memset(x->worst, 0, threads_workers(x->settings->pool) * sizeof *x->worst);
        for_points(x, settle_points);
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
    unsigned workers = threads_workers(x->settings->pool);
    x->probe = calloc(workers, sizeof *x->probe);
    x->worst = calloc(workers, sizeof *x->worst);
    x->turned_count = calloc(workers, sizeof *x->turned_count);
    if (!x->probe || !x->worst || !x->turned_count)
        return error_no_memory(err, "relaxing the mesh");
    for (unsigned i = 0; i < workers; i++)
        if (probe_init(&x->probe[i], x->settings->field, err))
            return err->status;
    return STATUS_OK;
}

static void close_relax(struct relax *x)
{
    for (unsigned i = 0; x->probe && i < threads_workers(x->settings->pool); i++)
        probe_clear(&x->probe[i]);
    free(x->probe);
    free(x->worst);
    free(x->turned_count);
    free_rooms(x);
    remesh_clear(&x->r);
}

static bool collect(const struct relax *x, struct relax_stats *stats)
{
    bool good = true;
    for (unsigned i = 0; i < threads_workers(x->settings->pool); i++) {
        good = good && !x->probe[i].failed;
        stats->evaluations += x->probe[i].evaluations;
        stats->worst_residual = fmax(stats->worst_residual, x->worst[i]);
    }
    return good;
}

static size_t bytes_of(const struct relax *x)
{
    const struct remesh *r = &x->r;
    size_t point = sizeof *r->position + sizeof *r->normal + sizeof *r->degree + sizeof *r->corner;
    size_t moved = sizeof *x->place + sizeof *x->normal + sizeof *x->keep + sizeof *x->turned;
    return r->point_room * point + x->room * moved + (r->point_room - r->first_new) * sizeof *r->beside +
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
    free_rooms(&x);
    if (status == STATUS_OK)
        status = remesh_close(&x.r, mesh, err);
    close_relax(&x);
    if (status != STATUS_OK)
        mesh_clear(mesh);
    return status;
}
