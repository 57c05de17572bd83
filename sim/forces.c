/*
 * Parts 1 to 4 of a step (paper 3.5): springs and dampers, normals, pressure. Compiled once for each set of instructions
 * (kernels.h): SIM_KERNELS is the name of the table at the end.
 *
 * A row is x, y, z and 0: GCC's vectors, so that arithmetic reads as on paper and runs four wide. What is not a vector's, such as a
 * length and its inverse, is worked out for four edges, triangles or points at once (lanes.h).
 */
#include "sim/kernels.h"
#include "sim/lanes.h"
#include "sim/sweep.h"

#include <math.h>
#include <string.h>

static inline double dot(row a, row b)
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

static inline double length_of(row a)
{
    return sqrt(dot(a, a));
}

/* What has no length has no direction either. */
static inline double inverse(double length)
{
    return length > 0 ? 1 / length : 0;
}

/* The lengths of four rows, and the inverses of four lengths: each as of one alone, to the bit. */
static inline lanes lengths_of(const row a[4])
{
    const struct lanes3 turned = lanes_of_rows(a);
    return lanes_sqrt(lanes_dot(turned, turned));
}

static inline lanes inverses(lanes length)
{
    return lanes_select(length > 0, 1 / length, lanes_all(0));
}

/* Part 1: "initialize acceleration and normal vectors to (0,0,0)". By memset, since that does not read the lines of the cache which
 * it writes: a tenth of the time of a large balloon's step. */
static void clear_points(struct sim *sim, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *normal = sim->rows.normal;
    const size_t size = (chunk->clear_end - chunk->clear_begin) * sizeof *force;
    memset(&force[chunk->clear_begin], 0, size);
    memset(&normal[chunk->clear_begin], 0, size);
}

/* The tables that a loop reads, as local variables: for all that the compiler knows, a row that is written might be one of
 * the addresses in struct sim, which it would then read again for each edge. */
struct edges {
    const row *position, *velocity;
    const uint32_t (*point)[2];
    const double *spring_const, *rest_length;
    const unsigned char *active;
    double damping;
    double most,
        most_of_rest; /* an edge of rest length r is surely not overlong up to most + most_of_rest r */
};

static inline struct edges edges_of(const struct sim *sim, const struct sim_part *part)
{
    const struct sim_balloon *b = part->balloon;
    const double most = b->now->threshold_length * (1 - 1e-12);
    return (struct edges){.position = sim->rows.position,
                          .velocity = sim->rows.velocity,
                          .point = (const uint32_t(*)[2])sim->edge_point,
                          .spring_const = sim->current_spring_const,
                          .rest_length = sim->rest_length,
                          .active = sim->edge_active,
                          .damping = b->now->damping,
                          .most = b->own_thresholds ? 0 : most,
                          .most_of_rest = b->own_thresholds ? most : 0};
}

/* Part 2: springs and dampers. With l = a - b and its length |l|,
 *     f_a = -[k_s (|l| - r) + k_d (v . l)/|l|] l/|l|,   f_b = -f_a      Witkin, SIGGRAPH '95 course notes 34
 * The paper prints |v| under the damper's l: a misprint, since that would be 0/0 in a balloon at rest. An edge of no
 * length has no direction and pulls at nothing. Returns f_b; *over becomes what the edge is longer than it may be. */
static inline row edge_force(const struct edges *edges, uint32_t e, double *over)
{
    const uint32_t a = edges->point[e][0], b = edges->point[e][1];
    const row l = edges->position[a] - edges->position[b], v = edges->velocity[a] - edges->velocity[b];
    const double length = length_of(l), rest = edges->rest_length[e];
    const double spring = edges->spring_const[e] * (length - rest);
    const double damper = edges->damping * dot(v, l) * inverse(length);
    *over = length - (edges->most + edges->most_of_rest * rest);
    return (spring + damper) * inverse(length) * l;
}

