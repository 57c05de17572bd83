#include "sim/effects.h"
#include "common/array.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

const struct effect *const effects[] = {
    &effect_spring_by_height,
    &effect_rip,
    &effect_membrane,
    &effect_bending,
    &effect_viscosity,
    &effect_plasticity,
    &effect_areas,
    &effect_gas,
    &effect_tube, /* after the gas of both balloons */
    &effect_needles,
    &effect_ground,
    &effect_obstacles,
    &effect_contact,
    &effect_gravity,
    &effect_drag,
    &effect_string,
    &effect_pins, /* takes away what the others add */
    &effect_fracture,
    NULL,
};

bool effect_is_wanted(const struct effect *effect, const struct scene *scene)
{
    if (effect->scene_wanted)
        return effect->scene_wanted(scene);
    for (size_t i = 0; i < scene->balloon_count; i++)
        if (effect->wanted(&scene->balloons[i]))
            return true;
    return false;
}

size_t effects_count(const struct scene *scene)
{
    size_t count = 0;
    for (const struct effect *const *effect = effects; *effect; effect++)
        count += effect_is_wanted(*effect, scene);
    return count;
}

static bool is_wanted(const struct sim *sim, const struct effect *effect, const struct sim_balloon *balloon)
{
    if (effect->scene_wanted)
        return balloon == sim->balloons && effect->scene_wanted(sim->scene);
    return effect->wanted(balloon->scene);
}

/* Counts the hooks of a phase, and stores them where there is an array to store them in. */
static size_t list_hooks(struct sim *sim, enum effect_phase phase, struct effect_hook *hooks)
{
    size_t count = 0;
    for (const struct effect *const *effect = effects; *effect; effect++)
        for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
            if ((*effect)->phase == phase && is_wanted(sim, *effect, b)) {
                if (hooks)
                    hooks[count] = (struct effect_hook){*effect, b};
                count++;
            }
    return count;
}

static enum status open_hooks(struct sim *sim, struct error *err)
{
    enum status status = STATUS_OK;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase] && !status; i++)
            if (sim->hooks[phase][i].effect->open)
                status = sim->hooks[phase][i].effect->open(sim, sim->hooks[phase][i].balloon, err);
    return status;
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
    return open_hooks(sim, err);
}

/* Those that were not opened have nothing to close: what they keep is still empty. */
void effects_close(struct sim *sim)
{
    for (int phase = 0; phase < EFFECT_PHASES; phase++) {
        for (size_t i = 0; sim->hooks[phase] && i < sim->hook_count[phase]; i++)
            if (sim->hooks[phase][i].effect->close)
                sim->hooks[phase][i].effect->close(sim, sim->hooks[phase][i].balloon);
        free(sim->hooks[phase]);
    }
}

/* What hooks are left to finish, from the first to before the last. */
struct unfinished {
    size_t first, last;
};

static void finish_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct unfinished *left = context;
    for (size_t i = left->first; i < left->last; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->finish)
            hook->effect->finish(sim, hook->balloon, part);
    }
}

static void finish(struct sim *sim, struct unfinished left)
{
    bool any = false;
    for (size_t i = left.first; i < left.last; i++)
        any |= sim->hooks[EFFECT_FORCES][i].effect->finish != NULL;
    if (any)
        sim_each_part(sim, finish_part, &left);
}

/* Runs the hooks of a phase; whatever they leave to finish is done before the next one that applies anything.
 * Returns the first that is left. */
static size_t apply(struct sim *sim, enum effect_phase phase)
{
    size_t first = 0;
    for (size_t i = 0; i < sim->hook_count[phase]; i++) {
        if (!sim->hooks[phase][i].effect->apply)
            continue;
        if (phase == EFFECT_FORCES)
            finish(sim, (struct unfinished){first, i});
        first = i;
        sim->hooks[phase][i].effect->apply(sim, sim->hooks[phase][i].balloon);
    }
    return first;
}

size_t effects_begin_forces(struct sim *sim)
{
    return apply(sim, EFFECT_FORCES);
}

void effects_finish_forces(struct sim *sim, const struct sim_part *part, size_t first)
{
    finish_part(sim, part, &(struct unfinished){first, sim->hook_count[EFFECT_FORCES]});
}

void effects_copied(struct sim *sim, const struct sim_balloon *balloon, uint32_t point, uint32_t copy,
                    double share)
{
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->copied && hook->balloon == balloon)
            hook->effect->copied(sim, hook->balloon, point, copy, share);
    }
}

static void after_forces(struct sim *sim)
{
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++)
        if (sim->hooks[EFFECT_FORCES][i].effect->after)
            sim->hooks[EFFECT_FORCES][i].effect->after(sim, sim->hooks[EFFECT_FORCES][i].balloon);
}

/* What is held by effects that do not tell what is in an edge or a triangle, to be counted when that goes:
 * before anything did in this step, or now. */
