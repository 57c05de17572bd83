/* Who works on what: each balloon's points in as many parts as there are workers. */
#include "common/array.h"
#include "common/threads.h"
#include "sim/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t lowest(const uint32_t *point, int corners)
{
    uint32_t low = point[0];
    for (int k = 1; k < corners; k++)
        low = point[k] < low ? point[k] : low;
    return low;
}

/* Counting sort: items by their lowest points, and otherwise as they came. count has
 * a place for each point. */
static void order(const uint32_t *points, int corners, uint32_t items, uint32_t *count, uint32_t point_count,
                  uint32_t *place)
{
    memset(count, 0, point_count * sizeof *count);
    for (uint32_t i = 0; i < items; i++)
        count[lowest(&points[(size_t)i * (size_t)corners], corners)]++;
    for (uint32_t p = 0, sum = 0; p < point_count; p++) {
        const uint32_t here = count[p];
        count[p] = sum;
        sum += here;
    }
    for (uint32_t i = 0; i < items; i++)
        place[i] = count[lowest(&points[(size_t)i * (size_t)corners], corners)]++;
}

void parts_order(const struct mesh *mesh, uint32_t *edge_place, uint32_t *triangle_place, uint32_t *count)
{
    order(mesh->edge[0], 2, mesh->edge_count, count, mesh->point_count, edge_place);
    order(mesh->triangle[0], 3, mesh->triangle_count, count, mesh->point_count, triangle_place);
}

