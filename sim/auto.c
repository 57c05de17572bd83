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
#include "sim/guard_bound.h"
#include "sim/methods.h"
#include "sim/rkn4.h"
#include "sim/trial.h"
#include "sim/weights.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cheap ones first: what cannot beat the best so far is not tried. The last two, which solve equations and
 * share what they keep, are open only where the others would have to split steps in more than STIFF. */
static const struct integrator *const candidates[] = {
    &integrator_symplectic_euler, &integrator_verlet, &integrator_rk4, &integrator_rkn4,
    &integrator_backward_euler,   &integrator_bdf2};
enum { CANDIDATES = sizeof candidates / sizeof candidates[0], STIFF = 6 };

/* In sim->scratch: what no candidate uses. */
enum { GUARD_ROW = 10, TRIAL_ROWS };

struct auto_method {
    void *own[CANDIDATES];
    bool is_open[CANDIDATES];
    /* What the future depends on; no padding. */
    struct {
        uint64_t choices;          /* so far */
        uint64_t steps;            /* of the scene, taken since it was opened */
        uint64_t next;             /* of them, before which to choose again */
        uint64_t broken;           /* edges, at the last choice */
        uint64_t change;           /* of the schedule, that was to come then */
        uint64_t candidate;        /* that was chosen, and in how many parts */
        double parts, error, work; /* as its trial had it */
        double stable;             /* s: by the guard's bound for the first candidate, when it was opened */
        /* Work that each took in its last trial for the last choice, 0 where there was none: it will not take
         * less than half of that in the next one, so that what was far too dear is not tried again. */
        double spent[CANDIDATES];
    } memory;
};

/* Calls open or close of a candidate as if it were the scene's method. */
static enum status open_candidate(struct sim *sim, int i, struct error *err)
{
    struct auto_method *m = sim->method;
    enum status status = STATUS_OK;
    assert(candidates[i]->vectors <= GUARD_ROW);
    m->is_open[i] = true;
    if (i > 0 && candidates[i]->open && candidates[i]->open == candidates[i - 1]->open) {
        m->own[i] = m->own[i - 1];
        return STATUS_OK;
    }
    sim->method = NULL;
    if (candidates[i]->open)
        status = candidates[i]->open(sim, err);
    m->own[i] = sim->method;
    sim->method = m;
    return status;
}

