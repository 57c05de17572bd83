/* What the keys of the sculpting window do. */
#include "sculpt/window_app.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* At the start there is nothing to stay with. */
static void answer_recover(struct app *app, int key, int modifiers)
{
    (void)modifiers;
    struct error err = {0};
    const bool first = !app->open;
    if (key == WINDOW_ESCAPE) {
        app->question = ASK_NOTHING;
        if (first)
            window_close(app->window);
    }
    if (key != 'r' && key != 'n')
        return;
    enum status status = app_open_session(app, app->opening, key == 'r', &err);
    if (status && first) {
        app->failed = err;
        window_close(app->window);
    } else if (status) {
        app->question = ASK_NOTHING;
        app_say(app, err.text);
    }
}

static void answer_unsaved(struct app *app, int key, int modifiers)
{
    (void)modifiers;
    if (key == WINDOW_ESCAPE || key == 's')
        app->question = ASK_NOTHING;
    if (key == 's')
        app->next_when_saved = app_save(app, NULL);
    else if (key == 'd')
        app_do_next(app);
}

static void answer_hollow(struct app *app, int key, int modifiers)
{
    (void)modifiers;
    if (key == 'f' || key == 'n')
        app_take_model(app, key == 'f');
    if (key != WINDOW_ESCAPE)
        return;
    app->question = ASK_NOTHING;
    octree_clear(&app->model);
}

/* Keys are those of Latin 1, and names UTF-8. */
static bool is_letter(int key, int modifiers)
{
    return !(modifiers & WINDOW_CTRL) && ((key >= ' ' && key < 127) || (key >= 0xA0 && key < 0x100));
}

static void append_letter(char *text, size_t size, int key)
{
    const size_t length = strlen(text), more = key < 128 ? 1 : 2;
    if (length + more >= size)
        return;
    if (more == 2)
        text[length] = (char)(0xC0 | key >> 6);
    text[length + more - 1] = (char)(more == 2 ? 0x80 | (key & 0x3F) : key);
    text[length + more] = '\0';
}

/* With all bytes of a letter that has several. */
static void remove_letter(char *text)
{
    size_t length = strlen(text);
    while (length > 0 && ((unsigned char)text[--length] & 0xC0) == 0x80)
        ;
    text[length] = '\0';
}

/* A letter takes the place of a name that was proposed; backspace takes that name up. */
static void answer_name(struct app *app, int key, int modifiers)
{
    const bool letter = is_letter(key, modifiers);
    if (app->proposed && letter)
        app->answer[0] = '\0';
    app->proposed = app->proposed && !letter && key != WINDOW_BACKSPACE;
    const size_t length = strlen(app->answer);
    if (key == WINDOW_ESCAPE) {
        app->question = ASK_NOTHING;
    } else if (key == WINDOW_ENTER && length > 0) {
        app_take_name(app);
    } else if (key == WINDOW_BACKSPACE && length > 0) {
        remove_letter(app->answer);
        app->sure = false;
    } else if (letter) {
        append_letter(app->answer, sizeof app->answer, key);
        app->sure = false;
    }
}

static void toggle_balloon(struct app *app)
{
    app_say(app, "");
    app->preview = !app->preview;
    if (app->preview)
        app_remake_balloon(app);
    app_schedule(app);
}

static void toggle_inflation(struct app *app)
{
    struct error err = {0};
    if (app->preview && app->balloon.inflated) {
        app_remake_balloon(app); /* back to rest */
        return;
    }
    if (!app->preview)
        toggle_balloon(app); /* as the sculpture is now */
    if (!app->preview)
        return;
    enum status status = balloon_inflate(&app->balloon, &err);
    app->preview = !status;
    app_say_unless_ok(app, status, &err);
    app_schedule(app);
}

static void control_key(struct app *app, int key, int modifiers)
{
    struct error err = {0};
    bool done = true;
    const char *nothing = "There is nothing more to do again.";
    if (app->drag != DRAG_NOTHING)
        return; /* a step is open */
    switch (key) {
    case 'z':
        done = modifiers & WINDOW_SHIFT ? session_redo(&app->session, &err)
                                        : session_undo(&app->session, &err);
        nothing = modifiers & WINDOW_SHIFT ? nothing : "There is nothing more to undo.";
        break;
    case 'y':
        done = session_redo(&app->session, &err);
        break;
    case 's':
        if (modifiers & WINDOW_SHIFT)
            app_ask_name(app, NAME_SAVE);
        else
            app_save(app, NULL);
        return;
    case 'o':
        app_leave(app, NEXT_OPEN);
        return;
    case 'e':
        app_ask_name(app, NAME_EXPORT);
        return;
    case 'q':
        app_leave(app, NEXT_QUIT);
        return;
    default:
        return;
    }
    app_say(app, done ? "" : err.text[0] ? err.text : nothing);
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
    if (orbit_key(&app->orbit, key, modifiers & WINDOW_CTRL) || hints_key(&app->hints, key))
        return;
    switch (key) {
    case WINDOW_HOME:
        app_see_all(app);
        break;
    case 'e':
        app->cell_edges = !app->cell_edges;
        break;
    case 'l':
        app->smooth_light = !app->smooth_light;
        app_forget_faces(app);
        break;
    case 'v':
        app_say(app, orbit_change_stereo(&app->orbit, &app->view, window_has_quad(app->window)));
        break;
    case 'p':
        toggle_balloon(app);
        break;
    case 'i':
        toggle_inflation(app);
        break;
    default:
        break;
    }
}

static void answer(struct app *app, int key, int modifiers)
{
    static void (*const answers[])(struct app *, int, int) = {[ASK_RECOVER] = answer_recover,
                                                              [ASK_UNSAVED] = answer_unsaved,
                                                              [ASK_HOLLOW] = answer_hollow,
                                                              [ASK_NAME] = answer_name};
    answers[app->question](app, key, modifiers);
}

void app_key(void *self, int key, int modifiers)
{
    struct app *app = self;
    if (app->question)
        answer(app, key, modifiers);
    else if (modifiers & WINDOW_CTRL && key < 128 && isalpha(key))
        control_key(app, tolower(key), modifiers);
    else if (!tool_key(&app->session, key) && !brush_key(&app->session, key))
        view_key(app, key, modifiers);
    orbit_camera(&app->orbit, &app->view.camera);
    if (app->open)
        app_aim(app);
    window_redraw(app->window);
}
