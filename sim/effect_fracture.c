/* What tears, how its strength is scattered, and what the gas and the checkpoint are told:
 * fracture.h is the rule. */
#include "common/vec3.h"
#include "sim/checkpoint.h"
#include "sim/effects.h"
#include "sim/fracture.h"
#include "sim/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->fracture.on && balloon->fracture.mode == SCENE_FRACTURE_TEAR;
}

/* A number from -1 to 1 for each cell of a lattice, from SplitMix64's last three lines (common/random.h). */
static double lattice(uint64_t seed, int64_t x, int64_t y, int64_t z)
{
    uint64_t h = seed * 0x9e3779b97f4a7c15u + (uint64_t)x * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 30)) + (uint64_t)y * 0x94d049bb133111ebu;
    h = ((h ^ (h >> 27)) + (uint64_t)z) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 30)) * 0x94d049bb133111ebu;
    return (double)((h ^ (h >> 31)) >> 11) * 0x1p-52 - 1;
}

/* Smooth from cell to cell, a cell being 0.12 R: a property of the skin, whatever its mesh. */
static double noise_at(uint64_t seed, const double place[3], double cell)
{
    int64_t low[3];
    double share[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        const double x = place[i] / cell;
        low[i] = (int64_t)floor(x);
        share[i] = x - floor(x);
        share[i] *= share[i] * (3 - 2 * share[i]);
    }
    for (int k = 0; k < 8; k++) {
        double weight = 1;
        for (int i = 0; i < 3; i++)
            weight *= k >> i & 1 ? share[i] : 1 - share[i];
        sum += weight * lattice(seed, low[0] + (k & 1), low[1] + (k >> 1 & 1), low[2] + (k >> 2 & 1));
    }
    return sum;
}

/* A triangle no wider than this share of its longest side. */
static const double next_to_line = 0.02;

static void measure_triangles(const struct sim *sim, const struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t], i = t - b->triangle_begin;
        double d1[3], d2[3], cross[3];
        sim_sides(sim, t, d1, d2);
        vec3_cross(d1, d2, cross);
        f->shape[i][0] = vec3_length(d1);
        f->shape[i][1] = vec3_dot(d1, d2) / f->shape[i][0];
        const double twice = vec3_length(cross),
                     square = fmax(fmax(vec3_dot(d1, d1), vec3_dot(d2, d2)),
                                   vec3_dot(d1, d1) - 2 * vec3_dot(d1, d2) + vec3_dot(d2, d2));
        f->shape[i][2] = twice > next_to_line * square ? twice / f->shape[i][0] : 0;
        for (int k = 0; k < 3; k++)
            f->middle[i][k] = sim->position[p[0]][k] + (d1[k] + d2[k]) / 3;
        double from_centre[3];
        vec3_sub(f->middle[i], b->centre, from_centre);
        f->noise[i] = noise_at((uint64_t)b->scene->fracture.seed, from_centre, 0.12 * b->radius);
    }
}

/* Patches: from the first triangle that has none, all that hang together within 0.15 R of it;
 * scraps join a neighbour. */
static void make_patches(const struct sim_balloon *b, uint32_t *queue)
{
    struct fracture *f = b->fracture;
    const struct topology *top = b->topology;
    const uint32_t count = b->triangle_end - b->triangle_begin;
    const double reach = 0.15 * b->radius;
    memset(f->patch, 0xff, count * sizeof *f->patch);
    for (uint32_t t = 0; t < count; t++) {
        if (f->patch[t] != MESH_NONE)
            continue;
        uint32_t first = 0, end = 1, neighbour = MESH_NONE;
        double area = 0;
        queue[0] = t;
        f->patch[t] = f->patch_count;
        while (first < end) {
            const uint32_t at = queue[first++];
            area += top->rest_area[at];
            for (int k = 0; k < 3; k++) {
                const uint32_t n = top->neighbour[at][k] - b->triangle_begin;
                if (top->neighbour[at][k] == MESH_NONE || f->patch[n] == f->patch_count)
                    continue;
                if (f->patch[n] != MESH_NONE) {
                    neighbour = f->patch[n];
                } else if (vec3_distance(f->middle[n], f->middle[t]) < reach) {
                    f->patch[n] = f->patch_count;
                    queue[end++] = n;
                }
            }
        }
        if (neighbour != MESH_NONE && area < reach * reach) {
            for (uint32_t i = 0; i < end; i++)
                f->patch[queue[i]] = neighbour;
            f->patch_area[neighbour] += area;
        } else {
            f->patch_area[f->patch_count++] = area;
        }
    }
}

