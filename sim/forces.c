/*
 * Parts 1 to 4 of a step (paper 3.5): springs and dampers, normals, pressure. Compiled once for each precision and set of
 * instructions (kernels.h): SIM_REAL is the type of number, SIM_KERNELS the name of the table at the end.
 *
 * A row is x, y, z and 0: GCC's vectors, so that arithmetic reads as on paper and runs four wide.
 */
#include "sim/kernels.h"

#include <math.h>

typedef SIM_REAL real;
typedef real row __attribute__((vector_size(4 * sizeof(real)), may_alias));

static inline real dot(row a, row b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Four wide where rows fit registers; GCC 12 takes a row that does not apart at each shuffle. */
static inline row cross(row a, row b)
{
#ifdef SIM_WIDE
    const row a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3),
              b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const row zxy = a * b_yzx - a_yzx * b;
    return __builtin_shufflevector(zxy, zxy, 1, 2, 0, 3);
#else
    return (row){a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
#endif
}

static inline real length_of(row a)
{
    return sizeof(real) == sizeof(float) ? (real)sqrtf((float)dot(a, a)) : (real)sqrt((double)dot(a, a));
}

/* What has no length has no direction either. */
static inline real inverse(real length)
{
    return length > 0 ? 1 / length : 0;
}

/* Part 1: "initialize acceleration and normal vectors to (0,0,0)". */
static void clear_points(struct sim *sim, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *normal = sim->rows.normal;
    for (uint32_t p = chunk->clear_begin; p < chunk->clear_end; p++)
        force[p] = normal[p] = (row){0};
}

/* The tables that a loop reads, as local variables: for all that the compiler knows, a row that is written might be one of
 * the addresses in struct sim, which it would then read again for each edge. */
struct edges {
    const row *position, *velocity;
    const uint32_t (*point)[2];
    const double *spring_const, *rest_length;
    const unsigned char *active;
    real damping;
};

static inline struct edges edges_of(const struct sim *sim, const struct sim_part *part)
{
    return (struct edges){sim->rows.position,
                          sim->rows.velocity,
                          (const uint32_t(*)[2])sim->edge_point,
                          sim->current_spring_const,
                          sim->rest_length,
                          sim->edge_active,
                          (real)part->balloon->now->damping};
}

/* Part 2: springs and dampers. With l = a - b and its length |l|,
 *     f_a = -[k_s (|l| - r) + k_d (v . l)/|l|] l/|l|,   f_b = -f_a      Witkin, SIGGRAPH '95 course notes 34
 * The paper prints |v| under the damper's l: a misprint, since that would be 0/0 in a balloon at rest. An edge of no
 * length has no direction and pulls at nothing. Returns f_b. */
static inline row edge_force(const struct edges *edges, uint32_t e)
{
    const uint32_t a = edges->point[e][0], b = edges->point[e][1];
    const row l = edges->position[a] - edges->position[b], v = edges->velocity[a] - edges->velocity[b];
    const real length = length_of(l);
    const real spring = (real)edges->spring_const[e] * (length - (real)edges->rest_length[e]);
    const real damper = edges->damping * dot(v, l) * inverse(length);
    return (spring + damper) * inverse(length) * l;
}

/* Adds it to those of the two points that are the part's. */
static inline void add_to_own_ends(const struct sim_part *part, row *force, const uint32_t *p, row f)
{
    if (p[0] - part->point_begin < part->point_end - part->point_begin)
        force[p[0]] -= f;
    if (p[1] - part->point_begin < part->point_end - part->point_begin)
        force[p[1]] += f;
}

static void coming_forces(struct sim *sim, const struct sim_part *part)
{
    const struct edges edges = edges_of(sim, part);
    row *force = sim->rows.force;
    for (uint32_t i = 0; i < part->edge_in_count; i++) {
        const uint32_t e = part->edge_in[i];
        if (edges.active[e])
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e));
    }
}

