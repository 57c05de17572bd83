/* Who works on what: each balloon's points in as many parts as there are workers. */
#include "common/array.h"
#include "common/threads.h"
#include "sim/sim.h"

#include <stdlib.h>
#include <string.h>

static uint32_t lowest(const uint32_t *point, int corners)
{
    uint32_t low = point[0];
    for (int k = 1; k < corners; k++)
        low = point[k] < low ? point[k] : low;
    return low;
}

/* Counting sort: items by their lowest points, and otherwise as they came. count has a place for each point. */
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
    part->edge_in = array_new(part->edge_in_count + 1, sizeof *part->edge_in);
    part->triangle_in = array_new(part->triangle_in_count + 1, sizeof *part->triangle_in);
    if (!part->edge_in || !part->triangle_in)
        return false;
    list_incoming(part, edges, 2, b->edge_begin, part->edge_begin, part->edge_in);
    list_incoming(part, triangles, 3, b->triangle_begin, part->triangle_begin, part->triangle_in);
    sim->bytes += (part->edge_in_count + part->triangle_in_count) * sizeof(uint32_t);
    return true;
}

enum status parts_open(struct sim *sim, struct error *err)
{
    const unsigned workers = threads_workers(sim->pool);
    sim->part_count = workers * sim->balloon_count;
    sim->parts = array_new(sim->part_count, sizeof *sim->parts);
    sim->overlong = array_new(sim->part_count, sizeof *sim->overlong);
    if (!sim->parts || !sim->overlong)
        return error_no_memory(err, "the workers' parts");
    for (size_t i = 0; i < sim->part_count; i++) {
        struct sim_part *part = &sim->parts[i];
        part->balloon = &sim->balloons[i / workers];
        const uint64_t begin = part->balloon->point_begin, count = part->balloon->point_end - begin;
        part->point_begin = (uint32_t)(begin + count * (i % workers) / workers);
        part->point_end = (uint32_t)(begin + count * (i % workers + 1) / workers);
        if (!fill_part(sim, part))
            return error_no_memory(err, "the workers' parts");
    }
    return STATUS_OK;
}

void parts_close(struct sim *sim)
{
    for (size_t i = 0; sim->parts && i < sim->part_count; i++) {
        free(sim->parts[i].edge_in);
        free(sim->parts[i].triangle_in);
    }
    free(sim->parts);
    free(sim->overlong);
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
