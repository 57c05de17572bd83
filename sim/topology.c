#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/measure.h"
#include "sim/membrane.h"
#include "sim/reorder.h"

#include <stdlib.h>
#include <string.h>

/* A hexagonal mesh of n points on a sphere of radius R has edges of R sqrt(8
 * pi/(sqrt 3 n)) = 3.8 R/sqrt n. */
uint32_t topology_room(const struct scene_fracture *fracture, uint32_t points)
{
    if (!fracture->on || fracture->mode != SCENE_FRACTURE_TEAR)
        return 0;
    const double room = 64 + fracture->reserve * sqrt((double)points) / 3.8;
    return (uint32_t)fmin(room, 4.0 * points);
}

static uint32_t *neighbours(const struct sim_balloon *b, uint32_t triangle)
{
    return b->topology->neighbour[triangle - b->triangle_begin];
}

static int corner_of(const struct sim *sim, uint32_t triangle, uint32_t point)
{
    const uint32_t *p = sim->triangle_point[triangle];
    return p[0] == point ? 0 : p[1] == point ? 1 : 2;
}

/* The side of `triangle` that has the edge. */
static int side_of(const struct sim *sim, uint32_t triangle, uint32_t edge)
{
    const uint32_t *e = sim->triangle_edge[triangle];
    return e[0] == edge ? 0 : e[1] == edge ? 1 : 2;
}

/* Across the side before the point (towards the next triangle against the clock), or the one after it. */
static bool turn(const struct sim *sim, const struct sim_balloon *b, struct fan *fan, bool against_clock)
{
    const int side = against_clock ? (fan->corner + 2) % 3 : fan->corner;
    const uint32_t next = neighbours(b, fan->triangle)[side];
    if (next == MESH_NONE)
        return false;
    *fan = (struct fan){next, corner_of(sim, next, sim->triangle_point[fan->triangle][fan->corner])};
    return true;
}

bool topology_next(const struct sim *sim, const struct sim_balloon *b, struct fan *fan)
{
    return turn(sim, b, fan, true);
}

bool topology_first(const struct sim *sim, const struct sim_balloon *b, uint32_t point, struct fan *fan)
{
    const uint32_t start = b->topology->triangle_at[point - b->point_begin];
    *fan = (struct fan){start, corner_of(sim, start, point)};
    while (turn(sim, b, fan, false))
        if (fan->triangle == start)
            return true;
    return false;
}

static void connect(const struct sim *sim, const struct sim_balloon *b, uint32_t *one)
{
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t e = sim->triangle_edge[t][k], other = one[e - b->edge_begin];
            if (other == MESH_NONE) {
                one[e - b->edge_begin] = t;
                neighbours(b, t)[k] = MESH_NONE;
            } else {
                neighbours(b, t)[k] = other;
                neighbours(b, other)[side_of(sim, other, e)] = t;
            }
        }
}

static void measure_rest(const struct sim *sim, const struct sim_balloon *b)
{
    struct topology *top = b->topology;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        memcpy(top->rest[p - b->point_begin], sim->position[p], sizeof *top->rest);
    for (uint32_t p = 0; p < b->point_room - b->point_begin; p++) {
        top->name[p] = top->named[p] = p;
        top->family[p] = p < b->point_end - b->point_begin ? p : 0;
    }
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        top->area += top->rest_area[t - b->triangle_begin] = sim_area(sim, t);
        for (int k = 0; k < 3; k++)
            top->triangle_at[sim->triangle_point[t][k] - b->point_begin] = t;
    }
}

static struct sim_part *last_part(struct sim *sim, const struct sim_balloon *b)
{
    struct sim_part *part = sim->parts + sim->part_count;
    while (part[-1].balloon != b)
        part--;
    return part - 1;
}

