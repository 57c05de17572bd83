/* "The user can change the time interval or the internal air pressure between any time steps" (paper 3.5). */
#include "common/scene_fields.h"
#include "sim/sim.h"

#include <string.h>

static void change_balloon(struct sim *sim, struct sim_balloon *balloon, const char *key, double value)
{
    if (!strcmp(key, "pressure")) {
        balloon->now->pressure = value;
    } else if (!strcmp(key, "damping")) {
        balloon->now->damping = value;
    } else if (!strcmp(key, "threshold")) {
        balloon->now->threshold_length = value * balloon->mean_rest_length;
    } else if (!strcmp(key, "spring_factor")) {
        balloon->now->spring_factor = value;
        for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++)
            sim->current_spring_const[e] = sim->init_spring_const[e] * value;
    }
}

/* Time goes on counting from here in steps of the new size. */
static void change_step(struct sim *sim, double value)
{
    sim->time_base = sim->time;
    sim->steps_since = 0;
    sim->step = value;
}

void sim_change(struct sim *sim, const struct scene_schedule *entry)
{
    for (size_t i = 0; i < entry->change_count; i++) {
        const char *key = entry->change[i].field->key;
        if (!strcmp(key, "step"))
            change_step(sim, entry->change[i].value);
        for (size_t b = 0; b < sim->balloon_count; b++)
            if (entry->balloon < 0 || (size_t)entry->balloon == b)
                change_balloon(sim, &sim->balloons[b], key, entry->change[i].value);
    }
}
