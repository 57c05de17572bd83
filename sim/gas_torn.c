#include "sim/gas_torn.h"
#include "common/mesh.h"
#include "common/vec3.h"
#include "sim/gas.h"
#include "sim/measure.h"

#include <stdlib.h>
#include <string.h>

enum status gas_torn_open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    const uint32_t points = b->point_end - b->point_begin, edges = b->edge_end - b->edge_begin,
                   triangles = b->triangle_end - b->triangle_begin;
    struct gas_torn *torn = b->gas->torn = calloc(1, sizeof *torn);
    if (!torn)
        return error_no_memory(err, "the gas");
    torn->group = sim_table(sim, points, sizeof *torn->group);
    torn->number = sim_table(sim, points, sizeof *torn->number);
    torn->sides = sim_table(sim, edges, sizeof *torn->sides);
    torn->active = sim_table(sim, triangles, sizeof *torn->active);
    torn->rims.side = sim_table(sim, edges, sizeof *torn->rims.side);
    torn->rims.hole = sim_table(sim, edges, sizeof *torn->rims.hole);
    if (!torn->group || !torn->number || !torn->sides || !torn->active || !torn->rims.side ||
        !torn->rims.hole)
        return error_no_memory(err, "the gas");
    memset(torn->active, 1, triangles);
    b->rims = &torn->rims;
    return STATUS_OK;
}

void gas_torn_close(struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    if (!torn)
        return;
    free(torn->group);
    free(torn->number);
    free(torn->sides);
    free(torn->active);
    free(torn->rims.side);
    free(torn->rims.hole);
    free(torn);
    b->gas->torn = NULL;
    b->rims = NULL;
}

/* The one that stands for all that hang together with a point; ways get shorter as they are gone. */
static uint32_t find(uint32_t *group, uint32_t point)
{
    while (group[point] != point)
        point = group[point] = group[group[point]];
    return point;
}

/* The lower one stands for both. */
static void join(uint32_t *group, uint32_t a, uint32_t b)
{
    a = find(group, a);
    b = find(group, b);
    group[a > b ? a : b] = a > b ? b : a;
}

static void part_all(const struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    for (uint32_t p = 0; p < b->point_end - b->point_begin; p++)
        torn->group[p] = p;
}

/* FNV-1a over words (Fowler, Noll & Vo). */
static uint64_t mix(uint64_t hash, const unsigned char *flags, uint32_t count)
{
    const uint64_t prime = 0x100000001b3;
    for (; count >= 8; count -= 8, flags += 8) {
        uint64_t word;
        memcpy(&word, flags, sizeof word);
        hash = (hash ^ word) * prime;
    }
    while (count--)
        hash = (hash ^ *flags++) * prime;
    return hash;
}

/* Of the triangles that are active and what bounds the gas; never 0. */
static uint64_t fingerprint(const struct sim *sim, const struct sim_balloon *b)
{
    const uint64_t hash = mix(0xcbf29ce484222325, &sim->triangle_active[b->triangle_begin],
                              b->triangle_end - b->triangle_begin);
    return mix(hash, b->gas->held, b->point_end - b->point_begin) | 1;
}

static bool counts(const struct sim *sim, const struct sim_balloon *b, uint32_t triangle)
{
    return sim->triangle_active[triangle] && b->gas->held[sim->triangle_point[triangle][0] - b->point_begin];
}

static void count_sides(const struct sim *sim, const struct sim_balloon *b)
{
    unsigned char *sides = b->gas->torn->sides;
    memset(sides, 0, b->edge_end - b->edge_begin);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3 && counts(sim, b, t); k++)
            sides[sim->triangle_edge[t][k] - b->edge_begin]++;
}

