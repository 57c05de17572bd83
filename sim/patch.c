#include "sim/patch.h"
#include "common/array.h"
#include "common/vec3.h"

/* The angle between a point's direction and the place, in degrees. */
static double angle_at(const struct sim *sim, const struct sim_balloon *b, uint32_t p, const double place[3])
{
    double d[3], across[3];
    vec3_sub(sim->position[p], b->centre, d);
    vec3_cross(d, place, across);
    return atan2(vec3_length(across), vec3_dot(d, place)) * 180 / M_PI;
}

enum status patch_find(struct sim *sim, const struct sim_balloon *balloon, const double place[3],
                       double reach, uint32_t **points, uint32_t *count, struct error *err)
{
    uint32_t within = 0, nearest = balloon->point_begin;
    double least = INFINITY;
    for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++) {
        const double angle = angle_at(sim, balloon, p, place);
        within += angle <= reach;
        if (angle < least) {
            least = angle;
            nearest = p;
        }
    }
    *points = array_new((size_t)within + 1, sizeof **points);
    if (!*points)
        return error_no_memory(err, "a patch of the skin");
    *count = 0;
    for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++)
        if (p == nearest || angle_at(sim, balloon, p, place) <= reach)
            (*points)[(*count)++] = p;
    sim->bytes += *count * sizeof **points;
    return STATUS_OK;
}
