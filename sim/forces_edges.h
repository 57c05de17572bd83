/*
 * Part 2 of a step (paper 3.5; forces.c): springs and dampers, and beside them what the scene's
 * blocks `viscosity` and `plasticity` ask of each edge whose length is at hand anyway
 * (effect_viscosity.c, effect_plasticity.c).
 */
#ifndef SIM_FORCES_EDGES_H
#define SIM_FORCES_EDGES_H

#include "sim/forces_math.h"
#include "sim/sweep.h"

/* What a loop over edges does; known when it is compiled. */
enum edge_work {
    EDGE_SPRINGS = 1, /* the paper's springs and dampers */
    EDGE_ARMS = 2,    /* pulls of viscous arms, and how fast they give way */
    EDGE_WATCH = 4,   /* looks how hard the springs pull */
};

/* The tables that a loop reads, as local variables: for all that the compiler knows, a row that is written
 * might be one of the addresses in struct sim, which it would then read again for each edge. */
struct edges {
    const row *position, *velocity;
    const uint32_t (*point)[2];
    const double *spring_const, *rest_length;
    const unsigned char *active;
    double damping;
    double most, most_of_rest; /* up to most + most_of_rest r an edge of rest length r is not overlong */
    /* Of arms: how far each has given way, from the balloon's first edge on, and at what rate; the stiffness
     * over the spring's; 1/T. */
    const double *given;
    double *given_rate;
    size_t first;
    double ratio, per_time;
};

static inline struct edges edges_of(const struct sim *sim, const struct sim_part *part)
{
    const struct sim_balloon *b = part->balloon;
    const double most = b->now->threshold_length * (1 - 1e-12);
    struct edges edges = {.position = sim->rows.position,
                          .velocity = sim->rows.velocity,
                          .point = (const uint32_t(*)[2])sim->edge_point,
                          .spring_const = sim->current_spring_const,
                          .rest_length = sim->rest_length,
                          .active = sim->edge_active,
                          .damping = b->now->damping,
                          .most = b->own_thresholds ? 0 : most,
                          .most_of_rest = b->own_thresholds ? most : 0};
    if (b->arm_count > 0) {
        edges.given = sim->scalar + b->arms;
        edges.given_rate = sim->scalar_rate + b->arms;
        edges.first = b->edge_begin;
        edges.ratio = b->scene->viscosity.ratio;
        edges.per_time = 1 / b->scene->viscosity.time;
    }
    return edges;
}

/* What one edge, or each of four, comes to. */
struct edge_found {
    double over;  /* what it is longer than it may be */
    double force; /* of its spring */
    double rate;  /* at which its arm gives way */
};

/* Part 2: springs and dampers. With l = a - b and its length |l|,
 *     f_a = -[k_s (|l| - r) + k_d (v . l)/|l|] l/|l|,   f_b = -f_a      Witkin, SIGGRAPH '95 course notes 34
 * The paper prints |v| under the damper's l: a misprint, since that would be 0/0 in a balloon at rest. An
 * edge of no length has no direction and pulls at nothing. Returns f_b. */
INLINE row edge_force(const struct edges *edges, uint32_t e, enum edge_work work, struct edge_found *found)
{
    const uint32_t a = edges->point[e][0], b = edges->point[e][1];
    const row l = edges->position[a] - edges->position[b], v = edges->velocity[a] - edges->velocity[b];
    const double length = length_of(l), rest = edges->rest_length[e], stretched = length - rest;
    double pull = 0;
    found->over = length - (edges->most + edges->most_of_rest * rest);
    found->force = edges->spring_const[e] * stretched;
    if (work & EDGE_SPRINGS)
        pull = found->force + edges->damping * dot(v, l) * inverse(length);
    if (work & EDGE_ARMS) {
        const double left = stretched - edges->given[e - edges->first];
        found->rate = left * edges->per_time;
        pull += edges->ratio * edges->spring_const[e] * left;
    }
    return pull * inverse(length) * l;
}

/* The same for four edges that follow each other. */
struct edges_found {
    lanes over, force, rate;
};

