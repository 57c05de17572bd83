/* The live window: the clock becomes steps and pictures; how it opens and ends. */
#include "sim/window.h"
#include "common/command.h"
#include "common/vec3.h"
#include "sim/interrupt.h"
#include "sim/ledger.h"
#include "sim/window_app.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A picture is not drawn more often than this; steps get this much of its time at
 * least, and this share of it. */
static const double frame_seconds = 1.0 / 60, step_seconds = 0.012, step_share = 0.4;

/* The clock that the simulation follows does not run on while the program was stopped. */
static const double longest_tick = 0.25;

double app_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void app_say(struct app *app, const char *text)
{
    app_complain(app, text);
    app->message_left = WINDOW_NEWS_SECONDS;
}

void app_complain(struct app *app, const char *text)
{
    hints_say(&app->hints, text);
    app->message_left = 0;
    window_redraw(app->window);
}

void app_show_title(struct app *app)
{
    const char *path = app->live.sim->scene->path, *slash = strrchr(path, '/');
    char title[600];
    snprintf(title, sizeof title, "%.500s%s%s - balloon-sim", slash ? slash + 1 : path,
             app->live.paused ? " (paused)" : "", app->film ? " (recording)" : "");
    window_title(app->window, title);
    window_redraw(app->window);
}

int app_dot(const struct app *app)
{
    enum { WIDTH = 600, HEIGHT = 450 }; /* dots that are enough */
    int size[2];
    orbit_eye_size(&app->view, size);
    const int dot = size[0] / WIDTH < size[1] / HEIGHT ? size[0] / WIDTH : size[1] / HEIGHT;
    return dot > 1 ? dot : 1;
}

struct panel_box app_eye(const struct app *app)
{
    const int dot = app_dot(app);
    int place[2] = {app->x, app->y}, size[2];
    orbit_eye_size(&app->view, size);
    orbit_eye_place(&app->view, place);
    return (struct panel_box){app->x - place[0], app->y - place[1], size[0] / dot, size[1] / dot};
}

/* The next tick, once a picture's time has passed since the last; in a pause it only looks for signals. */
static void schedule(struct app *app)
{
    enum { LOOK = 200 }; /* ms */
    const double left = frame_seconds - (app_seconds() - app->clock);
    window_timer(app->window, app->live.paused ? LOOK : left > 0 ? (int)(1e3 * left) : 0);
}

void app_pause(struct app *app, bool paused)
{
    app->live.paused = paused;
    app->clock = app_seconds();
    app_show_title(app);
    schedule(app);
}

static void say_unless_ok(struct app *app, enum status status, const struct error *err)
{
    if (!status)
        return;
    app_complain(app, err->text);
    app_show_title(app);
}

void app_step(struct app *app)
{
    struct error err = {0};
    app->live.paused = true;
    app->stale = true;
    say_unless_ok(app, live_step(&app->live, &err), &err);
    app_record_frame(app);
    app_pause(app, true);
}

void app_turn(struct app *app, enum live_dial dial, double value)
{
    if (dial == LIVE_SPRINGS && !live_has_springs(&app->live)) {
        app_say(app, "springs: there are none; the skin is a membrane");
        return;
    }
    live_turn(&app->live, dial, value);
    app->touched = app->touched || dial != LIVE_PACE;
    app->stale = true;
    window_redraw(app->window);
}

void app_show(struct app *app, double frame)
{
    const double last = (double)app->live.past.count - 1;
    live_show(&app->live, (size_t)fmin(fmax(frame, 0), last));
    app_forget_news(app);
    app->touched = app->stale = true;
    app_pause(app, true);
}

void app_restart(struct app *app)
{
    live_restart(&app->live);
    app_forget_news(app);
    hints_say(&app->hints, "");
    app->touched = app->stale = true;
    app_pause(app, false);
}

void app_see_all(struct app *app)
{
    const struct sim *sim = app->live.sim;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            for (int i = 0; i < 3; i++) {
                const double at = sim->position[sim->triangle_point[t][k]][i];
                low[i] = fmin(low[i], at);
                high[i] = fmax(high[i], at);
            }
    orbit_frame(&app->orbit, &app->view, low, high);
}

/* As long as nobody has touched the run, its companions are asked how far off it is. */
static enum status ask_estimate(struct app *app, struct error *err)
{
    if (!app->estimate || app->touched)
        return STATUS_OK;
    return estimate_compare(app->estimate, app->live.sim, &app->error, err);
}

static bool interrupted(struct app *app)
{
    const enum status caught = interrupt_caught();
    if (!caught)
        return false;
    error_set(&app->failed, caught, "interrupted at %g s", app->live.sim->time);
    window_close(app->window);
    return true;
}

/* The steps of the time that has passed between two ticks. */
static void run(void *self)
{
    struct app *app = self;
    struct error err = {0};
    const uint64_t steps = app->live.sim->steps;
    const double due = app->due;
    app->due = 0;
    if (due == 0 || app->live.paused)
        return;
    enum status status = live_run(&app->live, due, fmax(step_seconds, step_share * app->drawing), &err);
    if (!status && app->live.sim->steps != steps)
        status = ask_estimate(app, &err);
    if (app->live.sim->steps != steps)
        app->stale = true;
    say_unless_ok(app, status, &err);
}

