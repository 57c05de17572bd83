/* Two references that know nothing of each other: a method that chooses its steps, at the tightest
 * tolerance that it can keep; and one of fixed steps, halved and extrapolated until the two agree as far
 * as rounding lets them. */
#include "sim/accuracy_plan.h"
#include "sim/guard.h"

#include <math.h>

/* Explicit methods, unless the steps that are stable are too many. */
enum { PAIR_TOLERANT = 2 };
struct pair {
    const char *tolerant[PAIR_TOLERANT],
        *fixed; /* the first of them is better, where both keep a tolerance */
};
static const struct pair explicit_pair = {{"cvode-adams", "rk-adaptive"}, "rkn4"},
                         implicit_pair = {{"cvode-bdf", "rk-adaptive"}, "implicit-midpoint"};

static double budget(const struct accuracy_plan *plan)
{
    return ACCURACY_REFERENCE_SHARE * plan->subject.options->seconds;
}

/* A run that is told of as it goes: how many it takes is not known beforehand, and each brings things on by a
 * part of the way that is left. */
static enum status go(struct accuracy_plan *plan, struct accuracy_run *run,
                      const struct accuracy_dials *dials, double limit, struct accuracy_states *states,
                      struct error *err)
{
    struct accuracy_subject *subject = &plan->subject;
    subject->part = 0.25 * (ACCURACY_REFERENCES_DONE - subject->done);
    const enum status status = accuracy_go(run, subject, dials, limit, states, err);
    subject->done += subject->part;
    subject->part = 0;
    return status;
}

/* What each of a pair's methods may be tried at next. */
struct attempt {
    const struct integrator *method;
    double tolerance;
};

/* At ten times the tolerance a method of order p takes 10^(1/p) times fewer steps: one of the fifth that came
 * less than 10^(-1/5) of the way needs more than that. One that stood still for another reason may go on
 * soon. */
static double next_tolerance(double tolerance, double share)
{
    const double order = 5, decades = order * -log10(fmax(share, 1e-9));
    return decades > 1 ? 100 * tolerance : 10 * tolerance;
}

/* One run, kept where it comes to its end. */
static enum status attempt(struct accuracy_plan *plan, struct attempt *a, struct accuracy_states *states,
                           struct error *err)
{
    const struct accuracy_dials dials = accuracy_dials_of(plan, a->method, a->tolerance);
    struct accuracy_run run;
    const enum status status = go(plan, &run, &dials, budget(plan), states, err);
    if (status) {
        a->tolerance = next_tolerance(a->tolerance, status == STATUS_RESOURCE ? run.reached / dials.end : 1);
        return status;
    }
    snprintf(plan->table->reference[0], sizeof plan->table->reference[0], "%s at time.tolerance=%g",
             a->method->name, a->tolerance);
    plan->tightest = a->tolerance;
    accuracy_close(&run);
    return STATUS_OK;
}

/* The tightest tolerance that any of the methods can keep that may be had for the scene. A shorter span
 * begins not far below what could be kept over a longer one. */
static enum status find_tolerant(struct accuracy_plan *plan, const struct pair *pair,
                                 struct accuracy_states *states, struct error *err)
{
    const double first = fmax(plan->tightest / 1e3, 1e-12), last = 1e-5;
    struct attempt attempts[PAIR_TOLERANT], *next = attempts;
    for (int i = 0; i < PAIR_TOLERANT; i++) {
        const struct integrator *method = integrator_find(pair->tolerant[i]);
        attempts[i] = (struct attempt){method,
                                       accuracy_unsuited(plan->subject.scene, method) ? INFINITY : first};
        if (attempts[i].tolerance < next->tolerance * (1 - 1e-9))
            next = &attempts[i];
    }
    enum status status = STATUS_RESOURCE;
    while (next->tolerance < last * (1 + 1e-9)) {
        status = attempt(plan, next, states, err);
        if (status != STATUS_RANGE && status != STATUS_RESOURCE && status != STATUS_DIVERGED)
            return status;
        for (int i = 0; i < PAIR_TOLERANT; i++)
            if (attempts[i].tolerance < next->tolerance * (1 - 1e-9))
                next = &attempts[i];
    }
    return status;
}

/* fine becomes what is left when the error's first term, of the method's order, is taken out. */
static void extrapolate(const struct sim *sim, const struct accuracy_states *coarse, int order,
                        const struct accuracy_states *fine, struct accuracy_states *result)
{
    const double w = 1 / (ldexp(1, order) - 1);
    for (int i = 0; i < ACCURACY_TIMES; i++) {
        for (uint32_t p = 0; p < sim->point_count; p++)
            for (int k = 0; k < 4; k++)
                result->position[i][p][k] = fine->position[i][p][k] +
                                            w * (fine->position[i][p][k] - coarse->position[i][p][k]);
        result->volume[i] = fine->volume[i] + w * (fine->volume[i] - coarse->volume[i]);
        result->pressure[i] = fine->pressure[i] + w * (fine->pressure[i] - coarse->pressure[i]);
        result->energy[i] = fine->energy[i] + w * (fine->energy[i] - coarse->energy[i]);
    }
}

