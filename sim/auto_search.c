#include "sim/auto_search.h"
#include "sim/guard_bound.h"
#include "sim/methods.h"
#include "sim/rkn4.h"

#include <math.h>

/* Cheap ones first: what cannot beat the best so far is not tried. The last two, which solve equations and
 * share what they keep, are open only where the others would have to split steps in more than AUTO_STIFF.
 * rk-adaptive is none: steps no longer than the scene's take six forces each at the least, and at tolerances
 * of 1e-5 to 1e-8 the scenes in data/scenes took it from 0.7 (rubber, creep) to 5 times (stiff) as long as
 * what is chosen here. Whoever wants its errors, a tenth to a thousandth at the same tolerance but where
 * springs slip, names it: also those of events within steps, which no trial shows. */
const struct integrator *const auto_candidates[AUTO_CANDIDATES] = {
    &integrator_symplectic_euler, &integrator_verlet, &integrator_rk4, &integrator_rkn4,
    &integrator_backward_euler,   &integrator_bdf2};

static double parts_for(const struct sim *sim, double longest)
{
    return fmax(ceil(sim->whole_step / longest * (1 - 1e-12)), 1);
}

/* The fewest parts that are surely stable for a candidate, from the bound for the one that acts: what both
 * terms of the bound (guard.h) allow is in proportion to the limits. */