static double held_as_a_whole(struct sim *sim, bool before)
{
    double energy = 0;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        const struct effect *effect = hook->effect;
        if (!effect->energy || effect->edge_energy || effect->triangle_energy)
            continue;
        energy += before && effect->energy_before ? effect->energy_before(sim, hook->balloon)
                                                  : effect->energy(sim, hook->balloon);
    }
    return energy;
}

/* Nothing moves between two steps: what there is less of afterwards went at once. */
void effects_run(struct sim *sim, enum effect_phase phase)
{
    const bool counted = sim->ledger.on && phase == EFFECT_AFTER_STEP;
    const double held = counted ? held_as_a_whole(sim, true) : 0;
    const size_t first = apply(sim, phase);
    if (phase == EFFECT_FORCES)
        finish(sim, (struct unfinished){first, sim->hook_count[phase]});
    if (phase == EFFECT_AFTER_STEP)
        after_forces(sim);
    if (counted)
        sim->ledger.account.let_go += held - held_as_a_whole(sim, false);
}

/* What turns points back does so at a step's end, which no method's estimate of its error sees. Once skin has
 * broken no run is another to any tolerance. */
static void note_met(struct sim *sim, const char *effect)
{
    const struct integrator *method = sim->integrator;
    sim->met = sim->time;
    if (!sim->broken && (method->choose || method->flags & INTEGRATOR_ADAPTIVE))
        sim_tell(sim, sim->balloons, effect,
                 "turns points back, at the ends of steps: that error goes with the step, not with "
                 "time.tolerance (--estimate tells it)");
}

enum status effects_settle(struct sim *sim, struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; i < sim->hook_count[EFFECT_MOVED] && !status; i++) {
        const struct effect *effect = sim->hooks[EFFECT_MOVED][i].effect;
        status = effect->settle(sim, err);
        if (sim->changed && !isfinite(sim->met))
            note_met(sim, effect->name);
    }
    sim->swept &= !sim->changed || sim->pushed;
    return status;
}

double effects_due(const struct sim *sim)
{
    double due = INFINITY;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++) {
            const struct effect_hook *hook = &sim->hooks[phase][i];
            const double at = hook->effect->due ? hook->effect->due(hook->balloon) : INFINITY;
            if (at > sim->time)
                due = fmin(due, at);
        }
    return due;
}

enum status effects_check(struct sim *sim, struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES] && !status; i++)
        if (sim->hooks[EFFECT_FORCES][i].effect->check)
            status = sim->hooks[EFFECT_FORCES][i].effect->check(sim, sim->hooks[EFFECT_FORCES][i].balloon,
                                                                err);
    return status;
}

void sim_tell(struct sim *sim, const struct sim_balloon *balloon, const char *effect, const char *text)
{
    if (sim->news_count < SIM_NEWS_EACH * sim->balloon_count)
        sim->news[sim->news_count++] = (struct sim_news){sim->time, effect, text,
                                                         (size_t)(balloon - sim->balloons)};
}

size_t effects_blocks(struct sim *sim, struct sim_block *blocks)
{
    size_t count = 0;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++)
            if (sim->hooks[phase][i].effect->blocks) {
                const struct effect_hook *hook = &sim->hooks[phase][i];
                const size_t more = hook->effect->blocks(sim, hook->balloon, &blocks[count]);
                assert(more <= EFFECT_BLOCKS_MAX);
                count += more;
            }
    return count;
}

size_t effects_left(struct sim *sim, struct sim_block *blocks)
{
    size_t count = 0;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->left)
            count += hook->effect->left(sim, hook->balloon, &blocks[count]);
    }
    return count;
}

double effects_energy(struct sim *sim)
{
    double energy = 0;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++)
            if (sim->hooks[phase][i].effect->energy)
                energy += sim->hooks[phase][i].effect->energy(sim, sim->hooks[phase][i].balloon);
    return energy;
}

void effects_power(struct sim *sim, double *dissipated, double *work)
{
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++)
            if (sim->hooks[phase][i].effect->power)
                sim->hooks[phase][i].effect->power(sim, sim->hooks[phase][i].balloon, dissipated, work);
}

double effects_edge_energy(const struct sim *sim, uint32_t edge)
{
    double energy = 0;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->edge_energy && edge >= hook->balloon->edge_begin && edge < hook->balloon->edge_end)
            energy += hook->effect->edge_energy(sim, hook->balloon, edge);
    }
    return energy;
}

double effects_triangle_energy(const struct sim *sim, uint32_t triangle)
{
    double energy = 0;
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->triangle_energy && triangle >= hook->balloon->triangle_begin &&
            triangle < hook->balloon->triangle_end)
            energy += hook->effect->triangle_energy(sim, hook->balloon, triangle);
    }
    return energy;
}