static void close(struct sim *sim)
{
    struct auto_method *m = sim->method;
    for (int i = 0; i < CANDIDATES && m; i++)
        if (m->is_open[i] && candidates[i]->close && (i == 0 || m->own[i] != m->own[i - 1])) {
            sim->method = m->own[i];
            candidates[i]->close(sim);
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
    sim->acting = candidates[0];
    const double stable = guard_stable_step(sim);
    const bool is_stiff = sim->whole_step > STIFF * stable;
    ((struct auto_method *)sim->method)->memory.stable = stable;
    for (int i = 0; i < CANDIDATES && !status; i++)
        if (is_stiff || !(candidates[i]->flags & INTEGRATOR_IMPLICIT))
            status = open_candidate(sim, i, err);
    return status;
}

static double parts_for(const struct sim *sim, double longest)
{
    return fmax(ceil(sim->whole_step / longest * (1 - 1e-12)), 1);
}

/* The fewest parts that are surely stable for a candidate, from the bound for the one that acts: what both
 * terms of the bound (guard.h) allow is in proportion to the limits. */
static double fewest_parts(struct sim *sim, int i)
{
    const struct integrator *to = candidates[i];
    if (isinf(to->oscillation_limit))
        return parts_for(sim, guard_following(sim).step);
    if (isinf(sim->acting->oscillation_limit)) {
        sim->acting = to;
        guard_bound_outdated(sim);
    }
    const double larger = fmin(to->oscillation_limit / sim->acting->oscillation_limit,
                               to->decay_limit / sim->acting->decay_limit);
    const double stable = guard_stable_step(sim) * larger;
    return parts_for(sim, fmin(stable, guard_following(sim).step));
}

/* A candidate in a number of parts, with what its trial said, or before that with the least
 * work that it can take. */
struct option {
    int candidate;
    double parts;
    struct trial_result result;
};

/* Evaluations of a step, as far as one knows before a trial; one of rkn4 for nothing would cost more
 * than all others together. */
static double least_work(const struct sim *sim, int candidate)
{
    const struct integrator *method = candidates[candidate];
    if (method == &integrator_rkn4)
        return rkn4_evaluations(sim);
    return method->evaluations > 0 ? method->evaluations : TRIAL_IMPLICIT_LEAST;
}

static struct option untried(const struct sim *sim, int candidate, double parts)
{
    const double least = least_work(sim, candidate);
    return (struct option){
        candidate, parts, {INFINITY, parts <= GUARD_PARTS_MAX ? least * parts : INFINITY, false, false}};
}

/* How many of the scene's steps a trial takes: two, or one where they are split in many parts, and before the
 * first step, since that choice does not last. */
static uint32_t trial_steps(const struct sim *sim, double parts)
{
    return sim->steps == 0 ? 1 : (uint32_t)fmax(fmin(2, 1000 / parts), 1);
}

static void try_option(struct sim *sim, struct option *option)
{
    const struct auto_method *m = sim->method;
    sim->is_trying = true;
    option->result = trial_run(sim, candidates[option->candidate], m->own[option->candidate],
                               (uint32_t)option->parts, trial_steps(sim, option->parts), TRIAL_ROWS);
    sim->is_trying = false;
}

/* In how many more parts it would keep the tolerance, by its order; of errors near the radius that says
 * little. What took too much work takes no less in more parts. */
static struct option split_further(const struct sim *sim, const struct option *option, double tolerance,
                                   double most)
{
    const double error = option->result.error, farthest = error < 1e-2 ? INFINITY : 8;
    const double missing = pow(error / tolerance, 1.0 / candidates[option->candidate]->order);
    const double parts = ceil(option->parts * fmin(fmax(1.1 * missing, 1.25), farthest));
    return untried(sim, option->candidate, parts <= most && !option->result.too_dear ? parts : INFINITY);
}

/* The one with the least work; of those that are within a tenth of it the one of the highest order,
 * whose errors are less. */
static struct option *find_cheapest(struct option *options)
{
    double least = INFINITY;
    for (int i = 0; i < CANDIDATES; i++)
        least = fmin(least, options[i].result.work);
    struct option *cheapest = NULL;
    for (int i = 0; i < CANDIDATES; i++)
        if (options[i].result.work <= 1.1 * least &&
            (!cheapest || candidates[i]->order > candidates[cheapest->candidate]->order))
            cheapest = &options[i];
    return cheapest;
}

/* Of an option that takes its steps in parts, by itself, nobody knows how far it is off; nor is another
 * known that would not do so, once it has been split. It is taken where no other comes near. */
static struct option find_near(const struct option *nearest, const struct option *in_parts)
{
    const double near = 1e-2;
    return nearest->result.error <= near || isinf(in_parts->result.work) ? *nearest : *in_parts;
}

/* Tries what promises to be cheapest until that keeps the tolerance; what cannot be cheaper than another that
 * does is never tried, nor what takes MUCH work and twice that of one that takes its steps in parts. A burst
 * is not smooth, and no split brings it within any tolerance: where nothing does in PARTS_MORE times the
 * parts that are stable, it is what came nearest. */
static struct option find_best(struct sim *sim)
{
    enum { TRIALS_MAX = 30, PARTS_MORE = 64, MUCH = 100000 };
    struct auto_method *m = sim->method;
    const double tolerance = sim->scene->time.tolerance;
    struct option next[CANDIDATES], nearest = {.parts = 1, .result = {INFINITY, INFINITY, false, false}},
                                    in_parts = nearest;
    double fewest[CANDIDATES], most[CANDIDATES];
    for (int i = 0; i < CANDIDATES; i++) {
        next[i] = untried(sim, i, m->is_open[i] ? fewest_parts(sim, i) : INFINITY);
        fewest[i] = next[i].parts;
        most[i] = PARTS_MORE * fewest[i];
        if (sim->next_change == m->memory.change)
            next[i].result.work = fmax(next[i].result.work, m->memory.spent[i] / 2);
        m->memory.spent[i] = 0;
    }
    for (int trials = 0; trials < TRIALS_MAX && sim_goes_on(sim); trials++) {
        struct option *cheapest = find_cheapest(next);
        if (isinf(cheapest->result.work) || cheapest->result.work > fmax(2 * in_parts.result.work, MUCH))
            return find_near(&nearest, &in_parts);
        if (cheapest->result.error <= tolerance)
            return *cheapest;
        try_option(sim, cheapest);
        if (cheapest->result.error < nearest.result.error)
            nearest = *cheapest;
        m->memory.spent[cheapest->candidate] = cheapest->result.work;
        const bool was_split = cheapest->parts > fewest[cheapest->candidate];
        if (cheapest->result.in_parts && cheapest->result.work < in_parts.result.work)
            in_parts = *cheapest;
        if (cheapest->result.in_parts && was_split)
            *cheapest = untried(sim, cheapest->candidate, INFINITY);
        else if (!(cheapest->result.error <= tolerance))
            *cheapest = split_further(sim, cheapest, tolerance, most[cheapest->candidate]);
    }
    return find_near(&nearest, &in_parts);
}

static bool is_due(const struct sim *sim)
{
    const struct auto_method *m = sim->method;
    return m->memory.steps >= m->memory.next || sim->next_change != m->memory.change ||
           sim->broken > 4 * m->memory.broken + sim->edge_count / 50;
}

static void take(struct sim *sim, const struct option *option)
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
    double spent[CANDIDATES];
    struct guard_memory guard; /* with its x in the row GUARD_ROW */
};

