#include "sim/effect_cost.h"
#include "common/vec3.h"
#include "sim/gas.h"
#include "sim/reorder.h"
#include "sim/without.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

struct subject {
    const struct scene *scene;
    const struct mesh *meshes;
    const struct pricing_options *options;
    double done, each; /* share of the whole so far; of a run */
};

/* One run of the scene or of what is left of it. */
struct course {
    struct sim sim;
    double stretch[EFFECT_COST_STRETCHES]; /* s: the shortest so far */
    double first_break;                    /* s */
};

static enum status step(const struct subject *s, struct course *c, struct error *err)
{
    if (pricing_ask(s->options, s->done, err))
        return err->status;
    const enum status status = pricing_step(s->options, &c->sim, err);
    c->sim.news_count = 0;
    if (c->sim.broken && isinf(c->first_break))
        c->first_break = c->sim.time;
    return status;
}

/* Whether it is at the time, or past it where the method can look into its steps: else where one of the
 * scene's steps ends, as the other run does, which may split them in other parts. */
static bool is_at(const struct sim *sim, double time)
{
    if (sim->integrator->look)
        return sim->time >= time;
    return sim->steps_since % sim->substeps == 0 && sim->time > time - 1e-6 * sim->whole_step;
}

static enum status go_to(const struct subject *s, struct course *c, double time, double *seconds,
                         struct error *err)
{
    enum status status = STATUS_OK;
    const double began = pricing_now();
    while (!status && !is_at(&c->sim, time))
        status = step(s, c, err);
    *seconds = pricing_now() - began;
    return status;
}

/* How far the scene gets in the time that a run may take; and what the whole is, should no run beside it come
 * to an end. */
static enum status find_span(const struct subject *s, double limit, struct effect_cost_table *table,
                             double *seconds, struct error *err)
{
    struct course whole = {.first_break = INFINITY};
    const double began = pricing_now(), least = s->scene->time.step * EFFECT_COST_STRETCHES;
    enum status status = sim_open(&whole.sim, s->scene, s->meshes, 1, err);
    table->bytes = whole.sim.bytes;
    while (!status && !sim_at_end(&whole.sim) && (pricing_now() - began < limit || whole.sim.time < least))
        status = step(s, &whole, err);
    if (!status && whole.sim.steps == 0)
        status = error_set(err, STATUS_INPUT,
                           "--effect-cost: time.end = %g is over before a step of time.step = %g",
                           s->scene->time.end, s->scene->time.step);
    *seconds = pricing_now() - began;
    table->end = s->scene->time.end;
    table->span = fmin(whole.sim.time, table->end);
    if (!status) {
        table->steps = whole.sim.steps;
        table->pieces = sim_measure(&whole.sim).pieces;
        table->first_break = whole.first_break;
        table->seconds = *seconds / (double)whole.sim.steps;
    }
    sim_clear(&whole.sim);
    return status;
}

/* RMS over the points that both began with, each in its balloon's radius. */
static double distance(const struct sim *a, const struct sim *b)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < a->balloon_count; i++) {
        const struct sim_balloon *x = &a->balloons[i], *y = &b->balloons[i];
        const double scale = x->radius > 0 ? x->radius : 1;
        for (uint32_t p = 0; x->point_begin + p < x->point_end && y->point_begin + p < y->point_end;
             p++, count++) {
            const double *at = a->position[reorder_point(x, p)], *other = b->position[reorder_point(y, p)];
            const double d = vec3_distance(at, other) / scale;
            sum += d * d;
        }
    }
    return sqrt(sum / count);
}

/* Something that both runs have: its largest size so far, and the largest difference. */
struct quantity {
    double size, change;
};

static void take(struct quantity *quantity, double whole, double rest)
{
    quantity->size = fmax(quantity->size, fmax(fabs(whole), fabs(rest)));
    quantity->change = fmax(quantity->change, fabs(whole - rest));
}

static double relative(const struct quantity *quantity)
{
    return quantity->size > 0 ? quantity->change / quantity->size : 0;
}

struct answer {
    struct quantity volume, pressure;
};

