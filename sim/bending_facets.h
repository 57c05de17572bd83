/*
 * The first of the passes over hinges (bending_passes.h): what their triangles bring to them, four triangles
 * at a time. The step goes through the same triangles for their normals (forces_triangles.h), which are a
 * part of it: so these are added up here too, but not where air is.
 */
#ifndef SIM_BENDING_FACETS_H
#define SIM_BENDING_FACETS_H

#include "sim/bending_hinge.h"
#include "sim/bending_kernels.h"
#include "sim/forces_triangles.h"

/* A row has room for one more number, and the guard needs two of a triangle, to six digits: each
 * as half of one's bits. */
INLINE lanes pack(lanes high, lanes low)
{
    const lane_mask upper = {-(1LL << 32), -(1LL << 32), -(1LL << 32), -(1LL << 32)};
    return (lanes)(((lane_mask)high & upper) | (lane_mask)((lane_bits)low >> 32));
}

INLINE lanes packed_high(lanes both)
{
    const lane_mask upper = {-(1LL << 32), -(1LL << 32), -(1LL << 32), -(1LL << 32)};
    return (lanes)((lane_mask)both & upper);
}

INLINE lanes packed_low(lanes both)
{
    return (lanes)((lane_mask)both << 32);
}

INLINE lanes of_four(const double *table, const size_t index[4])
{
    return (lanes){table[index[0]], table[index[1]], table[index[2]], table[index[3]]};
}

/* Four that follow each other, or fewer, with the last of them again in place of more; `count` is known when
 * it is compiled where it is 4. */
INLINE void list_four(size_t first, size_t count, size_t index[4])
{
    for (size_t i = 0; i < 4; i++)
        index[i] = first + (i < count ? i : count - 1);
}

INLINE void put_four(lanes numbers, double *table, size_t count)
{
    if (count == 4)
        lanes_put(numbers, table);
    else
        for (size_t i = 0; i < count; i++)
            table[i] = numbers[i];
}

/* What the first pass works with; all tables begin with the balloon's first triangle. Copied, so that the
 * compiler knows that what is written is none of the addresses. */
struct facet_work {
    const row *position, *velocity;
    const uint32_t (*point)[3];
    const unsigned char *active;
    const double *least;
    row *normal;
    double *cotangent[3], *swing[3];
};

INLINE struct facet_work facet_work_of(const struct sim *sim, const struct sim_balloon *b)
{
    const struct bending_passes *p = &b->bending->passes;
    return (struct facet_work){.position = sim->rows.position,
                               .velocity = sim->rows.velocity,
                               .point = (const uint32_t(*)[3])sim->triangle_point + b->triangle_begin,
                               .active = sim->triangle_active + b->triangle_begin,
                               .least = p->least,
                               .normal = (row *)p->normal,
                               .cotangent = {p->cotangent[0], p->cotangent[1], p->cotangent[2]},
                               .swing = {p->swing[0], p->swing[1], p->swing[2]}};
}

INLINE struct lanes3 sides_of(const row *rows, const uint32_t (*point)[3], const size_t triangle[4],
                              int corner)
{
    row side[4];
    for (int i = 0; i < 4; i++)
        side[i] = rows[point[triangle[i]][corner]] - rows[point[triangle[i]][0]];
    return lanes_of_rows(side);
}

/* 1/|n|; 0 of a triangle that is gone. */
INLINE lanes inverse_lengths(const struct facet_work *w, lanes square, const size_t triangle[4], size_t count)
{
    lanes inverse = inverses(lanes_sqrt(square));
    if (count < 4 || !four_are_set(&w->active[triangle[0]]))
        for (int i = 0; i < 4; i++)
            inverse[i] = w->active[triangle[i]] ? inverse[i] : 0;
    return inverse;
}

INLINE void put_swings(const struct facet_work *w, const size_t triangle[4], size_t count, struct lanes3 unit,
                       const lanes cotangent[3])
{
    const lanes w1 = lanes_dot(unit, sides_of(w->velocity, w->point, triangle, 1)),
                w2 = lanes_dot(unit,
                               sides_of(w->velocity, w->point, triangle, 2)); /* less that of corner 0 */
    const lanes g0 = cotangent[0] * (w1 - w2), g1 = cotangent[1] * w2, g2 = cotangent[2] * -w1;
    put_four(g2 - g1, w->swing[0] + triangle[0], count);
    put_four(g0 - g2, w->swing[1] + triangle[0], count);
    put_four(g1 - g0, w->swing[2] + triangle[0], count);
}