/* Of shear waves at rest: sqrt(mu/rho), or that of a lattice of springs: its shear modulus is sqrt(3)/4 k and
 * its mass by area 2 m/(sqrt 3 r^2) (Seung & Nelson, Phys. Rev. A 38 (1988) 1005), so that c = r sqrt(3 k/(8
 * m)). */
static double wave_speed(const struct sim *sim, const struct sim_balloon *b)
{
    double stiffness = 0, mass = 0;
    if (b->membrane)
        return sqrt(b->membrane->modulus / b->scene->membrane.density);
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        stiffness += sim->init_spring_const[e] / (b->edge_end - b->edge_begin);
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        mass += sim->mass[p] / (b->point_end - b->point_begin);
    return b->mean_rest_length * sqrt(3 * stiffness / (8 * mass));
}

static bool allocate(struct sim *sim, const struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    const size_t triangles = b->triangle_end - b->triangle_begin, points = b->point_room - b->point_begin;
    f->list_room = 8 + (uint32_t)(2 * b->scene->fracture.smallest * (double)triangles);
    f->shape = sim_table(sim, triangles, sizeof *f->shape);
    f->energy = sim_table(sim, triangles, sizeof *f->energy);
    f->noise = sim_table(sim, triangles, sizeof *f->noise);
    f->middle = sim_table(sim, triangles, sizeof *f->middle);
    f->patch = sim_table(sim, triangles, sizeof *f->patch);
    f->patch_sum = sim_table(sim, triangles, sizeof *f->patch_sum);
    f->patch_area = sim_table(sim, triangles, sizeof *f->patch_area);
    f->list = sim_table(sim, triangles + 1, sizeof *f->list);
    f->seen = sim_table(sim, triangles, sizeof *f->seen);
    f->stamp = sim_table(sim, points, sizeof *f->stamp);
    f->tips = sim_table(sim, TIPS_MAX, sizeof *f->tips);
    f->births = sim_table(sim, BIRTHS_MAX, sizeof *f->births);
    f->rims.side = sim_table(sim, b->topology->rim_room, sizeof *f->rims.side);
    f->rims.hole = sim_table(sim, b->topology->rim_room, sizeof *f->rims.hole);
    f->hole_of = sim_table(sim, 3 * triangles, sizeof *f->hole_of);
    f->lost = sim_table(sim, triangles, sizeof *f->lost);
    return f->shape && f->energy && f->noise && f->middle && f->patch && f->patch_sum && f->patch_area &&
           f->list && f->seen && f->stamp && f->tips && f->births && f->rims.side && f->rims.hole &&
           f->hole_of && f->lost;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    enum status status = topology_open(sim, b, err);
    if (status)
        return status;
    struct fracture *f = b->fracture = calloc(1, sizeof *f);
    if (!f || !allocate(sim, b))
        return error_no_memory(err, "the cracks");
    const struct scene_fracture *scene = &b->scene->fracture;
    measure_triangles(sim, b);
    make_patches(b, f->list);
    f->radius = b->radius;
    f->wave_speed = wave_speed(sim, b);
    f->whole_energy = fracture_equal_energy(scene->strength);
    f->branch_energy = fracture_equal_energy(scene->branching);
    b->rims = &f->rims;
    sim->fingerprint = checkpoint_fingerprint(sim);
    return STATUS_OK;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    struct fracture *f = b->fracture;
    topology_close(b);
    b->rims = NULL;
    b->fracture = NULL;
    if (!f)
        return;
    void *arrays[] = {f->shape,      f->energy,    f->noise,   f->middle, f->patch, f->patch_sum,
                      f->patch_area, f->list,      f->seen,    f->stamp,  f->tips,  f->births,
                      f->rims.side,  f->rims.hole, f->hole_of, f->lost};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    free(f);
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *list)
{
    struct fracture *f = b->fracture;
    const size_t triangles = b->triangle_end - b->triangle_begin;
    const struct sim_block own[] = {
        {"cracks", &f->now, sizeof f->now},
        {"tips", f->tips, TIPS_MAX * sizeof *f->tips},
        {"births", f->births, BIRTHS_MAX * sizeof *f->births},
        {"patches", f->patch_sum, triangles * sizeof *f->patch_sum},
        {"fallen", f->lost, triangles},
    };
    memcpy(list, own, sizeof own);
    return sizeof own / sizeof own[0] + topology_blocks(sim, b, list + sizeof own / sizeof own[0]);
}

const struct effect effect_fracture = {
    .name = "fracture",
    .phase = EFFECT_AFTER_STEP,
    .wanted = wanted,
    .open = open,
    .close = close,
    .apply = fracture_step,
    .blocks = blocks,
    .source = "Griffith 1921; Petersan et al. 2004; Moulinet & Adda-Bedia 2015"};