static void edge_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    const struct edges edges = edges_of(sim, part);
    const uint32_t inner_end = chunk->edge_inner_end, end = chunk->edge_end;
    row *force = sim->rows.force;
    for (uint32_t e = chunk->edge_begin; e < inner_end; e++)
        if (edges.active[e]) {
            const row f = edge_force(&edges, e);
            force[edges.point[e][0]] -= f;
            force[edges.point[e][1]] += f;
        }
    for (uint32_t e = inner_end; e < end; e++)
        if (edges.active[e])
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e));
}

/* Part 3: the unit normal of a triangle, which each active one adds to its three points'. A triangle without area has none
 * to add. Where pressure acts on areas (areas.h): twice its area along that normal. */
static inline row triangle_normal(const row *position, const uint32_t *p, bool unit)
{
    const row twice_area = cross(position[p[1]] - position[p[0]], position[p[2]] - position[p[0]]);
    if (unit)
        return twice_area * inverse(length_of(twice_area));
    return twice_area;
}

/* Adds it to those of the three points that are the part's. */
static inline void add_to_own(const struct sim_part *part, row *normal, const uint32_t *p, row n)
{
    for (int k = 0; k < 3; k++)
        if (p[k] - part->point_begin < part->point_end - part->point_begin)
            normal[p[k]] += n;
}

static inline void add_coming(struct sim *sim, const struct sim_part *part, bool unit)
{
    const row *position = sim->rows.position;
    for (uint32_t i = 0; i < part->triangle_in_count; i++) {
        const uint32_t *p = sim->triangle_point[part->triangle_in[i]];
        if (sim->triangle_active[part->triangle_in[i]])
            add_to_own(part, sim->rows.normal, p, triangle_normal(position, p, unit));
    }
}

static inline void add_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                                 bool unit)
{
    const row *position = sim->rows.position;
    row *normal = sim->rows.normal;
    const uint32_t(*point)[3] = (const uint32_t(*)[3])sim->triangle_point;
    const unsigned char *active = sim->triangle_active;
    const uint32_t inner_end = chunk->triangle_inner_end, end = chunk->triangle_end;
    for (uint32_t t = chunk->triangle_begin; t < inner_end; t++)
        if (active[t]) {
            const row n = triangle_normal(position, point[t], unit);
            normal[point[t][0]] += n;
            normal[point[t][1]] += n;
            normal[point[t][2]] += n;
        }
    for (uint32_t t = inner_end; t < end; t++)
        if (active[t])
            add_to_own(part, normal, point[t], triangle_normal(position, point[t], unit));
}

static void coming_normals(struct sim *sim, const struct sim_part *part)
{
    add_coming(sim, part, true);
}

static void triangle_normals(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_triangles(sim, part, chunk, true);
}

static void coming_areas(struct sim *sim, const struct sim_part *part)
{
    add_coming(sim, part, false);
}

static void triangle_areas(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_triangles(sim, part, chunk, false);
}

/* Part 4: normalize the normals; pressure is a force along them. A point that lost its last triangle has no normal, and
 * nothing for the air to press on. */
static void pressure_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *normal = sim->rows.normal;
    const real pressure = (real)part->balloon->now->pressure;
    const uint32_t end = chunk->point_end;
    for (uint32_t p = chunk->point_begin; p < end; p++) {
        normal[p] *= inverse(length_of(normal[p]));
        force[p] += pressure * normal[p];
    }
}

/* Where pressure acts on areas, in place of part 4. */
static void push_areas(struct sim *sim, const struct sim_part *part, double constant, const double *gradient)
{
    row *force = sim->rows.force;
    const row *twice_area = sim->rows.normal, *position = sim->rows.position;
    const row d = {(real)gradient[0], (real)gradient[1], (real)gradient[2], 0};
    const real c = (real)constant;
    const uint32_t end = part->point_end;
    for (uint32_t p = part->point_begin; p < end; p++)
        force[p] += (c + dot(d, position[p])) * (1 / (real)6) * twice_area[p];
}

