/* What the keys of the live window do. */
#include "sim/window_app.h"

#include <math.h>

/* A key turns a dial by this part of its slider, down to where that begins. Time is not turned finely, but to
 * a tenth and back. */
static const double key_part[LIVE_DIALS] = {
    [LIVE_PRESSURE] = 0.02, [LIVE_STEP] = 0.02, [LIVE_SPRINGS] = 0.02, [LIVE_PACE] = 0.1};

static bool dial_key(struct app *app, int key)
{
    static const struct {
        int key;
        enum live_dial dial;
        int sign;
    } keys[] = {
        {WINDOW_UP_ARROW, LIVE_PRESSURE, 1},
        {WINDOW_DOWN_ARROW, LIVE_PRESSURE, -1},
        {']', LIVE_STEP, 1},
        {'[', LIVE_STEP, -1},
        {'+', LIVE_SPRINGS, 1},
        {'=', LIVE_SPRINGS, 1},
        {'-', LIVE_SPRINGS, -1},
        {'>', LIVE_PACE, 1},
        {'<', LIVE_PACE, -1},
    };
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].key == key) {
            const double before = app_dial_part(app, keys[i].dial),
                         part = before + keys[i].sign * key_part[keys[i].dial];
            app_turn(app, keys[i].dial, app_dial_value(app, keys[i].dial, fmax(part, fmin(before, 0))));
            return true;
        }
    return false;
}

static bool time_key(struct app *app, int key)
{
    const double second = app->live.sim->scene->view.playback, frame = (double)app->live.shown;
    switch (key) {
    case ' ':
        app_pause(app, !app->live.paused);
        return true;
    case '.':
        app_step(app);
        return true;
    case 'r':
        app_restart(app);
        return true;
    case WINDOW_LEFT_ARROW:
        app_show(app, frame - 1);
        return true;
    case WINDOW_RIGHT_ARROW:
        app_show(app, frame + 1);
        return true;
    case WINDOW_PAGE_UP:
        app_show(app, frame - second);
        return true;
    case WINDOW_PAGE_DOWN:
        app_show(app, frame + second);
        return true;
    default:
        return false;
    }
}

/* Exact orders are for films; here they show what sorting gets wrong. */
static void change_order(struct app *app)
{
    static const struct {
        enum render_order next;
        const char *text; /* of the next */
    } orders[] = {[RENDER_NONE] = {RENDER_SORT, "layers: sorted by their middles"},
                  [RENDER_SORT] = {RENDER_LIST, "layers: exact, by a list for each pixel"},
                  [RENDER_LIST] = {RENDER_PEEL, "layers: exact, peeled one by one"},
                  [RENDER_PEEL] = {RENDER_NONE, "layers: as they come"}};
    const enum render_order before = app->view.order;
    app->view.order = orders[before].next;
    app_say(app, orders[before].text);
}

static void say_grey(struct app *app)
{
    if (app->stretch_colours && app_scale_is_grey(app))
        app_say(app,
                "stereo: for red and cyan glasses, through which stretch is grey: the tauter the lighter");
}

static void view_key(struct app *app, int key, int modifiers)
{
    if (orbit_key(&app->orbit, key, modifiers & WINDOW_CTRL) || hints_key(&app->hints, key))
        return;
    switch (key) {
    case WINDOW_HOME:
    case 'f':
        app_see_all(app);
        break;
    case 'v':
        app_say(app, orbit_change_stereo(&app->orbit, &app->view, window_has_quad(app->window)));
        say_grey(app);
        break;
    case 's':
        app->view.style = app->view.style == RENDER_LATEX ? RENDER_PAPER : RENDER_LATEX;
        break;
    case 'o':
        change_order(app);
        break;
    case 'w':
        app->wires = (app->wires + 1) % WIRES_KINDS;
        break;
    case 'c':
        app->stretch_colours = !app->stretch_colours;
        say_grey(app);
        break;
    case WINDOW_TAB:
        app->panel = !app->panel;
        if (app->panel && !app_has_sliders(app))
            app_say(app, "no room for sliders");
        break;
    case 'm':
        app_record(app);
        break;
    case 'p':
        app_save_picture(app);
        break;
    default:
        break;
    }
}

void app_key(void *self, int key, int modifiers)
{
    struct app *app = self;
    if (modifiers & WINDOW_CTRL && key == 'q')
        window_close(app->window);
    else if (modifiers & WINDOW_CTRL || (!dial_key(app, key) && !time_key(app, key)))
        view_key(app, key, modifiers);
    window_redraw(app->window);
}
