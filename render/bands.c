/* A picture is drawn eye by eye into the target, and a large one in bands. */
#include "render/parts.h"

/* A target holds at most this many pixels; larger pictures are drawn in bands, so that they need little more
 * memory than themselves. */
enum { BAND_PIXELS = 1 << 22 };

/* What drawing a band needs to hand around. */
struct band {
    struct render *render;
    const struct render_view *view;
    const struct render_scene *scene;
    const struct camera_eye *eye;
    int below; /* the picture's row, from below, that is the target's lowest */
};

enum status render_bind_band(struct render *render, int width, int height, bool smooth, struct error *err)
{
    int rows = BAND_PIXELS / width < height ? BAND_PIXELS / width : height;
    return target_bind(&render->target, &render->gl, width, rows, smooth ? 4 : 1, err);
}

static int limited(int value, int least, int most)
{
    return value < least ? least : value > most ? most : value;
}

/* The box of the target that anything but the backdrop may meet. */
static void find_box(const struct band *band, int box[4])
{
    const struct geometry *g = &band->render->geometry;
    const struct camera_eye *eye = band->eye;
    int margin = (int)band->render->overlay.widest + 1;
    camera_pixels(band->view, eye, g->low, g->high, g->nearest, g->farthest, box);
    if (!box[2] || !box[3])
        return;
    int left = limited(box[0] - margin, eye->left, eye->left + eye->width);
    int right = limited(box[0] + box[2] + margin, eye->left, eye->left + eye->width);
    int bottom = limited(box[1] - margin - band->below, 0, band->render->target.height);
    int top = limited(box[1] + box[3] + margin - band->below, 0, band->render->target.height);
    const int result[4] = {left, bottom, right - left, top - bottom};
    for (int i = 0; i < 4; i++)
        box[i] = result[i];
}

static void draw_behind_all(const struct band *band)
{
    struct render *render = band->render;
    draw_behind(&render->draw, &render->gl, band->view, band->eye, &render->geometry, band->below);
}

/* All but the text. */
static void draw_all(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    draw_behind_all(band);
    if (band->scene->solid)
        solid_draw_eye(&render->solid, gl, band->view, band->eye, &render->geometry, band->scene);
    draw_eye(&render->draw, gl, band->eye, &render->geometry);
    overlay_draw_lines(&render->overlay, gl, band->view, band->eye, &render->geometry);
}

/* Smooth edges are costly: only the part of the picture that anything may meet is drawn with more than one
 * sample a pixel; the backdrop around it needs none. */
static void draw_smoothly(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    int box[4];
    find_box(band, box);
    target_bind_resolved(&render->target, gl);
    draw_behind_all(band);
    if (box[2] && box[3]) {
        target_bind_drawn(&render->target, gl);
        gl->Scissor(box[0], box[1], box[2], box[3]);
        draw_all(band);
        gl->Scissor(band->eye->left, 0, band->eye->width, render->target.height);
        target_resolve(&render->target, gl, box);
        target_bind_resolved(&render->target, gl);
    }
}

static void draw_one_eye(const struct band *band)
{
    struct render *render = band->render;
    const struct gl *gl = &render->gl;
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(band->eye->left, 0, band->eye->width, render->target.height);
    if (band->view->smooth_edges)
        draw_smoothly(band);
    else
        draw_all(band);
    overlay_draw_text(&render->overlay, gl, band->view, band->eye);
    gl->Disable(GL_SCISSOR_TEST);
}

enum status render_bands(struct render *render, const struct render_view *view,
                         const struct render_scene *scene, struct image *out, struct error *err)
{
    struct camera_eye eyes[2];
    int count = camera_eyes(view, eyes), rows = render->target.height;
    enum status status = STATUS_OK;
    for (int below = 0; below < view->height && !status; below += rows) {
        int left = view->height - below;
        target_bind_drawn(&render->target, &render->gl);
        for (int i = 0; i < count; i++)
            draw_one_eye(&(struct band){render, view, scene, &eyes[i], below});
        if (out)
            status = target_read(&render->target, &render->gl, out, below, left < rows ? left : rows, err);
        else
            target_show(&render->target, &render->gl, below, left < rows ? left : rows);
    }
    return status;
}
