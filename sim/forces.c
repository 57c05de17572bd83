/*
 * Parts 1 to 4 of a step (paper 3.5): springs and dampers, normals, pressure. Compiled once for each set of
 * instructions (kernels.h): SIM_KERNELS is the name of the table at the end.
 *
 * A row is x, y, z and 0: GCC's vectors, so that arithmetic reads as on paper and runs four wide. What
 * is not a vector's, such as a length and its inverse, is worked out for four edges, triangles or
 * points at once (lanes.h).
 */
#include "sim/forces_edges.h"
#include "sim/forces_triangles.h"
#include "sim/kernels.h"

#include <string.h>

/* Part 1: "initialize acceleration and normal vectors to (0,0,0)". By memset, since that does not read the
 * lines of the cache which it writes: a tenth of the time of a large balloon's step. */
static void clear_points(struct sim *sim, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *normal = sim->rows.normal;
    const size_t size = (chunk->clear_end - chunk->clear_begin) * sizeof *force;
    memset(&force[chunk->clear_begin], 0, size);
    memset(&normal[chunk->clear_begin], 0, size);
}

/* Part 2. */
static void coming_forces(struct sim *sim, const struct sim_part *part)
{
    if (part->balloon->arm_count > 0)
        add_coming_edges(sim, part, EDGE_SPRINGS | EDGE_ARMS);
    else
        add_coming_edges(sim, part, EDGE_SPRINGS);
}

static void edge_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    if (part->balloon->arm_count > 0)
        add_edges(sim, part, chunk, EDGE_SPRINGS | EDGE_ARMS | EDGE_WATCH);
    else if (part->balloon->slip)
        add_edges(sim, part, chunk, EDGE_SPRINGS | EDGE_WATCH);
    else
        add_edges(sim, part, chunk, EDGE_SPRINGS);
}

/* What viscous springs add to their springs, for methods that move these by themselves. */
static void arm_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    if (chunk == part->chunks)
        add_coming_edges(sim, part, EDGE_ARMS);
    add_edges(sim, part, chunk, EDGE_ARMS);
}

static uint32_t slip_edges(struct sim *sim, const struct sim_part *part, edge_function *slip)
{
    const struct sim_balloon *b = part->balloon;
    const struct scene_plasticity *block = &b->scene->plasticity;
    const struct edges edges = edges_of(sim, part);
    uint32_t e = part->edge_begin, count = 0;
    for (; part->edge_end - e >= 4; e += 4)
        if (lanes_any(slipping(&edges, e, block->yield, block->hardening, &b->slip[e - b->edge_begin])))
            for (uint32_t i = 0; i < 4; i++)
                count += slip(sim, part->balloon, e + i);
    for (; e < part->edge_end; e++)
        count += slip(sim, part->balloon, e);
    return count;
}

/* Part 3. */
static void triangle_normals(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_triangles(sim, part, chunk, true);
}

/* Part 4: normalize the normals; pressure is a force along them. A point that lost its last triangle has no
 * normal, and nothing for the air to press on. */
static void pressure_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *normal = sim->rows.normal;
    const double pressure = part->balloon->now->pressure;
    const uint32_t end = chunk->point_end;
    uint32_t p = chunk->point_begin;
    for (; end - p >= 4; p += 4) {
        const lanes inverse_length = inverses(lengths_of(&normal[p]));
        for (uint32_t i = 0; i < 4; i++) {
            normal[p + i] *= inverse_length[i];
            force[p + i] += pressure * normal[p + i];
        }
    }
    for (; p < end; p++) {
        normal[p] *= inverse(length_of(normal[p]));
        force[p] += pressure * normal[p];
    }
}

static void triangle_areas(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_triangles(sim, part, chunk, false);
}

