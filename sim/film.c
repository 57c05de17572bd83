#include "sim/film.h"

#include "common/vec3.h"
#include "sim/skins.h"

#include <stdio.h>
#include <stdlib.h>

struct film {
    struct skins skins;
    struct render *render;
    struct render_view view;
    struct frames *frames;
    struct image image;
    char *keys;                 /* the scene's, a line each */
    struct image_text texts[2]; /* of every PNG */
};

/* Every frame tells where it is from: the scene's file, and all keys that its state depends on, seeds among them. */
static enum status make_texts(struct film *film, const struct scene *scene, struct error *err)
{
    size_t size = 0;
    FILE *stream = open_memstream(&film->keys, &size);
    if (!stream)
        return error_no_memory(err, "the frames' texts");
    scene_write_keys(scene, stream);
    if (fclose(stream))
        return error_no_memory(err, "the frames' texts");
    film->texts[0] = (struct image_text){"Scene", scene->path ? scene->path : scene->balloons[0].mesh};
    film->texts[1] = (struct image_text){"Keys", film->keys};
    return STATUS_OK;
}

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
        status = make_texts(film, sim->scene, err);
    struct frames_options with_texts = *options;
    with_texts.texts = film->texts;
    with_texts.text_count = sizeof film->texts / sizeof *film->texts;
    if (!status)
        status = frames_open(&with_texts, &film->frames, err);
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
    free(film->keys);
    free(film);
    return status;
}
