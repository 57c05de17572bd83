/* What the sculpting window says. */
#include "sculpt/window_app.h"

#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 2048, LETTER_WIDTH = 6, MARGIN = 8, ROOM_FOR_TOOL = 100 };

static const char help[] = "left       tool              middle, alt+left  turn\n"
                           "right      pan (shift+middle)       wheel      zoom\n"
                           "ctrl+wheel + -  brush size   shift+wheel [ ]   brush depth\n"
                           "\n"
                           "s  sphere    b  box        c  cylinder    d  draw a stroke\n"
                           "k  cut: what lies right of a dragged line\n"
                           "n  sandpaper   h  heat\n"
                           "tab  chip or fill          g  snap to the grid of cells\n"
                           "x y z  mirror              m  next material to fill with\n"
                           "\n"
                           "ctrl+z undo       ctrl+y, ctrl+shift+z  redo\n"
                           "ctrl+s save       ctrl+shift+s  save as\n"
                           "ctrl+o open or import           ctrl+e  export\n"
                           "ctrl+q quit\n"
                           "\n"
                           "home  see all     1 3 7  front, right, top (ctrl: the other side)\n"
                           "e  cell edges     l  light by side or by shape     v  stereo\n"
                           "p  balloon        i  inflate it              F1 ?  this help";

/* While it is shown no tool works. */
static void describe_balloon(const struct app *app, char *text, size_t size)
{
    const bool inflated = app->balloon.inflated;
    snprintf(text, size, "the balloon%s   p  back to the sculpture   i  %s   F1 help",
             inflated ? ", blown up" : "", inflated ? "back to rest" : "inflate it");
}

static void describe_tool(const struct app *app, char *text, size_t size)
{
    const struct session *s = &app->session;
    const bool either = s->tool != TOOL_SANDPAPER && s->tool != TOOL_HEAT; /* these only take away */
    char mirror[16] = "";
    for (int axis = 0; axis < 3; axis++)
        if (s->mirror >> axis & 1)
            strncat(mirror, (const char *[]){"x", "y", "z"}[axis], 2);
    snprintf(text, size, "%s%s  brush %.3g cells  depth %+.1f%s%s%s  F1 help",
             either && s->fill ? "fill "
             : either          ? "chip "
                               : "",
             session_tool_names[s->tool], s->radius * (1 << s->tree.depth), s->depth, s->snap ? "  grid" : "",
             *mirror ? "  mirror " : "", mirror);
}

/* What is shown of a name. */
static const char *end_of(const char *name)
{
    const size_t length = strlen(name);
    return length > 1000 ? name + length - 1000 : name;
}

static void describe_question(const struct app *app, char *text, size_t size)
{
    static const char *const names[] = {
        [NAME_SAVE] = "Save as: %.1000s_\nenter  save     esc  do not",
        [NAME_OPEN] = "Open or import (.oct .vox .stl .ply .obj): %.1000s_\nenter  open     esc  do not",
        [NAME_EXPORT] = "Export (.vox .ply .chips): %.1000s_\nenter  export     esc  do not",
    };
    text[0] = '\0';
    switch (app->question) {
    case ASK_RECOVER:
        snprintf(text, size,
                 "%.1000s: work that was not saved was found.\nr  take it up     n  forget it     esc  %s",
                 end_of(app->opening), app->open ? "do not open it" : "quit");
        break;
    case ASK_UNSAVED:
        snprintf(text, size,
                 "There is work that is not saved.\ns  save and %s     d  discard it     esc  stay",
                 app->next == NEXT_QUIT ? "quit" : "open another");
        break;
    case ASK_HOLLOW:
        snprintf(text, size,
                 "%.1000s is hollow: %llu cells within are empty.\nf  fill them     n  leave them     esc  "
                 "do not import it",
                 end_of(app->opening), (unsigned long long)app->hollow);
        break;
    case ASK_NAME:
        snprintf(text, size, names[app->naming], end_of(app->answer));
        if (app->proposed)
            strncat(text, "     backspace  change this name", size - strlen(text) - 1);
        break;
    default:
        break;
    }
}

/* A text that fits into the width of an eye's picture, at this height; from the lower
 * border if that is negative. */
