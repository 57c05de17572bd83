/* What the keys of the sculpting window do. */
#include "sculpt/window_app.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static void answer_recover(struct app *app, int key)
{
    if (key == WINDOW_ESCAPE)
        window_close(app->window);
    if (key != 'r' && key != 'n')
        return;
    if (app_open_session(app, key == 'r', &app->failed))
        window_close(app->window);
}

static void answer_quit(struct app *app, int key)
{
    if (key == WINDOW_ESCAPE)
        app->question = ASK_NOTHING;
    if (key == 'd' || (key == 's' && app_save(app, NULL)))
        window_close(app->window);
}

static void answer_name(struct app *app, int key)
{
    const size_t length = strlen(app->answer);
    if (key == WINDOW_ESCAPE)
        app->question = ASK_NOTHING;
    else if (key == WINDOW_BACKSPACE && length > 0)
        app->answer[length - 1] = '\0';
    else if (key == WINDOW_ENTER && length > 0 && app_save(app, app->answer))
        app->question = ASK_NOTHING;
    else if (key >= ' ' && key < 127 && length + 1 < sizeof app->answer)
        app->answer[length] = (char)key, app->answer[length + 1] = '\0';
}

static void see_all(struct app *app)
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

static void toggle_balloon(struct app *app)
{
    app->preview = !app->preview;
    if (app->preview)
        app_remake_balloon(app);
    else
        window_timer(app->window, -1);
}

static void toggle_inflation(struct app *app)
{
    struct error err = {0};
    if (app->preview && app->balloon.inflated) {
        app_remake_balloon(app); /* back to rest */
        return;
    }
    app->preview = true;
    if (!app->balloon.mesh.triangle_count || app->session.unsaved)
        app_remake_balloon(app);
    if (!app->preview)
        return;
    enum status status = balloon_inflate(&app->balloon, &err);
    app->preview = !status;
    app_say_unless_ok(app, status, &err);
    if (!status)
        window_timer(app->window, STEP_MILLISECONDS);
}

static void look(struct app *app, enum orbit_side side, enum orbit_side other, int modifiers)
{
    orbit_look(&app->orbit, modifiers & WINDOW_CTRL ? other : side);
}

static void control_key(struct app *app, int key, int modifiers)
{
    struct error err = {0};
    bool done = true;
    switch (key) {
    case 'z':
        done = modifiers & WINDOW_SHIFT ? session_redo(&app->session, &err)
                                        : session_undo(&app->session, &err);
        break;
    case 'y':
        done = session_redo(&app->session, &err);
        break;
    case 's':
        if (modifiers & WINDOW_SHIFT) {
            snprintf(app->answer, sizeof app->answer, "%s", app->session.path);
            app->question = ASK_NAME;
        } else {
            app_save(app, NULL);
        }
        return;
    case 'q':
        app_quit(app);
        return;
    default:
        return;
    }
    app_say(app, done ? "" : err.text[0] ? err.text : "There is nothing more.");
    app_remake_balloon(app);
    app_show_title(app);
}

static bool tool_key(struct session *session, int key)
{
    static const char keys[TOOLS] = {
        [TOOL_SPHERE] = 's', [TOOL_BOX] = 'b',       [TOOL_CYLINDER] = 'c', [TOOL_STROKE] = 'd',
        [TOOL_CUT] = 'k',    [TOOL_SANDPAPER] = 'n', [TOOL_HEAT] = 'h'};
    for (int tool = 0; tool < TOOLS; tool++)
        if (keys[tool] == key && !session->dragging) {
            session->tool = (enum session_tool)tool;
            return true;
        }
    return false;
}

static bool brush_key(struct session *session, int key)
{
    switch (key) {
    case WINDOW_TAB:
        session->fill = !session->fill;
        return true;
    case 'x':
    case 'y':
    case 'z':
        session->mirror ^= 1u << (key - 'x');
        return true;
    case 'g':
        session->snap = !session->snap;
        return true;
    case 'm':
        session->material = session->material % 8 + 1;
        return true;
    case '+':
    case '=':
    case '-':
        session_resize_brush(session, key == '-' ? -1 : 1);
        return true;
    case '[':
    case ']':
        session_sink_brush(session, key == '[' ? -1 : 1);
        return true;
    default:
        return false;
    }
}

static void view_key(struct app *app, int key, int modifiers)
{
    static const enum render_stereo next[] = {
        [RENDER_MONO] = RENDER_PARALLEL, [RENDER_PARALLEL] = RENDER_CROSSED, [RENDER_CROSSED] = RENDER_MONO};
    switch (key) {
    case '1':
        look(app, ORBIT_FRONT, ORBIT_BACK, modifiers);
        break;
    case '3':
        look(app, ORBIT_RIGHT, ORBIT_LEFT, modifiers);
        break;
    case '7':
        look(app, ORBIT_TOP, ORBIT_BOTTOM, modifiers);
        break;
    case WINDOW_HOME:
        see_all(app);
        break;
    case 'e':
        app->cell_edges = !app->cell_edges;
        break;
    case 'v':
        app->view.stereo = next[app->view.stereo];
        break;
    case 'p':
        toggle_balloon(app);
        break;
    case 'i':
        toggle_inflation(app);
        break;
    case WINDOW_F1:
    case '?':
        app->help = !app->help;
        break;
    case WINDOW_ESCAPE:
        app->help = false;
        app->message[0] = '\0';
        break;
    default:
        break;
    }
}

void app_key(void *self, int key, int modifiers)
{
    struct app *app = self;
    if (app->question == ASK_RECOVER)
        answer_recover(app, key);
    else if (app->question == ASK_QUIT)
        answer_quit(app, key);
    else if (app->question == ASK_NAME)
        answer_name(app, key);
    else if (modifiers & WINDOW_CTRL && isalpha(key))
        control_key(app, tolower(key), modifiers);
    else if (!tool_key(&app->session, key) && !brush_key(&app->session, key))
        view_key(app, key, modifiers);
    orbit_camera(&app->orbit, &app->view.camera);
    if (app->open)
        app_aim(app);
    window_redraw(app->window);
}
