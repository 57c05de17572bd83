/* Progress: a bar on a terminal, or now and then a note. */
#include "common/command.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

/* A thread looks at it every second whatever the others are at, so that a first step of a day
 * is told, too. */
static struct {
    const char *what, *size, *unit;
    double total, began;
    bool bar; /* or else notes */
    bool watched, end;
    pthread_t thread;
    pthread_mutex_t lock; /* for all that follows */
    pthread_cond_t ended;
    bool started;
    const char *at;    /* what it is at, in words; or NULL */
    double from, done; /* from: what was done at the beginning, of a run that is gone on with */
    double shown;      /* when the bar was drawn last */
    /* Or how long it had taken, and what was done, at the last note; 0: there was none. */
    double told, told_share;
} progress = {.lock = PTHREAD_MUTEX_INITIALIZER};

static double now(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Two digits, and more only before the point. */
static void tell_number(double value, char *text, size_t size)
{
    snprintf(text, size, value >= 10 && value < 1e6 ? "%.0f" : "%.2g", value);
}

/* "3.2 hours" */
static void tell_time(double seconds, char *text, size_t size)
{
    static const struct {
        double seconds;
        const char *name;
    } unit[] = {{1, "s"}, {60, "minutes"}, {3600, "hours"}, {86400, "days"}, {365.25 * 86400, "years"}};
    char number[16];
    size_t i = 0;
    while (i + 1 < sizeof unit / sizeof *unit && seconds >= 2 * unit[i + 1].seconds)
        i++;
    tell_number(seconds / unit[i].seconds, number, sizeof number);
    snprintf(text, size, "%s %s", number, unit[i].name);
}

static double share_done(void)
{
    return progress.total > 0 ? fmin(progress.done / progress.total, 1) : 0;
}

/* A second, of what is measured in the work's unit; 0: nothing is done yet. */
static double rate_after(double spent)
{
    return spent > 0 ? (progress.done - progress.from) / spent : 0;
}

static void show_bar(double time)
{
    enum { WIDTH = 30 };
    const double share = share_done(), rate = rate_after(time - progress.began);
    char bar[WIDTH + 1], pace[32], left[32];
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < share * WIDTH ? '#' : '.';
    bar[WIDTH] = '\0';
    flockfile(stderr); /* a note is a line of its own */
    fprintf(stderr, "\r%s %s %3.0f %%", progress.what, bar, 100 * share);
    if (rate > 0) {
        tell_number(rate, pace, sizeof pace);
        tell_time((progress.total - progress.done) / rate, left, sizeof left);
        fprintf(stderr, "  %s %s/s  %s left", pace, progress.unit, left);
    } else if (progress.at) {
        fprintf(stderr, "  %s", progress.at);
    }
    fputs(" \033[K", stderr);
    funlockfile(stderr);
    progress.shown = time;
}

enum { FIRST = 5, WORK = 3, BETWEEN = 10, SOON = 5 }; /* s */

/* The first is soon there, and says how large the work is; others come by the tenths that are
 * done, or once it has taken twice as long. What waits for a machine that others keep busy is not slow by
 * itself: no word before it has worked for some time. */
static bool is_note_due(double spent)
{
    if (progress.told == 0)
        return spent >= FIRST && now(CLOCK_PROCESS_CPUTIME_ID) >= WORK;
    const bool is_tenth = floor(10 * share_done()) > floor(10 * progress.told_share);
    return spent >= progress.told + BETWEEN && (is_tenth || spent >= 2 * progress.told);
}

static void tell(double spent)
{
    const double rate = rate_after(spent), left = (progress.total - progress.done) / rate;
    const char *size = progress.told > 0 ? "" : progress.size;
    char so_far[32], rest[32], percent[32];
    const bool is_nearly_done = rate > 0 && left < SOON;
    if (is_nearly_done && spent < fmax(2 * FIRST, 2 * progress.told))
        return; /* or so it seems: what takes longer than it should is told of all the same */
    tell_number(100 * share_done(), percent, sizeof percent);
    tell_time(spent, so_far, sizeof so_far);
    tell_time(left, rest, sizeof rest);
    const char *comma = *size ? "; " : "";
    if (is_nearly_done)
        command_note("%s: %s%s%s %% is done after %s", progress.what, size, comma, percent, so_far);
    else if (rate > 0)
        command_note("%s: %s%s%s %% is done after %s; at this pace the rest takes %s", progress.what, size,
                     comma, percent, so_far, rest);
    else
        command_note("%s: %s%s%s have gone by without a measurable part being done%s%s", progress.what, size,
                     comma, so_far, progress.at ? ": " : "", progress.at ? progress.at : "");
    progress.told = spent;
    progress.told_share = share_done();
}

static void *keep_watch(void *context)
{
    (void)context;
    pthread_mutex_lock(&progress.lock);
    while (!progress.end) {
        struct timespec second;
        clock_gettime(CLOCK_MONOTONIC, &second);
        second.tv_sec++;
        pthread_cond_timedwait(&progress.ended, &progress.lock, &second);
        const double time = now(CLOCK_MONOTONIC);
        if (progress.end)
            break;
        if (progress.bar)
            show_bar(time);
        else if (is_note_due(time - progress.began))
            tell(time - progress.began);
    }
    pthread_mutex_unlock(&progress.lock);
    return NULL;
}

/* Without the thread the work goes on all the same. */
static void begin_watch(void)
{
    pthread_condattr_t clock;
    progress.end = false;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&progress.ended, &clock);
    pthread_condattr_destroy(&clock);
    progress.watched = !pthread_create(&progress.thread, NULL, keep_watch, NULL);
    if (!progress.watched)
        pthread_cond_destroy(&progress.ended);
}

static void end_watch(void)
{
    pthread_mutex_lock(&progress.lock);
    progress.end = true;
    pthread_cond_signal(&progress.ended);
    pthread_mutex_unlock(&progress.lock);
    pthread_join(progress.thread, NULL);
    pthread_cond_destroy(&progress.ended);
    progress.watched = false;
}

void progress_begin(const char *what, const char *size, const char *unit, double total)
{
    progress.bar = !command_is_quiet() && isatty(STDERR_FILENO);
    progress.what = what;
    progress.size = size;
    progress.unit = unit;
    progress.total = total;
    progress.began = now(CLOCK_MONOTONIC);
    progress.started = false;
    progress.at = NULL;
    progress.from = progress.done = progress.shown = progress.told = progress.told_share = 0;
    if (!command_is_quiet())
        begin_watch();
}

void progress_update(double done)
{
    pthread_mutex_lock(&progress.lock);
    progress.done = done;
    if (!progress.started)
        progress.from = done;
    progress.started = true;
    const double time = progress.bar ? now(CLOCK_MONOTONIC) : 0;
    if (progress.bar && time - progress.shown >= 0.1)
        show_bar(time);
    pthread_mutex_unlock(&progress.lock);
}

void progress_say(const char *at)
{
    pthread_mutex_lock(&progress.lock);
    progress.at = at;
    pthread_mutex_unlock(&progress.lock);
}

void progress_make_way(void)
{
    if (progress.bar)
        fputs("\r\033[K", stderr);
}

void progress_end(void)
{
    if (progress.watched)
        end_watch();
    progress_make_way();
    progress.bar = false;
}
