#include "sim/skins.h"

#include "common/array.h"
#include "common/vec3.h"

#include <stdlib.h>

/* IEC 61966-2-1. */
static float linear_light(double srgb)
{
    return (float)(srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4));
}

static void look_into(struct skins *skins, size_t i)
{
    const struct sim *sim = skins->sim;
    const struct sim_balloon *b = &sim->balloons[i];
    skins->meshes[i] = (struct mesh){.point_count = sim->point_count,
                                     .position = skins->position,
                                     .normal = skins->normal,
                                     .triangle_count = b->triangle_end - b->triangle_begin,
                                     .triangle = sim->triangle_point + b->triangle_begin};
    skins->skins[i] = (struct render_skin){.mesh = &skins->meshes[i],
                                           .active = sim->triangle_active + b->triangle_begin,
                                           .opacity = skins->opacity + b->triangle_begin,
                                           .shininess = skins->shininess + b->triangle_begin};
    for (int k = 0; k < 3; k++)
        skins->skins[i].colour[k] = linear_light(b->scene->colour[k]);
}

enum status skins_init(struct skins *skins, struct sim *sim, struct error *err)
{
    *skins = (struct skins){.sim = sim};
    skins->meshes = array_new(sim->balloon_count, sizeof *skins->meshes);
    skins->skins = array_new(sim->balloon_count, sizeof *skins->skins);
    skins->opacity = array_new(sim->triangle_count, sizeof *skins->opacity);
    skins->shininess = array_new(sim->triangle_count, sizeof *skins->shininess);
    skins->position = array_new(sim->point_count, sizeof *skins->position);
    skins->normal = array_new(sim->point_count, sizeof *skins->normal);
    if (!skins->meshes || !skins->skins || !skins->position || !skins->normal || !skins->opacity ||
        !skins->shininess) {
        skins_clear(skins);
        return error_no_memory(err, "the skins");
    }
    for (size_t i = 0; i < sim->balloon_count; i++)
        look_into(skins, i);
    return STATUS_OK;
}

void skins_clear(struct skins *skins)
{
    free(skins->meshes);
    free(skins->skins);
    free(skins->position);
    free(skins->normal);
    free(skins->opacity);
    free(skins->shininess);
    *skins = (struct skins){0};
}

void skins_update(struct skins *skins)
{
    const struct sim *sim = skins->sim;
    sim_forces(skins->sim); /* for the normals where the points are now */
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++) {
            skins->position[p][i] = sim->position[p][i];
            skins->normal[p][i] = sim->normal[p][i];
        }
    sim_material(skins->sim, skins->opacity, skins->shininess);
}

double skins_ball(const struct sim *sim, double centre[3])
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
