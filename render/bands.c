/* A picture is drawn eye by eye into the target, and a large one in bands. */
#include "render/parts.h"

#include <string.h>

/* A target holds at most this many pixels; larger pictures are drawn in bands, so that they need little more
 * memory than themselves. */
enum { BAND_PIXELS = 1 << 22 };

/* Strips in linear light, with lists of layers, hold at most this many samples (or one row). */
enum { LIGHT_PIXELS = 1 << 20 };

static const float exposure = 0.86f; /* of latex; the backdrop looks the same with and without */

/* What drawing a band needs to hand around. */
struct band {
    struct render *render;
    const struct render_view *view;
    const struct render_scene *scene;
    const struct camera_eye *eye;
    int number;              /* the eye's */
    int below;               /* the picture's row, from below, that is the target's lowest */
    struct draw_place place; /* where in what is bound */
};

enum status render_bind_band(struct render *render, const struct render_view *view, struct error *err)
{
    int rows = BAND_PIXELS / view->width < view->height ? BAND_PIXELS / view->width : view->height;
    const int samples = view->outlines == RENDER_SAMPLED && !render_in_light(view) ? 4 : 1;
    return target_bind(&render->target, &render->gl, view->width, rows, samples, err);
}

bool render_in_light(const struct render_view *view)
{
    return view->style == RENDER_LATEX || view->order > RENDER_SORT || view->samples > 1;
}

static bool is_filtered(const struct render_view *view)
{
    return view->outlines == RENDER_FILTERED && view->samples <= 1;
}

enum status render_ready(struct render *render, const struct render_view *view, struct error *err)
{
    enum status status = STATUS_OK;
    if (stereo_is_mixed(view->stereo) && !render->stereo.program)
        status = stereo_open(&render->stereo, &render->gl, err);
    if (!status && is_filtered(view) && !render->outlines.program)
        status = outlines_open(&render->outlines, &render->gl, err);
    if (status || !render_in_light(view))
        return status;
    if (!render->light.tone)
        status = light_open(&render->light, &render->gl, err);
    if (!status)
        status = draw_ready(&render->draw, &render->gl, view->style, LIGHT_BLENDED, err);
    if (!status && view->order > RENDER_SORT)
        status = draw_ready(&render->draw, &render->gl, view->style, LIGHT_PEELING, err);
    if (!status && view->order == RENDER_LIST && render->light.lists)
        status = draw_ready(&render->draw, &render->gl, view->style, LIGHT_LISTED, err);
    return status;
}

static int limited(int value, int least, int most)
{
    return value < least ? least : value > most ? most : value;
}

/* What the target holds of an eye's picture. */
static void eye_rectangle(const struct band *band, int rectangle[4])
{
    const struct camera_eye *eye = band->eye;
    const int rows = band->render->target.height;
    int bottom = limited(eye->bottom - band->below, 0, rows);
    int top = limited(eye->bottom + eye->height - band->below, 0, rows);
    const int result[4] = {eye->left, bottom, eye->width, top - bottom};
    memcpy(rectangle, result, sizeof result);
}

/* From now on no more than that rectangle of what is bound is drawn. */
static void scissor(struct band *band, const int rectangle[4])
{
    memcpy(band->place.scissor, rectangle, sizeof band->place.scissor);
    band->render->gl.Scissor(rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
}

/* The eye's picture lies in the target. */
static void place_eye(struct band *band)
{
    const struct camera_eye *eye = band->eye;
    int rectangle[4];
    eye_rectangle(band, rectangle);
    band->place = (struct draw_place){
        .viewport = {eye->left, eye->bottom - band->below, eye->width, eye->height},
        .brightness = 1,
        .eye = band->number};
    scissor(band, rectangle);
}

/* The box of the target that anything but the backdrop may meet. */
static void find_box(const struct band *band, int box[4])
{
    const struct geometry *g = &band->render->geometry;
    const struct camera_eye *eye = band->eye;
    int margin = (int)band->render->overlay.widest + 1;
    camera_pixels(eye, g->low, g->high, g->nearest, g->farthest, box);
    if (!box[2] || !box[3])
        return;
    int left = limited(box[0] - margin, eye->left, eye->left + eye->width);
    int right = limited(box[0] + box[2] + margin, eye->left, eye->left + eye->width);
    int rows[4];
    eye_rectangle(band, rows);
    int bottom = limited(box[1] - margin - band->below, rows[1], rows[1] + rows[3]);
    int top = limited(box[1] + box[3] + margin - band->below, rows[1], rows[1] + rows[3]);
    const int result[4] = {left, bottom, right - left, top - bottom};
    for (int i = 0; i < 4; i++)
        box[i] = result[i];
}

/* Backdrop and shadows where the target is read from, or, with several samples a pixel, where it is drawn. A
 * picture in one band has the same backdrop as the one before it. */
static void draw_behind(const struct band *band, bool smoothly)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    const struct draw_place *place = &band->place;
    const bool keeps = !smoothly && render->target.height == band->view->height;
    if (!keeps || !behind_fetch(&render->behind, gl, &render->target, place->viewport)) {
        draw_backdrop(&render->draw, gl, place);
        if (keeps)
            behind_keep(&render->behind, gl, &render->target, place->viewport);
    }
    gl->Enable(GL_SCISSOR_TEST);
    draw_shadow(&render->draw, gl, place, band->eye, &render->geometry);
}

