#include "sim/film.h"

#include "common/vec3.h"
#include "render/camera.h"
#include "render/frame_files.h"
#include "sim/skins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct film {
    struct skins skins;
    struct render *render;
    struct render_view view;
    double ball[4];           /* around all points at rest: centre, radius */
    double away[3];           /* from the target to the eye, as the scene has it */
    struct frames *frames[2]; /* of both eyes, or the left one's with the second NULL */
    const char *folder;       /* whose frames of an earlier run are still there; or NULL */
    size_t first, removed;
    struct image image;
    char *keys;                 /* the scene's, a line each */
    struct image_text texts[2]; /* of every PNG */
};

/* Every frame tells where it is from: the scene's file, and all keys that its state
 * depends on, seeds among them. */
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

static const struct {
    enum render_stereo stereo;
    const char *name;
} eyes[2] = {{RENDER_LEFT, "left"}, {RENDER_RIGHT, "right"}};

static enum status open_frames(struct film *film, const struct scene *scene,
                               const struct frames_options *options, struct error *err)
{
    const bool separate = scene->view.stereo == SCENE_SEPARATE;
    struct frames_options own = *options;
    own.width = film->view.width;
    own.height = film->view.height;
    own.texts = film->texts;
    own.counted = "edges broken";
    own.counted_one = "edge broken";
    own.text_count = sizeof film->texts / sizeof *film->texts;
    enum status status = STATUS_OK;
    for (int i = 0; i < (separate ? 2 : 1) && !status; i++) {
        own.eye = separate ? eyes[i].name : NULL;
        status = frames_open(&own, &film->frames[i], err);
    }
    return status;
}

/* Each eye's pictures are whole ones: those of both are never put together. */
static void look(const struct sim *sim, const double centre[3], double radius, struct render_view *view)
{
    skins_camera(sim, centre, radius, view);
    if (sim->scene->view.stereo == SCENE_SEPARATE)
        view->stereo = eyes[0].stereo;
}

static enum status check_view(const struct render_view *view, struct error *err)
{
    enum status status = camera_check(view, err);
    return status ? error_prefix(err, "view") : STATUS_OK;
}

enum status film_check(const struct sim *sim, const double centre[3], double radius, struct error *err)
{
    struct render_view view = {0};
    look(sim, centre, radius, &view);
    return check_view(&view, err);
}

enum status film_open(struct sim *sim, const double centre[3], double radius,
                      const struct frames_options *options, struct film **result, struct error *err)
{
    struct film *film = calloc(1, sizeof *film);
    if (!film)
        return error_no_memory(err, "the film");
    look(sim, centre, radius, &film->view);
    memcpy(film->ball, centre, 3 * sizeof *centre);
    film->ball[3] = radius;
    vec3_sub(film->view.camera.eye, film->view.camera.target, film->away);
    film->folder = options->folder;
    film->first = options->first;
    enum status status = check_view(&film->view, err);
    if (!status)
        status = skins_init(&film->skins, sim, err);
    if (!status)
        status = render_open(film->view.width, film->view.height, &film->render, err);
    if (!status)
        status = make_texts(film, sim->scene, err);
    if (!status)
        status = open_frames(film, sim->scene, options, err);
    if (status)
        film_close(film, false, NULL);
    else
        *result = film;
    return status;
}

void film_turn(struct film *film, double turns)
{
    struct render_camera *camera = &film->view.camera;
    const double angle = 2 * M_PI * turns, c = cos(angle), s = sin(angle), *away = film->away;
    camera->eye[0] = camera->target[0] + c * away[0] + s * away[2];
    camera->eye[2] = camera->target[2] - s * away[0] + c * away[2];
}

/* A film is never a mixture of two runs, however this one ends. */
static enum status remove_old(struct film *film, struct error *err)
{
    enum status status = film->folder ? frame_files_remove(film->folder, film->first, &film->removed, err)
                                      : STATUS_OK;
    film->folder = NULL;
    return status;
}

size_t film_removed(const struct film *film)
{
    return film ? film->removed : 0;
}

static enum status draw_eye(struct film *film, int eye, struct error *err)
{
    const struct sim *sim = film->skins.sim;
    if (film->frames[1])
        film->view.stereo = eyes[eye].stereo;
    const struct render_scene scene = skins_scene(&film->skins, &film->view);
    enum status status = render_draw_scene(film->render, &film->view, &scene, &film->image, err);
    if (!status)
        status = remove_old(film, err);
    frames_count(film->frames[eye], sim->broken);
    return status ? status : frames_add(film->frames[eye], &film->image, sim->time, err);
}

enum status film_frame(struct film *film, struct error *err)
{
    enum status status = STATUS_OK;
    skins_update(&film->skins);
    skins_floor(&film->skins, film->ball, &film->view);
    for (int eye = 0; eye < 2 && film->frames[eye] && !status; eye++)
        status = draw_eye(film, eye, err);
    return status;
}

enum status film_close(struct film *film, bool keep, struct error *err)
{
    enum status status = STATUS_OK;
    if (!film)
        return STATUS_OK;
    for (int eye = 0; eye < 2; eye++)
        if (film->frames[eye] && keep && !status)
            status = frames_close(film->frames[eye], err);
        else if (film->frames[eye])
            frames_abandon(film->frames[eye]);
    render_close(film->render);
    image_clear(&film->image);
    skins_clear(&film->skins);
    free(film->keys);
    free(film);
    return status;
}
