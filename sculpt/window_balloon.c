#include "sculpt/window_balloon.h"

#include "common/array.h"
#include "common/vec3.h"
#include "surface/surface.h"

#include <stdlib.h>

enum { BALLOON_TRIANGLES = 4000 };

/* Few cells keep their shape, many are smoothed over more of them, so that the triangles follow. */
static double sigma_for(unsigned depth)
{
    return depth <= 5 ? 0.7 : depth == 6 ? 1 : depth == 7 ? 1.5 : 2;
}

/* Thick and glossy: light shows through a little where the film is seen straight on. */
static enum status make_film(struct balloon *balloon, struct error *err)
{
    const uint32_t count = balloon->mesh.triangle_count;
    balloon->opacity = array_new(count, sizeof *balloon->opacity);
    balloon->shininess = array_new(count, sizeof *balloon->shininess);
    if (!balloon->opacity || !balloon->shininess)
        return error_no_memory(err, "the balloon");
    for (uint32_t i = 0; i < count; i++) {
        balloon->opacity[i] = 0.94f;
        balloon->shininess[i] = 60;
    }
    balloon->skin = (struct render_skin){.mesh = &balloon->mesh,
                                         .opacity = balloon->opacity,
                                         .shininess = balloon->shininess,
                                         .colour = {0.69f, 0.008f, 0.013f}};
    return STATUS_OK;
}

enum status balloon_mesh(struct balloon *balloon, const struct octree *tree, struct error *err)
{
    balloon_clear(balloon);
    struct surface_options options = surface_defaults();
    struct surface_stats stats;
    options.field.sigma = sigma_for(tree->depth);
    options.triangles = BALLOON_TRIANGLES;
    enum status status = surface_make(tree, &options, &balloon->mesh, &stats, err);
    if (!status)
        status = make_film(balloon, err);
    if (status)
        balloon_clear(balloon);
    return status;
}

/* Where the simulator puts a mesh: its points' mean in the middle, their mean distance the scene's radius. */
static void find_place(struct balloon *balloon)
{
    const struct mesh *mesh = &balloon->mesh;
    double distance = 0;
    for (int i = 0; i < 3; i++) {
        balloon->middle[i] = 0;
        for (uint32_t p = 0; p < mesh->point_count; p++)
            balloon->middle[i] += mesh->position[p][i] / mesh->point_count;
    }
    for (uint32_t p = 0; p < mesh->point_count; p++)
        distance += vec3_distance(mesh->position[p], balloon->middle) / mesh->point_count;
    balloon->scale = balloon->scene.balloons[0].radius / distance;
}

enum status balloon_inflate(struct balloon *balloon, struct error *err)
{
    enum status status = mesh_connect(&balloon->mesh, err);
    if (!status)
        status = scene_from_mesh("the balloon", &balloon->scene, err);
    if (!status)
        status = scene_check(&balloon->scene, err);
    if (!status) {
        find_place(balloon);
        status = sim_open(&balloon->sim, &balloon->scene, &balloon->mesh, 0, err);
    }
    if (!status)
        status = skins_init(&balloon->skins, &balloon->sim, err);
    balloon->inflated = !status;
    if (status)
        balloon_clear(balloon);
    return status;
}

enum status balloon_step(struct balloon *balloon, struct error *err)
{
    return sim_step(&balloon->sim, err);
}

void balloon_clear(struct balloon *balloon)
{
    skins_clear(&balloon->skins);
    sim_clear(&balloon->sim);
    scene_clear(&balloon->scene);
    mesh_clear(&balloon->mesh);
    free(balloon->opacity);
    free(balloon->shininess);
    *balloon = (struct balloon){0};
}

const struct render_skin *balloon_skins(struct balloon *balloon, size_t *count, struct render_camera *camera)
{
    *count = balloon->mesh.triangle_count > 0;
    if (!balloon->inflated)
        return &balloon->skin;
    skins_update(&balloon->skins);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = (camera->eye[i] - balloon->middle[i]) * balloon->scale;
        camera->target[i] = (camera->target[i] - balloon->middle[i]) * balloon->scale;
    }
    camera->eye_distance *= balloon->scale;
    camera->screen_distance *= balloon->scale;
    return balloon->skins.skins;
}
