/* balloon-sim: inflates the balloons of a scene until they burst. */
#include "common/command.h"
#include "sim/clash.h"
#include "sim/explain.h"
#include "sim/guard.h"
#include "sim/price.h"
#include "sim/price_effects.h"
#include "sim/run.h"
#include "sim/window.h"

#include <math.h>
#include <stdlib.h>

static enum status load_scene(const struct options *options, struct scene *scene, struct error *err)
{
    enum status status = mesh_is_readable_name(options->scene) ? scene_from_mesh(options->scene, scene, err)
                                                               : scene_load(options->scene, scene, err);
    for (size_t i = 0; i < options->set_count && !status; i++)
        status = scene_set(scene, options->set[i], err);
    return status ? status : scene_check(scene, err);
}

static void note_repairs(const struct scene *scene, const struct mesh_report *reports)
{
    char text[512];
    for (size_t i = 0; i < scene->balloon_count; i++) {
        if (*mesh_report_repairs(&reports[i], text, sizeof text))
            command_note("%s: %s", scene->balloons[i].mesh, text);
        if (reports[i].volume < 0)
            command_note("%s: was inside out; its triangles were turned", scene->balloons[i].mesh);
        if (reports[i].pinched_points)
            command_note("%s: %zu points join sheets that touch there only", scene->balloons[i].mesh,
                         reports[i].pinched_points);
    }
}

static void note(const char *text, void *context)
{
    (void)context;
    command_note("%s", text);
}

/* Whether the boxes around two balloons share room. */
static bool overlap(const struct sim *sim, const struct sim_balloon *a, const struct sim_balloon *b)
{
    for (int i = 0; i < 3; i++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        const struct sim_balloon *both[] = {a, b};
        for (int n = 0; n < 2; n++)
            for (uint32_t p = both[n]->point_begin; p < both[n]->point_end; p++) {
                low[n] = fmin(low[n], sim->position[p][i]);
                high[n] = fmax(high[n], sim->position[p][i]);
            }
        if (low[0] >= high[1] || low[1] >= high[0])
            return false;
    }
    return true;
}

/* Once: with contact they would not be let begin so. */
static void note_overlap(const struct sim *sim)
{
    for (size_t i = 0; i < sim->balloon_count && !sim->scene->contact.on; i++)
        for (size_t k = 0; k < i; k++)
            if (overlap(sim, &sim->balloons[k], &sim->balloons[i])) {
                command_note(
                    "balloons[%zu] and balloons[%zu] begin in one another's room, and pass through each "
                    "other: move them apart, and give contact = { };",
                    k, i);
                return;
            }
}

/* *meshes becomes [balloon_count], also on failure; NULL when there is no memory. */
static enum status load_meshes(const struct scene *scene, struct mesh **meshes, struct error *err)
{
    struct mesh_report *reports = calloc(scene->balloon_count, sizeof *reports);
    *meshes = calloc(scene->balloon_count, sizeof **meshes);
    enum status status = *meshes && reports ? sim_load_meshes(scene, *meshes, reports, err)
                                            : error_no_memory(err, "the meshes");
    if (!status)
        note_repairs(scene, reports);
    free(reports);
    return status;
}

static void free_meshes(const struct scene *scene, struct mesh *meshes)
{
    for (size_t i = 0; meshes && i < scene->balloon_count; i++)
        mesh_clear(&meshes[i]);
    free(meshes);
}

static enum status check(const struct options *options, struct sim *sim, struct error *err)
{
    enum status status = run_check(options, sim, err);
    if (status)
        return status;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct sim_balloon *b = &sim->balloons[i];
        printf("balloons[%zu]: %s: %u points, %u edges, %u triangles, mean radius %.6g, mean edge %.6g\n", i,
               b->scene->mesh, b->point_end - b->point_begin, b->edge_end - b->edge_begin,
               b->triangle_end - b->triangle_begin, b->radius, b->mean_rest_length);
    }
    char guard[256];
    guard_describe(sim, guard, sizeof guard);
    printf("%s: %s\n", sim->scene->path, guard);
    const struct integrator *method = sim->integrator;
    printf("%s: good: %zu bytes, %.0f steps of %s (order %d; %s)\n", sim->scene->path, sim->bytes,
           sim->scene->time.end / sim->step, method->name, method->order, method->source);
    return STATUS_OK;
}

/* Checks or runs a scene, whose meshes are no longer needed once the sim is open, and are freed. */
static enum status simulate(const struct options *options, const struct scene *scene, struct mesh **meshes,
                            struct error *err)
{
    struct sim sim = {0};
    struct estimate *estimate = NULL;
    enum status status = sim_open(&sim, scene, *meshes, options->threads, err);
    if (!status && options->estimate && !options->check && !options->explain)
        status = estimate_open(&sim, *meshes, options->threads, &estimate, err);
    free_meshes(scene, *meshes);
    *meshes = NULL;
    if (!status)
        note_overlap(&sim);
    if (!status && options->explain)
        explain_bursts(&sim, stdout);
    else if (!status && options->check)
        status = check(options, &sim, err);
    else if (!status && options->window)
        status = sim_window(&(struct sim_window_options){options->log, WINDOW_PAST_BYTES}, &sim, estimate,
                            err);
    else if (!status)
        status = run(options, &sim, estimate, err);
    estimate_close(estimate);
    sim_clear(&sim);
    return status;
}

static enum status perform(const struct options *options, struct error *err)
{
    struct scene scene = {0};
    struct mesh *meshes = NULL;
    enum status status = load_scene(options, &scene, err);
    if (!status)
        status = clash_check(options, &scene, err);
    if (!status && options->explain)
        explain_effects(&scene, stdout);
    if (!status)
        status = load_meshes(&scene, &meshes, err);
    if (!status) {
        scene_tell_idle(&scene, note, NULL);
        const bool only_told = options->check || options->explain;
        if (options->accuracy_cost && !only_told)
            status = price_accuracy(&scene, meshes, options->accuracy_cost, err);
        else if (options->effect_cost && !only_told)
            status = price_effects(&scene, meshes, options->effect_cost, err);
        else
            status = simulate(options, &scene, &meshes, err);
    }
    free_meshes(&scene, meshes);
    scene_clear(&scene);
    return status;
}

int main(int argc, char **argv)
{
    struct options options;
    struct error err = {0};
    command_begin("balloon-sim");
    command_keep_memory();
    if (!options_parse(&options, argc, argv))
        return command_fail(&(struct error){.status = STATUS_NO_MEMORY});
    enum status status = STATUS_OK;
    if (options.help_scene)
        scene_write_help(stdout);
    else
        status = perform(&options, &err);
    options_clear(&options);
    return status ? command_fail(&err) : command_end();
}
