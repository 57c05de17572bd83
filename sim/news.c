#include "sim/news.h"
#include "common/command.h"
#include "sim/auto.h"
#include "sim/guard.h"

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

void news_note(struct news *news, struct sim *sim)
{
    char line[LINE_SIZE];
    note_method(news, sim);
    for (size_t i = 0; i < sim->news_count; i++) {
        const struct sim_news *told = &sim->news[i];
        snprintf(line, sizeof line, "at %.4g s: balloons[%zu]: %s: %s", told->time, told->balloon,
                 told->effect, told->text);
        note(news, told->time, line);
    }
    sim->news_count = 0;
}