enum status topology_open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    struct topology *top = b->topology = calloc(1, sizeof *top);
    if (!top)
        return error_no_memory(err, "how the skin hangs together");
    const size_t triangles = b->triangle_end - b->triangle_begin, points = b->point_room - b->point_begin,
                 edges = b->edge_room - b->edge_begin;
    top->old_points = b->point_end;
    top->old_edges = b->edge_end;
    top->rim_room = 2 * (b->edge_room - b->edge_end);
    top->neighbour = sim_table(sim, triangles, sizeof *top->neighbour);
    top->rest_area = sim_table(sim, triangles, sizeof *top->rest_area);
    top->rest = sim_table(sim, points, sizeof *top->rest);
    top->triangle_at = sim_table(sim, points, sizeof *top->triangle_at);
    top->late_edge = sim_table(sim, edges, sizeof *top->late_edge);
    top->late_triangle = sim_table(sim, triangles, sizeof *top->late_triangle);
    top->slow_from = sim_table(sim, triangles / TOPOLOGY_STRETCH + 1, sizeof *top->slow_from);
    top->rim = sim_table(sim, top->rim_room, sizeof *top->rim);
    top->name = sim_table(sim, points, sizeof *top->name);
    top->named = sim_table(sim, points, sizeof *top->named);
    top->family = sim_table(sim, points, sizeof *top->family);
    top->place = sim_table(sim, points, sizeof *top->place);
    top->spare_numbers = sim_table(sim, points, sizeof *top->spare_numbers);
    top->spare = sim_table(sim, points, sizeof *sim->position);
    uint32_t *one = malloc(edges * sizeof *one);
    const bool room = top->neighbour && top->rest_area && top->rest && top->triangle_at && top->late_edge &&
                      top->late_triangle && top->slow_from && top->rim && top->name && top->named &&
                      top->family && top->place && top->spare_numbers && top->spare && one;
    if (room) {
        memset(one, 0xff, edges * sizeof *one);
        connect(sim, b, one);
        measure_rest(sim, b);
        top->tail = last_part(sim, b);
        topology_nothing_slow(b);
    }
    free(one);
    return room ? STATUS_OK : error_no_memory(err, "how the skin hangs together");
}

void topology_close(struct sim_balloon *b)
{
    struct topology *top = b->topology;
    if (!top)
        return;
    void *arrays[] = {top->neighbour,     top->rest_area,     top->rest,      top->triangle_at,
                      top->late_edge,     top->late_triangle, top->slow_from, top->rim,
                      top->name,          top->named,         top->family,    top->place,
                      top->spare_numbers, top->spare};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    free(top);
    b->topology = NULL;
}

/* The last part adds up what acts on new points, whoever has the slot. New edges have theirs there. */
static void edge_is_late(struct sim *sim, struct sim_balloon *b, uint32_t edge)
{
    struct topology *top = b->topology;
    if (edge >= top->old_edges || top->late_edge[edge - b->edge_begin])
        return;
    top->late_edge[edge - b->edge_begin] = 1;
    top->tail->edge_in[top->tail->edge_in_count++] = edge;
    top->now.late_edges++;
    parts_loosen_edge(sim, b, edge);
}

void topology_slow(struct sim *sim, struct sim_balloon *b, uint32_t triangle)
{
    struct topology *top = b->topology;
    const uint32_t t = triangle - b->triangle_begin;
    uint32_t *from = &top->slow_from[t / TOPOLOGY_STRETCH];
    top->late_triangle[t] = 1;
    top->slow += t < *from ? *from - t : 0;
    *from = t < *from ? t : *from;
    parts_loosen_triangle(sim, b, triangle);
}

void topology_nothing_slow(const struct sim_balloon *b)
{
    struct topology *top = b->topology;
    const uint32_t triangles = b->triangle_end - b->triangle_begin;
    memset(top->late_edge, 0, b->edge_room - b->edge_begin);
    memset(top->late_triangle, 0, triangles);
    for (uint32_t i = 0; i <= triangles / TOPOLOGY_STRETCH; i++)
        top->slow_from[i] = triangles - i * TOPOLOGY_STRETCH < TOPOLOGY_STRETCH ? triangles
                                                                                : (i + 1) * TOPOLOGY_STRETCH;
    top->slow = 0;
}

