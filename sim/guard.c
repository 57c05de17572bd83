#include "sim/guard_bound.h"
#include "sim/membrane.h"
#include "sim/reorder.h"
#include "sim/sweep.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum status guard_open(struct sim *sim, struct error *err)
{
    struct guard *guard = sim->guard = calloc(1, sizeof *guard);
    if (!guard)
        return error_no_memory(err, "the guard");
    double **arrays[] = {
        &guard->x,        &guard->springs, &guard->dampers, &guard->rows.stiffness, &guard->rows.damping,
        &guard->rows.push};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        if (!(*arrays[i] = sim_table(sim, sim->point_count, sizeof **arrays[i])))
            return error_no_memory(err, "the guard");
    for (uint32_t p = 0; p < sim->point_count; p++)
        guard->x[p] = 1;
    sim->substeps = 1;
    sim->whole_step = sim->step;
    return STATUS_OK;
}

void guard_close(struct sim *sim)
{
    struct guard *guard = sim->guard;
    if (!guard)
        return;
    double *arrays[] = {
        guard->x,        guard->springs, guard->dampers, guard->rows.stiffness, guard->rows.damping,
        guard->rows.push};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    free(guard);
    sim->guard = NULL;
}

void guard_outdated(struct sim *sim)
{
    sim->guard->memory.is_known = GUARD_UNKNOWN;
}

void guard_bound_outdated(struct sim *sim)
{
    if (sim->guard->memory.is_known != GUARD_UNKNOWN)
        sim->guard->memory.is_known = GUARD_REACH_KNOWN;
}

size_t guard_blocks(struct sim *sim, struct sim_block *blocks)
{
    blocks[0] = (struct sim_block){"guard", &sim->guard->memory, sizeof sim->guard->memory};
    const size_t size = sim->point_count * sizeof *sim->guard->x;
    blocks[1] = (struct sim_block){"guard's vector", sim->guard->x, size};
    if (sim->fingerprint == 0) /* nothing can be cut: guard_cut() alone goes by what the last bound found */
        return 2;
    blocks[2] = (struct sim_block){"guard's stiffness", sim->guard->rows.stiffness, size};
    blocks[3] = (struct sim_block){"guard's damping", sim->guard->rows.damping, size};
    return 4;
}

/* The kinetic energy of a block of points, or no number when one of their places or speeds is none: 0 times
 * that is NaN, and 0 for any other. */
static double moving_energy(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    (void)context;
    double energy[4] = {0};
    for (uint32_t p = begin; p < end; p++)
        for (int i = 0; i < 4; i++)
            energy[i] += sim->mass[p] * sim->velocity[p][i] * sim->velocity[p][i] + 0 * sim->position[p][i];
    return (energy[0] + energy[1] + energy[2]) / 2;
}

/* What the points can have from now on: at least what they have. `least` is 1e-12 of what it takes to stretch
 * every edge by its own length, in energy: six digits above what rounding makes of a balloon at rest. */
static void find_reach(struct sim *sim)
{
    struct guard_memory *memory = &sim->guard->memory;
    double energy = vector_sum(sim, moving_energy, NULL), scale = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        if (sim->edge_active[e])
            energy += sim_spring_energy(sim, e);
        scale += sim->current_spring_const[e] * sim->rest_length[e] * sim->rest_length[e];
    }
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->membrane) {
            energy += membrane_elastic(sim, b);
            scale += membrane_scale(b);
        }
    energy += fmax(effects_energy(sim), 0); /* what bent skins and taut strings hold, too */
    memory->least = 1e-12 * scale;
    memory->reach = fmax(memory->reach, sqrt(2 * energy));
}

/* Edges that let go leave the rest stabler: worth another look once an eighth of them has. */
static bool is_worth_a_look(const struct sim *sim)
{
    const struct guard_memory *memory = &sim->guard->memory;
    return sim->substeps > 1 && sim->broken - memory->broken > (sim->edge_count - memory->broken) / 8;
}