/* The air's resistance (effect_drag.c): factor (w . N) |w . N| N/|N|^2, N twice the area vector, w the wind less the mean speed. */
static inline row drag_force(const struct sim *sim, const uint32_t *p, real factor, row wind)
{
    const row *position = sim->rows.position, *velocity = sim->rows.velocity;
    const row n = triangle_normal(position, p, false);
    const row w = wind - (velocity[p[0]] + velocity[p[1]] + velocity[p[2]]) * (1 / (real)3);
    const real across = dot(w, n), squared = dot(n, n);
    return factor * across * (across < 0 ? -across : across) * inverse(squared) * n;
}

static void drag_triangles(struct sim *sim, const struct sim_part *part, double factor, const double *wind)
{
    row *force = sim->rows.force;
    const row w = {(real)wind[0], (real)wind[1], (real)wind[2], 0};
    const real f = (real)factor;
    for (uint32_t i = 0; i < part->triangle_in_count; i++) {
        const uint32_t t = part->triangle_in[i];
        if (sim->triangle_active[t])
            add_to_own(part, force, sim->triangle_point[t], drag_force(sim, sim->triangle_point[t], f, w));
    }
    for (const struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
        const uint32_t(*point)[3] = (const uint32_t(*)[3])sim->triangle_point;
        const unsigned char *active = sim->triangle_active;
        for (uint32_t t = c->triangle_begin; t < c->triangle_inner_end; t++)
            if (active[t]) {
                const row push = drag_force(sim, point[t], f, w);
                force[point[t][0]] += push;
                force[point[t][1]] += push;
                force[point[t][2]] += push;
            }
        for (uint32_t t = c->triangle_inner_end; t < c->triangle_end; t++)
            if (active[t])
                add_to_own(part, force, point[t], drag_force(sim, point[t], f, w));
    }
}

static double sum_volume(const struct sim *sim, uint32_t begin, uint32_t end, const double *origin)
{
    const row *twice_area = sim->rows.normal, *position = sim->rows.position;
    const row o = {(real)origin[0], (real)origin[1], (real)origin[2], 0};
    row sum = {0};
    for (uint32_t p = begin; p < end; p++)
        sum += (position[p] - o) * twice_area[p];
    return (double)(sum[0] + sum[1] + sum[2]);
}

/* The same where each edge's threshold is its own rest length's. */
static uint32_t count_overlong_of_their_own(const struct sim *sim, const struct sim_part *part, real limit)
{
    const row *position = sim->rows.position;
    const uint32_t(*point)[2] = (const uint32_t(*)[2])sim->edge_point;
    const double *rest = sim->rest_length;
    uint32_t count = 0;
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++) {
        const row l = position[point[e][0]] - position[point[e][1]];
        if (dot(l, l) > limit * (real)(rest[e] * rest[e]))
            count += sim->edge_active[e];
    }
    return count;
}

/* Part 2: "check if the length of the edge is greater than the threshold value". */
static uint32_t count_overlong(const struct sim *sim, const struct sim_part *part)
{
    const row *position = sim->rows.position;
    const uint32_t(*point)[2] = (const uint32_t(*)[2])sim->edge_point;
    const unsigned char *active = sim->edge_active;
    const real limit = (real)(part->balloon->now->threshold_length * part->balloon->now->threshold_length);
    const uint32_t end = part->edge_end;
    uint32_t count = 0;
    if (part->balloon->own_thresholds)
        return count_overlong_of_their_own(sim, part, limit);
    for (uint32_t e = part->edge_begin; e < end; e++) {
        const row l = position[point[e][0]] - position[point[e][1]];
        if (dot(l, l) > limit)
            count += active[e];
    }
    return count;
}

extern const struct sim_kernels SIM_KERNELS;
const struct sim_kernels SIM_KERNELS = {clear_points,     coming_forces,   edge_forces,    coming_normals,
                                        triangle_normals, pressure_forces, count_overlong, coming_areas,
                                        triangle_areas,   push_areas,      drag_triangles, sum_volume};
