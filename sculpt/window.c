/* The sculpting window: what the hand does becomes calls of the session. */
#include "sculpt/window.h"

#include "sculpt/window_app.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum {
    WINDOW_WIDTH = 960,
    WINDOW_HEIGHT = 720,
    LOOK_MILLISECONDS = 20, /* how often it is looked whether a file has been written */
};

void app_say(struct app *app, const char *text)
{
    hints_say(&app->hints, text);
    window_redraw(app->window);
}

/* What went wrong is said where the hand looks. */
void app_say_unless_ok(struct app *app, enum status status, const struct error *err)
{
    if (status)
        app_say(app, err->text);
}

void app_show_title(struct app *app)
{
    char title[PATH_MAX + 32];
    snprintf(title, sizeof title, "%s%s - balloon-sculpt", app->open ? app->session.path : app->options->path,
             app->session.unsaved ? " *" : "");
    window_title(app->window, title);
    window_redraw(app->window);
}

/* The balloon follows the sculpture. */
void app_remake_balloon(struct app *app)
{
    struct error err = {0};
    if (!app->preview)
        return;
    enum status status = balloon_mesh(&app->balloon, &app->session.tree, &err);
    app->preview = !status;
    app_say_unless_ok(app, status, &err);
    if (!status && app->balloon.kept < 0.5) {
        char text[160];
        snprintf(
            text, sizeof text,
            "thin walls are lost: the balloon holds %.0f %% of what was carved; balloon-sculpt --solid fills hollows",
            100 * app->balloon.kept);
        app_say(app, text);
    }
    app_schedule(app);
}

void app_see_all(struct app *app)
{
    const struct octree_info info = octree_measure(&app->session.tree);
    const double side = 1 << app->session.tree.depth;
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = info.low[i] / side;
        high[i] = (info.high[i] + 1) / side;
    }
    orbit_frame(&app->orbit, &app->view, low, high);
}

struct render_view app_drawn_view(const struct app *app)
{
    struct render_view view = app->view;
    orbit_make_even(&view);
    orbit_camera(&app->orbit, &view.camera);
    return view;
}

void app_aim(struct app *app)
{
    double origin[3], direction[3];
    const struct render_view view = app_drawn_view(app);
    if (orbit_ray(&view, app->x + 0.5, app->y + 0.5, origin, direction))
        session_aim(&app->session, origin, direction);
    else
        session_aim_nowhere(&app->session);
}

static void moved(void *self, int x, int y, int modifiers)
{
    struct app *app = self;
    struct error err = {0};
    const int dx = x - app->x, dy = y - app->y;
    (void)modifiers;
    if (dx || dy)
        app->moved = app_seconds();
    app->x = x;
    app->y = y;
    if (!app->open)
        return;
    if (app->drag == DRAG_TURN)
        orbit_turn(&app->orbit, dx, dy);
    else if (app->drag == DRAG_PAN)
        orbit_pan(&app->orbit, &app->view, dx, dy);
    orbit_camera(&app->orbit, &app->view.camera);
    app_aim(app);
    if (app->drag == DRAG_TOOL) {
        const char *nothing = session_why_no_drag(&app->session);
        if (nothing)
            app_say(app, nothing);
        app_say_unless_ok(app, session_drag(&app->session, &err), &err);
    }
    window_redraw(app->window);
}

static void begin_drag(struct app *app, enum window_button button, int modifiers)
{
    struct error err = {0};
    if (button == WINDOW_RIGHT || (button == WINDOW_MIDDLE && modifiers & WINDOW_SHIFT))
        app->drag = DRAG_PAN;
    else if (button == WINDOW_MIDDLE || modifiers & WINDOW_ALT)
        app->drag = DRAG_TURN;
    else if (app->preview)
        app_say(app, "The balloon is for looking; p goes back to the sculpture.");
    else {
        app->drag = DRAG_TOOL;
        const char *nothing = session_why_nothing(&app->session);
        hints_say(&app->hints, nothing ? nothing : "");
        app_say_unless_ok(app, session_press(&app->session, &err), &err);
    }
}

/* Undo that reaches back less far is told of. */
static void tell_forgotten(struct app *app)
{
    const struct session *session = &app->session;
    const size_t megabytes = app->options->undo_memory >> 20;
    char text[200];
    if (session->forgotten == app->forgotten)
        return;
    app->forgotten = session->forgotten;
    if (history_can_undo(&session->history))
        snprintf(
            text, sizeof text,
            "The undo memory of %zu MB is full: the oldest steps were let go (--undo-memory MB gives more).",
            megabytes);
    else
        snprintf(
            text, sizeof text,
            "This step is larger than the undo memory of %zu MB: nothing can be undone (--undo-memory MB "
            "gives more).",
            megabytes);
    app_say(app, text);
}

void app_end_drag(struct app *app)
{
    struct error err = {0};
    if (app->drag == DRAG_NOTHING)
        return;
    if (app->drag == DRAG_TOOL && app->session.dragging) {
        app_say_unless_ok(app, session_release(&app->session, &err), &err);
        if (app->session.unsaved && !app->session.saving)
            app->written = NULL;
        tell_forgotten(app);
        if (app->session.tree.root == 0)
            app_say(app, "Nothing is left of the cube; ctrl+z takes the last step back.");
    }
    app->drag = DRAG_NOTHING;
    app_aim(app);
    app_show_title(app);
}