/* The same for four edges that follow each other. */
static inline lanes edge_forces_of_four(const struct edges *edges, uint32_t e, row f[4])
{
    row l[4], v[4];
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t a = edges->point[e + i][0], b = edges->point[e + i][1];
        l[i] = edges->position[a] - edges->position[b];
        v[i] = edges->velocity[a] - edges->velocity[b];
    }
    const struct lanes3 l3 = lanes_of_rows(l), v3 = lanes_of_rows(v);
    const lanes rest = lanes_at(edges->rest_length + e);
    const lanes length = lanes_sqrt(lanes_dot(l3, l3)), inverse_length = inverses(length);
    const lanes spring = lanes_at(edges->spring_const + e) * (length - rest);
    const lanes damper = edges->damping * lanes_dot(v3, l3) * inverse_length;
    const lanes pull = (spring + damper) * inverse_length;
    for (int i = 0; i < 4; i++)
        f[i] = pull[i] * l[i];
    return length - (edges->most + edges->most_of_rest * rest);
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
        double over; /* its own part sees to that */
        if (edges.active[e])
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e, &over));
    }
}

/* And sees to how long the edges are (sweep.h). */
static void edge_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    const struct edges edges = edges_of(sim, part);
    const uint32_t inner_end = chunk->edge_inner_end, end = chunk->edge_end;
    row *force = sim->rows.force;
    uint32_t e = chunk->edge_begin;
    lanes most = lanes_all(-INFINITY);
    for (; inner_end - e >= 4; e += 4) {
        row f[4];
        lanes over = edge_forces_of_four(&edges, e, f);
        for (uint32_t i = 0; i < 4; i++)
            if (edges.active[e + i]) {
                force[edges.point[e + i][0]] -= f[i];
                force[edges.point[e + i][1]] += f[i];
            } else
                over[i] = -INFINITY;
        most = lanes_max(over, most);
    }
    for (double over; e < end; e++)
        if (edges.active[e]) {
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e, &over));
            most[0] = fmax(most[0], over);
        }
    struct sim_seen *seen = &sim->seen[part - sim->parts];
    seen->over = fmax(seen->over, fmax(fmax(most[0], most[1]), fmax(most[2], most[3])));
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

/* The same for four triangles that follow each other. */
struct normals {
    row twice_area[4], added[4];
    lanes inverse;
};

static inline struct normals normals_of_four(const row *position, const uint32_t (*point)[3], bool unit)
{
    struct normals n;
    for (int i = 0; i < 4; i++)
        n.added[i] = n.twice_area[i] = triangle_normal(position, point[i], false);
    n.inverse = inverses(lengths_of(n.twice_area));
    for (int i = 0; i < 4 && unit; i++)
        n.added[i] *= n.inverse[i];
    return n;
}

/* The air's resistance (effect_drag.c), with what the normal has brought: (r C/12) (w . N) |w . N| N/|N|^2, N twice the area
 * vector, w the wind less the mean speed. */
struct air {
    row *force; /* sim->rows.air */
    const row *velocity;
    row wind;      /* three times it */
    double factor; /* r C/108 */
};

static inline struct air air_of(const struct sim *sim)
{
    const struct scene_drag *drag = &sim->scene->drag;
    const row wind = {drag->wind[0], drag->wind[1], drag->wind[2], 0};
    return (struct air){sim->rows.air, sim->rows.velocity, 3 * wind,
                        drag->air_density * drag->coefficient / 108};
}

static inline row wind_at(const struct air *air, const uint32_t *p)
{
    return air->wind - (air->velocity[p[0]] + air->velocity[p[1]] + air->velocity[p[2]]);
}

static inline row air_force(const struct air *air, const uint32_t *p, row n)
{
    const double across = dot(wind_at(air, p), n), size = across < 0 ? -across : across,
                 inverse_length = inverse(length_of(n));
    return air->factor * (across * size) * (inverse_length * inverse_length) * n;
}

/* The same for four triangles, each as for one alone, to the bit. */
static inline void air_forces_of_four(const struct air *air, const uint32_t (*point)[3],
                                      const struct normals *n, row f[4])
{
    row w[4];
    for (int i = 0; i < 4; i++)
        w[i] = wind_at(air, point[i]);
    const lanes across = lanes_dot(lanes_of_rows(w), lanes_of_rows(n->twice_area));
    const lanes size = lanes_select(across < 0, -across, across);
    const lanes push = air->factor * (across * size) * (n->inverse * n->inverse);
    for (int i = 0; i < 4; i++)
        f[i] = push[i] * n->twice_area[i];
}

