/*
 * The method that chooses a method: trials of the present state (trial.h) say which of the candidates, in how
 * many substeps, keeps its error within time.tolerance for the least work. Work is counted in evaluations of
 * the forces, so that the choice, and with it every bit of the result, is the same on any machine.
 *
 * It chooses before the first step, again after 32, 256, 2048, ... of the scene's steps, since a balloon at
 * rest does not show what it will be like in motion, whenever the schedule changes something, and when four
 * times as many edges have let go.
 */
#include "sim/auto.h"
#include "sim/auto_search.h"
#include "sim/guard_bound.h"
#include "sim/methods.h"
#include "sim/weights.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Calls open or close of a candidate as if it were the scene's method. */
static enum status open_candidate(struct sim *sim, int i, struct error *err)
{
    struct auto_method *m = sim->method;
    enum status status = STATUS_OK;
    assert(auto_candidates[i]->vectors <= AUTO_GUARD_ROW);
    m->is_open[i] = true;
    if (i > 0 && auto_candidates[i]->open && auto_candidates[i]->open == auto_candidates[i - 1]->open) {
        m->own[i] = m->own[i - 1];
        return STATUS_OK;
    }
    sim->method = NULL;
    if (auto_candidates[i]->open)
        status = auto_candidates[i]->open(sim, err);
    m->own[i] = sim->method;
    sim->method = m;
    return status;
}

static void close(struct sim *sim)
{
    struct auto_method *m = sim->method;
    for (int i = 0; i < AUTO_CANDIDATES && m; i++)
        if (m->is_open[i] && auto_candidates[i]->close && (i == 0 || m->own[i] != m->own[i - 1])) {
            sim->method = m->own[i];
            auto_candidates[i]->close(sim);
        }
    free(m);
    sim->method = NULL;
}

static enum status open(struct sim *sim, struct error *err)
{
    enum status status = weights_open(sim, err);
    sim->method = calloc(1, sizeof(struct auto_method));
    if (!sim->method)
        return error_no_memory(err, "the choice of a method");
    sim->acting = auto_candidates[0];
    const double stable = guard_stable_step(sim);
    const bool is_stiff = sim->whole_step > AUTO_STIFF * stable;
    ((struct auto_method *)sim->method)->memory.stable = stable;
    for (int i = 0; i < AUTO_CANDIDATES && !status; i++)
        if (is_stiff || !(auto_candidates[i]->flags & INTEGRATOR_IMPLICIT))
            status = open_candidate(sim, i, err);
    return status;
}

static bool is_due(const struct sim *sim)
{
    const struct auto_method *m = sim->method;
    return m->memory.steps >= m->memory.next || sim->next_change != m->memory.change ||
           sim->broken > 4 * m->memory.broken + sim->edge_count / 50;
}

static void take(struct sim *sim, const struct auto_option *option)
{
    struct auto_method *m = sim->method;
    const bool another = m->memory.candidate != (uint64_t)option->candidate;
    if (m->memory.choices == 0 || another || m->memory.parts != option->parts)
        m->memory.choices++;
    sim->changed |= another;
    m->memory.candidate = (uint64_t)option->candidate;
    m->memory.parts = option->parts;
    m->memory.error = option->result.error;
    m->memory.work = option->result.work;
    m->memory.broken = sim->broken;
    m->memory.change = sim->next_change;
    if (m->memory.steps >= m->memory.next)
        m->memory.next = m->memory.next ? 8 * m->memory.next : 32;
}

/* What the future depends on and a choice changes before it is made. */
struct kept {
    double spent[AUTO_CANDIDATES];
    struct guard_memory guard; /* with its x in the row AUTO_GUARD_ROW */
};

static void keep(const struct sim *sim, struct kept *kept)
{
    const struct auto_method *m = sim->method;
    memcpy(kept->spent, m->memory.spent, sizeof kept->spent);
    memcpy(sim->scratch[AUTO_GUARD_ROW], sim->guard->x, sim->point_count * sizeof *sim->guard->x);
    kept->guard = sim->guard->memory;
}

static void put_back(struct sim *sim, const struct kept *kept)
{
    struct auto_method *m = sim->method;
    memcpy(m->memory.spent, kept->spent, sizeof kept->spent);
    memcpy(sim->guard->x, sim->scratch[AUTO_GUARD_ROW], sim->point_count * sizeof *sim->guard->x);
    sim->guard->memory = kept->guard;
    sim->acting = auto_candidates[m->memory.candidate];
}