static void triangle_is_late(struct sim *sim, struct sim_balloon *b, uint32_t triangle)
{
    struct topology *top = b->topology;
    if (top->late_triangle[triangle - b->triangle_begin])
        return;
    top->tail->triangle_in[top->tail->triangle_in_count++] = triangle;
    top->now.late_triangles++;
    topology_slow(sim, b, triangle);
}

/* What is remembered of the point is true of its copy. */
static uint32_t copy_point(struct sim *sim, struct sim_balloon *b, uint32_t point, double share)
{
    struct topology *top = b->topology;
    const uint32_t copy = b->point_end++;
    top->now.points++;
    top->family[copy - b->point_begin] = top->family[top->name[point - b->point_begin]];
    for (int i = 0; i < 4; i++) {
        sim->position[copy][i] = sim->position[point][i];
        sim->velocity[copy][i] = sim->velocity[point][i];
        if (sim->before)
            sim->before[copy][i] = sim->before[point][i];
        sim->force[copy][i] = 0;
        sim->normal[copy][i] = sim->normal[point][i];
        for (int s = 0; s < sim->integrator->vectors; s++)
            sim->scratch[s][copy][i] = sim->scratch[s][point][i];
    }
    memcpy(top->rest[copy - b->point_begin], top->rest[point - b->point_begin], sizeof *top->rest);
    sim->mass[copy] = sim->mass[point] * share;
    sim->mass[point] -= sim->mass[copy];
    effects_copied(sim, b, point, copy, share);
    parts_extend(top->tail, b->point_end, b->edge_end);
    return copy;
}

static void replace(uint32_t *numbers, int count, uint32_t old, uint32_t new)
{
    for (int i = 0; i < count; i++)
        if (numbers[i] == old)
            numbers[i] = new;
}

/* By which masses are shared: a membrane's are its triangles' thirds; points with springs have theirs
 * whatever the triangles, and a sliver's share would be so light that its springs and dampers ask for
 * the smallest of steps. */
static double fan_weight(const struct sim *sim, const struct sim_balloon *b, struct fan fan,
                         bool against_clock)
{
    double weight = 0;
    do
        weight += b->membrane ? b->topology->rest_area[fan.triangle - b->triangle_begin] : 1;
    while (turn(sim, b, &fan, against_clock));
    return weight;
}

/* The edges around a point of a rim. */
static void tell_guard(struct sim *sim, struct sim_balloon *b, uint32_t point, uint32_t like)
{
    uint32_t edges[FAN_MAX + 1], count = 0;
    struct fan fan;
    topology_first(sim, b, point, &fan);
    edges[count++] = sim->triangle_edge[fan.triangle][fan.corner];
    do {
        if (count > FAN_MAX) { /* a crack ends here: all is looked at anew */
            guard_bound_outdated(sim);
            return;
        }
        edges[count++] = sim->triangle_edge[fan.triangle][(fan.corner + 2) % 3];
    } while (topology_next(sim, b, &fan));
    guard_cut(sim, b, point, like, edges, count);
}

/* The triangles around the point from `fan` on get a point of their own. */
static void split(struct sim *sim, struct sim_balloon *b, struct fan fan, bool against_clock, struct fan rest)
{
    const uint32_t point = sim->triangle_point[fan.triangle][fan.corner];
    const double weight = fan_weight(sim, b, fan, against_clock),
                 other = fan_weight(sim, b, rest, !against_clock);
    const uint32_t copy = copy_point(sim, b, point, weight + other > 0 ? weight / (weight + other) : 0.5);
    b->topology->triangle_at[point - b->point_begin] = rest.triangle;
    b->topology->triangle_at[copy - b->point_begin] = fan.triangle;
    struct fan last;
    bool more;
    do {
        last = fan;
        more = turn(sim, b, &fan, against_clock);
        sim->triangle_point[last.triangle][last.corner] = copy;
        triangle_is_late(sim, b, last.triangle);
        for (int k = 0; k < 2; k++) {
            const uint32_t edge = sim->triangle_edge[last.triangle][(last.corner + 2 * k) % 3];
            replace(sim->edge_point[edge], 2, point, copy);
            edge_is_late(sim, b, edge);
        }
    } while (more);
    tell_guard(sim, b, copy, point);
    tell_guard(sim, b, point, point);
}

