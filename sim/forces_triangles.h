/* Part 3 of a step (paper 3.5; forces.c): the normals of triangles, and with them the air's
 * resistance (effect_drag.c). */
#ifndef SIM_FORCES_TRIANGLES_H
#define SIM_FORCES_TRIANGLES_H

#include "sim/forces_math.h"
#include "sim/sim.h"

/* Part 3: the unit normal of a triangle, which each active one adds to its three points'. A triangle without
 * area has none to add. Where pressure acts on areas (areas.h): twice its area along that normal. */
static inline row triangle_normal(const row *position, const uint32_t *p, bool unit)
{
    const row twice_area = cross(position[p[1]] - position[p[0]], position[p[2]] - position[p[0]]);
    if (unit)
        return twice_area * inverse(length_of(twice_area));
    return twice_area;
}

/* The air's resistance (effect_drag.c), with what the normal has brought: (r C/12) (w . n) |w . n| N, n =
 * N/|N|, w the wind less the mean speed. */
struct air {
    const row *velocity;
    row wind;      /* three times it */
    double factor; /* r C/108 */
};

static inline struct air air_of(const struct sim *sim)
{
    const struct scene_drag *drag = &sim->scene->drag;
    const row wind = {drag->wind[0], drag->wind[1], drag->wind[2], 0};
    return (struct air){sim->rows.velocity, 3 * wind, drag->air_density * drag->coefficient / 108};
}

/* 3 w of a triangle. */
static inline row air_passing(const struct air *air, const uint32_t *p)
{
    return air->wind - air->velocity[p[0]] - air->velocity[p[1]] - air->velocity[p[2]];
}

/* Four triangles that follow each other: N, twice their area vectors, as rows and turned, and 1/|N|, or 0;
 * and 3 w, where there is air. */
struct facets {
    row twice_area[4], wind[4];
    struct lanes3 turned;
    lanes inverse;
};

INLINE struct facets facets_of(const row *position, const struct air *air, const uint32_t (*point)[3])
{
    struct facets f;
    for (int i = 0; i < 4; i++) {
        f.twice_area[i] = triangle_normal(position, point[i], false);
        if (air)
            f.wind[i] = air_passing(air, point[i]);
    }
    f.turned = lanes_of_rows(f.twice_area);
    f.inverse = inverses(lanes_sqrt(lanes_dot(f.turned, f.turned)));
    return f;
}

static inline row air_force(const struct air *air, const uint32_t *p, row n)
{
    const double across = dot(air_passing(air, p), n) * inverse(length_of(n));
    return air->factor * (across * fabs(across)) * n;
}

/* The same for four triangles, each as for one alone, to the bit: what their N are multiplied by. */
static inline lanes air_pushes(const struct air *air, const struct facets *f)
{
    const struct lanes3 w = lanes_of_rows(f->wind);
    const lanes across = lanes_dot(w, f->turned) * f->inverse;
    return air->factor * (across * lanes_size(across));
}

/* Adds to those of the three points that are the part's. */
static inline void add_to_own(const struct sim_part *part, row *rows, const uint32_t *p, row r)
{
    for (int k = 0; k < 3; k++)
        if (p[k] - part->point_begin < part->point_end - part->point_begin)
            rows[p[k]] += r;
}

/* Its corners, once: what is written might be among them, for all that the compiler knows. */
struct corners {
    size_t a, b, c;
};

static inline void add_to_all(row *rows, const struct corners *at, row r)
{
    rows[at->a] += r;
    rows[at->b] += r;
    rows[at->c] += r;
}

/* For the few that are not among four whole ones. */
static void add_own_triangle(struct sim *sim, const struct sim_part *part, uint32_t t, bool unit,
                             const struct air *air)
{
    const uint32_t *p = sim->triangle_point[t];
    if (!sim->triangle_active[t])
        return;
    add_to_own(part, sim->rows.normal, p, triangle_normal(sim->rows.position, p, unit));
    if (air)
        add_to_own(part, sim->rows.force, p,
                   air_force(air, p, triangle_normal(sim->rows.position, p, false)));
}

INLINE void add_own_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                              bool unit, const struct air *air)
{
    const row *position = sim->rows.position;
    row *normal = sim->rows.normal, *force = sim->rows.force;
    const uint32_t(*point)[3] = (const uint32_t(*)[3])sim->triangle_point;
    const unsigned char *active = sim->triangle_active;
    const uint32_t inner_end = chunk->triangle_inner_end, end = chunk->triangle_end;
    uint32_t t = chunk->triangle_begin;
    for (; inner_end - t >= 4; t += 4) {
        if (!four_are_set(&active[t])) {
            for (uint32_t i = 0; i < 4; i++)
                add_own_triangle(sim, part, t + i, unit, air);
            continue;
        }
        const uint32_t(*four)[3] = &point[t];
        const struct facets f = facets_of(position, air, four);
        const lanes share = unit ? f.inverse : lanes_all(1);
        const lanes push = air ? air_pushes(air, &f) : lanes_all(0);
        for (int i = 0; i < 4; i++) {
            const struct corners at = {four[i][0], four[i][1], four[i][2]};
            add_to_all(normal, &at, lanes_spread(share, i) * f.twice_area[i]);
            if (air)
                add_to_all(force, &at, lanes_spread(push, i) * f.twice_area[i]);
        }
    }
    for (; t < end; t++)
        add_own_triangle(sim, part, t, unit, air);
}

INLINE void add_all_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                              bool unit, const struct air *air)
{
    for (uint32_t i = 0; i < part->triangle_in_count && chunk == part->chunks; i++)
        add_own_triangle(sim, part, part->triangle_in[i], unit, air);
    add_own_triangles(sim, part, chunk, unit, air);
}

INLINE void add_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                          bool unit)
{
    const struct air air = air_of(sim);
    if (sim->drag)
        add_all_triangles(sim, part, chunk, unit, &air);
    else
        add_all_triangles(sim, part, chunk, unit, NULL);
}

#endif