static double fewest_parts(struct sim *sim, int i)
{
    const struct integrator *to = auto_candidates[i];
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

/* Evaluations of a step, as far as one knows before a trial; one of rkn4 for nothing would cost more
 * than all others together. */
static double least_work(const struct sim *sim, int candidate)
{
    const struct integrator *method = auto_candidates[candidate];
    if (method == &integrator_rkn4)
        return rkn4_evaluations(sim);
    return method->evaluations > 0 ? method->evaluations : TRIAL_IMPLICIT_LEAST;
}

static struct auto_option untried(const struct sim *sim, int candidate, double parts)
{
    const double least = least_work(sim, candidate);
    return (struct auto_option){candidate,
                                parts,
                                {INFINITY, parts <= GUARD_PARTS_MAX ? least * parts : INFINITY, false, false},
                                INFINITY,
                                false};
}

/* How many of the scene's steps a trial takes: two, or one where they are split in many parts, and before the
 * first step, since that choice does not last. */
static uint32_t trial_steps(const struct sim *sim, double parts)
{
    return sim->steps == 0 ? 1 : (uint32_t)fmax(fmin(2, 1000 / parts), 1);
}

/* Of an implicit method, whose work nobody knows beforehand, sees no more than MOST through. */
static void try_option(struct sim *sim, struct auto_option *option, double most)
{
    const struct auto_method *m = sim->method;
    sim->is_trying = true;
    option->result = trial_run(sim, auto_candidates[option->candidate], m->own[option->candidate],
                               (uint32_t)option->parts, trial_steps(sim, option->parts), most,
                               AUTO_TRIAL_ROWS);
    sim->is_trying = false;
}

/* Errors of more, in radii, say little: a motion that goes astray so far may find no way at all. */
static const double near = 1e-2;

/* Whether in eight times as many parts the error was about as large as before. */
static bool has_not_fallen(const struct auto_option *option)
{
    return option->result.error > near && option->result.error > 0.85 * option->last_error;
}

/* In how many more parts it would keep the tolerance, by its order; of errors near the radius that says
 * little. What took too much work takes no less in more parts. */
static struct auto_option split_further(const struct sim *sim, const struct auto_option *option,
                                        double tolerance, double most)
{
    const double error = option->result.error, farthest = error < near ? INFINITY : 8;
    const double missing = pow(error / tolerance, 1.0 / auto_candidates[option->candidate]->order);
    const double times = fmin(fmax(1.1 * missing, 1.25), farthest), parts = ceil(option->parts * times);
    const bool may = parts <= most && !option->result.too_dear;
    struct auto_option next = untried(sim, option->candidate, may ? parts : INFINITY);
    next.is_vain = has_not_fallen(option);
    if (times == farthest)
        next.last_error = error;
    return next;
}

/* The one with the least work; of those that are within a tenth of it the one of the highest order,
 * whose errors are less. */
static struct auto_option *find_cheapest(struct auto_option *options)
{
    double least = INFINITY;
    for (int i = 0; i < AUTO_CANDIDATES; i++)
        least = fmin(least, options[i].result.work);
    struct auto_option *cheapest = NULL;
    for (int i = 0; i < AUTO_CANDIDATES; i++)
        if (options[i].result.work <= 1.1 * least &&
            (!cheapest || auto_candidates[i]->order > auto_candidates[cheapest->candidate]->order))
            cheapest = &options[i];
    return cheapest;
}

/* What a search for the best has come to. */
struct search {
    struct auto_option next[AUTO_CANDIDATES]; /* to be tried, or keeps the tolerance */
    struct auto_option
        first[AUTO_CANDIDATES];  /* trials in the fewest parts that are stable; work INFINITY: none */
    struct auto_option nearest;  /* the one of the least error */
    struct auto_option in_parts; /* the cheapest that takes its steps in parts */
    double fewest[AUTO_CANDIDATES];
    bool falls; /* some error has, with more parts, or is not near the radius */
};

static void begin_search(struct sim *sim, struct search *search)
{
    struct auto_method *m = sim->method;
    for (int i = 0; i < AUTO_CANDIDATES; i++) {
        const double parts = search->fewest[i] = m->is_open[i] ? fewest_parts(sim, i) : INFINITY;
        search->next[i] = untried(sim, i, parts);
        search->first[i] = untried(sim, i, INFINITY);
        if (sim->next_change == m->memory.change)
            search->next[i].result.work = fmax(search->next[i].result.work, m->memory.spent[i] / 2);
        m->memory.spent[i] = 0;
    }
    search->nearest = search->in_parts = untried(sim, 0, INFINITY);
    search->nearest.parts = 1;
    search->falls = false;
}

/* Twice what the next best takes at the least, or four times what it has had so far: a trial that gets dearer
 * waits until the others turn out to be as dear. */
static double most_work(const struct search *search, const struct auto_option *option)
{
    double least = INFINITY;
    for (int i = 0; i < AUTO_CANDIDATES; i++)
        if (i != option->candidate)
            least = fmin(least, search->next[i].result.work);
    const double most = fmax(2 * least, 4 * option->result.work);
    return fmin(fmax(most, 8 * TRIAL_IMPLICIT_LEAST), TRIAL_WORK_MAX);
}

/* What to try of a candidate after a trial, by what that said; and what is known by it. */
static void learn(struct sim *sim, struct search *search, struct auto_option *option)
{
    enum { PARTS_MORE = 64 };
    const int i = option->candidate;
    const double tolerance = sim->scene->time.tolerance, fewest = search->fewest[i];
    const bool in_parts = option->result.in_parts, was_split = option->parts > fewest;
    if (isinf(search->first[i].result.work))
        search->first[i] = *option;
    if (option->result.error < search->nearest.result.error)
        search->nearest = *option;
    search->falls |= option->result.error <= near;
    search->falls |= isfinite(option->last_error) && !has_not_fallen(option);
    if (in_parts && !option->result.too_dear && option->result.work < search->in_parts.result.work)
        search->in_parts = *option;
    if (in_parts && was_split)
        *option = untried(sim, i, INFINITY);
    else if (!(option->result.error <= tolerance))
        *option = split_further(sim, option, tolerance, PARTS_MORE * fewest);
}

/* Where nothing keeps the tolerance. Of an option that takes its steps in parts, by itself, nobody knows how
 * far it is off; nor is another known that would not do so, once it has been split. It is taken where no
 * other comes near. Where no error falls none is nearer than another: the cheapest will do. */
static struct auto_option find_near(struct search *search)
{
    if (search->nearest.result.error > near && !isinf(search->in_parts.result.work))
        return search->in_parts;
    bool any_vain = false;
    for (int i = 0; i < AUTO_CANDIDATES; i++)
        any_vain |= search->next[i].is_vain;
    return any_vain && !search->falls ? *find_cheapest(search->first) : search->nearest;
}

/* Tries what promises to be cheapest until that keeps the tolerance; what cannot be cheaper than another that
 * does is never tried, nor what takes MUCH work and twice that of one that takes its steps in parts. A burst
 * is not smooth, and no split brings it within any tolerance: where nothing does in PARTS_MORE times the
 * parts that are stable, it is what came nearest. Those are not tried where more parts have brought no
 * method's error down: so stiff a motion goes astray within a step, whatever follows it. */
struct auto_option auto_search(struct sim *sim)
{
    enum { TRIALS_MAX = 30, MUCH = 100000 };
    struct auto_method *m = sim->method;
    struct search search;
    begin_search(sim, &search);
    for (int trials = 0; trials < TRIALS_MAX && sim_goes_on(sim);) {
        struct auto_option *cheapest = find_cheapest(search.next);
        const double work = cheapest->result.work, most = most_work(&search, cheapest);
        if (isinf(work) || work > fmax(2 * search.in_parts.result.work, MUCH))
            break;
        if (cheapest->result.error <= sim->scene->time.tolerance)
            return *cheapest;
        if (cheapest->is_vain && !search.falls) {
            cheapest->result.work = INFINITY;
            continue;
        }
        try_option(sim, cheapest, most);
        m->memory.spent[cheapest->candidate] = cheapest->result.work;
        if (cheapest->result.too_dear && most < TRIAL_WORK_MAX) { /* to be tried again, with more */
            cheapest->result = (struct trial_result){INFINITY, cheapest->result.work, false, false};
            continue;
        }
        learn(sim, &search, cheapest);
        trials++;
    }
    return find_near(&search);
}