/* sim->acting and wanted_substeps follow from what is remembered: also where that comes out of a file. */
static bool choose(struct sim *sim, bool first)
{
    struct auto_method *m = sim->method;
    sim->acting = auto_candidates[m->memory.candidate];
    if (first && is_due(sim)) {
        struct kept kept;
        keep(sim, &kept);
        const struct auto_option best = auto_search(sim);
        if (!sim_goes_on(sim)) { /* as if it had never begun: whoever resumes the run chooses anew */
            put_back(sim, &kept);
            return false;
        }
        take(sim, &best);
    }
    m->memory.steps += first;
    if (sim->acting != auto_candidates[m->memory.candidate]) {
        sim->acting = auto_candidates[m->memory.candidate];
        guard_bound_outdated(sim);
    }
    sim->wanted_substeps = (uint32_t)m->memory.parts;
    return true;
}

static enum status advance(struct sim *sim, double dt, struct error *err)
{
    struct auto_method *m = sim->method;
    sim->method = m->own[m->memory.candidate];
    enum status status = auto_candidates[m->memory.candidate]->advance(sim, dt, err);
    sim->method = m;
    if (status == STATUS_INTERRUPTED && sim->steps_since % sim->substeps == 0)
        m->memory.steps--; /* it is still to be begun */
    return status;
}

static size_t blocks(struct sim *sim, struct sim_block *list)
{
    struct auto_method *m = sim->method;
    size_t count = 0;
    list[count++] = (struct sim_block){"choice", &m->memory, sizeof m->memory};
    for (int i = 0; i < AUTO_CANDIDATES; i++)
        if (m->is_open[i] && auto_candidates[i]->blocks) {
            sim->method = m->own[i];
            count += auto_candidates[i]->blocks(sim, &list[count]);
        }
    sim->method = m;
    return count;
}

static bool is_sound(const struct sim *sim)
{
    const struct auto_method *m = sim->method;
    const double parts = m->memory.parts;
    return m->memory.candidate < AUTO_CANDIDATES && m->is_open[m->memory.candidate] && parts >= 0 &&
           parts <= GUARD_PARTS_MAX;
}

bool auto_describe(const struct sim *sim, uint64_t *choices, char *text, size_t size)
{
    const struct auto_method *m = sim->method;
    if (sim->integrator != &integrator_auto || m->memory.choices == *choices || isinf(m->memory.work))
        return false;
    *choices = m->memory.choices;
    const double fastest = 2 / m->memory.stable, parts = m->memory.parts;
    if (isinf(m->memory.error)) {
        snprintf(
            text, size,
            "%s, %.0f substep%s: stiffness ratio %.3g, steps in parts, with an error that no trial tells, "
            "%.3g evaluations a step",
            auto_candidates[m->memory.candidate]->name, parts, parts == 1 ? "" : "s",
            fastest / sim->balloons[0].breathing_rate, m->memory.work);
        return true;
    }
    snprintf(text, size,
             "%s, %.0f substep%s: stiffness ratio %.3g, error %.1g radii a step%s%s, %.3g evaluations a step",
             auto_candidates[m->memory.candidate]->name, parts, parts == 1 ? "" : "s",
             fastest / sim->balloons[0].breathing_rate, m->memory.error,
             auto_candidates[m->memory.candidate]->flags & INTEGRATOR_IMPLICIT
                 ? " but for what swings faster than its steps, which it damps"
                 : "",
             m->memory.error > sim->scene->time.tolerance ? " (no method keeps time.tolerance)" : "",
             m->memory.work);
    return true;
}

/* The limits are those of what it chooses, and the order is that at the least. */
const struct integrator integrator_auto = {.name = "auto",
                                           .order = 1,
                                           .vectors = AUTO_TRIAL_ROWS + TRIAL_VECTORS,
                                           .oscillation_limit = INFINITY,
                                           .decay_limit = INFINITY,
                                           .open = open,
                                           .close = close,
                                           .choose = choose,
                                           .advance = advance,
                                           .blocks = blocks,
                                           .is_sound = is_sound,
                                           .source = "trials of the scene itself"};