static void swap(struct accuracy_states *a, struct accuracy_states *b)
{
    const struct accuracy_states kept = *a;
    *a = *b;
    *b = kept;
}

/* What find_fixed() works on. */
struct halving {
    struct accuracy_states coarse, fine, result;
    double parts; /* of the scene's step */
    double spent; /* s */
};

/* Once more, in twice as many parts; with the run before it extrapolated, it is the reference
 * if that agrees better. */
static enum status halve(struct accuracy_plan *plan, const struct integrator *method, struct halving *h,
                         const struct accuracy_states *other, struct error *err)
{
    const struct accuracy_dials dials = accuracy_dials_of(plan, method, plan->step / h->parts);
    struct accuracy_run run;
    enum status status = go(plan, &run, &dials, 4 * budget(plan), &h->fine, err);
    if (status)
        return status;
    if (h->coarse.position[0]) {
        if (!h->result.position[0])
            status = accuracy_states_open(&h->result, &run.sim, err);
        if (!status)
            extrapolate(&run.sim, &h->coarse, method->order, &h->fine, &h->result);
        const double distance = status ? INFINITY : accuracy_distance(&run.sim, &h->result, other);
        if (distance < plan->table->agreement) {
            plan->table->agreement = distance;
            swap(&h->result, &plan->reference);
            snprintf(plan->table->reference[1], sizeof plan->table->reference[1],
                     "%s in steps of %.3g and %.3g s, extrapolated", method->name, 2 * dials.step,
                     dials.step);
        }
    }
    h->spent = run.seconds;
    h->parts *= 2;
    swap(&h->coarse, &h->fine);
    accuracy_close(&run);
    return status;
}

/* Halves until the agreement is that of rounding, or no longer improves, or it would take too long. */
static enum status find_fixed(struct accuracy_plan *plan, const struct pair *pair,
                              const struct accuracy_states *other, struct error *err)
{
    enum { AT_LEAST = 3, AT_MOST = 20 };
    const struct integrator *method = integrator_find(pair->fixed);
    const double limit = isfinite(method->oscillation_limit) ? method->oscillation_limit / 2 : INFINITY,
                 total = budget(plan);
    struct halving h = {.parts = 2};
    plan->table->agreement = INFINITY;
    while (plan->step / h.parts > plan->stable * limit)
        h.parts *= 2;
    enum status status = STATUS_OK;
    double spent = 0, before = INFINITY;
    for (int i = 0; i < AT_MOST && !status; i++) {
        status = halve(plan, method, &h, other, err);
        spent += h.spent;
        const double agreement = plan->table->agreement;
        if (i >= AT_LEAST - 1 && (agreement < 1e-13 || agreement > 0.7 * before))
            break;
        if (i > 0 && spent + 2 * h.spent > total)
            break;
        before = agreement;
    }
    accuracy_states_close(&h.coarse);
    accuracy_states_close(&h.fine);
    accuracy_states_close(&h.result);
    return status;
}

static enum status find_both(struct accuracy_plan *plan, const struct pair *pair, struct error *err)
{
    struct accuracy_states tolerant = {0};
    enum status status = find_tolerant(plan, pair, &tolerant, err);
    if (!status)
        status = find_fixed(plan, pair, &tolerant, err);
    accuracy_states_close(&tolerant);
    return status;
}

/* Motion that folds and wrinkles forgets where it began: runs can be compared for a shorter time only. So
 * they can where no method that chooses its steps comes to the end. */
static bool is_shortened(struct accuracy_plan *plan, enum status status)
{
    const double fair = 1e-5; /* of the radius: where references agree less, few rows could be judged */
    const bool stands = status == STATUS_RESOURCE || status == STATUS_DIVERGED;
    if (plan->quarter < 4 || (!stands && (status || plan->table->agreement <= fair)))
        return false;
    plan->reach = plan->table->span / 4;
    accuracy_set_span(plan);
    snprintf(plan->table->span_reason, sizeof plan->table->span_reason, "for as long as %s",
             stands ? "references come on" : "two references agree");
    return true;
}

enum status accuracy_find_reference(struct accuracy_plan *plan, struct error *err)
{
    enum { TRIES = 6 };
    enum status status = STATUS_OK;
    for (int i = 0; i < TRIES; i++) {
        const double evaluations = 4 * plan->table->span / plan->stable;
        const bool is_stiff = evaluations * plan->evaluation > budget(plan) / 2;
        status = find_both(plan, is_stiff ? &implicit_pair : &explicit_pair, err);
        if (i + 1 < TRIES && is_shortened(plan, status))
            continue;
        if (status != STATUS_INPUT)
            break;
        plan->reach = 0.8 * plan->table->span; /* it breaks earlier than by the first run */
        accuracy_set_span(plan);
    }
    if (status && status != STATUS_INTERRUPTED)
        error_prefix(err, "--accuracy-cost, the references");
    return status;
}
