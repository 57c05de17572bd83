#include "sim/film.h"

#include "common/array.h"
#include "common/vec3.h"
#include "render/render.h"

#include <stdlib.h>

struct film {
    struct sim *sim;
    struct render *render;
    struct render_view view;
    struct frames *frames;
    struct image image;
    struct mesh *meshes;        /* [balloon_count] borrow the sim's arrays: not to be cleared */
    struct render_skin *skins;  /* [balloon_count] */
    float *opacity, *shininess; /* [triangle_count] */
};

/* The ball around all points at rest: what the camera's lengths are measured in. */
static double seen_radius(const struct sim *sim, double centre[3])
{
    double radius = 0;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (uint32_t p = 0; p < sim->point_count; p++)
            sum += sim->position[p][i];
        centre[i] = sum / sim->point_count;
    }
    for (uint32_t p = 0; p < sim->point_count; p++)
        radius = fmax(radius, vec3_distance(sim->position[p], centre));
    return radius;
}

static void set_camera(struct render_view *view, const struct sim *sim)
{
    static const enum render_stereo stereo[] = {
        [SCENE_MONO] = RENDER_MONO, [SCENE_PARALLEL] = RENDER_PARALLEL, [SCENE_CROSSED] = RENDER_CROSSED};
    const struct scene_view *scene = &sim->scene->view;
    struct render_camera *camera = &view->camera;
    double centre[3];
    const double radius = seen_radius(sim, centre);
    for (int i = 0; i < 3; i++) {
        camera->target[i] = centre[i] + radius * scene->target[i];
        camera->eye[i] = camera->target[i] + radius * scene->camera[i];
        camera->up[i] = i == 1;
    }
    view->width = scene->size[0];
    view->height = scene->size[1];
    view->stereo = stereo[scene->stereo];
    view->sorted = true;
    view->smooth_edges = true;
    view->floor = true;
    view->floor_height = centre[1] - 1.8 * radius;
    camera->field_of_view_deg = scene->field_of_view;
    camera->screen_distance = vec3_distance(camera->eye, camera->target);
    camera->eye_distance = scene->eye_distance * camera->screen_distance;
}

/* IEC 61966-2-1. */
static float linear_light(double srgb)
{
    return (float)(srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4));
}

/* Each balloon's skin looks into the sim's arrays. */
static void set_skins(struct film *film)
{
    const struct sim *sim = film->sim;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct sim_balloon *b = &sim->balloons[i];
        film->meshes[i] = (struct mesh){.point_count = sim->point_count,
                                        .position = sim->position,
                                        .normal = sim->normal,
                                        .triangle_count = b->triangle_end - b->triangle_begin,
                                        .triangle = sim->triangle_point + b->triangle_begin};
        film->skins[i] = (struct render_skin){.mesh = &film->meshes[i],
                                              .active = sim->triangle_active + b->triangle_begin,
                                              .opacity = film->opacity + b->triangle_begin,
                                              .shininess = film->shininess + b->triangle_begin};
        for (int k = 0; k < 3; k++)
            film->skins[i].colour[k] = linear_light(b->scene->colour[k]);
    }
}

enum status film_open(struct sim *sim, const struct frames_options *options, struct film **result,
                      struct error *err)
{
    struct film *film = calloc(1, sizeof *film);
    if (!film)
        return error_no_memory(err, "the film");
    film->sim = sim;
    film->meshes = array_new(sim->balloon_count, sizeof *film->meshes);
    film->skins = array_new(sim->balloon_count, sizeof *film->skins);
    film->opacity = array_new(sim->triangle_count, sizeof *film->opacity);
    film->shininess = array_new(sim->triangle_count, sizeof *film->shininess);
    enum status status = STATUS_OK;
    if (!film->meshes || !film->skins || !film->opacity || !film->shininess)
        status = error_no_memory(err, "the film");
    if (!status) {
        set_camera(&film->view, sim);
        set_skins(film);
        status = render_open(film->view.width, film->view.height, &film->render, err);
    }
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
    sim_forces(film->sim); /* for the normals where the points are now */
    sim_material(film->sim, film->opacity, film->shininess);
    enum status status = render_draw(film->render, &film->view, film->skins, film->sim->balloon_count,
                                     &film->image, err);
    return status ? status : frames_add(film->frames, &film->image, film->sim->time, err);
}

enum status film_close(struct film *film, struct error *err)
{
    if (!film)
        return STATUS_OK;
    enum status status = film->frames ? frames_close(film->frames, err) : STATUS_OK;
    if (film->render)
        render_close(film->render);
    image_clear(&film->image);
    free(film->meshes);
    free(film->skins);
    free(film->opacity);
    free(film->shininess);
    free(film);
    return status;
}