/* The neighbour's own edge: half the stiffness each. */
static uint32_t double_edge(struct sim *sim, struct sim_balloon *b, uint32_t edge)
{
    const uint32_t copy = b->edge_end++;
    b->topology->now.edges++;
    for (int k = 0; k < 2; k++)
        sim->edge_point[copy][k] = sim->edge_point[edge][k];
    sim->init_spring_const[edge] /= 2;
    sim->current_spring_const[edge] /= 2;
    sim->init_spring_const[copy] = sim->init_spring_const[edge];
    sim->current_spring_const[copy] = sim->current_spring_const[edge];
    if (b->membrane) {
        double *weight = b->membrane->edge_weight;
        weight[edge - b->edge_begin] /= 2;
        weight[copy - b->edge_begin] = weight[edge - b->edge_begin];
    }
    sim->rest_length[copy] = sim->rest_length[edge];
    sim->broken_length[copy] = sim->broken_length[edge];
    sim->edge_active[copy] = sim->edge_active[edge];
    if (sim->past.edge_active) /* a look back finds the places as they were, and the skin as it is cut */
        sim->past.edge_active[copy] = sim->past.edge_active[edge];
    parts_extend(b->topology->tail, b->point_end, b->edge_end);
    parts_new_edge(sim, b, copy);
    return copy;
}

/* Whether a list of what is late takes another cut: each comes in once, so that one for all does. */
static bool has_room(uint32_t room, uint32_t count, uint32_t all)
{
    enum { FANS = 2 * FAN_MAX }; /* more triangles than two ends have */
    return room >= all || room - count >= FANS;
}

bool topology_can_cut(struct sim *sim, struct sim_balloon *b)
{
    struct topology *top = b->topology;
    const struct sim_part *tail = top->tail;
    const bool room = b->point_room - b->point_end >= 2 && b->edge_room - b->edge_end >= 1 &&
                      has_room(tail->edge_in_room, tail->edge_in_count, top->old_edges - b->edge_begin) &&
                      has_room(tail->triangle_in_room, tail->triangle_in_count,
                               b->triangle_end - b->triangle_begin);
    if (!room && top->now.refused++ == 0)
        sim_tell(sim, b, "fracture",
                 "has used up its reserve: cracks stop; give fracture.reserve more radii");
    return room;
}

void topology_cut(struct sim *sim, struct sim_balloon *b, uint32_t triangle, int side)
{
    struct topology *top = b->topology;
    const uint32_t edge = sim->triangle_edge[triangle][side], other = neighbours(b, triangle)[side];
    const int other_side = side_of(sim, other, edge);
    if (sim->ledger.on)
        sim->ledger.account.fracture += effects_edge_energy(sim, edge);
    neighbours(b, triangle)[side] = neighbours(b, other)[other_side] = MESH_NONE;
    const uint32_t sides[2][2] = {{triangle, (uint32_t)side}, {other, (uint32_t)other_side}};
    memcpy(top->rim + top->now.rims, sides, sizeof sides);
    top->now.rims += 2;
    top->now.torn += sim->rest_length[edge];
    sim->triangle_edge[other][other_side] = double_edge(sim, b, edge);
    for (int end = 0; end < 2; end++) {
        /* at the side's first corner the rest of the triangle's fan lies against the
         * clock, at its second with it */
        const struct fan from = {triangle, (side + end) % 3};
        const uint32_t point = sim->triangle_point[triangle][from.corner];
        struct fan last = from;
        while (last.triangle != other && turn(sim, b, &last, end == 0))
            ;
        if (last.triangle != other)
            split(sim, b, (struct fan){other, corner_of(sim, other, point)}, end == 1, from);
        else
            tell_guard(sim, b, point, point); /* of the second edge's damper */
    }
    reorder_wake(sim, b);
    sim->changed = true;
    sim->broken++;
}
