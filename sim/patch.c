#include "sim/patch.h"
#include "common/vec3.h"
#include "sim/reorder.h"

#include <stdlib.h>

/* The angle between a point's direction and the place, in degrees. */
static double angle_at(const struct sim *sim, const struct sim_balloon *b, uint32_t p, const double place[3])
{
    double d[3], across[3];
    vec3_sub(sim->position[p], b->centre, d);
    vec3_cross(d, place, across);
    return atan2(vec3_length(across), vec3_dot(d, place)) * 180 / M_PI;
}

static uint32_t nearest_to(const struct sim *sim, const struct sim_balloon *b, const double place[3])
{
    uint32_t nearest = b->point_begin;
    double least = INFINITY;
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        const double angle = angle_at(sim, b, p, place);
        if (angle < least) {
            least = angle;
            nearest = p;
        }
    }
    return nearest;
}

static void add_point(struct patch *patch, const struct sim_balloon *b, uint32_t point)
{
    const struct topology *top = b->topology;
    const uint32_t name = reorder_name(b, point), of = patch->member[top ? top->family[name] : name];
    if (of == MESH_NONE)
        return;
    patch->point[patch->count] = point;
    patch->of[patch->count++] = of;
}

static void find_points(struct patch *patch, const struct sim_balloon *b)
{
    patch->count = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        add_point(patch, b, p);
}

enum status patch_open(struct sim *sim, const struct sim_balloon *balloon, const double place[3],
                       double reach, const char *what, struct patch *patch, struct error *err)
{
    const uint32_t nearest = nearest_to(sim, balloon, place),
                   points = balloon->point_end - balloon->point_begin;
    patch->member = sim_table(sim, points, sizeof *patch->member);
    if (!patch->member)
        return error_no_memory(err, what);
    for (uint32_t p = 0; p < points; p++) {
        const uint32_t point = balloon->point_begin + p;
        const bool within = point == nearest || angle_at(sim, balloon, point, place) <= reach;
        patch->member[p] = within ? patch->first++ : MESH_NONE;
    }
    const uint32_t room = patch->first + balloon->point_room - balloon->point_end;
    patch->point = sim_table(sim, room, sizeof *patch->point);
    patch->of = sim_table(sim, room, sizeof *patch->of);
    patch->mass = sim_table(sim, patch->first, sizeof *patch->mass);
    if (!patch->point || !patch->of || !patch->mass)
        return error_no_memory(err, what);
    find_points(patch, balloon);
    for (uint32_t k = 0; k < patch->first; k++)
        patch->mass[k] = sim->mass[patch->point[k]];
    return STATUS_OK;
}

void patch_clear(struct patch *patch)
{
    free(patch->point);
    free(patch->of);
    free(patch->member);
    free(patch->mass);
    *patch = (struct patch){0};
}

void patch_copied(struct patch *patch, const struct sim_balloon *balloon, uint32_t copy)
{
    add_point(patch, balloon, copy);
}

void patch_reorder(struct patch *patch, const struct sim_balloon *balloon)
{
    find_points(patch, balloon);
}
