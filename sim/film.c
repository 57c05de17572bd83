#include "sim/film.h"

#include "common/vec3.h"
#include "sim/skins.h"

#include <stdlib.h>

struct film {
    struct skins skins;
    struct render *render;
    struct render_view view;
    struct frames *frames;
    struct image image;
};

/* The scene measures in radii of the ball around all points at rest. */
static void set_camera(struct render_view *view, const struct sim *sim, const double centre[3], double radius)
{
    const struct scene_view *scene = &sim->scene->view;
    struct render_camera *camera = &view->camera;
    for (int i = 0; i < 3; i++) {
        camera->target[i] = centre[i] + radius * scene->target[i];
        camera->eye[i] = camera->target[i] + radius * scene->camera[i];
        camera->up[i] = i == 1;
    }
    camera->field_of_view_deg = scene->field_of_view;
    camera->screen_distance = vec3_distance(camera->eye, camera->target);
    camera->eye_distance = scene->eye_distance * camera->screen_distance;
    skins_view(scene, view);
    view->smooth_edges = true;
    view->floor = true;
    view->floor_height = centre[1] - 1.8 * radius; /* it floats, with room to swell */
}

enum status film_open(struct sim *sim, const double centre[3], double radius,
                      const struct frames_options *options, struct film **result, struct error *err)
{
    struct film *film = calloc(1, sizeof *film);
    if (!film)
        return error_no_memory(err, "the film");
    set_camera(&film->view, sim, centre, radius);
    enum status status = skins_init(&film->skins, sim, err);
    if (!status)
        status = render_open(film->view.width, film->view.height, &film->render, err);
    if (!status)
        status = frames_open(options, &film->frames, err);
    if (status)
        film_close(film, NULL);
    else
        *result = film;
    return status;
}

enum status film_frame(struct film *film, struct error *err)
{
    const struct sim *sim = film->skins.sim;
    skins_update(&film->skins);
    enum status status = render_draw(film->render, &film->view, film->skins.skins, sim->balloon_count,
                                     &film->image, err);
    return status ? status : frames_add(film->frames, &film->image, sim->time, err);
}

enum status film_close(struct film *film, struct error *err)
{
    if (!film)
        return STATUS_OK;
    enum status status = film->frames ? frames_close(film->frames, err) : STATUS_OK;
    render_close(film->render);
    image_clear(&film->image);
    skins_clear(&film->skins);
    free(film);
    return status;
}
