#include "sim/effects.h"
#include "common/array.h"

const struct effect *const effects[] = {
    &effect_spring_by_height,
    &effect_rip,
    NULL,
};

/* Counts the hooks of a phase, and stores them where there is an array to store them in. */
static size_t list_hooks(struct sim *sim, enum effect_phase phase, struct effect_hook *hooks)
{
    size_t count = 0;
    for (const struct effect *const *effect = effects; *effect; effect++)
        for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
            if ((*effect)->phase == phase && (*effect)->wanted(b->scene)) {
                if (hooks)
                    hooks[count] = (struct effect_hook){*effect, b};
                count++;
            }
    return count;
}

enum status effects_resolve(struct sim *sim, struct error *err)
{
    for (enum effect_phase phase = 0; phase < EFFECT_PHASES; phase++) {
        sim->hook_count[phase] = list_hooks(sim, phase, NULL);
        if (sim->hook_count[phase] == 0)
            continue;
        sim->hooks[phase] = array_new(sim->hook_count[phase], sizeof *sim->hooks[phase]);
        if (!sim->hooks[phase])
            return error_no_memory(err, "the effects");
        list_hooks(sim, phase, sim->hooks[phase]);
    }
    return STATUS_OK;
}

void effects_run(struct sim *sim, enum effect_phase phase)
{
    for (size_t i = 0; i < sim->hook_count[phase]; i++)
        sim->hooks[phase][i].effect->apply(sim, sim->hooks[phase][i].balloon);
}
