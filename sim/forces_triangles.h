/* Part 3 of a step (paper 3.5; forces.c): the normals of triangles, and with them the air's resistance (effect_drag.c). */
#ifndef SIM_FORCES_TRIANGLES_H
#define SIM_FORCES_TRIANGLES_H

#include "sim/forces_math.h"
#include "sim/sim.h"

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
    const double across = dot(wind_at(air, p), n), size = fabs(across),
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
    const lanes push = air->factor * (across * lanes_size(across)) * (n->inverse * n->inverse);
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

/* Adds to those of all three; `air` NULL: only the normal. What is written might be p, for all that the compiler knows. */
static inline void add_to_all(row *normals, row *air, const uint32_t *p, row normal, row force)
{
    const size_t a = p[0], b = p[1], c = p[2];
    normals[a] += normal;
    normals[b] += normal;
    normals[c] += normal;
    if (air) {
        air[a] += force;
        air[b] += force;
        air[c] += force;
    }
}

INLINE void add_own_triangle(struct sim *sim, const struct sim_part *part, uint32_t t, bool unit,
                             const struct air *air)
{
    const uint32_t *p = sim->triangle_point[t];
    if (!sim->triangle_active[t])
        return;
    add_to_own(part, sim->rows.normal, p, triangle_normal(sim->rows.position, p, unit));
    if (air)
        add_to_own(part, air->force, p, air_force(air, p, triangle_normal(sim->rows.position, p, false)));
}

INLINE void add_coming(struct sim *sim, const struct sim_part *part, bool unit, const struct air *air)
{
    for (uint32_t i = 0; i < part->triangle_in_count; i++)
        add_own_triangle(sim, part, part->triangle_in[i], unit, air);
}

INLINE void add_own_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
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
        row f[4] = {{0}};
        if (air)
            air_forces_of_four(air, &point[t], &n, f);
        for (uint32_t i = 0; i < 4; i++)
            if (active[t + i])
                add_to_all(normal, air ? air->force : NULL, point[t + i], n.added[i], f[i]);
    }
    for (; t < end; t++)
        add_own_triangle(sim, part, t, unit, air);
}

INLINE void add_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                          bool unit)
{
    if (sim->rows.air) {
        const struct air air = air_of(sim);
        if (chunk == part->chunks)
            add_coming(sim, part, unit, &air);
        add_own_triangles(sim, part, chunk, unit, &air);
    } else {
        if (chunk == part->chunks)
            add_coming(sim, part, unit, NULL);
        add_own_triangles(sim, part, chunk, unit, NULL);
    }
}

#endif
