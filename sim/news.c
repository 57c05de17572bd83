#include "sim/news.h"
#include "common/command.h"

void news_note(struct sim *sim)
{
    for (size_t i = 0; i < sim->news_count; i++) {
        const struct sim_news *news = &sim->news[i];
        command_note("at %.4g s: balloons[%zu]: %s: %s", news->time, news->balloon, news->effect, news->text);
    }
    sim->news_count = 0;
}
