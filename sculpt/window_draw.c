/* What the sculpting window shows. */
#include "sculpt/window_app.h"

#include "common/array.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES_MAX = 8 * 120 + 40, TEXTS_MAX = 4, PREVIEW_WIDTH = 256, PREVIEW_HEIGHT = 192 };

static const float yellow[3] = {0.9f, 0.6f, 0.05f}, pale[3] = {0.75f, 0.75f, 0.72f},
                   blue[3] = {0.1f, 0.25f, 0.8f};

/* Material 1 is clay; the others go round the circle of hues by the golden ratio, so that neighbours differ. */
static void colour_of(unsigned material, uint8_t colour[3])
{
    static const uint8_t clay[3] = {205, 172, 139};
    for (int i = 0; i < 3; i++) {
        const double hue = material * 0.618034 + i / 3.0;
        const double wave = 0.5 + 0.5 * cos(2 * M_PI * hue);
        colour[i] = material == 1 ? clay[i] : (uint8_t)(90 + 140 * wave);
    }
}

static enum status update_brick(struct app *app, const int brick[3], struct error *err)
{
    const uint64_t key = ((uint64_t)brick[2] << 20) + ((uint64_t)brick[1] << 10) + (uint64_t)brick[0];
    enum status status = brick_find_faces(&app->session.tree, brick, &app->found, err);
    app->faces.count = 0;
    if (!status && !ARRAY_RESERVE(&app->faces, app->found.count))
        status = error_no_memory(err, "the faces of a brick");
    for (size_t i = 0; i < app->found.count && !status; i++) {
        const struct brick_face *from = &app->found.items[i];
        struct render_face *face = &app->faces.items[app->faces.count++];
        *face = (struct render_face){.size = {1, 1}, .side = from->side};
        memcpy(face->corner, from->corner, sizeof face->corner);
        colour_of(from->material, face->colour);
        if (from->side / 2 == 1) /* sizes go along y, z; z, x; x, y */
            face->size[1] = from->length;
        else if (from->side / 2 == 2)
            face->size[0] = from->length;
    }
    return status ? status : render_solid_set(app->solid, key, app->faces.items, app->faces.count, err);
}

enum status app_update_solid(struct app *app, struct error *err)
{
    struct octree_regions regions;
    session_take_changes(&app->session, &regions);
    enum status status = STATUS_OK;
    for (int i = 0; i < regions.count; i++) {
        int first[3], last[3], at[3];
        bricks_of_region(&app->session.tree, &regions.items[i], first, last);
        for (at[2] = first[2]; at[2] <= last[2] && !status; at[2]++)
            for (at[1] = first[1]; at[1] <= last[1] && !status; at[1]++)
                for (at[0] = first[0]; at[0] <= last[0] && !status; at[0]++)
                    status = update_brick(app, at, err);
    }
    return status;
}

static void add_line(struct render_line *lines, size_t *count, const double from[3], const double to[3],
                     const float colour[3], float opacity, bool on_top)
{
    struct render_line *line = &lines[(*count)++];
    *line = (struct render_line){.opacity = opacity, .width = on_top ? 1.5f : 1, .on_top = on_top};
    memcpy(line->from, from, sizeof line->from);
    memcpy(line->to, to, sizeof line->to);
    memcpy(line->colour, colour, sizeof line->colour);
}

/* A square across an axis at `at`: the mirror plane, and by two of them the cube. */
static void add_square(struct render_line *lines, size_t *count, int axis, double at, const float colour[3],
                       float opacity)
{
    for (int k = 0; k < 4; k++) {
        double ends[2][3];
        for (int end = 0; end < 2; end++) {
            const int corner = (k + end) % 4;
            ends[end][axis] = at;
            ends[end][(axis + 1) % 3] = corner == 1 || corner == 2;
            ends[end][(axis + 2) % 3] = corner >= 2;
        }
        add_line(lines, count, ends[0], ends[1], colour, opacity, false);
    }
}

static size_t make_lines(const struct app *app, struct render_line *lines)
{
    static double segments[8 * 120][2][3];
    size_t count = 0;
    for (int axis = 0; axis < 3; axis++) {
        add_square(lines, &count, axis, axis == 1, pale,
                   0.35f); /* three squares have the cube's nine nearest edges */
        if (app->session.mirror >> axis & 1)
            add_square(lines, &count, axis, 0.5, blue, 0.8f);
    }
    const size_t found = session_outline(&app->session, segments, sizeof segments / sizeof segments[0]);
    for (size_t i = 0; i < found; i++)
        add_line(lines, &count, segments[i][0], segments[i][1], yellow, 0.9f, true);
    return count;
}