/* Four triangles as they are now. */
struct facets_put {
    struct lanes3 twice_area;
    row unit[4]; /* and in the fourth place of each what pack() has put there */
    lane_mask crushed;
};

/* A row has N, and in the fourth place 1/|n|^2 and twice the sum of squares of the sides over that. */
INLINE struct facets_put put_facets(const struct facet_work *w, size_t first, size_t count, bool damped)
{
    size_t triangle[4];
    list_four(first, count, triangle);
    const struct lanes3 a = sides_of(w->position, w->point, triangle, 1),
                        b = sides_of(w->position, w->point, triangle, 2), n = lanes_cross(a, b);
    const lanes aa = lanes_dot(a, a), bb = lanes_dot(b, b), ab = lanes_dot(a, b), square = lanes_dot(n, n);
    const lanes length = inverse_lengths(w, square, triangle, count), inverse = length * length;
    const lanes cotangent[3] = {ab * length, (aa - ab) * length, (bb - ab) * length};
    const struct lanes3 unit = times(length, n);
    struct facets_put put = {.twice_area = n, .crushed = (lane_mask)(square < of_four(w->least, triangle))};
    lanes_turn((const row[4]){(row)unit.x, (row)unit.y, (row)unit.z,
                              (row)pack(inverse, 4 * (aa + bb - ab) * inverse)},
               put.unit);
    for (size_t i = 0; i < count; i++)
        w->normal[first + i] = put.unit[i];
    for (int k = 0; k < 3; k++)
        put_four(cotangent[k], w->cotangent[k] + first, count);
    if (damped)
        put_swings(w, triangle, count, unit, cotangent);
    return put;
}

/* What of four triangles goes to their points on the way: nothing; or the step's part 3
 * (forces_triangles.h), to the bit. */
enum facet_normals { NORMALS_NONE, NORMALS_UNIT, NORMALS_AREA };

INLINE row unit_of(row normal)
{
    const lane_mask three = {-1, -1, -1, 0};
    return (row)((lane_mask)normal & three);
}

INLINE void add_four(const struct facet_work *w, const struct facets_put *put, size_t first,
                     enum facet_normals normals, row *to)
{
    row area[4];
    lanes_to_rows(put->twice_area, area);
    for (size_t i = 0; i < 4; i++) {
        const uint32_t *p = w->point[first + i];
        const struct corners at = {p[0], p[1], p[2]};
        add_to_all(to, &at, normals == NORMALS_UNIT ? unit_of(put->unit[i]) : area[i]);
    }
}

INLINE bool put_chunk(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                      bool damped, enum facet_normals normals)
{
    const struct facet_work w = facet_work_of(sim, part->balloon);
    const uint32_t balloon = part->balloon->triangle_begin;
    const size_t end = chunk->triangle_end - balloon, inner_end = chunk->triangle_inner_end - balloon;
    lane_mask crushed = {0};
    for (uint32_t i = 0; normals && chunk == part->chunks && i < part->triangle_in_count; i++)
        add_own_triangle(sim, part, part->triangle_in[i], normals == NORMALS_UNIT, NULL);
    for (size_t t = chunk->triangle_begin - balloon; t < end; t += 4) {
        const size_t count = end - t < 4 ? end - t : 4;
        const bool whole = count == 4 && t + 4 <= inner_end && four_are_set(&w.active[t]);
        const struct facets_put put = count == 4 ? put_facets(&w, t, 4, damped)
                                                 : put_facets(&w, t, count, damped);
        crushed |= put.crushed;
        if (normals && whole)
            add_four(&w, &put, t, normals, sim->rows.normal);
        for (uint32_t i = 0; normals && !whole && i < count; i++)
            add_own_triangle(sim, part, balloon + (uint32_t)t + i, normals == NORMALS_UNIT, NULL);
    }
    return lanes_any(crushed);
}

INLINE bool put_as_asked(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                         enum facet_normals normals)
{
    return part->balloon->bending->damping > 0 ? put_chunk(sim, part, chunk, true, normals)
                                               : put_chunk(sim, part, chunk, false, normals);
}

static bool chunk_triangles(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    bool *crushed = &part->balloon->bending->passes.crushed[part - sim->parts];
    const bool some = sim->drag                ? put_as_asked(sim, part, chunk, NORMALS_NONE)
                      : part->balloon->by_area ? put_as_asked(sim, part, chunk, NORMALS_AREA)
                                               : put_as_asked(sim, part, chunk, NORMALS_UNIT);
    *crushed = some || (*crushed && chunk > part->chunks);
    return !sim->drag;
}

#endif
