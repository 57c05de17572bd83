/*
 * The rounds of a relaxation in which points move: for relax.c.
 *
 *     struct smoothing s;
 *     if (smoothing_open(&s, &r, field, threshold, pool, err)) ...
 *     s.mean = edges_mean(&r);
 *     if (smoothing_round(&s)) ...                 as often as wanted; the mesh may change in between
 *     smoothing_close(&s);
 *
 * A round moves each point within its tangent plane. That leaves the surface by the square of the way
 * only, so a point is brought back to it, by a step of Newton's method, once its moves since the last time
 * add up to a share of an edge. Until points settle at the end a field that is cut off early is near
 * enough, and costs less.
 */
#ifndef SURFACE_RELAX_SMOOTH_H
#define SURFACE_RELAX_SMOOTH_H

#include "common/threads.h"
#include "surface/probe.h"
#include "surface/remesh.h"

struct smoothing {
    struct remesh *r;     /* borrowed */
    struct threads *pool; /* borrowed */
    struct field field;   /* the one given, cut off early */
    struct probe *probe;  /* [workers] */
    double threshold;
    double mean;          /* length of edges; set before each round */
    double (*place)[3];   /* [room] where points go in this round */
    double (*normal)[3];  /* [room] */
    float *way;           /* [room] gone since the last step of Newton's method, in mean edges */
    uint8_t *keep;        /* [room] the point stays where it was */
    uint8_t *turned;      /* [room] and was found to have to */
    size_t *turned_count; /* [workers] */
    uint32_t room, known; /* points from `known` on have not moved yet */
};

/* Errors: STATUS_NO_MEMORY; *s is to be closed all the same. */
enum status smoothing_open(struct smoothing *s, struct remesh *r, const struct field *field, double threshold,
                           struct threads *pool, struct error *err);

/* All points move, but for those whose triangles would turn over; these stay, which may turn others, and so
 * on: at most until all stay. False when memory ran out. */
bool smoothing_round(struct smoothing *s);

/* Bytes of the points' arrays. */
size_t smoothing_bytes(const struct smoothing *s);
void smoothing_close(struct smoothing *s);

/* Calls what_to_do for each block of points, by all workers. */
void smoothing_blocks(const struct remesh *r, struct threads *pool,
                      void (*what_to_do)(void *context, size_t block, unsigned worker), void *context);

/* The points of a block. */
struct point_range {
    uint32_t begin, end;
};

struct point_range smoothing_range(const struct remesh *r, size_t block);

#endif