/* Lines that translucent skin may lie before, or behind. */
static bool lines_meet_skin(const struct render *render)
{
    return render->overlay.hidden_lines > 0 && render->geometry.translucent.count > 0;
}

/* First what of the lines lies behind the nearest skin, so that this dims it. What lies between translucent
 * skin and opaque things behind that is covered by these. */
static void draw_lines_behind(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    if (!lines_meet_skin(render))
        return;
    draw_depths(&render->draw, gl, &band->place, band->eye, &render->geometry);
    overlay_draw_lines_behind(&render->overlay, gl, band->eye, &render->geometry);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
}

/* Over the skins the rest of the lines. */
static void draw_lines_before(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    if (lines_meet_skin(render))
        draw_depths(&render->draw, gl, &band->place, band->eye, &render->geometry);
    overlay_draw_lines(&render->overlay, gl, band->eye, &render->geometry);
}

/* All but the text. */
static void draw_all(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    draw_behind(band, render->target.samples > 1);
    draw_lines_behind(band);
    if (band->scene->solid)
        solid_draw_eye(&render->solid, gl, band->view, band->eye, &render->geometry, band->scene);
    draw_eye(&render->draw, gl, &band->place, band->eye, &render->geometry);
    draw_lines_before(band);
}

/* Smooth edges are costly: only the part of the picture that anything may meet is drawn with more than one
 * sample a pixel; the backdrop around it needs none. */
static void draw_smoothly(struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    int box[4];
    find_box(band, box);
    target_bind_resolved(&render->target, gl);
    draw_behind(band, false);
    if (box[2] && box[3]) {
        target_bind_drawn(&render->target, gl);
        scissor(band, box);
        draw_all(band);
        place_eye(band);
        target_resolve(&render->target, gl, box);
        target_bind_resolved(&render->target, gl);
    }
}

static void draw_layers(void *self, const struct light_pass *pass)
{
    const struct band *band = self;
    struct render *render = band->render;
    if (render->geometry.translucent.count)
        draw_translucent(&render->draw, &render->gl, band->view->style, &band->place, band->eye,
                         &render->geometry, pass);
}

/* A strip of the target (x, y from below, width, height) in linear light, over what is there. */
static enum status draw_strip(struct band *band, const int strip[4], struct error *err)
{
    struct render *render = band->render;
    const struct render_view *view = band->view;
    const struct gl *gl = &render->gl;
    const int side = view->samples > 1 ? view->samples : 1;
    const bool latex = view->style == RENDER_LATEX;
    const bool smooth = view->outlines == RENDER_SAMPLED && side == 1 && view->order <= RENDER_SORT;
    enum status status = light_bind(&render->light, gl, strip[2] * side, strip[3] * side, smooth ? 4 : 1,
                                    err);
    if (status)
        return status;
    band->place = (struct draw_place){.viewport = {(band->eye->left - strip[0]) * side,
                                                   (band->eye->bottom - band->below - strip[1]) * side,
                                                   band->eye->width * side, band->eye->height * side},
                                      .brightness = latex ? 1 / exposure : 1,
                                      .eye = band->number};
    scissor(band, (const int[4]){0, 0, strip[2] * side, strip[3] * side});
    draw_backdrop(&render->draw, gl, &band->place);
    draw_shadow(&render->draw, gl, &band->place, band->eye, &render->geometry);
    draw_lines_behind(band);
    if (band->scene->solid)
        solid_draw_eye(&render->solid, gl, view, band->eye, &render->geometry, band->scene);
    draw_opaque(&render->draw, gl, view->style, band->eye, &render->geometry);
    light_layers(&render->light, gl, view->order, draw_layers, band);
    draw_lines_before(band);
    light_finish(&render->light, gl);
    target_bind_drawn(&render->target, gl);
    gl->Viewport(0, 0, render->target.width, render->target.height);
    gl->Scissor(strip[0], strip[1], strip[2], strip[3]);
    light_tone(&render->light, gl, strip, side, latex ? exposure : 0);
    return STATUS_OK;
}