static void pressed(void *self, enum window_button button, bool down, int x, int y, int modifiers)
{
    struct app *app = self;
    moved(app, x, y, modifiers);
    if (!app->open || app->question)
        return;
    if (down && app->drag == DRAG_NOTHING)
        begin_drag(app, button, modifiers);
    else if (!down)
        app_end_drag(app);
    window_redraw(app->window);
}

static void left_window(void *self)
{
    struct app *app = self;
    if (app->open && app->drag == DRAG_NOTHING)
        session_aim_nowhere(&app->session);
    window_redraw(app->window);
}

static void wheel(void *self, int steps, int x, int y, int modifiers)
{
    struct app *app = self;
    moved(app, x, y, modifiers);
    if (!app->open)
        return;
    if (modifiers & WINDOW_CTRL)
        session_resize_brush(&app->session, steps);
    else if (modifiers & WINDOW_SHIFT)
        session_sink_brush(&app->session, steps);
    else
        orbit_zoom(&app->orbit, steps);
    app->moved = app_seconds();
    orbit_camera(&app->orbit, &app->view.camera);
    window_redraw(app->window);
}

static bool wants_to_close(void *self)
{
    struct app *app = self;
    app_end_drag(app);
    if (!app->open || (!app->session.unsaved && !app->session.saving))
        return true;
    app_leave(app, NEXT_QUIT);
    return false;
}

double app_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A hand that rests sees finer cells: some are still to be made, or drawn. */
static bool wants_finer(const struct app *app)
{
    return app->open && !app->preview && !app->fine;
}

void app_schedule(struct app *app)
{
    int milliseconds = -1;
    if (app->open && app->session.saving)
        milliseconds = LOOK_MILLISECONDS;
    if (app->preview && app->balloon.inflated)
        milliseconds = STEP_MILLISECONDS;
    if (wants_finer(app))
        milliseconds = (int)fmax(0, 1e3 * (app->moved + REST_SECONDS - app_seconds()) + 1);
    window_timer(app->window, milliseconds);
}

/* As much as passes between two of these, unless that would take longer: then the balloon is slower. */
static enum status step_balloon(struct balloon *balloon, struct error *err)
{
    const double begin = app_seconds(), until = balloon->sim.time + 0.999e-3 * STEP_MILLISECONDS;
    enum status status;
    do
        status = balloon_step(balloon, err);
    while (!status && balloon->sim.time < until && app_seconds() - begin < 0.8e-3 * STEP_MILLISECONDS);
    return status;
}

static void on_time(void *self)
{
    struct app *app = self;
    struct error err = {0};
    app_follow_write(app);
    if (app->preview && app->balloon.inflated) {
        enum status status = step_balloon(&app->balloon, &err);
        app_say_unless_ok(app, status, &err);
        app->balloon.inflated = !status;
        window_redraw(app->window);
    }
    if (wants_finer(app))
        window_redraw(app->window); /* which schedules what comes next */
    else
        app_schedule(app);
}

static void resized(void *self, int width, int height)
{
    struct app *app = self;
    app->view.width = width;
    app->view.height = height;
    orbit_camera(&app->orbit, &app->view.camera);
    window_redraw(app->window);
}

static void drawn(void *self)
{
    app_draw(self);
}

static enum status open_window(struct app *app, struct error *err)
{
    static const struct window_events events = {.draw = drawn,
                                                .resize = resized,
                                                .key = app_key,
                                                .button = pressed,
                                                .wheel = wheel,
                                                .motion = moved,
                                                .leave = left_window,
                                                .timer = on_time,
                                                .close = wants_to_close};
    const char *path = app->options->path;
    bool left = false;
    char title[PATH_MAX + 32];
    snprintf(title, sizeof title, "%s - balloon-sculpt", path);
    enum status status = journal_is_left(path, &left, err);
    struct error reason = {0};
    if (!status && window_open(title, WINDOW_WIDTH, WINDOW_HEIGHT, &events, app, &app->window, &reason))
        status = error_set(err, reason.status,
                           "%.800s; --script FILE.chips carves without one, --render FILE.png shows",
                           reason.text);
    if (!status)
        status = render_open_window(app->window, &app->render, err);
    if (status)
        return status;
    snprintf(app->opening, sizeof app->opening, "%s", path);
    if (left && !app->options->recover)
        app->question = ASK_RECOVER;
    else
        status = app_open_session(app, path, left, err);
    return status;
}

enum status sculpt_window(const struct sculpt_window_options *options, struct error *err)
{
    struct app app = {.options = options, .orbit = orbit_start(), .cell_edges = true, .smooth_light = true};
    app.view.width = WINDOW_WIDTH;
    app.view.height = WINDOW_HEIGHT;
    enum status status = open_window(&app, err);
    if (!status)
        window_run(app.window);
    if (!status && app.failed.status) {
        *err = app.failed;
        status = err->status;
    }
    if (app.open)
        session_clear(&app.session);
    octree_clear(&app.model);
    balloon_clear(&app.balloon);
    app_forget_faces(&app);
    render_close(app.render);
    window_free(app.window);
    free(app.found.items);
    free(app.faces.items);
    return status;
}
