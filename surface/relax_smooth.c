#include "surface/relax_smooth.h"

#include "common/array.h"
#include "common/vec3.h"
#include "surface/relax_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 2048 }; /* points that a worker takes at a time */

/* A point does not go further in a round than this share of the mean edge, and is left alone where it would
 * go less than STILL of it. */
#define STEP_MOST 0.3
#define STILL     0.002

/* After so much of an edge a point is brought back to the surface. An edge that turns by an angle a has come
 * off it by a/2 times the square of this. */
#define WAY_MOST 0.1f

/* The field's value is off by at most 3 erfc(CUTOFF / sqrt 2), 1.4e-3, which the last steps of
 * Newton's method make good. */
#define CUTOFF 3.5

/* No triangle turns from its points' normals further than this cosine, or than it was. */
#define FACING_LEAST 0.35

void smoothing_blocks(const struct remesh *r, struct threads *pool,
                      void (*what_to_do)(void *, size_t, unsigned), void *context)
{
    threads_run(pool, ((size_t)r->point_count + BLOCK - 1) / BLOCK, what_to_do, context);
}

struct point_range smoothing_range(const struct remesh *r, size_t block)
{
    size_t end = (block + 1) * BLOCK;
    return (struct point_range){(uint32_t)(block * BLOCK),
                                end < r->point_count ? (uint32_t)end : r->point_count};
}

/* From a point to the mean of its triangles' centres, weighted by area, in its tangent plane. */
static void find_way(const struct remesh *r, uint32_t point, double way[3])
{
    const double *place = r->position[point], *normal = r->normal[point];
    double sum[3] = {0}, weight = 0, first[3], last[3], across[3];
    uint32_t corner = r->corner[point], start = corner;
    vec3_sub(r->position[side_point(r, side_next(side_next(corner)))], place, last);
    do {
        vec3_sub(r->position[side_point(r, side_next(corner))], place, first);
        vec3_cross(first, last, across);
        double area = vec3_length(across);
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += area * (first[axis] + last[axis]);
        weight += area;
        memcpy(last, first, sizeof last); /* going round, a triangle's first side is the next one's last */
        corner = corner_around(r, corner);
    } while (corner != start);
    weight = weight > 0 ? 1 / (3 * weight) : 0;
    double up = vec3_dot(sum, normal);
    for (int axis = 0; axis < 3; axis++)
        way[axis] = weight * (sum[axis] - up * normal[axis]);
}

/* One step of Newton's method along the gradient. False where there is none, or it is longer than `most`. */
static bool newton_step(const struct smoothing *s, struct probe *probe, double place[3], double normal[3],
                        double most)
{
    double point[3], gradient[3], side = s->field.side;
    for (int axis = 0; axis < 3; axis++)
        point[axis] = place[axis] * side;
    double excess = probe_value(probe, point, gradient) - s->threshold;
    double square = vec3_dot(gradient, gradient), length = sqrt(square);
    if (!(square > 0) || fabs(excess) > most * side * length)
        return false;
    for (int axis = 0; axis < 3; axis++) {
        place[axis] -= excess * gradient[axis] / square / side;
        normal[axis] = -gradient[axis] / length;
    }
    return true;
}

/* Where a point goes; false where it stays. */
static bool move_point(struct smoothing *s, uint32_t p, struct probe *probe)
{
    const struct remesh *r = s->r;
    double way[3];
    find_way(r, p, way);
    double length = vec3_length(way), share = fmin(1, STEP_MOST * s->mean / length);
    if (!(length >= STILL * s->mean))
        return false;
    for (int axis = 0; axis < 3; axis++)
        s->place[p][axis] = r->position[p][axis] + share * way[axis];
    memcpy(s->normal[p], r->normal[p], sizeof s->normal[p]);
    s->way[p] += (float)(share * length / s->mean);
    if (s->way[p] < WAY_MOST)
        return true;
    s->way[p] = 0;
    return newton_step(s, probe, s->place[p], s->normal[p], STEP_MOST * s->mean) &&
           vec3_dot(s->normal[p], r->normal[p]) >= 0.5;
}

static void move_points(void *context, size_t block, unsigned worker)
{
    struct smoothing *s = context;
    const struct point_range range = smoothing_range(s->r, block);
    for (uint32_t p = range.begin; p < range.end; p++)
        s->keep[p] = s->r->corner[p] == MESH_NONE || !move_point(s, p, &s->probe[worker]);
}

static const double *place_of(const struct smoothing *s, uint32_t p)
{
    return s->keep[p] ? s->r->position[p] : s->place[p];
}

static double facing(const double a[3], const double b[3], const double c[3], const double normal[3])
{
    double across[3];
    vec3_triangle(a, b, c, across);
    double length = vec3_length(across);
    return length > 0 ? vec3_dot(across, normal) / length : -1;
}

/* Whether a triangle (point, p, q) turns from the moved point's normal further than it may. */
static bool triangle_turns(const struct smoothing *s, uint32_t point, uint32_t p, uint32_t q)
{
    const struct remesh *r = s->r;
    double now = facing(s->place[point], place_of(s, p), place_of(s, q), s->normal[point]);
    return now < FACING_LEAST &&
           now < facing(r->position[point], r->position[p], r->position[q], r->normal[point]);
}

