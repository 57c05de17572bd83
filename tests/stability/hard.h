/* What the hard cases share: a guarded balloon, how much of what it has, and textbook Euler as
 * the one who must fail. */
#ifndef TESTS_STABILITY_HARD_H
#define TESTS_STABILITY_HARD_H

#include "common/random.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "unit/balloon.h"

/* The paper's balloon with a scene's defaults, in which the guard splits steps; nothing breaks
 * unless a test wants it to. */
#define HARD(...) SETTINGS("time.guard=substep", "balloons[0].threshold=1e300" __VA_OPT__(, ) __VA_ARGS__)
/* The same without a guard, by textbook Euler. */
#define EULER(...) \
    SETTINGS("time.integrator=explicit-euler", "balloons[0].threshold=1e300" __VA_OPT__(, ) __VA_ARGS__)

/* Moves every point at random by up to `size`. */
static inline void disturb(struct balloon *b, double size)
{
    uint64_t random = 7;
    for (uint32_t p = 0; p < b->sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b->sim.position[p][i] += size * (2 * random_unit(&random) - 1);
    guard_outdated(&b->sim); /* it has energy of its own now */
}

static inline double energy_of(struct balloon *b)
{
    const struct sim_measures m = sim_measure(&b->sim);
    return m.kinetic_energy + m.elastic_energy;
}

/* All that a balloon that began at rest can have in kinetic and elastic energy, by the pressures alone:
 * sqrt(2 E) grows by sqrt(sum P^2/m) a second at most (guard.h). */
static inline double reachable(const struct balloon *b, double pressure)
{
    double push = 0;
    for (uint32_t p = 0; p < b->sim.point_count; p++)
        push += pressure * pressure / b->sim.mass[p];
    return push * b->sim.time * b->sim.time / 2;
}

static inline void momentum_of(const struct sim *sim, double momentum[3])
{
    for (int i = 0; i < 3; i++)
        momentum[i] = 0;
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            momentum[i] += sim->mass[p] * sim->velocity[p][i];
}

/* The sum of |m v|: what errors of the momentum are measured by. */
static inline double impulse_of(const struct sim *sim)
{
    double sum = 0;
    for (uint32_t p = 0; p < sim->point_count; p++)
        sum += sim->mass[p] * vec3_length(sim->velocity[p]);
    return sum;
}

static inline void assert_finite(const struct sim *sim)
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_true(isfinite(sim->position[p][i]) && isfinite(sim->velocity[p][i]));
}

/* Within `count` steps the run is given up, and the message says where and which step would do. */
static inline void assert_diverges(struct balloon *b, int count)
{
    struct error err = {0};
    enum status status = STATUS_OK;
    while (count-- && !status)
        status = sim_step(&b->sim, &err);
    assert_refused(status, STATUS_DIVERGED, "diverged at time", &err);
    assert_non_null(strstr(err.text, "of balloons[0] is at"));
    assert_non_null(strstr(err.text, "on an edge of length"));
    assert_non_null(strstr(err.text, "is too large: steps up to"));
}

#endif
