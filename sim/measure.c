/* What the log tells about a state. */
#include "sim/measure.h"
#include "common/disjoint_sets.h"
#include "common/vec3.h"
#include "sim/fracture.h"
#include "sim/membrane.h"

/* Pieces are sets of edges, in which each active triangle joins its three: two triangles hang together where
 * they share an edge. */
uint32_t sim_piece_of(struct sim *sim, uint32_t t)
{
    return sets_find(sim->piece, sim->triangle_edge[t][0]);
}

void sim_find_pieces(struct sim *sim)
{
    for (uint32_t e = 0; e < sim->edge_count; e++)
        sim->piece[e] = e;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        if (sim->triangle_active[t]) {
            sets_unite(sim->piece, sim->triangle_edge[t][0], sim->triangle_edge[t][1]);
            sets_unite(sim->piece, sim->triangle_edge[t][0], sim->triangle_edge[t][2]);
        }
}

/* By Heron's formula in Kahan's stable form ("Miscalculating area and angles of a needle-like
 * triangle", 2014): a >= b >= c. */
double sim_rest_area(const struct sim *sim, uint32_t t)
{
    const uint32_t *edge = sim->triangle_edge[t];
    double a = sim->rest_length[edge[0]], b = sim->rest_length[edge[1]], c = sim->rest_length[edge[2]];
    const double most = fmax(a, fmax(b, c)), least = fmin(a, fmin(b, c));
    b = fmax(fmin(a, b), fmin(fmax(a, b), c));
    a = most;
    c = least;
    return sqrt(fmax((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)), 0)) / 4;
}

double sim_area(const struct sim *sim, uint32_t t)
{
    const uint32_t *p = sim->triangle_point[t];
    double twice[3];
    vec3_triangle(sim->position[p[0]], sim->position[p[1]], sim->position[p[2]], twice);
    return vec3_length(twice) / 2;
}

static void measure_skin(struct sim *sim, struct sim_measures *m)
{
    sim_find_pieces(sim);
    for (uint32_t e = 0; e < sim->edge_count; e++)
        sim->piece_area[e] = -1; /* no triangle has been counted here */
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        double *piece_area = &sim->piece_area[sim_piece_of(sim, t)];
        const double area = sim_area(sim, t);
        m->pieces += *piece_area < 0;
        *piece_area = fmax(*piece_area, 0) + area;
        m->largest_piece_area = fmax(m->largest_piece_area, *piece_area);
        m->area += area;
        m->triangles_active++;
    }
}

static bool has_skin(const struct sim *sim, uint32_t p)
{
    return vec3_dot(sim->normal[p], sim->normal[p]) > 0;
}

/* The mean of the points that carry skin; returns how many do. */
static uint32_t skin_centre(const struct sim *sim, const struct sim_balloon *b, double centre[3])
{
    uint32_t count = 0;
    for (int i = 0; i < 3; i++)
        centre[i] = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        if (has_skin(sim, p)) {
            count++;
            for (int i = 0; i < 3; i++)
                centre[i] += sim->position[p][i];
        }
    for (int i = 0; i < 3 && count; i++)
        centre[i] /= count;
    return count;
}

/* Six times the volume between a triangle and a place. */
static double cone(const struct sim *sim, uint32_t t, const double place[3])
{
    double a[3], b[3], c[3], cross[3];
    vec3_sub(sim->position[sim->triangle_point[t][0]], place, a);
    vec3_sub(sim->position[sim->triangle_point[t][1]], place, b);
    vec3_sub(sim->position[sim->triangle_point[t][2]], place, c);
    vec3_cross(b, c, cross);
    return vec3_dot(a, cross);
}

/* Returns how many points carry skin, and adds their distances from their mean to m->mean_radius. */
static uint32_t measure_shape(const struct sim *sim, const struct sim_balloon *b, struct sim_measures *m)
{
    double centre[3];
    const uint32_t count = skin_centre(sim, b, centre);
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        if (has_skin(sim, p))
            m->mean_radius += vec3_distance(sim->position[p], centre);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        if (sim->triangle_active[t])
            m->volume += cone(sim, t, centre) / 6;
    return count;
}

static void measure_elastic(struct sim *sim, struct sim_measures *m)
{
    for (uint32_t e = 0; e < sim->edge_count; e++)
        if (sim->edge_active[e]) {
            const double length = sim_edge_length(sim, e);
            m->elastic_energy += sim_spring_energy(sim, e);
            if (sim->rest_length[e] > 0)
                m->max_stretch = fmax(m->max_stretch, length / sim->rest_length[e]);
            m->edges_active++;
        }
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->membrane)
            m->elastic_energy += membrane_elastic(sim, b);
}

double sim_stiffness(const struct sim *sim, const struct sim_balloon *b)
{
    double sum = 0;
    if (b->membrane)
        return b->membrane->modulus * b->membrane->thickness;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++) /* what was cut has halves */
        sum += sim->current_spring_const[e];
    const uint32_t whole = b->topology ? b->topology->old_edges : b->edge_end;
    return sqrt(3) / 4 * sum / (whole - b->edge_begin);
}

static void measure_tears(struct sim *sim, struct sim_measures *m)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        m->hole_area += gas_look(sim, b).hole_area;
        if (!b->fracture)
            continue;
        m->torn_length += b->topology->now.torn;
        m->crack_energy += b->scene->fracture.toughness * b->radius * sim_stiffness(sim, b) *
                           b->topology->now.torn;
        for (uint32_t i = 0; i < b->fracture->now.tips; i++)
            m->crack_tips += b->fracture->tips[i].alive;
    }
}

struct sim_measures sim_measure(struct sim *sim)
{
    struct sim_measures m = {0};
    uint32_t count = 0;
    measure_skin(sim, &m);
    measure_elastic(sim, &m);
    measure_tears(sim, &m);
    for (size_t i = 0; i < sim->balloon_count; i++)
        count += measure_shape(sim, &sim->balloons[i], &m);
    if (count > 0)
        m.mean_radius /= count;
    for (uint32_t p = 0; p < sim->point_count; p++)
        m.kinetic_energy += sim->mass[p] * vec3_dot(sim->velocity[p], sim->velocity[p]) / 2;
    return m;
}
