#include "sim/accuracy_run.h"
#include "common/array.h"
#include "common/random.h"
#include "common/scene_checks.h"
#include "sim/effect_gas.h"
#include "sim/measure.h"
#include "sim/weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int index_of(const char *integrator)
{
    int i = 0;
    while (strcmp(scene_integrator_names[i], integrator))
        i++;
    return i;
}

const char *accuracy_unsuited(const struct scene *scene, const struct integrator *method)
{
    struct scene tried = *scene;
    struct error ignored;
    tried.time.integrator = index_of(method->name);
    for (size_t i = 0; i < scene->balloon_count; i++) {
        const struct scene_balloon *b = &scene->balloons[i];
        if (method->flags & INTEGRATOR_SPRINGS_ONLY && (b->membrane.on || b->bending.on))
            return "moves springs only";
        if (scene_check_fracture(&tried, i, &ignored))
            return "cannot follow a skin that tears";
    }
    return NULL;
}

/* Another member of the ensemble: every coordinate somewhere within 1e-9 of the radius from where it was. */
static void perturb(struct sim *sim, uint64_t member)
{
    uint64_t random = member;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            for (int i = 0; i < 3; i++)
                sim->position[p][i] += 1e-9 * b->radius * (2 * random_unit(&random) - 1);
}

struct accuracy_dials accuracy_first_dials(const struct scene *scene)
{
    const struct scene_time *time = &scene->time;
    return (struct accuracy_dials){integrator_find("auto"), time->step, time->tolerance, time->end,
                                   SCENE_GUARD_SUBSTEP,     0};
}

enum status accuracy_open(struct accuracy_run *run, const struct accuracy_subject *subject,
                          const struct accuracy_dials *dials, struct error *err)
{
    *run = (struct accuracy_run){.scene = *subject->scene, .limit = INFINITY};
    run->scene.time.integrator = index_of(dials->method->name);
    run->scene.time.step = dials->step;
    run->scene.time.tolerance = dials->tolerance;
    run->scene.time.end = dials->end;
    run->scene.time.guard = dials->guard;
    enum status status = sim_open(&run->sim, &run->scene, subject->meshes, 1, err);
    if (!status && dials->member)
        perturb(&run->sim, dials->member);
    return status;
}

void accuracy_close(struct accuracy_run *run)
{
    sim_clear(&run->sim);
}

/* Of this run: it is over at its end or at its limit. */
static double share_done(const struct accuracy_run *run)
{
    return fmin(1, fmax(run->reached / run->scene.time.end, run->seconds / run->limit));
}

enum status accuracy_step(struct accuracy_run *run, const struct accuracy_subject *subject, struct error *err)
{
    if (pricing_ask(subject->options, subject->done + subject->part * share_done(run), err))
        return err->status;
    const uint64_t evaluations = run->sim.evaluations, products = run->sim.products;
    const double began = pricing_now();
    const enum status status = pricing_step(subject->options, &run->sim, err);
    run->seconds += pricing_now() - began;
    run->reached = run->sim.time;
    run->evaluations += run->sim.evaluations - evaluations;
    run->products += run->sim.products - products;
    if (!status && run->seconds > run->limit)
        return error_set(err, STATUS_RESOURCE, "takes more than %.2g s", run->limit);
    return status;
}

/* Where a run was when it was last looked at. */
struct pace {
    double seconds, reached;
};

/* Methods that choose their steps may come upon what they cannot pass but in ever shorter ones: if the rest
 * would take many times what is left at the pace of the last part of the limit, it is over. */
static enum status check_pace(const struct accuracy_run *run, struct pace *last, struct error *err)
{
    const double part = run->limit / 8, many = 8;
    const double spent = run->seconds - last->seconds, gained = run->reached - last->reached;
    if (!(spent > part))
        return STATUS_OK;
    *last = (struct pace){run->seconds, run->reached};
    if ((run->scene.time.end - run->reached) * spent <= many * gained * (run->limit - run->seconds))
        return STATUS_OK;
    return error_set(err, STATUS_RESOURCE, "would take more than %.2g s", run->limit);
}

