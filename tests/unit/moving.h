/* A balloon in motion, for tests of the methods that move it: out of rest, smooth for as
 * long as nothing breaks. */
#ifndef TESTS_UNIT_MOVING_H
#define TESTS_UNIT_MOVING_H

#include "balloon.h"

#define MOVING_UNDAMPED                                                                                      \
    SETTINGS("balloons[0].damping=0", "balloons[0].pressure=4", "balloons[0].threshold=100", "time.end=0.4", \
             "time.guard=off")
#define MOVING_DAMPED                                                                          \
    SETTINGS("balloons[0].damping=0.3", "balloons[0].pressure=4", "balloons[0].threshold=100", \
             "time.end=0.4", "time.guard=off")

/* With these settings, this integrator and one setting more. */
static inline void open_moving(struct balloon *b, const char *const *settings, const char *integrator,
                               const char *also)
{
    char method[64];
    snprintf(method, sizeof method, "time.integrator=%s", integrator);
    const char *all[16] = {method, also};
    for (int i = 0; settings[i]; i++)
        all[i + 2] = settings[i];
    open_balloon(b, 2, all);
    for (uint32_t p = 0; p < b->sim.point_count; p++)
        for (int i = 0; i < 3; i++) /* long waves, so that no spring is compressed to nothing */
            b->sim.velocity[p][i] = 20 * sin(b->sim.position[p][(i + 1) % 3] / 20 + i);
}

static inline void run_to_end(struct balloon *b)
{
    struct error err = {0};
    while (!sim_at_end(&b->sim))
        assert_ok(sim_step(&b->sim, &err), &err);
}

/* RMS distance between the points of two states, over the radius. */
static inline double difference(const struct balloon *a, const struct balloon *b)
{
    double sum = 0;
    for (uint32_t p = 0; p < a->sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            sum += pow(a->sim.position[p][i] - b->sim.position[p][i], 2);
    return sqrt(sum / a->sim.point_count) / a->sim.balloons[0].radius;
}

#endif
