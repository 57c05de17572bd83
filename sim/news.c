#include "sim/news.h"
#include "common/command.h"
#include "sim/auto.h"
#include "sim/guard.h"

#include <math.h>
#include <stdio.h>

enum { LINE_SIZE = 512 };

static void note(const struct news *news, double time, const char *line)
{
    command_note("%s", line);
    if (news->hear)
        news->hear(news->self, time, line);
}

static void note_method(struct news *news, struct sim *sim)
{
    char text[256], line[LINE_SIZE];
    if (auto_describe(sim, &news->choices, text, sizeof text)) {
        note(news, sim->time, text);
    } else if (sim->substeps > 1 && sim->substeps >= 10 * news->parts && sim->acting == sim->integrator) {
        guard_describe(sim, text, sizeof text);
        snprintf(line, sizeof line, "at %.4g s: %s", sim->time, text);
        note(news, sim->time, news->parts ? line : text);
        news->parts = sim->substeps;
    }
}

static void note_passed(struct news *news, struct sim *sim)
{
    char text[256], line[LINE_SIZE];
    const double passed = guard_passed(sim);
    if (!(passed >= 10 * news->passed && passed > 0))
        return;
    guard_describe(sim, text, sizeof text);
    const int used = sim->steps > 1 ? snprintf(line, sizeof line, "at %.4g s: ", sim->time) : 0;
    snprintf(line + used, sizeof line - (size_t)used, "%s; it is taken all the same: time.guard is off",
             text);
    note(news, sim->time, line);
    news->passed = passed;
}

/* Says that a method which chooses its steps takes such short ones that it will hardly see the end, and again
 * when ten times as many are left. Some in a row count: the first few are always short, and one before an
 * event. */
static void note_pace(struct news *news, const struct sim *sim)
{
    enum { IN_A_ROW = 100, MANY = 1000000 };
    if (!(sim->integrator->flags & INTEGRATOR_ADAPTIVE))
        return;
    const double steps = (double)sim->steps - (double)news->pace.step; /* fewer than none: gone back */
    if (steps >= 0 && steps < IN_A_ROW)
        return;
    const double mean = (sim->time - news->pace.time) / steps,
                 rest = (sim->scene->time.end - sim->time) / mean;
    news->pace.step = sim->steps;
    news->pace.time = sim->time;
    if (!(steps <= 2 * IN_A_ROW && rest >= MANY && rest >= 10 * news->pace.rest))
        return;
    char text[256], line[LINE_SIZE];
    snprintf(text, sizeof text,
             "time.tolerance=%g and the forces ask for them; stiff ones ask nothing of "
             "time.integrator=bdf2",
             sim->scene->time.tolerance);
    const struct guard_follow follow = guard_following(sim);
    if (follow.step < INFINITY)
        guard_describe_follow(sim, &follow, text, sizeof text);
    snprintf(line, sizeof line,
             "at %.4g s: %s takes steps of %.2g s, and %.2g of them are left to time.end: %s", sim->time,
             sim->integrator->name, mean, rest, text);
    note(news, sim->time, line);
    news->pace.rest = rest;
}

void news_note(struct news *news, struct sim *sim)
{
    char line[LINE_SIZE];
    note_method(news, sim);
    note_passed(news, sim);
    note_pace(news, sim);
    for (size_t i = 0; i < sim->news_count; i++) {
        const struct sim_news *told = &sim->news[i];
        snprintf(line, sizeof line, "at %.4g s: balloons[%zu]: %s: %s", told->time, told->balloon,
                 told->effect, told->text);
        note(news, told->time, line);
    }
    sim->news_count = 0;
}
