/* One skin, standing on the floor, seen a little from the right and above: what a
 * program shows of its result. */
#include "render/render.h"

#include <math.h>

enum { STILL_WIDTH = 1024, STILL_HEIGHT = 768 };

static void find_bounds(const struct mesh *mesh, double low[3], double high[3])
{
    for (int i = 0; i < 3; i++) {
        low[i] = INFINITY;
        high[i] = -INFINITY;
        for (uint32_t p = 0; p < mesh->point_count; p++) {
            low[i] = fmin(low[i], mesh->position[p][i]);
            high[i] = fmax(high[i], mesh->position[p][i]);
        }
    }
}

static enum status draw_still(const struct render_skin *skin, int width, int height, struct image *image,
                              struct error *err)
{
    static const double from[3] = {0.55, 0.45, 1};
    struct render_view view = {
        .width = width, .height = height, .order = RENDER_SORT, .outlines = RENDER_SAMPLED, .floor = true};
    struct render *render = NULL;
    double low[3], high[3];
    find_bounds(skin->mesh, low, high);
    view.floor_height = low[1];
    enum status status = render_fit_camera(&view, low, high, from, 0.1, err);
    if (!status)
        status = render_open(view.width, view.height, &render, err);
    if (!status)
        status = render_draw(render, &view, skin, 1, image, err);
    render_close(render);
    return status;
}

enum status render_still(const struct render_skin *skin, const char *path, const char *software,
                         struct error *err)
{
    const struct image_text text = {"Software", software};
    struct image image = {0};
    enum status status = draw_still(skin, STILL_WIDTH, STILL_HEIGHT, &image, err);
    if (status)
        error_prefix(err, path);
    else
        status = image_save_png(&image, path, &text, 1, err);
    image_clear(&image);
    return status;
}

enum status render_still_png(const struct render_skin *skin, int width, int height, const char *software,
                             struct bytes *png, struct error *err)
{
    const struct image_text text = {"Software", software};
    struct image image = {0};
    enum status status = draw_still(skin, width, height, &image, err);
    if (!status)
        status = image_encode_png(&image, &text, 1, png, err);
    image_clear(&image);
    return status;
}
