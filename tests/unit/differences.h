/* Forces by differences: the oracle for exact derivatives, and energies for forces. */
#ifndef TESTS_UNIT_DIFFERENCES_H
#define TESTS_UNIT_DIFFERENCES_H

#include "check.h"
#include "common/random.h"
#include "sim/jacobian.h"

typedef double (*rows)[4];

static inline rows new_rows(const struct sim *sim)
{
    const size_t bytes = sim->point_count * sizeof(double[4]);
    return memset(aligned_alloc(32, bytes), 0, bytes);
}

static inline void fill(rows x, uint32_t count, double size, uint64_t *random)
{
    for (uint32_t p = 0; p < count; p++)
        for (int i = 0; i < 3; i++)
            x[p][i] += size * (2 * random_unit(random) - 1);
}

/* Stretched by these factors along x, y and z, shaken by up to `size` of edges of .3, in
 * motion, a few triangles gone. */
static inline void deform(struct sim *sim, const double factor[3], double size)
{
    uint64_t random = 3;
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            sim->position[p][i] *= factor[i];
    fill(sim->position, sim->point_count, size, &random);
    fill(sim->velocity, sim->point_count, 1, &random);
    for (uint32_t t = 0; t < sim->triangle_count; t += 13)
        sim->triangle_active[t] = 0;
}

static inline double largest(rows a, uint32_t count)
{
    double most = 0;
    for (uint32_t p = 0; p < count; p++)
        for (int i = 0; i < 3; i++)
            most = fmax(most, fabs(a[p][i]));
    return most;
}

/* rows += s d */
static inline void shift(rows x, uint32_t count, double s, rows d)
{
    for (uint32_t p = 0; p < count; p++)
        for (int i = 0; i < 3; i++)
            x[p][i] += s * d[p][i];
}

/* The force at (x + s dx, v + s dv). */
static inline void force_at(struct sim *sim, double s, rows dx, rows dv, rows force)
{
    const size_t bytes = sim->point_count * sizeof(double[4]);
    rows x = malloc(bytes), v = malloc(bytes);
    memcpy(x, sim->position, bytes);
    memcpy(v, sim->velocity, bytes);
    shift(sim->position, sim->point_count, s, dx);
    shift(sim->velocity, sim->point_count, s, dv);
    sim_forces(sim);
    memcpy(force, sim->force, bytes);
    memcpy(sim->position, x, bytes);
    memcpy(sim->velocity, v, bytes);
    free(x);
    free(v);
}

/* Central differences over h and 2 h and Richardson's extrapolation: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) /
 * (12 h), wrong by h^4 f'''''/30 and by the rounding of f / h. */
static const double difference_place[4] = {1, -1, 2, -2}, difference_weight[4] = {8, -8, -1, 1};

/* Of the force, along (dx, dv). */
static inline void difference(struct sim *sim, double h, rows dx, rows dv, rows df)
{
    rows f = new_rows(sim);
    memset(df, 0, sim->point_count * sizeof(double[4]));
    for (int k = 0; k < 4; k++) {
        force_at(sim, difference_place[k] * h, dx, dv, f);
        shift(df, sim->point_count, difference_weight[k] / (12 * h), f);
    }
    free(f);
}

/* How far K dx + D dv is from that, at the most, along a random direction; *size becomes the
 * largest of its numbers. */
static inline double product_error(struct sim *sim, double h, uint64_t *random, double *size)
{
    rows dx = new_rows(sim), dv = new_rows(sim), exact = new_rows(sim), near = new_rows(sim);
    fill(dx, sim->point_count, 1, random);
    fill(dv, sim->point_count, 1, random);
    difference(sim, h, dx, dv, near);
    sim_force_product(sim, 1, dx, 1, dv, exact);
    *size = largest(exact, sim->point_count);
    shift(exact, sim->point_count, -1, near);
    const double error = largest(exact, sim->point_count);
    free(dx);
    free(dv);
    free(exact);
    free(near);
    return error;
}

/* Of an energy, along dx. */
static inline double energy_difference(struct sim *sim, double h, rows dx, double (*energy)(struct sim *sim))
{
    const size_t bytes = sim->point_count * sizeof(double[4]);
    rows x = malloc(bytes);
    memcpy(x, sim->position, bytes);
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        shift(sim->position, sim->point_count, difference_place[k] * h, dx);
        sum += difference_weight[k] * energy(sim) / (12 * h);
        memcpy(sim->position, x, bytes);
    }
    free(x);
    return sum;
}

/* -force . dx; *size becomes the sum of the forces' sizes. */
static inline double work_against(struct sim *sim, rows dx, double *size)
{
    double work = 0;
    *size = 0;
    sim_forces(sim);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++) {
            work -= sim->force[p][i] * dx[p][i];
            *size += fabs(sim->force[p][i]);
        }
    return work;
}

#endif
