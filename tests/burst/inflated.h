/* A balloon of rubber at a stretch, with the gas that holds it there. Units: radius, shear modulus, density
 * and thickness are 1, so that time is in radii over the speed of shear waves. */
#ifndef TESTS_BURST_INFLATED_H
#define TESTS_BURST_INFLATED_H

#include "common/vec3.h"
#include "sim/fracture.h"
#include "support/rubber.h"
#include "support/shapes.h"
#include "unit/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct inflated {
    struct scene scene;
    struct sim sim;
    struct sim_balloon *balloon;
};

/* How one is made; 0 is the usual. */
struct inflation {
    unsigned level; /* of the icosphere */
    double stretch; /* it starts at rest there */
    double turned;  /* radians: another mesh for the same balloon */
    double step;    /* times the usual one */
    unsigned workers;
    bool springs;         /* in place of the membrane, without gas */
    const char *keys[16]; /* of the scene, further ones */
};

static inline void inflated_set(struct scene *scene, const char *key, double value)
{
    struct error err = {0};
    assert_ok(rubber_key(scene, key, value, &err), &err);
}

static inline void turn_mesh(struct mesh *mesh, double angle)
{
    for (uint32_t p = 0; p < mesh->point_count; p++)
        for (int axis = 0; axis < 2; axis++) {
            double *x = &mesh->position[p][axis], *y = &mesh->position[p][axis + 1];
            const double a = angle * (1 + axis), new_x = cos(a) * *x - sin(a) * *y;
            *y = sin(a) * *x + cos(a) * *y;
            *x = new_x;
        }
}

/* Springs as stiff and heavy as the rubber: k = 4/sqrt 3 mu, all points together 4 pi. */
static inline void set_springs(struct scene *scene, double stretch, double edge)
{
    const double point_area = 0.8660254 * edge * edge;
    inflated_set(scene, "balloons[0].radius", 1);
    inflated_set(scene, "balloons[0].spring", 4 / sqrt(3));
    inflated_set(scene, "balloons[0].point_mass", point_area);
    inflated_set(scene, "balloons[0].damping", 0.173 * edge);
    inflated_set(scene, "balloons[0].pressure", rubber_pressure(stretch) * stretch * stretch * point_area);
}

static inline void inflate(struct inflated *it, const struct inflation *how)
{
    struct mesh mesh;
    struct error err = {0};
    shape_icosphere(how->level, &mesh);
    if (how->turned != 0)
        turn_mesh(&mesh, how->turned);
    assert_ok(mesh_order(&mesh, &err), &err);
    *it = (struct inflated){0};
    assert_ok(scene_from_mesh("balloon.ply", &it->scene, &err), &err);
    const double edge = sqrt(4 * 3.141592653589793 / mesh.triangle_count * 4 / sqrt(3));
    if (how->springs)
        set_springs(&it->scene, how->stretch, edge);
    else
        assert_ok(rubber_keys(&it->scene, how->stretch, 0.05, &err), &err);
    inflated_set(&it->scene, "time.step", 0.12 * edge * (how->step > 0 ? how->step : 1));
    inflated_set(&it->scene, "time.end", 100);
    assert_ok(scene_set(&it->scene, "time.guard=substep", &err), &err);
    assert_ok(scene_set(&it->scene, "balloons[0].fracture.mode=tear", &err), &err);
    for (size_t i = 0; i < sizeof how->keys / sizeof how->keys[0] && how->keys[i]; i++)
        assert_ok(scene_set(&it->scene, how->keys[i], &err), &err);
    assert_ok(scene_check(&it->scene, &err), &err);
    assert_ok(sim_open(&it->sim, &it->scene, &mesh, how->workers ? how->workers : 1, &err), &err);
    it->balloon = it->sim.balloons;
    for (uint32_t p = it->balloon->point_begin; p < it->balloon->point_end; p++)
        for (int i = 0; i < 3; i++)
            it->sim.position[p][i] *= how->stretch;
    mesh_clear(&mesh);
}

static inline void deflate(struct inflated *it)
{
    sim_clear(&it->sim);
    scene_clear(&it->scene);
}

static inline void run_until(struct inflated *it, double time)
{
    struct error err = {0};
    while (it->sim.time < time)
        assert_ok(sim_step(&it->sim, &err), &err);
}