enum status accuracy_advance(struct accuracy_run *run, const struct accuracy_subject *subject, double time,
                             struct error *err)
{
    struct sim *sim = &run->sim;
    struct pace last = {run->seconds, run->reached};
    enum status status = STATUS_OK;
    while (!status && sim->time + (sim->integrator->look ? 0 : sim->step / 2) < time) {
        status = accuracy_step(run, subject, err);
        if (!status)
            status = check_pace(run, &last, err);
    }
    return status;
}

enum status accuracy_states_open(struct accuracy_states *states, const struct sim *sim, struct error *err)
{
    *states = (struct accuracy_states){0};
    for (int i = 0; i < ACCURACY_TIMES; i++)
        if (!(states->position[i] = array_new(sim->point_count, sizeof *states->position[i])))
            return error_no_memory(err, "the states that are compared");
    return STATUS_OK;
}

void accuracy_states_close(struct accuracy_states *states)
{
    for (int i = 0; i < ACCURACY_TIMES; i++)
        free(states->position[i]);
    *states = (struct accuracy_states){0};
}

static double area_of(const struct sim *sim, const struct sim_balloon *b)
{
    double area = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        area += sim->triangle_active[t] ? sim_area(sim, t) : 0;
    return area;
}

/* Of gas that presses no harder than the air outside rounding leaves some, whose errors mean nothing: it is
 * taken for none. */
static double gauge_of(struct sim *sim, const struct sim_balloon *b)
{
    const double gauge = gas_gauge_pressure(sim, b), rounding = 1e-12;
    return b->gas && fabs(gauge) < rounding * b->scene->gas.ambient ? 0 : gauge;
}

/* The pressing forces on all points, by their sizes, over the area that they press on. */
static double mean_pressure(struct sim *sim, double area)
{
    double force = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        force += b->by_area ? gauge_of(sim, b) * area_of(sim, b)
                            : b->now->pressure * (b->point_end - b->point_begin);
    return area > 0 ? force / area : 0;
}

static void note(struct sim *sim, double time, int i, struct accuracy_states *states)
{
    sim_look(sim, time);
    const struct sim_measures m = sim_measure(sim);
    memcpy(states->position[i], sim->position, sim->point_count * sizeof *states->position[i]);
    states->volume[i] = m.volume;
    states->pressure[i] = mean_pressure(sim, m.area);
    states->energy[i] = m.kinetic_energy + m.elastic_energy;
    sim_look_end(sim);
}

static enum status visit(struct accuracy_run *run, const struct accuracy_subject *subject,
                         struct accuracy_states *states, struct error *err)
{
    for (int i = 0; i < ACCURACY_TIMES; i++) {
        const enum status status = accuracy_advance(run, subject, subject->time[i], err);
        if (status)
            return status;
        if (run->sim.broken)
            return error_set(err, STATUS_INPUT, "an edge lets go at %g s", run->sim.time);
        note(&run->sim, subject->time[i], i, states);
    }
    return STATUS_OK;
}

double accuracy_distance(const struct sim *sim, const struct accuracy_states *a,
                         const struct accuracy_states *b)
{
    double largest = 0;
    for (int i = 0; i < ACCURACY_TIMES; i++) {
        const double distance = weights_distance(sim, b->position[i], a->position[i]);
        if (!(distance <= largest)) /* no number is the worst */
            largest = distance;
    }
    return largest;
}

enum status accuracy_go(struct accuracy_run *run, const struct accuracy_subject *subject,
                        const struct accuracy_dials *dials, double limit, struct accuracy_states *states,
                        struct error *err)
{
    enum status status = accuracy_open(run, subject, dials, err);
    run->limit = limit;
    if (!status && !states->position[0])
        status = accuracy_states_open(states, &run->sim, err);
    if (!status)
        status = visit(run, subject, states, err);
    if (status)
        accuracy_close(run);
    return status;
}
