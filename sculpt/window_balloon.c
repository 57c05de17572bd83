#include "sculpt/window_balloon.h"

#include "common/vec3.h"
#include "surface/surface.h"

#include <math.h>

enum { BALLOON_TRIANGLES = 4000 };

/* Few cells keep their shape, many are smoothed over more of them, so that the triangles follow. */
static double sigma_for(unsigned depth)
{
    return depth <= 5 ? 0.7 : depth == 6 ? 1 : depth == 7 ? 1.5 : 2;
}

/* Rubber that is pumped up to three times its volume and stays so: the paper's springs would go to shreds,
 * and leave an empty picture. It is so viscous that it hardly swings. */
static enum status make_scene(struct scene *scene, struct error *err)
{
    static const char *const settings[] = {
        "time.integrator=symplectic-euler", "time.guard=substep",
        "balloons[0].pressure=0",           "balloons[0].threshold=1e300",
        "balloons[0].membrane.law=gent",    "balloons[0].membrane.thickness=0.45",
        "balloons[0].membrane.viscosity=8", "balloons[0].gas.ambient=6",
        "balloons[0].gas.density=2.2e-5",   "balloons[0].gas.pump=1",
        "balloons[0].gas.pump_until=3",
    };
    enum status status = scene_from_mesh("the balloon", scene, err);
    for (size_t i = 0; i < sizeof settings / sizeof *settings && !status; i++)
        status = scene_set(scene, settings[i], err);
    return status ? status : scene_check(scene, err);
}

enum status balloon_mesh(struct balloon *balloon, const struct octree *tree, struct error *err)
{
    balloon_clear(balloon);
    struct surface_options options = surface_defaults();
    struct surface_stats stats;
    options.field.sigma = sigma_for(tree->depth);
    options.triangles = BALLOON_TRIANGLES;
    enum status status = surface_make(tree, &options, &balloon->mesh, &stats, err);
    if (status) {
        balloon_clear(balloon);
        return status;
    }
    balloon->kept = mesh_volume(&balloon->mesh) /
                    ldexp((double)octree_measure(tree).cells, -3 * (int)tree->depth);
    balloon->skin = (struct render_skin){.mesh = &balloon->mesh, /* as the simulator's at rest */
                                         .rest_opacity = 0.97f,
                                         .rest_shininess = 12,
                                         .colour = {0.69f, 0.008f, 0.013f}};
    return STATUS_OK;
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
        status = make_scene(&balloon->scene, err);
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
