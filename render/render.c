#include "render/render.h"

#include "common/array.h"
#include "render/parts.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum status render_use(struct render *render, struct error *err)
{
    if (!render->window)
        return context_use(render->context, err);
    window_use(render->window, context_leave());
    return STATUS_OK;
}

static enum status open_parts(struct render *render, gl_finder *find, struct error *err)
{
    const struct gl *gl = &render->gl;
    enum status status = gl_load(&render->gl, find, err);
    if (!status)
        status = draw_open(&render->draw, gl, err);
    if (!status)
        status = solid_draw_open(&render->solid, gl, err);
    if (!status)
        status = overlay_open(&render->overlay, gl, err);
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
    enum status status = context_open(&render->context, err);
    if (!status)
        status = open_parts(render, context_function, err);
    if (!status)
        status = render_bind_band(render, &(struct render_view){.width = width, .height = height}, err);
    if (status)
        render_close(render);
    else
        *result = render;
    return status;
}

enum status render_open_window(struct window *window, struct render **result, struct error *err)
{
    struct render *render = calloc(1, sizeof *render);
    if (!render)
        return error_no_memory(err, "the renderer");
    render->window = window;
    window_use(window, context_leave());
    enum status status = open_parts(render, window_function, err);
    if (status)
        render_close(render);
    else
        *result = render;
    return status;
}

/* The corners of the solid's box, and the lines' ends. */
static enum status collect_points(struct render *render, const struct render_scene *scene, struct error *err)
{
    double bounds[2][3];
    render->points.count = 0;
    if (!ARRAY_RESERVE(&render->points, 8 + 2 * scene->line_count))
        return error_no_memory(err, "the lines to draw");
    if (scene->solid && solid_bounds(scene->solid, bounds[0], bounds[1]))
        for (int corner = 0; corner < 8; corner++, render->points.count++)
            for (int i = 0; i < 3; i++)
                render->points.items[render->points.count][i] = bounds[corner >> i & 1][i];
    for (size_t i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++, render->points.count++)
            memcpy(render->points.items[render->points.count],
                   end ? scene->lines[i].to : scene->lines[i].from, sizeof *render->points.items);
    return STATUS_OK;
}

/* Sorted triangles lie about anywhere in the picture: cells bring neighbours together again. Where a
 * window is drawn into, each change of the scissor costs more than that gains: 7 pictures a second of
 * 100,000 triangles against 10. */
static bool uses_cells(const struct render *render, const struct render_view *view)
{
    return !render->window && cells_are_worth_it(&render->geometry, view);
}

static enum status build_cells(struct render *render, const struct render_view *view, struct error *err)
{
    struct camera_eye eyes[2];
    enum status status = STATUS_OK;
    const int count = camera_eyes(view, eyes);
    render->cells[1].indices.count = 0; /* of an eye that may not be there */
    for (int i = 0; i < count && uses_cells(render, view) && !status; i++)
        status = cells_build(&render->cells[i], &render->geometry, &eyes[i], err);
    return status;
}

/* Everything of a frame to the graphics card. */
static enum status prepare(struct render *render, const struct render_view *view,
                           const struct render_scene *scene, struct error *err)
{
    enum status status = camera_check(view, err);
    if (!status)
        status = collect_points(render, scene, err);
    if (!status)
        status = geometry_build(&render->geometry, view, scene->skins, scene->skin_count,
                                (const double(*)[3])render->points.items, render->points.count, err);
    if (!status)
        status = build_cells(render, view, err);
    if (!status)
        status = render_use(render, err);
    if (!status)
        status = render_ready(render, view, err);
    if (!status)
        status = render_bind_band(render, view, err);
    if (!status)
        status = overlay_upload(&render->overlay, &render->gl, &render->quads, view, scene, err);
    if (!status)
        draw_upload(&render->draw, &render->gl, &render->geometry,
                    uses_cells(render, view) ? render->cells : NULL);
    return status;
}

enum status render_draw_scene(struct render *render, const struct render_view *view,
                              const struct render_scene *scene, struct image *out, struct error *err)
{
    if (view->stereo == RENDER_QUAD)
        return error_set(err, STATUS_RANGE, "an image has no two buffers; its eyes can be side by side");
    enum status status = prepare(render, view, scene, err);
    if (!status)
        status = image_resize(out, view->width, view->height, err);
    return status ? status : render_bands(render, view, scene, out, err);
}

enum status render_draw(struct render *render, const struct render_view *view,
                        const struct render_skin *skins, size_t skin_count, struct image *out,
                        struct error *err)
{
    const struct render_scene scene = {.skins = skins, .skin_count = skin_count};
    return render_draw_scene(render, view, &scene, out, err);
}

enum status render_show(struct render *render, const struct render_view *view,
                        const struct render_scene *scene, struct error *err)
{
    assert(render->window);
    if (view->stereo == RENDER_QUAD && !window_has_quad(render->window))
        return error_set(err, STATUS_RESOURCE, "this screen has no two buffers, one for each eye");
    enum status status = prepare(render, view, scene, err);
    return status ? status : render_bands(render, view, scene, NULL, err);
}

void render_close(struct render *render)
{
    if (!render)
        return;
    struct error ignored;
    if (render->gl.Viewport && !render_use(render, &ignored)) {
        target_clear(&render->target, &render->gl);
        behind_clear(&render->behind, &render->gl);
        light_close(&render->light, &render->gl);
        stereo_close(&render->stereo, &render->gl);
        outlines_close(&render->outlines, &render->gl);
        draw_close(&render->draw, &render->gl);
        solid_draw_close(&render->solid, &render->gl);
        overlay_close(&render->overlay, &render->gl);
        quads_clear(&render->quads, &render->gl);
    }
    geometry_clear(&render->geometry);
    for (int i = 0; i < 2; i++)
        cells_clear(&render->cells[i]);
    free(render->points.items);
    context_close(render->context);
    free(render);
}