static void look(struct sim *sim)
{
    const uint64_t known = sim->guard->memory.is_known;
    if (known == GUARD_UNKNOWN)
        find_reach(sim);
    if (known != GUARD_KNOWN || is_worth_a_look(sim))
        guard_find_bound(sim);
}

double guard_stable_step(struct sim *sim)
{
    look(sim);
    return sim->guard->memory.stable;
}

static void set_parts(struct sim *sim, uint32_t parts)
{
    if (parts == sim->substeps)
        return;
    sim->substeps = parts;
    sim->step = sim->whole_step / parts;
    sim->time_base = sim->time;
    sim->steps_since = 0;
    sim->changed = true;
}

/* The fewest equal parts that are stable, beyond rounding. */
static double parts_needed(const struct sim *sim)
{
    if (sim->integrator->flags & INTEGRATOR_ADAPTIVE)
        return 1;
    return fmax(ceil(sim->whole_step / sim->guard->memory.stable * (1 - 1e-12)), 1);
}

/* In words: what asks for most of the bound, in a balloon. */
static const char *cause_of(const struct sim *sim, const struct sim_balloon *b)
{
    const uint32_t cause = sim->guard->memory.cause;
    if (cause >= GUARD_EFFECTS && cause - GUARD_EFFECTS < sim->hook_count[EFFECT_FORCES]) {
        const char *key = sim->hooks[EFFECT_FORCES][cause - GUARD_EFFECTS].effect->name;
        return strcmp(key, "pressure_on") ? key : "pressure";
    }
    if (cause == GUARD_SPRINGS)
        return b->membrane ? "membrane" : "springs";
    if (cause == GUARD_DAMPERS)
        return b->membrane ? "membrane's viscosity" : "dampers";
    return "pressure";
}

void guard_describe_follow(const struct sim *sim, const struct guard_follow *follow, char *text, size_t size)
{
    snprintf(text, size, "steps up to %.3g follow %s of balloons[%zu], %s", follow->step,
             follow->effect->follows, (size_t)(follow->balloon - sim->balloons), follow->effect->follows_why);
}

static void describe(struct sim *sim, bool is_refused, char *text, size_t size)
{
    const struct guard_memory *memory = &sim->guard->memory;
    const double step = sim->whole_step, stable = guard_stable_step(sim), parts = parts_needed(sim);
    const char *method = sim->acting->name;
    if (!(stable < INFINITY)) {
        snprintf(text, size, "every step is stable for %s", method);
        return;
    }
    size_t b = 0;
    while (b + 1 < sim->balloon_count && memory->point >= sim->balloons[b].point_end)
        b++;
    int used = 0;
    if (parts > 1 && parts <= GUARD_PARTS_MAX && !is_refused && sim->scene->time.guard == SCENE_GUARD_SUBSTEP)
        used = snprintf(text, size, "time.step %g is split in %.0f: ", step, parts);
    else if (parts > 1)
        used = snprintf(text, size, "time.step %g is too large%s: ", step,
                        sim->scene->time.guard == SCENE_GUARD_SUBSTEP ? " to be split" : "");
    if (memory->cause == GUARD_FOLLOW && guard_following(sim).effect) {
        const struct guard_follow follow = guard_following(sim);
        guard_describe_follow(sim, &follow, text + used, size - (size_t)used);
        return;
    }
    snprintf(
        text + used, size - (size_t)used,
        "steps up to %.3g are surely stable for %s; most of that is for the %s at point %u of balloons[%zu]",
        stable, method, cause_of(sim, &sim->balloons[b]), reorder_name(&sim->balloons[b], memory->point), b);
}

void guard_describe(struct sim *sim, char *text, size_t size)
{
    describe(sim, false, text, size);
}

static enum status refuse(struct sim *sim, struct error *err)
{
    char text[256];
    describe(sim, true, text, sizeof text);
    return error_set(err, STATUS_DIVERGED, "%s: refused at time %g: %s", sim->scene->path, sim->time, text);
}