static void compare(struct course *whole, struct course *rest, double time, struct answer *answer,
                    struct effect_cost_row *row)
{
    struct sim *w = &whole->sim, *r = &rest->sim;
    if (isfinite(whole->first_break) || isfinite(rest->first_break)) {
        row->position_after = fmax(row->position_after, distance(w, r));
        return;
    }
    sim_look(w, time);
    sim_look(r, time);
    row->position = fmax(row->position, distance(w, r));
    take(&answer->volume, sim_measure(w).volume, sim_measure(r).volume);
    for (size_t i = 0; i < w->balloon_count; i++) {
        const double outside = w->balloons[i].gas ? w->balloons[i].gas->scene->ambient : 0;
        take(&answer->pressure, outside + gas_gauge_pressure(w, &w->balloons[i]),
             outside + gas_gauge_pressure(r, &r->balloons[i]));
    }
    row->volume = relative(&answer->volume);
    row->pressure = relative(&answer->pressure);
    sim_look_end(r);
    sim_look_end(w);
}

/* Both through all stretches in turns, each first in every other one. */
static enum status alternate(struct subject *s, struct course *whole, struct course *rest, double span,
                             struct effect_cost_row *row, struct error *err)
{
    struct answer answer = {0};
    row->position = row->volume = row->pressure = row->position_after = 0;
    for (int i = 0; i < EFFECT_COST_STRETCHES; i++) {
        const double time = span * (i + 1) / EFFECT_COST_STRETCHES;
        for (int k = 0; k < 2; k++) {
            struct course *c = (i + k) % 2 ? rest : whole;
            double seconds;
            const enum status status = go_to(s, c, time, &seconds, err);
            if (status) {
                row->failed = c == rest && (status == STATUS_DIVERGED || status == STATUS_RANGE);
                return status;
            }
            c->stretch[i] = fmin(c->stretch[i], seconds);
            s->done += s->each / EFFECT_COST_STRETCHES;
        }
        compare(whole, rest, time, &answer, row);
    }
    return STATUS_OK;
}

static double sum(const double *seconds)
{
    double all = 0;
    for (int i = 0; i < EFFECT_COST_STRETCHES; i++)
        all += seconds[i];
    return all;
}

static void note(struct course *whole, struct course *rest, struct effect_cost_table *table,
                 struct effect_cost_row *row)
{
    const double all = sum(whole->stretch), left = sum(rest->stretch);
    struct sim *w = &whole->sim, *r = &rest->sim;
    row->steps = r->steps;
    row->seconds = left / (double)r->steps;
    row->share = left > all ? all / left - 1 : 1 - left / all;
    row->bytes = (double)w->bytes - (double)r->bytes;
    row->first_break = rest->first_break;
    row->pieces = sim_measure(r).pieces;
    table->steps = w->steps;
    table->first_break = whole->first_break;
    table->pieces = sim_measure(w).pieces;
    table->seconds = table->seconds > 0 ? fmin(table->seconds, all / (double)w->steps)
                                        : all / (double)w->steps;
}

static enum status go(struct subject *s, const struct scene *left, struct effect_cost_table *table,
                      struct effect_cost_row *row, struct error *err)
{
    struct course whole, rest;
    for (int i = 0; i < EFFECT_COST_STRETCHES; i++)
        whole.stretch[i] = rest.stretch[i] = INFINITY;
    enum status status = STATUS_OK;
    for (int k = 0; k < table->goes && !status; k++) {
        whole.first_break = rest.first_break = INFINITY;
        whole.sim = rest.sim = (struct sim){0};
        status = sim_open(&whole.sim, s->scene, s->meshes, 1, err);
        if (!status)
            status = sim_open(&rest.sim, left, s->meshes, 1, err);
        row->refused[0] = 0;
        if (!status)
            status = alternate(s, &whole, &rest, table->span, row, err);
        if (!status && k + 1 == table->goes)
            note(&whole, &rest, table, row);
        sim_clear(&rest.sim);
        sim_clear(&whole.sim);
    }
    return status;
}

/* What cannot be without the effect is a line of the table; what ends all is an error. */
static enum status measure_row(struct subject *s, struct effect_cost_table *table,
                               const struct effect *effect, struct error *err)
{
    struct effect_cost_row *row = &table->rows[table->count++];
    struct without without;
    *row = (struct effect_cost_row){.effect = effect,
                                    .seconds = NAN,
                                    .share = NAN,
                                    .bytes = NAN,
                                    .position = NAN,
                                    .position_after = NAN,
                                    .volume = NAN,
                                    .pressure = NAN,
                                    .first_break = INFINITY};
    enum status status = without_open(&without, s->scene, effect, err);
    row->instead = without.instead;
    if (!status)
        status = go(s, &without.scene, table, row, err);
    without_close(&without);
    if (status == STATUS_INPUT || row->failed) {
        snprintf(row->refused, sizeof row->refused, "%s", err->text);
        *err = (struct error){0};
        status = STATUS_OK;
    }
    return status;
}