static inline void prick(struct inflated *it)
{
    fracture_prick(&it->sim, it->balloon, (const double[3]){2, 1.7, 2.3});
}

/* Of all points: their momentum and mass. */
struct bulk {
    double momentum[3], mass;
};

static inline struct bulk bulk_of(const struct inflated *it)
{
    struct bulk bulk = {0};
    for (uint32_t p = 0; p < it->balloon->point_end; p++) {
        bulk.mass += it->sim.mass[p];
        for (int i = 0; i < 3; i++)
            bulk.momentum[i] += it->sim.mass[p] * it->sim.velocity[p][i];
    }
    return bulk;
}

/* Pricked while at rest it has, after so much time, no momentum beyond `error`, and all its mass. */
static inline void assert_a_burst_keeps_bulk(struct inflated *it, double time, double error)
{
    const double mass = bulk_of(it).mass;
    prick(it);
    run_until(it, time);
    const struct bulk after = bulk_of(it);
    assert_near(after.mass, mass, 1e-12);
    for (int i = 0; i < 3; i++)
        assert_near(after.momentum[i], 0, error);
}

/* Pieces as they hang together, counted anew from the neighbours. */
struct shreds {
    uint32_t count, fewest; /* triangles of the smallest */
    double largest;         /* share of the area at rest */
    double slenderness;     /* mean length over width of pieces above a hundredth of the area */
};

static inline uint32_t root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Longest way through a piece from triangle to triangle, found from its far ends: two
 * sweeps of shortest ways. */
static inline double length_of_piece(const struct sim_balloon *b, uint32_t start)
{
    const uint32_t count = b->triangle_end;
    double *way = malloc(count * sizeof *way), length = 0;
    uint32_t *queue = malloc((size_t)count * 16 * sizeof *queue);
    for (int sweep = 0; sweep < 3; sweep++) {
        size_t first = 0, end = 1;
        for (uint32_t t = 0; t < count; t++)
            way[t] = INFINITY;
        way[queue[0] = start] = 0;
        while (first < end) {
            const uint32_t t = queue[first++ % (16 * (size_t)count)];
            for (int k = 0; k < 3; k++) {
                const uint32_t n = b->topology->neighbour[t][k];
                if (n == MESH_NONE)
                    continue;
                const double next = way[t] + vec3_distance(b->fracture->middle[t], b->fracture->middle[n]);
                if (next < way[n] - 1e-12) {
                    way[n] = next;
                    queue[end++ % (16 * (size_t)count)] = n;
                }
            }
        }
        for (uint32_t t = 0; t < count; t++)
            if (way[t] < INFINITY && way[t] > way[start])
                start = t;
        length = way[start];
    }
    free(way);
    free(queue);
    return length;
}

static inline struct shreds count_shreds(const struct inflated *it)
{
    const struct sim_balloon *b = it->balloon;
    const struct topology *top = b->topology;
    const uint32_t count = b->triangle_end;
    uint32_t *parent = malloc(count * sizeof *parent), *triangles = calloc(count, sizeof *triangles);
    double *area = calloc(count, sizeof *area), slender = 0;
    struct shreds s = {.fewest = UINT32_MAX};
    uint32_t large = 0;
    for (uint32_t t = 0; t < count; t++)
        parent[t] = t;
    for (uint32_t t = 0; t < count; t++)
        for (int k = 0; k < 3; k++)
            if (top->neighbour[t][k] != MESH_NONE)
                parent[root(parent, t)] = root(parent, top->neighbour[t][k]);
    for (uint32_t t = 0; t < count; t++) {
        area[root(parent, t)] += top->rest_area[t];
        triangles[root(parent, t)]++;
    }
    for (uint32_t t = 0; t < count; t++) {
        if (triangles[t] == 0)
            continue;
        s.count++;
        s.fewest = triangles[t] < s.fewest ? triangles[t] : s.fewest;
        s.largest = fmax(s.largest, area[t] / top->area);
        if (area[t] > 0.01 * top->area) {
            const double length = length_of_piece(b, t);
            slender += length * length / area[t];
            large++;
        }
    }
    s.slenderness = large ? slender / large : 0;
    free(parent);
    free(triangles);
    free(area);
    return s;
}

#endif
