/* "The user can change the time interval or the internal air pressure between any time steps" (paper 3.5). */
#include "common/scene_fields.h"
#include "sim/fracture.h"
#include "sim/guard.h"
#include "sim/ledger.h"

#include <math.h>
#include <string.h>

/* Of springs, and of what beside them is as stiff as they are. */
static double held_by_springs(struct sim *sim, const struct sim_balloon *balloon)
{
    return ledger_elastic(sim, balloon->edge_begin, balloon->edge_end) + effects_energy(sim);
}

/* Springs that are stretched hold more, or less, from one moment to the next: the user's work. */
static void change_springs(struct sim *sim, struct sim_balloon *balloon, double factor)
{
    const double before = sim->ledger.on ? held_by_springs(sim, balloon) : 0;
    balloon->now->spring_factor = factor;
    if (balloon->fracture && !balloon->membrane)
        balloon->fracture->now.next_look = sim->time; /* its intervals go by how stiff they were */
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++)
        sim->current_spring_const[e] = sim->init_spring_const[e] * factor;
    if (sim->ledger.on)
        sim->ledger.account.user += held_by_springs(sim, balloon) - before;
}

static void change_balloon(struct sim *sim, struct sim_balloon *balloon, const char *key, double value)
{
    if (!strcmp(key, "pressure")) {
        balloon->now->pressure = value;
    } else if (!strcmp(key, "damping") && !balloon->membrane) {
        balloon->now->damping = value;
    } else if (!strcmp(key, "threshold")) {
        balloon->now->threshold_length = value * (balloon->own_thresholds ? 1 : balloon->mean_rest_length);
    } else if (!strcmp(key, "spring_factor")) {
        change_springs(sim, balloon, value);
    } else if (!strcmp(key, "pump")) {
        balloon->now->pump = value;
    } else if (!strcmp(key, "pump_until")) {
        balloon->now->pump_until = value;
    }
}

/* Time goes on counting from here in steps of the new size. */
static void change_step(struct sim *sim, double value)
{
    sim->time_base = sim->time;
    sim->steps_since = 0;
    sim->whole_step = value;
    sim->step = value / sim->substeps;
}

void sim_change(struct sim *sim, const struct scene_schedule *entry)
{
    sim->changed = true;
    sim->edge_room = -INFINITY;
    guard_outdated(sim);
    for (size_t i = 0; i < entry->change_count; i++) {
        const char *key = entry->change[i].field->key;
        if (!strcmp(key, "step"))
            change_step(sim, entry->change[i].value);
        for (size_t b = 0; b < sim->balloon_count; b++)
            if (entry->balloon < 0 || (size_t)entry->balloon == b)
                change_balloon(sim, &sim->balloons[b], key, entry->change[i].value);
    }
}

void sim_change_due(struct sim *sim)
{
    const struct scene *scene = sim->scene;
    while (sim->next_change < scene->schedule_count && scene->schedule[sim->next_change].at <= sim->time)
        sim_change(sim, &scene->schedule[sim->next_change++]);
}
