/* The skin in the live window: as it looks, in colours by its stretch, or as wires. */
#include "common/array.h"
#include "common/vec3.h"
#include "sim/material.h"
#include "sim/window_app.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float wire_colour[3] = {0.02f, 0.02f, 0.025f};

static const double count_seconds = 0.5; /* pictures are counted over */

/* Below so many frames a second outlines are filtered: the plain skin can be as quick as pictures come, one
 * every sixtieth of a second, or nearly. */
static const double slow_rate[] = {[RENDER_PAPER] = 55, [RENDER_LATEX] = 40};

/* Sampled ones are tried again after so many seconds, and then after twice as many, up to the most. */
static const double first_wait = 4, longest_wait = 64;

enum status app_open_pictures(struct app *app, struct error *err)
{
    struct window_bands *bands = &app->bands;
    const size_t triangles = app->live.sim->triangle_count;
    bands->position = array_new(3 * triangles, sizeof *bands->position);
    bands->normal = array_new(3 * triangles, sizeof *bands->normal);
    bands->triangle = array_new(triangles, sizeof *bands->triangle);
    bands->band = array_new(triangles, sizeof *bands->band);
    if (!bands->position || !bands->normal || !bands->triangle || !bands->band)
        return error_no_memory(err, "the colours of stretch");
    for (uint32_t t = 0; t < triangles; t++)
        for (uint32_t k = 0; k < 3; k++)
            bands->triangle[t][k] = 3 * t + k;
    return skins_init(&app->skins, app->live.sim, err);
}

void app_close_pictures(struct app *app)
{
    free(app->bands.position);
    free(app->bands.normal);
    free(app->bands.triangle);
    free(app->bands.band);
    skins_clear(&app->skins);
    free(app->lines.items);
    free(app->boxes.items);
    image_clear(&app->image);
}

/* The corners of the active triangles, band after band. */
static void fill_bands(struct app *app)
{
    const struct sim *sim = app->live.sim;
    struct window_bands *bands = &app->bands;
    size_t begin[WINDOW_BANDS + 1] = {0};
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        const double part = app_stretch_part(app, sim_triangle_stretch(sim, t));
        bands->band[t] = (unsigned char)fmin(part * WINDOW_BANDS, WINDOW_BANDS - 1);
        begin[bands->band[t] + 1]++;
    }
    for (int i = 0; i < WINDOW_BANDS; i++) {
        bands->mesh[i] = (struct mesh){.point_count = (uint32_t)(3 * begin[i + 1]),
                                       .position = bands->position + 3 * begin[i],
                                       .normal = bands->normal + 3 * begin[i],
                                       .triangle_count = (uint32_t)begin[i + 1],
                                       .triangle = bands->triangle};
        bands->skin[i] = (struct render_skin){.mesh = &bands->mesh[i]};
        app_scale_colour(app, (i + 0.5) / WINDOW_BANDS, bands->skin[i].colour);
        begin[i + 1] += begin[i];
    }
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++) {
            const uint32_t p = sim->triangle_point[t][k];
            const size_t at = 3 * begin[bands->band[t]] + (size_t)k;
            memcpy(bands->position[at], app->skins.position[p], sizeof *bands->position);
            memcpy(bands->normal[at], app->skins.normal[p], sizeof *bands->normal);
            begin[bands->band[t]] += k == 2;
        }
}

/* What there is beside the balloons, and the springs that hold. */
static bool make_wires(struct app *app, const struct render_view *view)
{
    const struct sim *sim = app->live.sim;
    const struct render_scene props = skins_scene(&app->skins, view);
    app->lines.count = 0;
    if (!ARRAY_RESERVE(&app->lines, props.line_count))
        return false;
    for (size_t i = 0; i < props.line_count; i++)
        app->lines.items[app->lines.count++] = props.lines[i];
    if (app->wires == WIRES_OFF)
        return true;
    if (!ARRAY_RESERVE(&app->lines, sim->edge_count))
        return false;
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        if (!sim->edge_active[e])
            continue;
        struct render_line *line = &app->lines.items[app->lines.count++];
        *line = (struct render_line){.opacity = 0.6f, .width = 1, .on_top = app->wires == WIRES_ALONE};
        memcpy(line->from, sim->position[sim->edge_point[e][0]], sizeof line->from);
        memcpy(line->to, sim->position[sim->edge_point[e][1]], sizeof line->to);
        memcpy(line->colour, wire_colour, sizeof line->colour);
        if (app->stretch_colours && app->wires == WIRES_ALONE)
            app_scale_colour(app, app_stretch_part(app, sim_edge_length(sim, e) / sim->rest_length[e]),
                             line->colour);
    }
    return true;
}