INLINE struct edges_found edge_forces_of_four(const struct edges *edges, uint32_t e, enum edge_work work,
                                              row f[4])
{
    const uint32_t(*point)[2] = edges->point + e;
    row l[4], v[4];
    for (int i = 0; i < 4; i++) {
        const uint32_t a = point[i][0], b = point[i][1];
        l[i] = edges->position[a] - edges->position[b];
        v[i] = edges->velocity[a] - edges->velocity[b];
    }
    const struct lanes3 l3 = lanes_of_rows(l), v3 = lanes_of_rows(v);
    const lanes rest = lanes_at(edges->rest_length + e), spring_const = lanes_at(edges->spring_const + e);
    const lanes length = lanes_sqrt(lanes_dot(l3, l3)), inverse_length = inverses(length);
    const lanes stretched = length - rest;
    struct edges_found found = {.over = length - (edges->most + edges->most_of_rest * rest),
                                .force = spring_const * stretched};
    lanes pull = lanes_all(0);
    if (work & EDGE_SPRINGS)
        pull = found.force + edges->damping * lanes_dot(v3, l3) * inverse_length;
    if (work & EDGE_ARMS) {
        const lanes left = stretched - lanes_at(edges->given + (e - edges->first));
        found.rate = left * edges->per_time;
        pull += edges->ratio * spring_const * left;
    }
    pull *= inverse_length;
    for (int i = 0; i < 4; i++)
        f[i] = lanes_spread(pull, i) * l[i];
    return found;
}

/* Adds it to those of the two points that are the part's. */
static inline void add_to_own_ends(const struct sim_part *part, row *force, const uint32_t *p, row f)
{
    if (p[0] - part->point_begin < part->point_end - part->point_begin)
        force[p[0]] -= f;
    if (p[1] - part->point_begin < part->point_end - part->point_begin)
        force[p[1]] += f;
}

INLINE void add_coming_edges(struct sim *sim, const struct sim_part *part, enum edge_work work)
{
    const struct edges edges = edges_of(sim, part);
    row *force = sim->rows.force;
    for (uint32_t i = 0; i < part->edge_in_count; i++) {
        const uint32_t e = part->edge_in[i];
        struct edge_found found; /* its own part sees to that */
        if (edges.active[e])
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e, work, &found));
    }
}

/* And sees to how long the edges are, and how hard they pull (sweep.h). */
INLINE void add_edges(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk,
                      enum edge_work work)
{
    const struct edges edges = edges_of(sim, part);
    const uint32_t inner_end = chunk->edge_inner_end, end = chunk->edge_end;
    row *force = sim->rows.force;
    uint32_t e = chunk->edge_begin;
    lanes most = lanes_all(-INFINITY), hardest = lanes_all(0), stiffest = lanes_all(0);
    for (; inner_end - e >= 4; e += 4) {
        const uint32_t(*point)[2] = edges.point + e;
        const unsigned char *active = edges.active + e;
        row f[4];
        struct edges_found found = edge_forces_of_four(&edges, e, work, f);
        for (int i = 0; i < 4; i++)
            if (active[i]) {
                force[point[i][0]] -= f[i];
                force[point[i][1]] += f[i];
            } else {
                found.over[i] = -INFINITY;
                found.force[i] = found.rate[i] = 0;
            }
        most = lanes_max(found.over, most);
        if (work & EDGE_ARMS)
            lanes_put(found.rate, edges.given_rate + (e - edges.first));
        if (work & EDGE_WATCH) {
            hardest = lanes_max(lanes_size(found.force), hardest);
            stiffest = lanes_max(lanes_at(edges.spring_const + e), stiffest);
        }
    }
    for (; e < end; e++) {
        struct edge_found found = {.over = -INFINITY};
        if (edges.active[e])
            add_to_own_ends(part, force, edges.point[e], edge_force(&edges, e, work, &found));
        most[0] = fmax(most[0], found.over);
        if (work & EDGE_ARMS)
            edges.given_rate[e - edges.first] = found.rate;
        if (work & EDGE_WATCH) {
            hardest[0] = fmax(hardest[0], fabs(found.force));
            stiffest[0] = fmax(stiffest[0], edges.spring_const[e]);
        }
    }
    struct sim_seen *seen = &sim->seen[part - sim->parts];
    seen->over = fmax(seen->over, lanes_largest(most));
    if (work & EDGE_WATCH) {
        seen->hardest = fmax(seen->hardest, lanes_largest(hardest));
        seen->stiffest = fmax(seen->stiffest, lanes_largest(stiffest));
    }
}

/* Those of four edges that follow each other whose springs pull or push with `yield` and more, to round-off;
 * `hardening` for what has slipped. */
static inline lane_mask slipping(const struct edges *edges, uint32_t e, double yield, double hardening,
                                 const double *slipped)
{
    row l[4];
    for (uint32_t i = 0; i < 4; i++)
        l[i] = edges->position[edges->point[e + i][0]] - edges->position[edges->point[e + i][1]];
    const lanes force = lanes_at(edges->spring_const + e) *
                        (lengths_of(l) - lanes_at(edges->rest_length + e));
    return (lane_mask)(lanes_size(force) > (1 - 1e-9) * (yield + hardening * lanes_at(slipped)));
}

#endif