/* The first item from begin on whose lowest point is not below `point`: items are in that order. */
static uint32_t first_from(const uint32_t *points, int corners, uint32_t begin, uint32_t end, uint32_t point)
{
    while (begin < end) {
        const uint32_t middle = begin + (end - begin) / 2;
        if (lowest(&points[(size_t)middle * (size_t)corners], corners) < point)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

/* Lists the items from begin to end that have a corner among the part's points; NULL: counts them. */
static uint32_t list_incoming(const struct sim_part *part, const uint32_t *points, int corners,
                              uint32_t begin, uint32_t end, uint32_t *list)
{
    uint32_t count = 0;
    for (uint32_t i = begin; i < end; i++) {
        bool inside = false;
        for (int k = 0; k < corners; k++)
            inside |= points[(size_t)i * (size_t)corners + (size_t)k] - part->point_begin <
                      part->point_end - part->point_begin;
        if (inside && list)
            list[count] = i;
        count += inside;
    }
    return count;
}

static bool fill_part(struct sim *sim, struct sim_part *part)
{
    const struct sim_balloon *b = part->balloon;
    const uint32_t *edges = sim->edge_point[0], *triangles = sim->triangle_point[0];
    part->edge_begin = first_from(edges, 2, b->edge_begin, b->edge_end, part->point_begin);
    part->edge_end = first_from(edges, 2, b->edge_begin, b->edge_end, part->point_end);
    part->triangle_begin = first_from(triangles, 3, b->triangle_begin, b->triangle_end, part->point_begin);
    part->triangle_end = first_from(triangles, 3, b->triangle_begin, b->triangle_end, part->point_end);
    part->edge_in_count = list_incoming(part, edges, 2, b->edge_begin, part->edge_begin, NULL);
    part->triangle_in_count = list_incoming(part, triangles, 3, b->triangle_begin, part->triangle_begin,
                                            NULL);
    const uint32_t ahead = b->edge_room - b->edge_end; /* for new edges */
    part->edge_in_room = part->edge_in_count + ahead;
    part->triangle_in_room = part->triangle_in_count;
    part->edge_in_own = array_new((size_t)part->edge_in_room + 1, sizeof *part->edge_in);
    part->triangle_in = array_new(part->triangle_in_count + 1, sizeof *part->triangle_in);
    if (!part->edge_in_own || !part->triangle_in)
        return false;
    part->edge_in = part->edge_in_own + ahead;
    list_incoming(part, edges, 2, b->edge_begin, part->edge_begin, part->edge_in);
    list_incoming(part, triangles, 3, b->triangle_begin, part->triangle_begin, part->triangle_in);
    sim->bytes += ((size_t)part->edge_in_room + part->triangle_in_count) * sizeof(uint32_t);
    return true;
}

static bool has_room(const struct sim_balloon *b)
{
    return b->point_room > b->point_end;
}

/* Points of a chunk: with their neighbours they take about a tenth of a megabyte for each thousand. */
enum { CHUNK_POINTS = 2048 };

/* One more than the largest corner of the items, but no more than `most`; *inner_end becomes the first item
 * that has a corner from `most` on. */
static uint32_t touched_end(const uint32_t *points, int corners, uint32_t begin, uint32_t end, uint32_t most,
                            uint32_t *inner_end)
{
    uint32_t touched = 0;
    *inner_end = end;
    for (uint32_t i = end; i-- > begin;) {
        uint32_t largest = 0;
        for (int k = 0; k < corners; k++) {
            const uint32_t p = points[(size_t)i * (size_t)corners + (size_t)k];
            largest = p > largest ? p : largest;
        }
        if (largest >= most)
            *inner_end = i;
        touched = largest + 1 > touched ? largest + 1 : touched;
    }
    return touched < most ? touched : most;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* The points that come in from lower parts are cleared with the first chunk. */
static uint32_t coming_end(const struct sim *sim, const struct sim_part *part)
{
    uint32_t end = part->point_begin;
    for (uint32_t i = 0; i < part->edge_in_count; i++)
        end = larger(end, sim->edge_point[part->edge_in[i]][1] + 1);
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t p = sim->triangle_point[part->triangle_in[i]][k];
            if (p < part->point_end)
                end = larger(end, p + 1);
        }
    return end;
}

/* Where points begin that edges or triangles have which reach into higher parts. */
static uint32_t leaving_begin(const struct sim *sim, const struct sim_part *part)
{
    uint32_t begin = part->point_end;
    for (const struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
        if (c->edge_inner_end < c->edge_end && sim->edge_point[c->edge_inner_end][0] < begin)
            begin = sim->edge_point[c->edge_inner_end][0];
        if (c->triangle_inner_end < c->triangle_end &&
            lowest(sim->triangle_point[c->triangle_inner_end], 3) < begin)
            begin = lowest(sim->triangle_point[c->triangle_inner_end], 3);
    }
    return begin;
}

/* None where a cut may give any point a neighbour in another part. */
static void find_inner(const struct sim *sim, struct sim_part *part)
{
    const bool torn = has_room(part->balloon);
    part->inner_begin = torn ? part->point_begin : coming_end(sim, part);
    part->inner_end = torn ? part->point_begin : larger(part->inner_begin, leaving_begin(sim, part));
}

static void fill_chunk(const struct sim *sim, const struct sim_part *part, struct sim_chunk *c)
{
    const uint32_t *edges = sim->edge_point[0], *triangles = sim->triangle_point[0];
    c->edge_end = first_from(edges, 2, c->edge_begin, part->edge_end, c->point_end);
    c->triangle_end = first_from(triangles, 3, c->triangle_begin, part->triangle_end, c->point_end);
    const uint32_t by_edges = touched_end(edges, 2, c->edge_begin, c->edge_end, part->point_end,
                                          &c->edge_inner_end);
    const uint32_t by_triangles = touched_end(triangles, 3, c->triangle_begin, c->triangle_end,
                                              part->point_end, &c->triangle_inner_end);
    c->edge_inner_most = c->edge_inner_end;
    c->triangle_inner_most = c->triangle_inner_end;
    c->clear_end = larger(larger(c->clear_begin, c->point_end), larger(by_edges, by_triangles));
}

static bool make_chunks(struct sim *sim, struct sim_part *part)
{
    const uint32_t points = part->point_end - part->point_begin;
    part->chunk_count = (points + CHUNK_POINTS - 1) / CHUNK_POINTS;
    part->chunks = calloc(part->chunk_count + 1, sizeof *part->chunks);
    if (!part->chunks)
        return false;
    struct sim_chunk here = {.point_end = part->point_begin,
                             .clear_end = part->point_begin,
                             .edge_end = part->edge_begin,
                             .triangle_end = part->triangle_begin};
    for (uint32_t i = 0; i < part->chunk_count; i++) {
        const uint32_t left = part->point_end - here.point_end;
        here = (struct sim_chunk){.point_begin = here.point_end,
                                  .point_end = here.point_end + (left < CHUNK_POINTS ? left : CHUNK_POINTS),
                                  .clear_begin = here.clear_end,
                                  .edge_begin = here.edge_end,
                                  .triangle_begin = here.triangle_end};
        fill_chunk(sim, part, &here);
        if (i == 0)
            here.clear_end = larger(here.clear_end, coming_end(sim, part));
        part->chunks[i] = here;
    }
    find_inner(sim, part);
    sim->bytes += part->chunk_count * sizeof *part->chunks;
    return true;
}

/* A balloon's points in as many parts as there are workers. */
static bool make_parts(struct sim *sim, const struct sim_balloon *b, struct sim_part *parts, unsigned workers)
{
    bool good = true;
    const uint64_t begin = b->point_begin, count = b->point_end - begin;
    for (unsigned i = 0; i < workers && good; i++) {
        parts[i].point_begin = (uint32_t)(begin + count * i / workers);
        parts[i].point_end = (uint32_t)(begin + count * (i + 1) / workers);
        good = fill_part(sim, &parts[i]) && make_chunks(sim, &parts[i]);
    }
    return good;
}

enum status parts_open(struct sim *sim, struct error *err)
{
    const unsigned workers = threads_workers(sim->pool);
    const struct sim_balloon *end = sim->balloons + sim->balloon_count;
    sim->part_count = 0;
    sim->edge_room = -INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < end; b++)
        sim->part_count += workers + has_room(b);
    sim->parts = sim_table(sim, sim->part_count, sizeof *sim->parts);
    sim->edge_rooms = array_new(sim->part_count, sizeof *sim->edge_rooms);
    sim->seen = sim_table(sim, sim->part_count, sizeof *sim->seen);
    bool good = sim->parts && sim->edge_rooms && sim->seen;
    struct sim_part *part = sim->parts;
    for (struct sim_balloon *b = sim->balloons; b < end && good; b++) {
        for (unsigned i = 0; i < workers + has_room(b); i++)
            part[i].balloon = b;
        good = make_parts(sim, b, part, workers) && (!has_room(b) || parts_make_tail(sim, &part[workers]));
        part += workers + has_room(b);
    }
    return good ? STATUS_OK : error_no_memory(err, "the workers' parts");
}

void parts_close(struct sim *sim)
{
    for (size_t i = 0; sim->parts && i < sim->part_count; i++) {
        free(sim->parts[i].edge_in_own);
        free(sim->parts[i].triangle_in);
        free(sim->parts[i].chunks);
    }
    free(sim->parts);
    free(sim->edge_rooms);
    free(sim->seen);
    threads_close(sim->pool);
}

struct job {
    struct sim *sim;
    void (*function)(struct sim *sim, const struct sim_part *part, void *context);
    void *context;
};

static void work(void *context, unsigned worker, unsigned workers)
{
    const struct job *job = context;
    for (size_t i = worker; i < job->sim->part_count; i += workers)
        job->function(job->sim, &job->sim->parts[i], job->context);
}

void sim_each_part(struct sim *sim,
                   void (*function)(struct sim *sim, const struct sim_part *part, void *context),
                   void *context)
{
    threads_each(sim->pool, work, &(struct job){sim, function, context});
}