/* Adds to those of the three points that are the part's. */
static inline void add_to_own(const struct sim_part *part, row *rows, const uint32_t *p, row r)
{
    for (int k = 0; k < 3; k++)
        if (p[k] - part->point_begin < part->point_end - part->point_begin)
            rows[p[k]] += r;
}

static inline void add_to_all(row *rows, const uint32_t *p, row r)
{
    rows[p[0]] += r;
    rows[p[1]] += r;
    rows[p[2]] += r;
}

static inline void add_own_triangle(struct sim *sim, const struct sim_part *part, uint32_t t, bool unit,
                                    const struct air *air)
{
    const uint32_t *p = sim->triangle_point[t];
    if (!sim->triangle_active[t])
        return;
    add_to_own(part, sim->rows.normal, p, triangle_normal(sim->rows.position, p, unit));
    if (air)
        add_to_own(part, air->force, p, air_force(air, p, triangle_normal(sim->rows.position, p, false)));
}

static inline void add_coming(struct sim *sim, const struct sim_part *part, bool unit, const struct air *air)
{
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        add_own_triangle(sim, part, part->triangle_in[i], unit, air);
}

static inline void add_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                                 bool unit, const struct air *air)
{
    const row *position = sim->rows.position;
    row *normal = sim->rows.normal;
    const uint32_t(*point)[3] = (const uint32_t(*)[3])sim->triangle_point;
    const unsigned char *active = sim->triangle_active;
    const uint32_t inner_end = chunk->triangle_inner_end, end = chunk->triangle_end;
    uint32_t t = chunk->triangle_begin;
    for (; inner_end - t >= 4; t += 4) {
        const struct normals n = normals_of_four(position, &point[t], unit);
        row f[4];
        if (air)
            air_forces_of_four(air, &point[t], &n, f);
        for (uint32_t i = 0; i < 4; i++)
            if (active[t + i]) {
                add_to_all(normal, point[t + i], n.added[i]);
                if (air)
                    add_to_all(air->force, point[t + i], f[i]);
            }
    }
    for (; t < end; t++)
        add_own_triangle(sim, part, t, unit, air);
}

/* The forces of the air are added up apart, in the triangles' order, so that their sums are the same however the points are shared
 * out; they are 0 again afterwards. */
static void add_air(struct sim *sim, const struct sim_chunk *chunk)
{
    row *force = sim->rows.force, *air = sim->rows.air;
    for (uint32_t p = chunk->point_begin; p < chunk->point_end; p++) {
        force[p] += air[p];
        air[p] = (row){0};
    }
}

static inline void add_all_triangles(struct sim *sim, const struct sim_part *part,
                                     const struct sim_chunk *chunk, bool unit)
{
    if (sim->rows.air) {
        const struct air air = air_of(sim);
        if (chunk == part->chunks)
            add_coming(sim, part, unit, &air);
        add_triangles(sim, part, chunk, unit, &air);
        add_air(sim, chunk);
    } else {
        if (chunk == part->chunks)
            add_coming(sim, part, unit, NULL);
        add_triangles(sim, part, chunk, unit, NULL);
    }
}

static void triangle_normals(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_all_triangles(sim, part, chunk, true);
}

static void triangle_areas(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    add_all_triangles(sim, part, chunk, false);
}

/* Part 4: normalize the normals; pressure is a force along them. A point that lost its last triangle has no normal, and
 * nothing for the air to press on. */
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

/* The same where each edge's threshold is its own rest length's. */
static uint32_t count_overlong_of_their_own(const struct sim *sim, const struct sim_part *part, double limit)
{
    const row *position = sim->rows.position;
    const uint32_t(*point)[2] = (const uint32_t(*)[2])sim->edge_point;
    const double *rest = sim->rest_length;
    uint32_t count = 0;
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++) {
        const row l = position[point[e][0]] - position[point[e][1]];
        if (dot(l, l) > limit * (rest[e] * rest[e]))
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
    const double limit = (part->balloon->now->threshold_length * part->balloon->now->threshold_length);
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
const struct sim_kernels SIM_KERNELS = {clear_points,     coming_forces,   edge_forces,
                                        triangle_normals, pressure_forces, count_overlong,
                                        triangle_areas,   push_areas,      sum_volume};