/* The rims' sides, in the order of their triangles; points along them come to hang together. */
static void list_sides(const struct sim *sim, const struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    torn->rims.side_count = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3 && counts(sim, b, t); k++) {
            if (torn->sides[sim->triangle_edge[t][k] - b->edge_begin] != 1)
                continue;
            uint32_t *side = torn->rims.side[torn->rims.side_count++];
            side[0] = sim->triangle_point[t][k];
            side[1] = sim->triangle_point[t][(k + 1) % 3];
            join(torn->group, side[0] - b->point_begin, side[1] - b->point_begin);
        }
}

static void number_holes(const struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    memset(torn->number, 0xff, (b->point_end - b->point_begin) * sizeof *torn->number); /* MESH_NONE */
    torn->rims.hole_count = 0;
    for (uint32_t i = 0; i < torn->rims.side_count; i++) {
        uint32_t *number = &torn->number[find(torn->group, torn->rims.side[i][0] - b->point_begin)];
        if (*number == MESH_NONE)
            *number = torn->rims.hole_count++;
        torn->rims.hole[i] = *number;
    }
}

void gas_torn_follow(const struct sim *sim, const struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    if (!sim->broken && torn->of == 0)
        return; /* nothing was ever open */
    const uint64_t now = fingerprint(sim, b);
    if (torn->of == now)
        return;
    torn->of = now;
    memcpy(torn->active, &sim->triangle_active[b->triangle_begin], b->triangle_end - b->triangle_begin);
    part_all(b);
    count_sides(sim, b);
    list_sides(sim, b);
    number_holes(b);
}

bool gas_torn_is_behind(const struct sim *sim, const struct sim_balloon *b)
{
    return memcmp(b->gas->torn->active, &sim->triangle_active[b->triangle_begin],
                  b->triangle_end - b->triangle_begin) != 0;
}

double gas_torn_volume_before(const struct sim *sim, const struct sim_balloon *b)
{
    double origin[4], volume = 0;
    struct gas_holes holes;
    gas_origin(sim, b, origin);
    gas_measure_holes(sim, b->rims, &holes);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t];
        double twice[3], from[3];
        if (!b->gas->torn->active[t - b->triangle_begin] || !b->gas->held[p[0] - b->point_begin])
            continue;
        vec3_triangle(sim->position[p[0]], sim->position[p[1]], sim->position[p[2]], twice);
        vec3_sub(sim->position[p[0]], origin, from);
        volume += vec3_dot(twice, from) / 6;
    }
    return volume + gas_fan_volume(&holes, origin);
}

double gas_torn_missing(const struct sim *sim, const struct sim_balloon *b)
{
    double area = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        area += sim->triangle_active[t] ? 0 : sim_area(sim, t);
    return area;
}

/* How many triangles hang together with each point that stands for a piece. Returns the largest
 * one's; the first of equals. */
static uint32_t count_pieces(const struct sim *sim, const struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    uint32_t largest = 0;
    part_all(b);
    memset(torn->number, 0, (b->point_end - b->point_begin) * sizeof *torn->number);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 1; k < 3 && counts(sim, b, t); k++)
            join(torn->group, sim->triangle_point[t][0] - b->point_begin,
                 sim->triangle_point[t][k] - b->point_begin);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        if (counts(sim, b, t))
            torn->number[find(torn->group, sim->triangle_point[t][0] - b->point_begin)]++;
    for (uint32_t p = 0; p < b->point_end - b->point_begin; p++)
        if (torn->number[p] > torn->number[largest])
            largest = p;
    return largest;
}

void gas_torn_let_go(struct sim *sim, struct sim_balloon *b)
{
    struct gas_torn *torn = b->gas->torn;
    gas_torn_follow(sim, b);
    const uint32_t largest = count_pieces(sim, b);
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        const uint32_t group = find(torn->group, p - b->point_begin);
        if (group != largest && torn->number[group] > 0 && b->gas->held[p - b->point_begin])
            gas_let_go(sim, b, &p, 1);
    }
    gas_torn_follow(sim, b); /* what fell off has no rims of the gas's */
}