enum status effect_cost_measure(const struct scene *scene, const struct mesh *meshes,
                                const struct pricing_options *options, struct effect_cost_table *table,
                                struct error *err)
{
    enum { GOES_LEAST = 2, GOES_MOST = 8 };
    const double count = (double)effects_count(scene);
    struct subject s = {.scene = scene, .meshes = meshes, .options = options};
    double seconds;
    *table = (struct effect_cost_table){.first_break = INFINITY};
    enum status status = find_span(&s, options->seconds / (2 * GOES_LEAST * count + 1), table, &seconds, err);
    table->goes = (int)fmax(fmin((options->seconds - seconds) / (2 * count * seconds), GOES_MOST),
                            GOES_LEAST);
    s.each = 1 / (2 * count * table->goes);
    for (const struct effect *const *effect = effects; *effect && !status; effect++)
        if (effect_is_wanted(*effect, scene))
            status = measure_row(&s, table, *effect, err);
    return status;
}

bool effect_cost_breaks_otherwise(const struct effect_cost_table *table, const struct effect_cost_row *row)
{
    const double a = table->first_break, b = row->first_break;
    return isfinite(a) != isfinite(b) || (isfinite(a) && fabs(a - b) > 0.01 * a);
}

static void say_break(const struct effect_cost_table *table, const struct effect_cost_row *row, double before,
                      char *text, size_t size)
{
    const int length = snprintf(text, size,
                                "until the skin first breaks at %.3g s changes the answer by %.1g, from then "
                                "on positions by %.1g radii",
                                table->first_break, before, row->position_after);
    if (row->pieces != table->pieces)
        snprintf(text + length, size - (size_t)length, "; in %u pieces, and without it in %u", table->pieces,
                 row->pieces);
}

static void say_change(const struct effect_cost_table *table, const struct effect_cost_row *row, char *text,
                       size_t size)
{
    const double before = fmax(row->position, fmax(row->volume, row->pressure));
    const double most = fmax(before, row->position_after);
    const bool otherwise = effect_cost_breaks_otherwise(table, row);
    if (otherwise && isinf(row->first_break))
        snprintf(text, size, "without it nothing breaks (with it at %.3g s): you need it",
                 table->first_break);
    else if (otherwise && isinf(table->first_break))
        snprintf(text, size, "without it the skin breaks at %.3g s: you need it", row->first_break);
    else if (otherwise)
        snprintf(text, size, "the skin first breaks at %.3g s, and without it at %.3g s: you need it",
                 table->first_break, row->first_break);
    else if (most == 0 && row->pieces == table->pieces)
        snprintf(text, size, "changes nothing: you do not need it");
    else if (most < EFFECT_COST_VISIBLE && row->pieces == table->pieces)
        snprintf(text, size, "changes the answer by %.1g: you may not need it", most);
    else if (isfinite(table->first_break))
        say_break(table, row, before, text, size);
    else
        snprintf(text, size,
                 "changes positions by %.2g radii, the volume by %.2g %%, the pressure by %.2g %%",
                 row->position, 100 * row->volume, 100 * row->pressure);
}

/* Times are as good as a hundredth. */
static void say_share(double share, char *text, size_t size)
{
    if (share < -0.01)
        snprintf(text, size, "saves %.2g %%", -100 * share);
    else
        snprintf(text, size, "%.2g %%", 100 * fmax(share, 0));
}

static void say_steps(const struct effect_cost_table *table, const struct effect_cost_row *row, char *text,
                      size_t size)
{
    *text = 0;
    if (row->steps != table->steps)
        snprintf(text, size, " (%" PRIu64 " steps, and without it %" PRIu64 ")", table->steps, row->steps);
}

void effect_cost_say(const struct effect_cost_table *table, const struct effect_cost_row *row, char *text,
                     size_t size)
{
    char change[256], steps[64], share[32];
    const char *name = row->effect->name;
    if (row->failed)
        snprintf(text, size, "%s: you need it; without it: %s", name, row->refused);
    else if (*row->refused)
        snprintf(text, size, "%s: cannot be left out alone: %s", name, row->refused);
    else {
        say_change(table, row, change, sizeof change);
        say_steps(table, row, steps, sizeof steps);
        say_share(row->share, share, sizeof share);
        snprintf(text, size, "%s%s%s: %s of the time%s, %s", name, row->instead ? " in place of " : "",
                 row->instead ? row->instead : "", share, steps, change);
    }
}