static const char help[] = "left       tool              middle, alt+left  turn\n"
                           "right      pan (shift+middle)       wheel      zoom\n"
                           "ctrl+wheel + -  brush size   shift+wheel [ ]   brush depth\n"
                           "\n"
                           "s  sphere    b  box        c  cylinder    d  draw a stroke\n"
                           "k  cut by a dragged line   n  sandpaper   h  heat\n"
                           "tab  chip or fill          g  snap to the grid of cells\n"
                           "x y z  mirror              m  next material to fill with\n"
                           "\n"
                           "ctrl+z undo       ctrl+y, ctrl+shift+z redo\n"
                           "ctrl+s save       ctrl+shift+s save as      ctrl+q quit\n"
                           "home  see all     1 3 7  front, right, top (ctrl: the other side)\n"
                           "e  cell edges     v  stereo\n"
                           "p  balloon        i  inflate it              F1 ?  this help";

static void describe_tool(const struct app *app, char *text, size_t size)
{
    const struct session *s = &app->session;
    char mirror[16] = "";
    for (int axis = 0; axis < 3; axis++)
        if (s->mirror >> axis & 1)
            strncat(mirror, (const char *[]){"x", "y", "z"}[axis], 2);
    snprintf(text, size, "%s%s%s  brush %.3g cells  depth %+.1f%s%s%s   F1 help", s->fill ? "fill " : "chip ",
             session_tool_names[s->tool], app->preview ? " (balloon)" : "", s->radius * (1 << s->tree.depth),
             s->depth, s->snap ? "  grid" : "", *mirror ? "  mirror " : "", mirror);
}

static const char *question_text(const struct app *app, char *text, size_t size)
{
    switch (app->question) {
    case ASK_RECOVER:
        return "Work that was not saved was found.\nr  take it up     n  forget it     esc  quit";
    case ASK_QUIT:
        return "There is work that is not saved.\ns  save and quit     d  discard it     esc  stay";
    case ASK_NAME:
        snprintf(text, size, "Save as: %s_\nenter  save     esc  do not", app->answer);
        return text;
    default:
        return NULL;
    }
}

static size_t make_texts(const struct app *app, struct render_text *texts, char storage[2][2048])
{
    size_t count = 0;
    const int height = app->view.height;
    if (app->open) {
        describe_tool(app, storage[0], sizeof storage[0]);
        texts[count++] = (struct render_text){storage[0], 8, height - 30, 2, {1, 1, 1}, true};
    }
    if (app->message[0])
        texts[count++] = (struct render_text){app->message, 8, 8, 2, {1, 0.8f, 0.3f}, true};
    if (app->help)
        texts[count++] = (struct render_text){help, 24, 48, 2, {1, 1, 1}, true};
    const char *question = question_text(app, storage[1], sizeof storage[1]);
    if (question)
        texts[count++] = (struct render_text){question, 40, height / 2 - 20, 2, {1, 1, 1}, true};
    return count;
}

void app_draw(struct app *app)
{
    static struct render_line lines[LINES_MAX];
    static char storage[2][2048];
    struct render_text texts[TEXTS_MAX];
    struct error err = {0};
    struct render_scene scene = {.lines = lines, .texts = texts, .cell_edges = app->cell_edges};
    struct render_view view = app->view;
    enum status status = app->open ? app_update_solid(app, &err) : STATUS_OK;
    orbit_camera(&app->orbit, &view.camera);
    if (app->open && app->preview) {
        scene.skins = balloon_skins(&app->balloon, &scene.skin_count, &view.camera);
    } else if (app->open) {
        scene.solid = app->solid;
        scene.line_count = make_lines(app, lines);
    }
    scene.text_count = make_texts(app, texts, storage);
    if (!status)
        status = render_show(app->render, &view, &scene, &err);
    if (status)
        snprintf(app->message, sizeof app->message, "%s", err.text);
}

enum status app_preview(struct app *app, struct bytes *png, struct error *err)
{
    struct render_view view = {.width = PREVIEW_WIDTH, .height = PREVIEW_HEIGHT, .smooth_edges = true};
    const struct render_scene scene = {.solid = app->solid};
    struct image image = {0};
    struct orbit orbit = orbit_start();
    orbit_camera(&orbit, &view.camera);
    enum status status = app_update_solid(app, err);
    if (!status)
        status = render_draw_scene(app->render, &view, &scene, &image, err);
    if (!status)
        status = image_encode_png(&image, NULL, 0, png, err);
    image_clear(&image);
    return status;
}
