/* The parts of a skin that can tear: what is new has a part of its own, the balloon's last. */
#include "sim/topology.h"

#include <stdlib.h>

/* Nothing as yet, but with room for all that can come in. */
bool parts_make_tail(struct sim *sim, struct sim_part *part)
{
    enum { FAN = 8 }; /* triangles that get a new point with each: half a fan, mostly */
    const struct sim_balloon *b = part->balloon;
    const uint64_t most = (uint64_t)FAN * (b->point_room - b->point_end) + 1;
    const uint32_t edges = b->edge_end - b->edge_begin, triangles = b->triangle_end - b->triangle_begin;
    part->point_begin = part->point_end = part->inner_begin = part->inner_end = b->point_end;
    part->edge_begin = part->edge_end = b->edge_end;
    part->triangle_begin = part->triangle_end = b->triangle_end;
    part->edge_in_room = most < edges ? (uint32_t)most : edges;
    part->triangle_in_room = most < triangles ? (uint32_t)most : triangles;
    part->edge_in = part->edge_in_own = sim_table(sim, part->edge_in_room, sizeof *part->edge_in);
    part->triangle_in = sim_table(sim, part->triangle_in_room, sizeof *part->triangle_in);
    part->chunks = calloc(1, sizeof *part->chunks);
    if (!part->edge_in || !part->triangle_in || !part->chunks)
        return false;
    part->chunk_count = 1;
    part->chunks[0] = (struct sim_chunk){.triangle_begin = b->triangle_end,
                                         .triangle_end = b->triangle_end,
                                         .triangle_inner_end = b->triangle_end};
    parts_extend(part, b->point_end, b->edge_end);
    return true;
}

void parts_extend(struct sim_part *tail, uint32_t point_end, uint32_t edge_end)
{
    struct sim_chunk *c = tail->chunks;
    tail->point_end = point_end;
    tail->edge_end = edge_end;
    c->point_begin = c->clear_begin = tail->point_begin;
    c->point_end = c->clear_end = point_end;
    c->edge_begin = c->edge_inner_end = tail->edge_begin;
    c->edge_end = edge_end;
}

static void take_edge(struct sim_part *part, uint32_t edge)
{
    *--part->edge_in = edge;
    part->edge_in_count++;
    part->edge_in_new++;
    part->chunks[0].clear_end = part->point_end; /* its points may be anywhere: all are cleared at once */
    for (uint32_t i = 1; i < part->chunk_count && part->chunks[i].clear_begin < part->point_end; i++)
        part->chunks[i].clear_begin = part->chunks[i].clear_end = part->point_end;
}

/* The part that works on one of the balloon's points. */
static struct sim_part *part_of(const struct sim_balloon *b, uint32_t point)
{
    struct sim_part *part = b->topology->tail;
    while (point < part->point_begin)
        part--;
    return part;
}

void parts_new_edge(struct sim *sim, const struct sim_balloon *balloon, uint32_t edge)
{
    struct sim_part *before = NULL;
    for (int k = 0; k < 2; k++) {
        struct sim_part *part = part_of(balloon, sim->edge_point[edge][k]);
        if (part != balloon->topology->tail && part != before)
            take_edge(part, edge);
        before = part;
    }
}

/* All new edges go again. */
static void forget(struct sim *sim, const struct sim_balloon *balloon)
{
    for (struct sim_part *part = sim->parts; part < sim->parts + sim->part_count; part++) {
        if (part->balloon != balloon)
            continue;
        part->edge_in += part->edge_in_new;
        part->edge_in_count -= part->edge_in_new;
        part->edge_in_new = 0;
    }
}

void parts_loosen_edge(struct sim *sim, const struct sim_balloon *balloon, uint32_t edge)
{
    for (struct sim_part *part = sim->parts; part < sim->parts + sim->part_count; part++)
        if (part->balloon == balloon && edge - part->edge_begin < part->edge_end - part->edge_begin) {
            struct sim_chunk *c = part->chunks;
            while (edge >= c->edge_end)
                c++;
            c->edge_inner_end = edge < c->edge_inner_end ? edge : c->edge_inner_end;
        }
}

void parts_loosen_triangle(struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle)
{
    for (struct sim_part *part = sim->parts; part < sim->parts + sim->part_count; part++)
        if (part->balloon == balloon &&
            triangle - part->triangle_begin < part->triangle_end - part->triangle_begin) {
            struct sim_chunk *c = part->chunks;
            while (triangle >= c->triangle_end)
                c++;
            c->triangle_inner_end = triangle < c->triangle_inner_end ? triangle : c->triangle_inner_end;
        }
}

/* What a part or a chunk begins or ends with: an old point, or the last part's first. */
static void shift(uint32_t *point, const struct sim_balloon *b, const uint32_t *place, uint32_t tail_begin)
{
    *point = *point == b->topology->tail->point_begin ? tail_begin : place[*point - b->point_begin];
}

void parts_renumber(struct sim *sim, const struct sim_balloon *balloon, const uint32_t *place,
                    uint32_t tail_begin)
{
    struct sim_part *tail = balloon->topology->tail;
    for (struct sim_part *part = sim->parts; part < tail; part++) {
        if (part->balloon != balloon)
            continue;
        uint32_t *ends[] = {&part->point_begin, &part->point_end, &part->inner_begin, &part->inner_end};
        for (int i = 0; i < 4; i++)
            shift(ends[i], balloon, place, tail_begin);
        for (struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
            uint32_t *of_chunk[] = {&c->point_begin, &c->point_end, &c->clear_begin, &c->clear_end};
            for (int i = 0; i < 4; i++)
                shift(of_chunk[i], balloon, place, tail_begin);
            c->edge_inner_end = c->edge_inner_most;
            c->triangle_inner_end = c->triangle_inner_most;
        }
    }
    tail->point_begin = tail->inner_begin = tail->inner_end = tail_begin;
    tail->edge_in_count = tail->triangle_in_count = 0;
    parts_extend(tail, balloon->point_end, balloon->edge_end);
    forget(sim, balloon);
    for (uint32_t e = balloon->topology->old_edges; e < balloon->edge_end; e++)
        parts_new_edge(sim, balloon, e);
}