/* Without a square root where nothing is wrong, which is nearly everywhere. */
static bool turns_over(const struct smoothing *s, uint32_t point)
{
    const struct remesh *r = s->r;
    const double *normal = s->normal[point], *place = s->place[point];
    double first[3], last[3], across[3];
    uint32_t corner = r->corner[point], start = corner, q = side_point(r, side_next(side_next(corner)));
    vec3_sub(place_of(s, q), place, last);
    do {
        uint32_t p = side_point(r, side_next(corner));
        vec3_sub(place_of(s, p), place, first);
        vec3_cross(first, last, across);
        double up = vec3_dot(across, normal);
        if (!(up > 0 && up * up >= 1.001 * FACING_LEAST * FACING_LEAST * vec3_dot(across, across)) &&
            triangle_turns(s, point, p, q))
            return true;
        memcpy(last, first, sizeof last);
        q = p;
        corner = corner_around(r, corner);
    } while (corner != start);
    return false;
}

static void mark_turned(void *context, size_t block, unsigned worker)
{
    struct smoothing *s = context;
    const struct point_range range = smoothing_range(s->r, block);
    for (uint32_t p = range.begin; p < range.end; p++) {
        s->turned[p] = !s->keep[p] && turns_over(s, p);
        s->turned_count[worker] += s->turned[p];
    }
}

static void keep_turned(void *context, size_t block, unsigned worker)
{
    struct smoothing *s = context;
    const struct point_range range = smoothing_range(s->r, block);
    (void)worker;
    for (uint32_t p = range.begin; p < range.end; p++)
        s->keep[p] |= s->turned[p];
}

static void take_moved(void *context, size_t block, unsigned worker)
{
    struct smoothing *s = context;
    const struct point_range range = smoothing_range(s->r, block);
    (void)worker;
    for (uint32_t p = range.begin; p < range.end; p++) {
        if (s->keep[p])
            continue;
        memcpy(s->r->position[p], s->place[p], sizeof s->place[p]);
        memcpy(s->r->normal[p], s->normal[p], sizeof s->normal[p]);
    }
}

static void free_rooms(struct smoothing *s)
{
    free(s->place);
    free(s->normal);
    free(s->keep);
    free(s->turned);
    s->place = s->normal = NULL;
    s->keep = s->turned = NULL;
}

static bool make_room(struct smoothing *s)
{
    uint32_t room = s->r->point_room;
    if (room > s->room) {
        free_rooms(s);
        float *way = realloc(s->way, room * sizeof *way);
        s->way = way ? way : s->way;
        s->place = array_new(room, sizeof *s->place);
        s->normal = array_new(room, sizeof *s->normal);
        s->keep = array_new(room, sizeof *s->keep);
        s->turned = array_new(room, sizeof *s->turned);
        s->room = way && s->place && s->normal && s->keep && s->turned ? room : 0;
    }
    for (; s->room && s->known < s->r->point_count; s->known++)
        s->way[s->known] = 0;
    return s->room;
}

bool smoothing_round(struct smoothing *s)
{
    const unsigned workers = threads_workers(s->pool);
    if (!make_room(s))
        return false;
    smoothing_blocks(s->r, s->pool, move_points, s);
    for (size_t turned = 1; turned;) {
        turned = 0;
        memset(s->turned_count, 0, workers * sizeof *s->turned_count);
        smoothing_blocks(s->r, s->pool, mark_turned, s);
        for (unsigned i = 0; i < workers; i++)
            turned += s->turned_count[i];
        if (turned)
            smoothing_blocks(s->r, s->pool, keep_turned, s);
    }
    smoothing_blocks(s->r, s->pool, take_moved, s);
    return true;
}

enum status smoothing_open(struct smoothing *s, struct remesh *r, const struct field *field, double threshold,
                           struct threads *pool, struct error *err)
{
    const unsigned workers = threads_workers(pool);
    *s = (struct smoothing){.r = r, .pool = pool, .threshold = threshold};
    field_cut_earlier(&s->field, field, CUTOFF);
    s->probe = calloc(workers, sizeof *s->probe);
    s->turned_count = calloc(workers, sizeof *s->turned_count);
    if (!s->probe || !s->turned_count)
        return error_no_memory(err, "relaxing the mesh");
    for (unsigned i = 0; i < workers; i++) {
        if (probe_init(&s->probe[i], &s->field, err))
            return err->status;
        probe_expect(&s->probe[i], edges_mean(r) * field->side);
    }
    return STATUS_OK;
}

size_t smoothing_bytes(const struct smoothing *s)
{
    return s->room *
           (sizeof *s->place + sizeof *s->normal + sizeof *s->way + sizeof *s->keep + sizeof *s->turned);
}

void smoothing_close(struct smoothing *s)
{
    for (unsigned i = 0; s->probe && i < threads_workers(s->pool); i++)
        probe_clear(&s->probe[i]);
    free(s->probe);
    free(s->turned_count);
    free(s->way);
    free_rooms(s);
    *s = (struct smoothing){0};
}
