/* What the sculpting window shows. */
#include "sculpt/window_app.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINES_MAX = 8 * 120 + 40, PREVIEW_WIDTH = 256, PREVIEW_HEIGHT = 192 };

/* What a frame may take for bricks that changed, beside being drawn. */
#define FRAME_SECONDS 0.02

/* Outlines of a sculpture that rests are smooth, unless it has so many faces that the
 * hand would wait for that. */
enum { FACES_SMOOTH = 150000 };

static const float yellow[3] = {0.9f, 0.6f, 0.05f}, pale[3] = {0.75f, 0.75f, 0.72f},
                   blue[3] = {0.1f, 0.25f, 0.8f};

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

/* The sculpture, with larger cells while the hand moves. */
static enum status draw_sculpture(struct app *app, const struct render_view *view, struct render_scene *scene,
                                  struct error *err)
{
    const double begin = app_seconds();
    const bool moving = begin < app->moved + REST_SECONDS;
    const int rest = app_rest_level(app), coarser = moving ? app->coarser : 0;
    const int level = rest + coarser < app->level_count ? rest + coarser : app->level_count - 1;
    enum status status = app_update_solid(app, level, FRAME_SECONDS, err);
    if (status)
        return status;
    const double drawn = app_seconds();
    struct render_view smooth = *view;
    if (!moving && app->shown == &app->levels[rest] && render_solid_faces(app->shown->solid) < FACES_SMOOTH)
        smooth.outlines = RENDER_SAMPLED;
    scene->solid = app->shown->solid;
    status = render_show(app->render, &smooth, scene, err);
    if (moving && app->shown == &app->levels[level])
        app_adapt(app, rest, app_seconds() - drawn);
    app->fine = !moving && app->shown == &app->levels[rest];
    return status;
}

void app_draw(struct app *app)
{
    static struct render_line lines[LINES_MAX];
    struct render_text texts[WINDOW_TEXTS_MAX];
    struct error err = {0};
    struct render_scene scene = {
        .lines = lines, .texts = texts, .cell_edges = app->cell_edges, .smooth_light = app->smooth_light};
    struct render_view view = app_drawn_view(app);
    scene.text_count = app_texts(app, texts);
    enum status status;
    if (app->open && !app->preview) {
        scene.line_count = make_lines(app, lines);
        status = draw_sculpture(app, &view, &scene, &err);
    } else {
        view.style = RENDER_LATEX;
        view.order = RENDER_SORT;
        view.outlines = RENDER_SAMPLED;
        if (app->open)
            scene.skins = balloon_skins(&app->balloon, &scene.skin_count, &view.camera);
        status = render_show(app->render, &view, &scene, &err);
    }
    if (status)
        hints_say(&app->hints, err.text);
    app_schedule(app);
}

enum status app_preview(struct app *app, struct bytes *png, struct error *err)
{
    struct render_view view = {.width = PREVIEW_WIDTH, .height = PREVIEW_HEIGHT, .outlines = RENDER_SAMPLED};
    struct render_scene scene = {0};
    struct image image = {0};
    struct orbit orbit = orbit_start();
    orbit_camera(&orbit, &view.camera);
    enum status status = app_update_solid(app, app->level_count - 1, INFINITY, err);
    scene.solid = app->shown->solid;
    if (!status)
        status = render_draw_scene(app->render, &view, &scene, &image, err);
    if (!status)
        status = image_encode_png(&image, NULL, 0, png, err);
    image_clear(&image);
    return status;
}