static void add_text(const struct app *app, struct render_text *texts, size_t *count, char storage[TEXT_SIZE],
                     int x, int y, const float colour[3])
{
    struct render_text *text = &texts[*count];
    int size[2], w, h;
    orbit_eye_size(&app->view, size);
    *text = (struct render_text){storage, x, y, 2, {colour[0], colour[1], colour[2]}, true};
    render_text_size(text, &w, &h);
    if (x + w > size[0]) {
        text->scale = 1;
        hints_wrap(storage, (size[0] - x - MARGIN - 2 * OVERLAY_BOX_MARGIN) / LETTER_WIDTH);
        render_text_size(text, &w, &h);
    }
    if (y < 0)
        text->y = size[1] + y - h;
    (*count)++;
}

/* Whether the last of these texts covers another, or leaves the eye's picture below. */
static bool covers(const struct app *app, const struct render_text *texts, size_t count)
{
    const struct render_text *last = &texts[count - 1];
    int size[2], width, height, other;
    orbit_eye_size(&app->view, size);
    render_text_size(last, &width, &height);
    for (size_t i = 0; i + 1 < count; i++) {
        render_text_size(&texts[i], &width, &other);
        if (texts[i].y < last->y + height && last->y < texts[i].y + other)
            return true;
    }
    return last->y + height > size[1];
}

/* The list of keys between the other texts, in small letters where there is not much room, and in the place
 * of the others, page by page, where there is less. */
static void add_help(struct app *app, struct render_text *texts, size_t *count,
                     char storage[WINDOW_TEXTS_MAX][TEXT_SIZE], const float colour[3])
{
    memcpy(storage[*count], help, sizeof help);
    add_text(app, texts, count, storage[*count], 3 * MARGIN, 6 * MARGIN, colour);
    if (covers(app, texts, *count))
        texts[*count - 1].scale = 1;
    app->hints.pages = 1;
    if (!covers(app, texts, *count))
        return;
    int size[2];
    orbit_eye_size(&app->view, size);
    texts[0] = texts[*count - 1];
    texts[0].text = storage[0];
    texts[0].x = texts[0].y = MARGIN;
    hints_page(&app->hints, help, size[0] - 2 * MARGIN, size[1] - 2 * MARGIN, storage[0], TEXT_SIZE);
    *count = 1;
}

static bool fits_in_large_letters(const struct app *app, const char *text)
{
    int eye[2], width, height;
    orbit_eye_size(&app->view, eye);
    render_text_size(&(struct render_text){.text = text, .scale = 2}, &width, &height);
    return MARGIN + width <= eye[0];
}

/* What has become of a file: behind the line, or above it where it would make its letters smaller. */
static void add_written(const struct app *app, char *line, size_t size)
{
    char both[TEXT_SIZE];
    if (!app->written)
        return;
    snprintf(both, sizeof both, "%.1000s  %s", line, app->written);
    if (fits_in_large_letters(app, line) && !fits_in_large_letters(app, both))
        snprintf(both, sizeof both, "%s\n%.1000s", app->written, line);
    snprintf(line, size, "%s", both);
}

size_t app_texts(struct app *app, struct render_text texts[WINDOW_TEXTS_MAX])
{
    static const float white[3] = {1, 1, 1}, warm[3] = {1, 0.8f, 0.3f};
    static char storage[WINDOW_TEXTS_MAX][TEXT_SIZE];
    size_t count = 0;
    int size[2];
    orbit_eye_size(&app->view, size);
    if (app->open && size[1] >= ROOM_FOR_TOOL) {
        (app->preview ? describe_balloon : describe_tool)(app, storage[count], TEXT_SIZE);
        add_written(app, storage[count], TEXT_SIZE);
        add_text(app, texts, &count, storage[count], MARGIN, -MARGIN, white);
    }
    if (app->hints.message[0]) {
        snprintf(storage[count], TEXT_SIZE, "%s", app->hints.message);
        add_text(app, texts, &count, storage[count], MARGIN, MARGIN, warm);
    }
    describe_question(app, storage[count], TEXT_SIZE);
    if (!storage[count][0] && app->hints.help)
        add_help(app, texts, &count, storage, white);
    else if (storage[count][0])
        add_text(app, texts, &count, storage[count], 3 * MARGIN, size[1] / 2 - 20, white);
    return count;
}