/* Where pressure acts on areas, in place of part 4. */
static void push_areas(struct sim *sim, const struct sim_part *part, double constant, const double *gradient)
{
    row *force = sim->rows.force;
    const row *twice_area = sim->rows.normal, *position = sim->rows.position;
    const row d = {gradient[0], gradient[1], gradient[2], 0};
    const double c = constant;
    const uint32_t end = part->point_end;
    for (uint32_t p = part->point_begin; p < end; p++)
        force[p] += (c + dot(d, position[p])) * (1 / 6.0) * twice_area[p];
}

static double sum_volume(const struct sim *sim, uint32_t begin, uint32_t end, const double *origin)
{
    const row *twice_area = sim->rows.normal, *position = sim->rows.position;
    const row o = {origin[0], origin[1], origin[2], 0};
    row sum = {0};
    for (uint32_t p = begin; p < end; p++)
        sum += (position[p] - o) * twice_area[p];
    return (double)(sum[0] + sum[1] + sum[2]);
}

static double room_of(const struct sim *sim, const struct sim_balloon *balloon, uint32_t e)
{
    const row *position = sim->rows.position;
    const uint32_t *p = sim->edge_point[e];
    if (!sim->edge_active[e])
        return INFINITY;
    return (1 - 1e-9) * sim_threshold(sim, balloon, e) - length_of(position[p[0]] - position[p[1]]);
}

/* Part 2: "check if the length of the edge is greater than the threshold value". */
static double edge_room(const struct sim *sim, const struct sim_part *part)
{
    const struct sim_balloon *b = part->balloon;
    const row *position = sim->rows.position;
    const lanes threshold = lanes_all((1 - 1e-9) * b->now->threshold_length);
    const uint32_t end = part->edge_end;
    lanes least = lanes_all(INFINITY);
    double room = INFINITY;
    uint32_t e = part->edge_begin;
    for (; end - e >= 4; e += 4) {
        if (!four_are_set(&sim->edge_active[e])) {
            for (uint32_t i = 0; i < 4; i++)
                room = fmin(room, room_of(sim, b, e + i));
            continue;
        }
        row l[4];
        for (uint32_t i = 0; i < 4; i++)
            l[i] = position[sim->edge_point[e + i][0]] - position[sim->edge_point[e + i][1]];
        const lanes most = b->own_thresholds ? threshold * lanes_at(&sim->rest_length[e]) : threshold;
        least = lanes_min(least, most - lengths_of(l));
    }
    for (; e < end; e++)
        room = fmin(room, room_of(sim, b, e));
    for (int i = 0; i < 4; i++)
        room = fmin(room, least[i]);
    return room;
}

/* Four points at a time: one after the other, each would wait for the one before it. */
static void box_ways(const struct sim *sim, uint32_t begin, uint32_t end, double box[2][4])
{
    enum { WIDE = 4 };
    const row *from = (const row *)sim->before, *to = sim->rows.position;
    lanes low[WIDE], high[WIDE];
    for (int i = 0; i < WIDE; i++)
        low[i] = high[i] = (lanes)from[begin];
    for (uint32_t p = begin; p < end; p += WIDE)
        for (uint32_t i = 0; i < WIDE; i++) {
            const uint32_t here = p + i < end ? p + i : end - 1;
            const lanes a = (lanes)from[here], b = (lanes)to[here];
            low[i] = lanes_min(lanes_min(a, b), low[i]);
            high[i] = lanes_max(lanes_max(a, b), high[i]);
        }
    const lanes lowest = lanes_min(lanes_min(low[0], low[1]), lanes_min(low[2], low[3])),
                highest = lanes_max(lanes_max(high[0], high[1]), lanes_max(high[2], high[3]));
    memcpy(box[0], &lowest, sizeof lowest);
    memcpy(box[1], &highest, sizeof highest);
}

extern const struct sim_kernels SIM_KERNELS;
const struct sim_kernels SIM_KERNELS = {clear_points,    coming_forces, edge_forces,    triangle_normals,
                                        pressure_forces, edge_room,     triangle_areas, push_areas,
                                        sum_volume,      arm_forces,    slip_edges,     box_ways};
