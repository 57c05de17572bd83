#include "render/render.h"

#include "render/camera.h"
#include "render/context.h"
#include "render/draw.h"
#include "render/target.h"

#include <stdlib.h>

struct render {
    struct context *context;
    struct gl gl;
    struct draw draw;
    struct target target;
    struct geometry geometry;
};

/* A target holds at most this many pixels; larger pictures are drawn in bands, so that they need little more
 * memory than themselves. */
enum { BAND_PIXELS = 1 << 22 };

static enum status bind_band(struct render *render, int width, int height, bool smooth, struct error *err)
{
    int rows = BAND_PIXELS / width < height ? BAND_PIXELS / width : height;
    return target_bind(&render->target, &render->gl, width, rows, smooth ? 4 : 1, err);
}

static enum status open_parts(struct render *render, int width, int height, struct error *err)
{
    enum status status = context_open(&render->context, err);
    if (!status)
        status = gl_load(&render->gl, context_function, err);
    if (!status)
        status = draw_open(&render->draw, &render->gl, err);
    if (!status)
        status = bind_band(render, width, height, false, err);
    return status;
}

enum status render_open(int width, int height, struct render **result, struct error *err)
{
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX)
        return error_set(err, STATUS_RANGE, "a picture of %d x %d cannot be drawn; each side must be 1 to %d",
                         width, height, IMAGE_SIDE_MAX);
    struct render *render = calloc(1, sizeof *render);
    if (!render)
        return error_no_memory(err, "the renderer");
    enum status status = open_parts(render, width, height, err);
    if (status) {
        render_close(render);
        return status;
    }
    *result = render;
    return STATUS_OK;
}

/* The box of the picture that the skins may meet, moved into the band from row `below` on. */
static void find_box(const struct render *render, const struct render_view *view,
                     const struct camera_eye *eye, int below, int box[4])
{
    const struct geometry *g = &render->geometry;
    camera_pixels(view, eye, g->low, g->high, g->nearest, g->farthest, box);
    int bottom = box[1] - below, top = bottom + box[3], rows = render->target.height;
    box[1] = bottom < 0 ? 0 : bottom;
    top = top < rows ? top : rows;
    box[3] = top > box[1] ? top - box[1] : 0;
}

/* Smooth edges are costly: only the part of the picture that the skins may meet is drawn with more than one
 * sample a pixel; the backdrop around it needs none. */
static void draw_smoothly(struct render *render, const struct render_view *view, const struct camera_eye *eye,
                          int below)
{
    const struct gl *gl = &render->gl;
    const struct geometry *g = &render->geometry;
    int box[4];
    find_box(render, view, eye, below, box);
    target_bind_resolved(&render->target, gl);
    draw_eye(&render->draw, gl, view, eye, g, below, false);
    if (!box[2] || !box[3])
        return;
    target_bind_drawn(&render->target, gl);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(box[0], box[1], box[2], box[3]);
    draw_eye(&render->draw, gl, view, eye, g, below, true);
    gl->Disable(GL_SCISSOR_TEST);
    target_resolve(&render->target, gl, box);
}

static void draw_plainly(struct render *render, const struct render_view *view, const struct camera_eye *eye,
                         int below)
{
    const struct gl *gl = &render->gl;
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(eye->left, 0, eye->width, render->target.height);
    draw_eye(&render->draw, gl, view, eye, &render->geometry, below, true);
    gl->Disable(GL_SCISSOR_TEST);
}

static enum status draw_bands(struct render *render, const struct render_view *view, struct image *out,
                              struct error *err)
{
    struct camera_eye eyes[2];
    int count = camera_eyes(view, eyes), rows = render->target.height;
    enum status status = STATUS_OK;
    for (int below = 0; below < view->height && !status; below += rows) {
        target_bind_drawn(&render->target, &render->gl);
        for (int i = 0; i < count; i++) {
            if (view->smooth_edges)
                draw_smoothly(render, view, &eyes[i], below);
            else
                draw_plainly(render, view, &eyes[i], below);
        }
        int left = view->height - below;
        status = target_read(&render->target, &render->gl, out, below, left < rows ? left : rows, err);
    }
    return status;
}

enum status render_draw(struct render *render, const struct render_view *view,
                        const struct render_skin *skins, size_t skin_count, struct image *out,
                        struct error *err)
{
    enum status status = camera_check(view, err);
    if (!status)
        status = geometry_build(&render->geometry, view, skins, skin_count, err);
    if (!status)
        status = image_resize(out, view->width, view->height, err);
    if (!status)
        status = context_use(render->context, err);
    if (!status)
        status = bind_band(render, view->width, view->height, view->smooth_edges, err);
    if (status)
        return status;
    draw_upload(&render->draw, &render->gl, &render->geometry);
    return draw_bands(render, view, out, err);
}

void render_close(struct render *render)
{
    if (!render)
        return;
    struct error ignored;
    if (render->context && render->gl.Viewport && !context_use(render->context, &ignored)) {
        target_clear(&render->target, &render->gl);
        draw_close(&render->draw, &render->gl);
    }
    geometry_clear(&render->geometry);
    context_close(render->context);
    free(render);
}
