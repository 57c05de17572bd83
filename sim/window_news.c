/* What the run tells as it goes on, for those before the window. */
#include "sim/window_app.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void app_hear(void *self, double time, const char *line)
{
    struct app *app = self;
    struct window_news *news = &app->news;
    if (news->count == WINDOW_NEWS)
        memmove(news->items, news->items + 1, --news->count * sizeof *news->items);
    struct window_news_item *item = &news->items[news->count++];
    item->time = time;
    item->left = WINDOW_NEWS_SECONDS;
    snprintf(item->line, sizeof item->line, "%s", line);
}

void app_pass_news(struct app *app, double seconds)
{
    struct window_news *news = &app->news;
    size_t kept = 0;
    if (app->message_left > 0 && !app->film) { /* a film says that it is recorded */
        app->message_left -= seconds;
        if (app->message_left <= 0)
            hints_say(&app->hints, "");
        app->message_left = fmax(app->message_left, 0);
    }
    if (app->hints.help)
        return;
    for (size_t i = 0; i < news->count; i++) {
        news->items[i].left -= seconds;
        if (news->items[i].left > 0)
            news->items[kept++] = news->items[i];
    }
    news->count = kept;
}

void app_forget_news(struct app *app)
{
    struct window_news *news = &app->news;
    while (news->count && news->items[news->count - 1].time > app->live.sim->time)
        news->count--;
    app->telling.parts = 0;
}
