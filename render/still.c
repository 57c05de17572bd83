/* One skin, standing on the floor, seen a little from the right and above: what a program shows of its result. */
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

enum status render_still(const struct render_skin *skin, const char *path, const char *software,
                         struct error *err)
{
    static const double from[3] = {0.55, 0.45, 1};
    struct render_view view = {
        .width = STILL_WIDTH, .height = STILL_HEIGHT, .sorted = true, .smooth_edges = true, .floor = true};
    const struct image_text text = {"Software", software};
    struct render *render = NULL;
    struct image image = {0};
    double low[3], high[3];
    find_bounds(skin->mesh, low, high);
    view.floor_height = low[1];
    enum status status = render_fit_camera(&view, low, high, from, 0.1, err);
    if (!status)
        status = render_open(view.width, view.height, &render, err);
    if (!status)
        status = render_draw(render, &view, skin, 1, &image, err);
    if (status)
        error_prefix(err, path);
    else
        status = image_save_png(&image, path, &text, 1, err);
    image_clear(&image);
    render_close(render);
    return status;
}