/* Only the part of the picture that anything may meet is drawn in linear light; the backdrop
 * around it is the same. */
static enum status draw_in_light(struct band *band, struct error *err)
{
    int box[4], side = band->view->samples > 1 ? band->view->samples : 1;
    enum status status = STATUS_OK;
    find_box(band, box);
    draw_behind(band, false);
    if (!box[2] || !box[3])
        return STATUS_OK;
    int rows = limited(LIGHT_PIXELS / (box[2] * side * side), 1, box[3]);
    for (int y = 0; y < box[3] && !status; y += rows) {
        const int strip[4] = {box[0], box[1] + y, box[2], limited(box[3] - y, 1, rows)};
        status = draw_strip(band, strip, err);
    }
    band->render->gl.Viewport(band->eye->left, band->eye->bottom - band->below, band->eye->width,
                              band->eye->height);
    return status;
}

/* Those of all that is drawn, within its box. */
static void filter_outlines(struct band *band)
{
    struct render *render = band->render;
    const int *eye = band->place.viewport;
    int box[4];
    find_box(band, box);
    place_eye(band);
    if (box[2] && box[3])
        outlines_filter(&render->outlines, &render->gl, &render->target, box);
    render->gl.Viewport(eye[0], eye[1], eye[2], eye[3]);
}

static enum status draw_one_eye(struct band *band, struct error *err)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    enum status status = STATUS_OK;
    gl->Enable(GL_SCISSOR_TEST);
    place_eye(band);
    if (render_in_light(band->view))
        status = draw_in_light(band, err);
    else if (band->view->outlines == RENDER_SAMPLED)
        draw_smoothly(band);
    else
        draw_all(band);
    if (!status && is_filtered(band->view))
        filter_outlines(band);
    place_eye(band);
    overlay_draw_text(&render->overlay, gl, band->eye);
    gl->Disable(GL_SCISSOR_TEST);
    return status;
}

/* What becomes of an eye's picture as soon as it is drawn: halves need nothing. */
static void put_eye(const struct band *band, int eye, int rows)
{
    struct render *render = band->render;
    if (stereo_is_mixed(band->view->stereo))
        stereo_keep(&render->stereo, &render->gl, &render->target, eye);
    else if (band->view->stereo == RENDER_QUAD)
        target_show(&render->target, &render->gl, eye ? GL_BACK_RIGHT : GL_BACK_LEFT, band->below, rows);
}

enum status render_bands(struct render *render, const struct render_view *view,
                         const struct render_scene *scene, struct image *out, struct error *err)
{
    struct camera_eye eyes[2];
    int count = camera_eyes(view, eyes), rows = render->target.height;
    enum status status = STATUS_OK;
    for (int below = 0; below < view->height && !status; below += rows) {
        const int left = view->height - below, shown = left < rows ? left : rows;
        for (int i = 0; i < count && !status; i++) {
            struct band band = {
                .render = render, .view = view, .scene = scene, .eye = &eyes[i], .number = i, .below = below};
            target_bind_drawn(&render->target, &render->gl);
            status = draw_one_eye(&band, err);
            if (!status)
                put_eye(&band, i, shown);
        }
        if (status)
            break;
        if (stereo_is_mixed(view->stereo))
            stereo_mix(&render->stereo, &render->gl, &render->target, view, below);
        if (out)
            status = target_read(&render->target, &render->gl, out, below, shown, err);
        else if (view->stereo != RENDER_QUAD)
            target_show(&render->target, &render->gl, GL_BACK, below, shown);
    }
    return status;
}