/* Steps are taken while a picture is being drawn, of the state before them; where none is drawn, as in a
 * window that is hidden, here. */
static void tick(void *self)
{
    struct app *app = self;
    const double now = app_seconds();
    if (interrupted(app))
        return;
    if (app->live.paused) {
        schedule(app);
        return;
    }
    run(app);
    app->due = fmin(now - app->clock, longest_tick);
    app->clock = now;
    app_pass_news(app, app->due);
    app_record_frame(app);
    window_redraw(app->window);
    schedule(app);
}

static void drawn(void *self)
{
    struct app *app = self;
    app_draw(app);
    if (app->log && app->stale)
        sim_log_row(app->log, app->live.sim, app->touched ? NAN : app->error);
    app->stale = false;
}

static void resized(void *self, int width, int height)
{
    struct app *app = self;
    app->view.width = width;
    app->view.height = height;
    window_redraw(app->window);
}

/* The camera of the scene, led by the hand from there on. */
static void set_camera(struct app *app)
{
    const struct scene_view *scene = &app->live.sim->scene->view;
    struct orbit *orbit = &app->orbit;
    const double radius = app->ball[3], *from = scene->camera;
    for (int i = 0; i < 3; i++)
        orbit->target[i] = app->ball[i] + radius * scene->target[i];
    orbit->distance = radius * vec3_length(from);
    orbit->azimuth_deg = atan2(from[0], from[2]) * 180 / M_PI;
    orbit->elevation_deg = atan2(from[1], hypot(from[0], from[2])) * 180 / M_PI;
    orbit->field_of_view_deg = scene->field_of_view;
    app->eye_distance = scene->eye_distance;
    skins_view(scene, &app->view);
    app->film_view = app->view;
    app->view.order = RENDER_SORT; /* live; films are as the scene says */
    app->view.samples = 1;
    app->view.outlines = RENDER_SAMPLED;
}

/* Where the scene asks for two buffers and the screen has them. */
static void use_quad(struct app *app)
{
    if (app->live.sim->scene->view.stereo != SCENE_QUAD)
        return;
    if (window_has_quad(app->window))
        app->view.stereo = RENDER_QUAD;
    else
        app_say(app, "stereo: this screen has no buffer for each eye; side by side instead");
}

static enum status open_window(struct app *app, struct error *err)
{
    static const struct window_events events = {.draw = drawn,
                                                .meanwhile = run,
                                                .resize = resized,
                                                .key = app_key,
                                                .button = app_pressed,
                                                .wheel = app_wheel,
                                                .motion = app_moved,
                                                .timer = tick};
    struct error reason = {0};
    if (window_open("balloon-sim", app->view.width, app->view.height, &events, app, &app->window, &reason))
        return error_set(
            err, reason.status,
            "%.800s; --frames DIR, --movie FILE, --contact-sheet FILE and --log FILE run without one",
            reason.text);
    enum status status = render_open_window(app->window, &app->render, err);
    use_quad(app);
    if (!status)
        status = app_open_pictures(app, err);
    return status;
}

static enum status open_log(struct app *app, struct error *err)
{
    const struct sim_log_options log = {.position_error = app->estimate};
    enum status status = ledger_open(app->live.sim, err);
    return status ? status : sim_log_open(app->options->log, &log, &app->log, err);
}

static void stepped(void *self)
{
    struct app *app = self;
    news_note(&app->telling, app->live.sim);
}

static enum status begin(struct app *app, struct sim *sim, struct error *err)
{
    app->ball[3] = skins_ball(sim, app->ball);
    app->live.sim = sim;
    app->rounding = app_find_rounding(sim);
    set_camera(app);
    enum status status = open_window(app, err);
    if (!status && app->options->log)
        status = open_log(app, err);
    if (!status)
        status = live_open(&app->live, sim, app->options->memory, err);
    else
        app->live = (struct live){0};
    app->live.stepped = stepped;
    app->live.self = app;
    return status;
}

enum status sim_window(const struct sim_window_options *options, struct sim *sim, struct estimate *estimate,
                       struct error *err)
{
    struct app app = {.options = options, .estimate = estimate, .error = NAN, .panel = true, .stale = true};
    app.telling = (struct news){.hear = app_hear, .self = &app};
    interrupt_watch();
    enum status status = begin(&app, sim, err);
    if (!status) {
        app_pause(&app, false);
        window_run(app.window);
        app_end_recording(&app);
        if (app.failed.status)
            *err = app.failed;
        status = app.failed.status;
    }
    struct error other = {0};
    if (status && status != interrupt_caught())
        sim_log_abandon(app.log);
    else if (sim_log_close(app.log, &other) && !status) {
        *err = other;
        status = other.status;
    }
    live_close(&app.live);
    app_close_pictures(&app);
    render_close(app.render);
    window_free(app.window);
    return status;
}
