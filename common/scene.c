#include "common/scene_checks.h"
#include "common/scene_fields.h"

#include <stdlib.h>
#include <string.h>

void scene_clear(struct scene *scene)
{
    for (size_t i = 0; i < scene->balloon_count; i++) {
        free(scene->balloons[i].mesh);
        free(scene->balloons[i].spring_by_height.profile.row);
        free(scene->balloons[i].membrane.ogden.row);
    }
    free(scene->balloons);
    free(scene->obstacles);
    free(scene->needles);
    free(scene->schedule);
    free(scene->path);
    *scene = (struct scene){0};
}

double scene_profile_at(const struct scene_profile *profile, double x)
{
    const double(*row)[2] = (const double(*)[2])profile->row;
    size_t count = profile->count;
    if (count == 0)
        return 1;
    if (x <= row[0][0])
        return row[0][1];
    for (size_t i = 1; i < count; i++)
        if (x <= row[i][0]) {
            double share = (x - row[i - 1][0]) / (row[i][0] - row[i - 1][0]);
            return row[i - 1][1] + share * (row[i][1] - row[i - 1][1]);
        }
    return row[count - 1][1];
}

static enum status check_profile(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_spring_by_height *block = &scene->balloons[number].spring_by_height;
    if (!block->on)
        return STATUS_OK;
    if (block->profile.count == 0)
        return scene_contradiction(scene, number, "spring_by_height", block->line, err,
                                   "give profile = ( (height, factor), ... )");
    for (size_t i = 1; i < block->profile.count; i++)
        if (!(block->profile.row[i][0] > block->profile.row[i - 1][0]))
            return scene_contradiction(scene, number, "spring_by_height.profile", block->line, err,
                                       "heights must rise from row to row; row %zu (%g) does not", i + 1,
                                       block->profile.row[i][0]);
    return STATUS_OK;
}

static enum status check_rip(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_rip *rip = &scene->balloons[number].rip;
    if (!rip->on)
        return STATUS_OK;
    const double *a = rip->place, *b = rip->direction;
    double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0)
        return STATUS_OK;
    return scene_contradiction(
        scene, number, "rip", rip->line, err,
        "place and direction must be two different directions from the balloon's centre, neither zero: else "
        "there is no such place on the skin");
}

/* Stable, so that of two changes at the same time the later line wins: insertion into a short list. */
static void sort_schedule(struct scene *scene)
{
    for (size_t i = 1; i < scene->schedule_count; i++)
        for (size_t j = i; j > 0 && scene->schedule[j - 1].at > scene->schedule[j].at; j--) {
            struct scene_schedule swap = scene->schedule[j];
            scene->schedule[j] = scene->schedule[j - 1];
            scene->schedule[j - 1] = swap;
        }
}

enum status scene_check(struct scene *scene, struct error *err)
{
    if (!scene->path)
        scene->path = strdup("scene");
    if (!scene->path)
        return error_no_memory(err, "the scene");
    if (scene->balloon_count == 0)
        return error_set(err, STATUS_INPUT,
                         "%s: has no balloon; give balloons = ( { mesh = \"FILE.ply\"; } );", scene->path);
    for (size_t i = 0; i < scene->balloon_count; i++) {
        if (!scene->balloons[i].mesh)
            return error_set(err, STATUS_INPUT, "%s: balloons[%zu] has no mesh; give mesh = \"FILE.ply\";",
                             scene->path, i);
        enum status status = check_profile(scene, i, err);
        if (!status)
            status = check_rip(scene, i, err);
        if (!status)
            status = scene_check_skin(scene, i, err);
        if (!status)
            status = scene_check_fracture(scene, i, err);
        if (!status)
            status = scene_check_gas(scene, i, err);
        if (!status)
            status = scene_check_places(scene, i, err);
        if (status)
            return status;
    }
    enum status status = scene_check_surroundings(scene, err);
    if (!status)
        sort_schedule(scene);
    return status;
}