enum status guard_longest_step(struct sim *sim, double *longest, struct error *err)
{
    *longest = sim->scene->time.guard == SCENE_GUARD_OFF ? INFINITY : guard_stable_step(sim);
    return sim->whole_step <= *longest * GUARD_PARTS_MAX ? STATUS_OK : refuse(sim, err);
}

/* Within a step that is split already: what was stable at its start no longer is, since speeds
 * or stretches have grown. */
static enum status split_further(struct sim *sim, struct error *err)
{
    const double more = ceil(sim->step / sim->guard->memory.stable * (1 - 1e-12));
    if (!(more > 1) || sim->integrator->flags & INTEGRATOR_ADAPTIVE)
        return STATUS_OK;
    if (!(more * sim->substeps <= GUARD_PARTS_MAX))
        return refuse(sim, err);
    sim->substeps *= (uint32_t)more;
    sim->steps_since *= (uint64_t)more;
    sim->step = sim->whole_step / sim->substeps;
    sim->changed = true;
    return STATUS_OK;
}

enum status guard_step(struct sim *sim, bool first, struct error *err)
{
    const int guard = sim->scene->time.guard;
    look(sim);
    if (!first)
        return guard == SCENE_GUARD_SUBSTEP ? split_further(sim, err) : STATUS_OK;
    const double wanted = fmax(sim->wanted_substeps, 1),
                 parts = guard == SCENE_GUARD_OFF ? wanted : fmax(parts_needed(sim), wanted);
    if (parts > wanted && (guard == SCENE_GUARD_REFUSE || !(parts <= GUARD_PARTS_MAX)))
        return refuse(sim, err);
    set_parts(sim, (uint32_t)parts * sim->finer);
    return STATUS_OK;
}

/* What is chosen by trials splits for the points by itself; what moves beside them is alike for all. */
static enum status may_follow(struct sim *sim, struct error *err)
{
    double longest;
    guard_stable_step(sim);
    const bool follows = guard_following(sim).step * GUARD_PARTS_MAX < sim->whole_step;
    return follows ? guard_longest_step(sim, &longest, err) : STATUS_OK;
}

enum status guard_may_step(struct sim *sim, struct error *err)
{
    const struct integrator *method = sim->integrator;
    const bool first = sim->steps_since % sim->substeps == 0;
    double longest;
    if (sim_at_end(sim))
        return STATUS_OK;
    if (first)
        sim_change_due(sim);
    enum status status = method->choose ? may_follow(sim, err) : guard_step(sim, first, err);
    if (!status && method->flags & INTEGRATOR_ADAPTIVE)
        status = guard_longest_step(sim, &longest, err);
    return status;
}

double guard_passed(const struct sim *sim)
{
    const double more = parts_needed(sim) / sim->substeps;
    return sim->scene->time.guard == SCENE_GUARD_OFF && more > 1 ? more : 0;
}

/* The most kinetic energy that numbers which do not run away have. */
static double most_energy(const struct guard_memory *memory)
{
    return 1e6 * fmax(memory->reach * memory->reach / 2, memory->least);
}

enum status guard_check(struct sim *sim, struct error *err)
{
    struct guard_memory *memory = &sim->guard->memory;
    memory->reach += memory->push * sim->taken;
    if (sweep_saw_energy(sim) <=
        most_energy(memory) / 2) /* far from where the order of its sum could matter */
        return STATUS_OK;
    const double energy = vector_sum(sim, moving_energy, NULL), before = memory->push;
    if (energy <= most_energy(memory))
        return STATUS_OK;
    if (isfinite(energy)) { /* what pushes may have grown within the step, as a pump's gas does */
        guard_find_bound(sim);
        memory->reach += fmax(memory->push - before, 0) * sim->taken;
    }
    return energy <= most_energy(memory) ? STATUS_OK : sim_diverged(sim, energy, err);
}