static void keep(const struct sim *sim, struct kept *kept)
{
    const struct auto_method *m = sim->method;
    memcpy(kept->spent, m->memory.spent, sizeof kept->spent);
    memcpy(sim->scratch[GUARD_ROW], sim->guard->x, sim->point_count * sizeof *sim->guard->x);
    kept->guard = sim->guard->memory;
}

static void put_back(struct sim *sim, const struct kept *kept)
{
    struct auto_method *m = sim->method;
    memcpy(m->memory.spent, kept->spent, sizeof kept->spent);
    memcpy(sim->guard->x, sim->scratch[GUARD_ROW], sim->point_count * sizeof *sim->guard->x);
    sim->guard->memory = kept->guard;
    sim->acting = candidates[m->memory.candidate];
}

/* sim->acting and wanted_substeps follow from what is remembered: also where that comes out of a file. */
static bool choose(struct sim *sim, bool first)
{
    struct auto_method *m = sim->method;
    sim->acting = candidates[m->memory.candidate];
    if (first && is_due(sim)) {
        struct kept kept;
        keep(sim, &kept);
        const struct option best = find_best(sim);
        if (!sim_goes_on(sim)) { /* as if it had never begun: whoever resumes the run chooses anew */
            put_back(sim, &kept);
            return false;
        }
        take(sim, &best);
    }
    m->memory.steps += first;
    if (sim->acting != candidates[m->memory.candidate]) {
        sim->acting = candidates[m->memory.candidate];
        guard_bound_outdated(sim);
    }
    sim->wanted_substeps = (uint32_t)m->memory.parts;
    return true;
}

static enum status advance(struct sim *sim, double dt, struct error *err)
{
    struct auto_method *m = sim->method;
    sim->method = m->own[m->memory.candidate];
    enum status status = candidates[m->memory.candidate]->advance(sim, dt, err);
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
    for (int i = 0; i < CANDIDATES; i++)
        if (m->is_open[i] && candidates[i]->blocks) {
            sim->method = m->own[i];
            count += candidates[i]->blocks(sim, &list[count]);
        }
    sim->method = m;
    return count;
}

static bool is_sound(const struct sim *sim)
{
    const struct auto_method *m = sim->method;
    const double parts = m->memory.parts;
    return m->memory.candidate < CANDIDATES && m->is_open[m->memory.candidate] && parts >= 0 &&
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
            candidates[m->memory.candidate]->name, parts, parts == 1 ? "" : "s",
            fastest / sim->balloons[0].breathing_rate, m->memory.work);
        return true;
    }
    snprintf(text, size,
             "%s, %.0f substep%s: stiffness ratio %.3g, error %.1g radii a step%s%s, %.3g evaluations a step",
             candidates[m->memory.candidate]->name, parts, parts == 1 ? "" : "s",
             fastest / sim->balloons[0].breathing_rate, m->memory.error,
             candidates[m->memory.candidate]->flags & INTEGRATOR_IMPLICIT
                 ? " but for what swings faster than its steps, which it damps"
                 : "",
             m->memory.error > sim->scene->time.tolerance ? " (no method keeps time.tolerance)" : "",
             m->memory.work);
    return true;
}

/* The limits are those of what it chooses, and the order is that at the least. */
const struct integrator integrator_auto = {.name = "auto",
                                           .order = 1,
                                           .vectors = TRIAL_ROWS + TRIAL_VECTORS,
                                           .oscillation_limit = INFINITY,
                                           .decay_limit = INFINITY,
                                           .open = open,
                                           .close = close,
                                           .choose = choose,
                                           .advance = advance,
                                           .blocks = blocks,
                                           .is_sound = is_sound,
                                           .source = "trials of the scene itself"};
