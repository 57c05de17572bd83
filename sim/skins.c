#include "sim/skins.h"

#include "common/array.h"
#include "common/vec3.h"
#include "sim/material.h"
#include "sim/measure.h"
#include "sim/props.h"

#include <stdlib.h>
#include <string.h>

/* How far below the middle the floor lies, in radii of the ball around all points at rest: legs reach further
 * down than the first, and swollen skin about to the second. */
static const double floor_least = 0.6, floor_most = 1.8;

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
                                           .shininess = skins->shininess + b->triangle_begin,
                                           .stretch = skins->stretch + b->triangle_begin,
                                           .rest_opacity = (float)b->scene->opacity,
                                           .rest_shininess = (float)b->scene->shininess};
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
    skins->stretch = array_new(sim->triangle_count, sizeof *skins->stretch);
    skins->position = array_new(sim->point_count, sizeof *skins->position);
    skins->normal = array_new(sim->point_count, sizeof *skins->normal);
    skins->lines = array_new(props_room(sim) + 1, sizeof *skins->lines);
    if (!skins->lines || !skins->meshes || !skins->skins || !skins->position || !skins->normal ||
        !skins->opacity || !skins->shininess || !skins->stretch) {
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
    free(skins->stretch);
    free(skins->lines);
    *skins = (struct skins){0};
}

static float area_stretch(const struct sim *sim, uint32_t t)
{
    const double rest = sim_rest_area(sim, t), area = sim_area(sim, t);
    return rest > 0 && isfinite(area) ? (float)fmin(area / rest, 1e6) : 1;
}

/* Adds a triangle's normal to its corners', each by sin(angle)/(product of the two sides there): with these
 * weights points of a sphere get its very normals, however irregular the triangles are, which is what keeps
 * the edges of highlights smooth (Max, "Weights for computing vertex normals from facet normals", 1999). */
static void add_normal(struct skins *skins, uint32_t t)
{
    const uint32_t *p = skins->sim->triangle_point[t];
    double side[3][3], square[3], twice[3];
    for (int k = 0; k < 3; k++) {
        vec3_sub(skins->position[p[(k + 1) % 3]], skins->position[p[k]], side[k]);
        square[k] = vec3_dot(side[k], side[k]);
    }
    vec3_cross(side[0], side[1], twice);
    for (int k = 0; k < 3; k++) {
        const double both = square[k] * square[(k + 2) % 3], weight = both > 0 ? 1 / both : 0;
        for (int i = 0; i < 3; i++)
            skins->normal[p[k]][i] += weight * twice[i];
    }
}

static void find_normals(struct skins *skins)
{
    const struct sim *sim = skins->sim;
    memset(skins->normal, 0, sim->point_count * sizeof *skins->normal);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        if (sim->triangle_active[t])
            add_normal(skins, t);
    for (uint32_t p = 0; p < sim->point_count; p++)
        vec3_unit(skins->normal[p]);
}

void skins_update(struct skins *skins)
{
    const struct sim *sim = skins->sim;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            for (int i = 0; i < 3; i++)
                skins->position[p][i] = sim->position[p][i];
    find_normals(skins);
    sim_material(skins->sim, skins->opacity, skins->shininess);
    skins->lowest = INFINITY;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        skins->stretch[t] = area_stretch(sim, t);
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            skins->lowest = fmin(skins->lowest, sim->position[sim->triangle_point[t][k]][1]);
    }
}

struct render_scene skins_scene(struct skins *skins, const struct render_view *view)
{
    skins->line_count = props_draw(skins->sim, view, skins->lines);
    return (struct render_scene){.skins = skins->skins,
                                 .skin_count = skins->sim->balloon_count,
                                 .lines = skins->lines,
                                 .line_count = skins->line_count};
}

void skins_floor(const struct skins *skins, const double ball[4], struct render_view *view)
{
    const struct scene_ground *ground = &skins->sim->scene->ground;
    const bool level = ground->on && ground->normal[0] == 0 && ground->normal[2] == 0 &&
                       ground->normal[1] > 0;
    const double below = fmin(fmax((ball[1] - skins->lowest) / ball[3], floor_least), floor_most);
    view->floor = true;
    view->floor_height = level ? ground->height : fmin(ball[1] - below * ball[3], props_foot(skins->sim));
}

enum render_order skins_order(enum scene_order order)
{
    static const enum render_order orders[] = {[SCENE_ORDER_NONE] = RENDER_NONE,
                                               [SCENE_ORDER_SORT] = RENDER_SORT,
                                               [SCENE_ORDER_PEEL] = RENDER_PEEL,
                                               [SCENE_ORDER_LIST] = RENDER_LIST};
    return orders[order];
}

void skins_view(const struct scene_view *scene, struct render_view *view)
{
    static const enum render_stereo stereo[] = {
        [SCENE_MONO] = RENDER_MONO,         [SCENE_PARALLEL] = RENDER_PARALLEL,
        [SCENE_CROSSED] = RENDER_CROSSED,   [SCENE_OVER_UNDER] = RENDER_OVER_UNDER,
        [SCENE_RED_CYAN] = RENDER_RED_CYAN, [SCENE_INTERLACED] = RENDER_INTERLACED,
        [SCENE_QUAD] = RENDER_PARALLEL,     [SCENE_LEFT] = RENDER_LEFT,
        [SCENE_RIGHT] = RENDER_RIGHT,       [SCENE_SEPARATE] = RENDER_PARALLEL,
    };
    view->width = scene->size[0];
    view->height = scene->size[1];
    view->stereo = stereo[scene->stereo];
    view->squeezed = scene->squeezed == 1;
    view->style = scene->style == SCENE_LATEX ? RENDER_LATEX : RENDER_PAPER;
    view->order = skins_order(scene->order);
    view->samples = scene->samples;
}

/* The scene measures in radii of the ball around all points at rest. */
void skins_camera(const struct sim *sim, const double centre[3], double radius, struct render_view *view)
{
    const struct scene_view *scene = &sim->scene->view;
    struct render_camera *camera = &view->camera;
    const double *from = scene->camera;
    const bool above = fabs(from[1]) > 1e3 * hypot(from[0], from[2]); /* or below: away is up */
    for (int i = 0; i < 3; i++) {
        camera->target[i] = centre[i] + radius * scene->target[i];
        camera->eye[i] = camera->target[i] + radius * from[i];
        camera->up[i] = above ? -(i == 2) : i == 1;
    }
    camera->field_of_view_deg = scene->field_of_view;
    camera->screen_distance = vec3_distance(camera->eye, camera->target);
    camera->eye_distance = scene->eye_distance * camera->screen_distance;
    skins_view(scene, view);
    view->outlines = RENDER_SAMPLED;
}

double skins_ball(const struct sim *sim, double centre[3])
{
    double radius = 0;
    const struct sim_balloon *end = sim->balloons + sim->balloon_count;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        uint32_t count = 0;
        for (const struct sim_balloon *b = sim->balloons; b < end; b++) {
            for (uint32_t p = b->point_begin; p < b->point_end; p++)
                sum += sim->position[p][i];
            count += b->point_end - b->point_begin;
        }
        centre[i] = sum / count;
    }
    for (const struct sim_balloon *b = sim->balloons; b < end; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            radius = fmax(radius, vec3_distance(sim->position[p], centre));
    return radius;
}
