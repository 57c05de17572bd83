/* Progress: a bar on a terminal, or now and then a note. */
#include "common/command.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static struct {
    const char *what, *unit;
    double total, began, shown;
    bool on;
    bool started;
    double from; /* what was done at the beginning: a run that is gone on with */
} progress;

/* The thread that notes how long the work takes: it waits whatever the others are at, so that a first step
 * of a day is told, too. */
static struct {
    bool on, end;
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t ended;
    double done;
} watch = {.lock = PTHREAD_MUTEX_INITIALIZER};

static double now(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* "3.2 hours" */
static void tell_time(double seconds, char *text, size_t size)
{
    static const struct {
        double seconds;
        const char *name;
    } unit[] = {{1, "s"}, {60, "minutes"}, {3600, "hours"}, {86400, "days"}, {365.25 * 86400, "years"}};
    size_t i = 0;
    while (i + 1 < sizeof unit / sizeof *unit && seconds >= 2 * unit[i + 1].seconds)
        i++;
    snprintf(text, size, "%.2g %s", seconds / unit[i].seconds, unit[i].name);
}

static void tell(double done, double spent)
{
    enum { SOON = 60 };
    const double share = done / progress.total, rate = (done - progress.from) / spent;
    const double left = rate > 0 ? (progress.total - done) / rate : INFINITY;
    char so_far[32], rest[32];
    tell_time(spent, so_far, sizeof so_far);
    tell_time(left, rest, sizeof rest);
    if (rate > 0 && left > SOON)
        command_note("%s: %.2g %% is done after %s; at this pace the rest takes %s", progress.what,
                     100 * share, so_far, rest);
    else if (!(rate > 0))
        command_note("%s: %s have gone by without a measurable part being done", progress.what, so_far);
}

/* What waits for a machine that others keep busy is not slow by itself: no word before it
 * has worked for some time. */
static void *keep_watch(void *context)
{
    enum { FIRST = 20, WORK = 10 };
    (void)context;
    double due = FIRST;
    pthread_mutex_lock(&watch.lock);
    while (!watch.end) {
        struct timespec time;
        clock_gettime(CLOCK_MONOTONIC, &time);
        time.tv_sec++;
        pthread_cond_timedwait(&watch.ended, &watch.lock, &time);
        const double spent = now(CLOCK_MONOTONIC) - progress.began;
        if (watch.end || spent < due || now(CLOCK_PROCESS_CPUTIME_ID) < WORK)
            continue;
        due = 2 * spent;
        tell(watch.done, spent);
    }
    pthread_mutex_unlock(&watch.lock);
    return NULL;
}

/* Without the thread the work goes on all the same. */
static void begin_watch(void)
{
    pthread_condattr_t clock;
    watch.done = 0;
    watch.end = false;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&watch.ended, &clock);
    pthread_condattr_destroy(&clock);
    watch.on = !pthread_create(&watch.thread, NULL, keep_watch, NULL);
    if (!watch.on)
        pthread_cond_destroy(&watch.ended);
}

static void end_watch(void)
{
    pthread_mutex_lock(&watch.lock);
    watch.end = true;
    pthread_cond_signal(&watch.ended);
    pthread_mutex_unlock(&watch.lock);
    pthread_join(watch.thread, NULL);
    pthread_cond_destroy(&watch.ended);
    watch.on = false;
}

void progress_begin(const char *what, const char *unit, double total)
{
    progress.on = !command_is_quiet() && isatty(STDERR_FILENO);
    progress.what = what;
    progress.unit = unit;
    progress.total = total;
    progress.began = now(CLOCK_MONOTONIC);
    progress.shown = progress.from = 0;
    progress.started = false;
    if (!command_is_quiet() && !progress.on)
        begin_watch();
}

static void show(double done, double time)
{
    enum { WIDTH = 30 };
    double spent = time - progress.began;
    double rate = spent > 0 ? (done - progress.from) / spent : 0;
    double share = progress.total > 0 ? fmin(done / progress.total, 1) : 0;
    char bar[WIDTH + 1];
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < share * WIDTH ? '#' : '.';
    bar[WIDTH] = '\0';
    fprintf(stderr, "\r%s %s %3.0f %%  %.0f %s/s  %.0f s left \033[K", progress.what, bar, 100 * share, rate,
            progress.unit, rate > 0 ? (progress.total - done) / rate : 0);
    progress.shown = time;
}

void progress_update(double done)
{
    pthread_mutex_lock(&watch.lock);
    watch.done = done;
    if (!progress.started)
        progress.from = done;
    progress.started = true;
    pthread_mutex_unlock(&watch.lock);
    if (!progress.on)
        return;
    double time = now(CLOCK_MONOTONIC);
    if (time - progress.shown >= 0.1)
        show(done, time);
}

void progress_end(void)
{
    if (watch.on)
        end_watch();
    if (progress.on)
        fputs("\r\033[K", stderr);
    progress.on = false;
}
