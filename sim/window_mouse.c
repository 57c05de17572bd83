/* The mouse in the live window: it turns the camera, moves sliders, and pricks and pulls the skin. */
#include "common/vec3.h"
#include "sim/window_app.h"

#include <stdlib.h>

enum { CLICK_PIXELS = 4 }; /* a pointer that moves further with the button down drags */

/* What is under a place of the window. */
static bool find(const struct app *app, int x, int y, struct hand_hit *hit)
{
    double origin[3], direction[3];
    const struct render_view view = app_drawn_view(app);
    return orbit_ray(&view, x + 0.5, y + 0.5, origin, direction) &&
           hand_find(app->live.sim, origin, direction, hit);
}

/* The hand moves in the plane through what it took, across the line of sight. */
static void pull(struct app *app)
{
    double origin[3], direction[3], ahead[3], to[3], place[3];
    const struct render_view view = app_drawn_view(app);
    if (!orbit_ray(&view, app->x + 0.5, app->y + 0.5, origin, direction))
        return;
    vec3_sub(view.camera.target, view.camera.eye, ahead);
    vec3_sub(app->live.hand.from, origin, to);
    const double along = vec3_dot(to, ahead) / vec3_dot(direction, ahead);
    for (int i = 0; i < 3; i++)
        place[i] = origin[i] + along * direction[i];
    hand_move(&app->live.hand, app->live.sim, place);
}

static void begin_pull(struct app *app)
{
    struct hand_hit hit;
    if (!find(app, app->pressed_x, app->pressed_y, &hit))
        return;
    app->drag = DRAG_PULL;
    app->touched = true;
    hand_take(&app->live.hand, app->live.sim, &hit);
    if (app->live.paused)
        app_say(app, "The hand holds the skin; space lets time go on.");
}

void app_moved(void *self, int x, int y, int modifiers)
{
    struct app *app = self;
    const int dx = x - app->x, dy = y - app->y;
    (void)modifiers;
    app->x = x;
    app->y = y;
    if (app->drag == DRAG_TOOL && abs(x - app->pressed_x) + abs(y - app->pressed_y) > CLICK_PIXELS)
        begin_pull(app);
    if (app->drag == DRAG_TURN)
        orbit_turn(&app->orbit, dx, dy);
    else if (app->drag == DRAG_PAN)
        orbit_pan(&app->orbit, &app->view, dx, dy);
    else if (app->drag == DRAG_PULL)
        pull(app);
    else if (app->drag == DRAG_DIAL || app->drag == DRAG_TIME)
        app_drag_slider(app, (x - app->pressed_eye.x) / app_dot(app));
    if (app->drag != DRAG_NOTHING)
        window_redraw(app->window);
}

static void begin_drag(struct app *app, enum window_button button, int modifiers)
{
    if (button == WINDOW_RIGHT || (button == WINDOW_MIDDLE && modifiers & WINDOW_SHIFT)) {
        app->drag = DRAG_PAN;
    } else if (button == WINDOW_MIDDLE || modifiers & WINDOW_ALT) {
        app->drag = DRAG_TURN;
    } else {
        const struct panel_box eye = app->pressed_eye = app_eye(app);
        const int across = (app->x - eye.x) / app_dot(app), down = (app->y - eye.y) / app_dot(app);
        app->drag = app_find_slider(app, across, down, &app->dial);
        if (app->drag == DRAG_NOTHING)
            app->drag = DRAG_TOOL;
        else
            app_drag_slider(app, across);
    }
    app->pressed_x = app->x;
    app->pressed_y = app->y;
}

static void prick(struct app *app)
{
    struct hand_hit hit;
    if (!find(app, app->x, app->y, &hit))
        return;
    const char *why_not = live_prick(&app->live, &hit);
    if (why_not)
        app_say(app, why_not);
    app->touched = app->stale = true;
}

static void end_drag(struct app *app)
{
    if (app->drag == DRAG_TOOL)
        prick(app);
    if (app->drag == DRAG_PULL)
        hand_let_go(&app->live.hand, app->live.sim);
    app->drag = DRAG_NOTHING;
}

void app_pressed(void *self, enum window_button button, bool down, int x, int y, int modifiers)
{
    struct app *app = self;
    app_moved(app, x, y, modifiers);
    if (down && app->drag == DRAG_NOTHING)
        begin_drag(app, button, modifiers);
    else if (!down)
        end_drag(app);
    window_redraw(app->window);
}

void app_wheel(void *self, int steps, int x, int y, int modifiers)
{
    struct app *app = self;
    app_moved(app, x, y, modifiers);
    orbit_zoom(&app->orbit, steps);
    window_redraw(app->window);
}
