/* The sculpting window: what the hand does becomes calls of the session. */
#include "sculpt/window.h"

#include "sculpt/window_app.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WINDOW_WIDTH = 960, WINDOW_HEIGHT = 720 };

void app_say(struct app *app, const char *text)
{
    snprintf(app->message, sizeof app->message, "%s", text);
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
    char title[1100];
    snprintf(title, sizeof title, "%s%s - balloon-sculpt", app->session.path ? app->session.path : app->path,
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
    window_timer(app->window, -1);
    enum status status = balloon_mesh(&app->balloon, &app->session.tree, &err);
    app->preview = !status;
    app_say_unless_ok(app, status, &err);
}

enum status app_open_session(struct app *app, bool recover, struct error *err)
{
    struct error reason = {0};
    enum status status = session_open(&app->session, app->path, app->depth, recover, &reason);
    if (status) {
        *err = reason;
        return status;
    }
    app->open = true;
    app->question = ASK_NOTHING;
    status = render_solid_new(app->render, (const double[3]){0, 0, 0}, 1.0 / (1 << app->session.tree.depth),
                              &app->solid, err);
    app_say(app, recover ? "The work that was not saved is back." : app->session.warning);
    app_show_title(app);
    return status;
}

void app_aim(struct app *app)
{
    double origin[3], direction[3];
    if (orbit_ray(&app->view, app->x + 0.5, app->y + 0.5, origin, direction))
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
    if (app->drag == DRAG_TOOL)
        app_say_unless_ok(app, session_drag(&app->session, &err), &err);
    window_redraw(app->window);
}

static void begin_drag(struct app *app, enum window_button button, int modifiers)
{
    struct error err = {0};
    if (button == WINDOW_RIGHT || (button == WINDOW_MIDDLE && modifiers & WINDOW_SHIFT))
        app->drag = DRAG_PAN;
    else if (button == WINDOW_MIDDLE || modifiers & WINDOW_ALT)
        app->drag = DRAG_TURN;
    else if (!app->preview) {
        app->drag = DRAG_TOOL;
        app->message[0] = '\0';
        app_say_unless_ok(app, session_press(&app->session, &err), &err);
    }
}

static void end_drag(struct app *app)
{
    struct error err = {0};
    if (app->drag == DRAG_TOOL)
        app_say_unless_ok(app, session_release(&app->session, &err), &err);
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
        end_drag(app);
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
    orbit_camera(&app->orbit, &app->view.camera);
    window_redraw(app->window);
}

bool app_save(struct app *app, const char *path)
{
    struct error err = {0};
    struct bytes png = {0};
    app_preview(app, &png, &err); /* a sculpture without a preview is whole */
    enum status status = path ? session_save_as(&app->session, path, &png, &err)
                              : session_save(&app->session, &png, &err);
    bytes_clear(&png);
    app_say(app, status ? err.text : "Saved.");
    app_show_title(app);
    return !status;
}

static bool wants_to_close(void *self)
{
    struct app *app = self;
    if (!app->open || !app->session.unsaved)
        return true;
    app->question = ASK_QUIT;
    window_redraw(app->window);
    return false;
}

void app_quit(struct app *app)
{
    if (wants_to_close(app))
        window_close(app->window);
}

static void step_balloon(void *self)
{
    struct app *app = self;
    struct error err = {0};
    if (!app->preview || !app->balloon.inflated)
        return;
    enum status status = balloon_step(&app->balloon, &err);
    app_say_unless_ok(app, status, &err);
    if (!status)
        window_timer(app->window, STEP_MILLISECONDS);
    window_redraw(app->window);
}

static void resized(void *self, int width, int height)
{
    struct app *app = self;
    app->view.width = app->view.stereo ? width & ~1 : width;
    app->view.height = height;
    orbit_camera(&app->orbit, &app->view.camera);
    window_redraw(app->window);
}

static void drawn(void *self)
{
    app_draw(self);
}

static enum status open_window(struct app *app, bool recover, struct error *err)
{
    static const struct window_events events = {.draw = drawn,
                                                .resize = resized,
                                                .key = app_key,
                                                .button = pressed,
                                                .wheel = wheel,
                                                .motion = moved,
                                                .leave = left_window,
                                                .timer = step_balloon,
                                                .close = wants_to_close};
    bool left = false;
    char title[1100];
    snprintf(title, sizeof title, "%s - balloon-sculpt", app->path);
    enum status status = journal_is_left(app->path, &left, err);
    struct error reason = {0};
    if (!status && window_open(title, WINDOW_WIDTH, WINDOW_HEIGHT, &events, app, &app->window, &reason))
        status = error_set(err, reason.status,
                           "%.800s; --script FILE.chips carves without one, --render FILE.png shows",
                           reason.text);
    if (!status)
        status = render_open_window(app->window, &app->render, err);
    if (status)
        return status;
    if (left && !recover)
        app->question = ASK_RECOVER;
    else
        status = app_open_session(app, recover && left, err);
    return status;
}

enum status sculpt_window(const char *path, unsigned depth, bool recover, struct error *err)
{
    struct app app = {.path = path, .depth = depth, .orbit = orbit_start(), .cell_edges = true};
    enum status status = open_window(&app, recover, err);
    if (!status)
        window_run(app.window);
    if (!status && app.failed.status) {
        *err = app.failed;
        status = err->status;
    }
    if (app.open)
        session_clear(&app.session);
    balloon_clear(&app.balloon);
    render_solid_free(app.solid);
    render_close(app.render);
    window_free(app.window);
    free(app.found.items);
    free(app.faces.items);
    return status;
}