struct render_view app_drawn_view(const struct app *app)
{
    struct render_view view = app->view;
    orbit_make_even(&view);
    orbit_camera(&app->orbit, &view.camera);
    view.camera.eye_distance = app->eye_distance * app->orbit.distance;
    if (app->filtered.on && !app->live.paused)
        view.outlines = RENDER_FILTERED;
    if (app->stretch_colours)
        view.style = RENDER_PAPER; /* whose colours are those that it is given */
    return view;
}

/* All but what lies on the glass. */
static enum status make_scene(struct app *app, struct render_view *view, struct render_scene *scene,
                              struct error *err)
{
    skins_update(&app->skins);
    skins_floor(&app->skins, app->ball, view);
    if (app->wires != WIRES_ALONE && app->stretch_colours) {
        fill_bands(app);
        scene->skins = app->bands.skin;
        scene->skin_count = WINDOW_BANDS;
    } else if (app->wires != WIRES_ALONE) {
        scene->skins = app->skins.skins;
        scene->skin_count = app->live.sim->balloon_count;
    }
    if (!make_wires(app, view))
        return error_no_memory(err, "the wires");
    scene->lines = app->lines.items;
    scene->line_count = app->lines.count;
    return STATUS_OK;
}

/* Outlines of several samples cost about as much as all the rest, those that are filtered a fifth of it and
 * look nearly the same: the eye sees the skin moving in jerks long before it sees the difference. */
static void choose_outlines(struct app *app, double now)
{
    if (app->live.paused)
        return;
    if (app->filtered.on && now >= app->filtered.until) {
        app->filtered.on = false;
    } else if (!app->filtered.on && app->frames_rate < slow_rate[app_drawn_view(app).style]) {
        app->filtered.on = true;
        app->filtered.wait = fmin(fmax(2 * app->filtered.wait, first_wait), longest_wait);
        app->filtered.until = now + app->filtered.wait;
    }
}

static void count_frames(struct app *app, double begun)
{
    const double now = app_seconds();
    app->drawing = now - begun;
    app->pictures++;
    if (now - app->counting < count_seconds)
        return;
    app->frames_rate = app->pictures / (now - app->counting);
    app->counting = now;
    app->pictures = 0;
    choose_outlines(app, now);
}

/* From dots to pixels. */
static void enlarge(struct app *app, struct render_text *texts, size_t count)
{
    const int dot = app_dot(app);
    for (size_t i = 0; i < count; i++) {
        texts[i].x *= dot;
        texts[i].y *= dot;
        texts[i].scale *= dot;
    }
    for (size_t i = 0; i < app->boxes.count; i++) {
        struct render_box *box = &app->boxes.items[i];
        box->x *= dot;
        box->y *= dot;
        box->width *= dot;
        box->height *= dot;
    }
}

void app_draw(struct app *app)
{
    struct render_text texts[WINDOW_TEXTS_MAX];
    struct render_scene scene = {.texts = texts};
    struct error err = {0};
    const double begun = app_seconds();
    struct render_view view = app_drawn_view(app);
    enum status status = make_scene(app, &view, &scene, &err);
    scene.text_count = app_texts(app, texts);
    if (app_make_boxes(app)) {
        scene.boxes = app->boxes.items;
        scene.box_count = app->boxes.count;
    }
    enlarge(app, texts, scene.text_count);
    if (!status)
        status = render_show(app->render, &view, &scene, &err);
    if (status) { /* it is read in the next picture */
        hints_say(&app->hints, err.text);
        app->message_left = 0;
    }
    count_frames(app, begun);
}

enum status app_draw_image(struct app *app, struct error *err)
{
    struct render_scene scene = {0};
    struct render_view view = app_drawn_view(app);
    enum status status = make_scene(app, &view, &scene, err);
    if (view.stereo == RENDER_QUAD)
        view.stereo = RENDER_PARALLEL; /* an image has no two buffers */
    orbit_make_even(&view);
    view.order = app->film_view.order;
    view.samples = app->film_view.samples;
    view.outlines = app->view.outlines;
    return status ? status : render_draw_scene(app->render, &view, &scene, &app->image, err);
}
