/* balloon-sim: inflates the balloons of a scene until they burst. */
#include "common/array.h"
#include "common/command.h"
#include "common/file.h"
#include "common/threads.h"
#include "sim/film.h"
#include "sim/sim.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct options {
    const char *scene;
    const char **set; /* [set_count] KEY=VALUE, in order */
    size_t set_count;
    const char *frames, *movie, *sheet, *log, *mesh;
    unsigned threads; /* 0: as many as the machine has */
    bool hash, check, explain, help_scene;
};

enum {
    OPTION_FRAMES = 256,
    OPTION_MOVIE,
    OPTION_SHEET,
    OPTION_LOG,
    OPTION_SET,
    OPTION_THREADS,
    OPTION_HASH,
    OPTION_CHECK,
    OPTION_EXPLAIN,
    OPTION_HELP_SCENE
};

static const struct argp_option option_table[] = {
    {"frames", OPTION_FRAMES, "DIR", 0, "Draw the frames into this folder: frame_0000.png, ...", 1},
    {"movie", OPTION_MOVIE, "FILE", 0, "Make a movie (.mp4, .webm or .gif; needs the program ffmpeg)", 1},
    {"contact-sheet", OPTION_SHEET, "FILE.png", 0, "Draw twelve moments into one picture", 1},
    {"log", OPTION_LOG, "FILE.tsv", 0, "Write a row of measures a frame", 1},
    {"output", 'o', "FILE", 0, "Write the skin as it is at the end (.ply, .stl or .obj)", 1},
    {"hash", OPTION_HASH, 0, 0, "Print a 64-bit hash of the final state as the last line", 1},
    {"set", OPTION_SET, "KEY=VALUE", 0, "Change a key of the scene, by its path: balloons[0].pressure=12", 2},
    {"threads", OPTION_THREADS, "N", 0,
     "How many threads work on a step (default: the machine's); results are equal to the bit", 2},
    {"check", OPTION_CHECK, 0, 0, "Read the scene and its meshes, say what is there, and stop", 3},
    {"explain", OPTION_EXPLAIN, 0, 0, "Say which effects are on or off, and why, and stop", 3},
    {"help-scene", OPTION_HELP_SCENE, 0, 0, "Print every key that a scene can have, and stop", 3},
    {"quiet", 'q', 0, 0, "No notes, no progress", 4},
    {0},
};

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case OPTION_FRAMES:
        o->frames = argument;
        break;
    case OPTION_MOVIE:
        o->movie = argument;
        break;
    case OPTION_SHEET:
        o->sheet = argument;
        break;
    case OPTION_LOG:
        o->log = argument;
        break;
    case 'o':
        if (!mesh_is_file_name(argument))
            argp_error(state, "-o %s: must end in .ply, .stl or .obj", argument);
        o->mesh = argument;
        break;
    case OPTION_THREADS:
        o->threads = (unsigned)command_whole(state, "--threads", argument, 1, THREADS_MAX);
        break;
    case OPTION_HASH:
        o->hash = true;
        break;
    case OPTION_SET:
        o->set[o->set_count++] = argument;
        break;
    case OPTION_CHECK:
        o->check = true;
        break;
    case OPTION_EXPLAIN:
        o->explain = true;
        break;
    case OPTION_HELP_SCENE:
        o->help_scene = true;
        break;
    case 'q':
        command_set_quiet(true);
        break;
    case ARGP_KEY_ARG:
        if (o->scene)
            argp_error(state, "%s: one scene or mesh at a time", argument);
        o->scene = argument;
        break;
    case ARGP_KEY_END:
        if (!o->scene && !o->help_scene)
            argp_error(state, "give a scene (.cfg) or a mesh (.ply, .stl, .obj)");
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static enum status load_scene(const struct options *options, struct scene *scene, struct error *err)
{
    enum status status = mesh_is_file_name(options->scene) ? scene_from_mesh(options->scene, scene, err)
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

static enum status open_sim(struct sim *sim, const struct scene *scene, const struct options *options,
                            struct error *err)
{
    struct mesh *meshes = calloc(scene->balloon_count, sizeof *meshes);
    struct mesh_report *reports = calloc(scene->balloon_count, sizeof *reports);
    enum status status = meshes && reports ? sim_load_meshes(scene, meshes, reports, err)
                                           : error_no_memory(err, "the meshes");
    if (!status) {
        note_repairs(scene, reports);
        status = sim_open(sim, scene, meshes, options->threads, err);
    }
    for (size_t i = 0; meshes && i < scene->balloon_count; i++)
        mesh_clear(&meshes[i]);
    free(meshes);
    free(reports);
    return status;
}

static void print_check(const struct sim *sim)
{
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct sim_balloon *b = &sim->balloons[i];
        printf("balloons[%zu]: %s: %u points, %u edges, %u triangles, mean radius %.6g, mean edge %.6g\n", i,
               b->scene->mesh, b->point_end - b->point_begin, b->edge_end - b->edge_begin,
               b->triangle_end - b->triangle_begin, b->radius, b->mean_rest_length);
        const double stable = sim_stable_step(sim, b);
        if (stable > 0)
            printf("balloons[%zu]: steps up to %.4g are surely stable; time.step is %g\n", i, stable,
                   sim->step);
    }
    const struct integrator *method = sim->integrator;
    printf("%s: good: %zu bytes, %.0f steps of %s (order %d; %s)\n", sim->scene->path, sim->bytes,
           sim->scene->time.end / sim->step, method->name, method->order, method->source);
}

static void print_effects(const struct scene *scene)
{
    for (const struct effect *const *effect = effects; *effect; effect++) {
        size_t wanted = 0;
        for (size_t i = 0; i < scene->balloon_count; i++)
            wanted += (*effect)->wanted(&scene->balloons[i]);
        if (wanted)
            printf("on\t%s\t%zu of %zu balloons have the block (%s)\n", (*effect)->name, wanted,
                   scene->balloon_count, (*effect)->source);
        else
            printf("off\t%s\tno balloon has the block\n", (*effect)->name);
    }
}

/* What becomes of the states: pictures, and rows in the log. */
struct outputs {
    struct film *film;
    struct sim_log *log;
    double next; /* number of the next frame, in frames of view.rate */
};

static enum status show_state(struct outputs *outputs, struct sim *sim, struct error *err)
{
    const double number = sim->time * sim->scene->view.rate + 1e-6; /* rounding must not put a frame off */
    if (number < outputs->next)
        return STATUS_OK;
    outputs->next = floor(number) + 1;
    if (outputs->log)
        sim_log_row(outputs->log, sim);
    return outputs->film ? film_frame(outputs->film, err) : STATUS_OK;
}

/* Steps to the end. *first_break becomes the time at which the first edge broke; it stays as it was when none did. */
static enum status run(struct sim *sim, struct outputs *outputs, double *first_break, struct error *err)
{
    const double end = sim->scene->time.end;
    enum status status = show_state(outputs, sim, err);
    const double steps = end / sim->step;
    progress_begin("inflating", "steps", steps);
    while (!status && sim->time + sim->step / 2 < end) {
        status = sim_step(sim, err);
        if (!status)
            status = show_state(outputs, sim, err);
        if (sim->broken && *first_break < 0)
            *first_break = sim->time;
        progress_update(sim->time / end * steps);
    }
    progress_end();
    return status;
}

static enum status open_outputs(struct outputs *outputs, const struct options *options, struct sim *sim,
                                struct error *err)
{
    if (options->log) {
        enum status status = sim_log_open(options->log, &outputs->log, err);
        if (status)
            return status;
    }
    if (!options->frames && !options->movie && !options->sheet)
        return STATUS_OK;
    struct frames_options frames = {.folder = options->frames,
                                    .movie = options->movie,
                                    .sheet = options->sheet,
                                    .rate = sim->scene->view.playback};
    return film_open(sim, &frames, &outputs->film, err);
}

/* A run that diverged keeps what it has shown so far; any other failure leaves the old log. */
static enum status close_outputs(struct outputs *outputs, enum status status, struct error *err)
{
    const bool keep = !status || status == STATUS_DIVERGED;
    struct error other = {0};
    enum status closed = film_close(outputs->film, &other);
    if (!keep)
        sim_log_abandon(outputs->log);
    else if (sim_log_close(outputs->log, closed ? NULL : &other) && !closed)
        closed = other.status;
    if (status || !closed)
        return status;
    *err = other;
    return closed;
}

static enum status save_skin(const struct sim *sim, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    struct mesh_report report;
    enum status status = sim_skin(sim, &mesh, err);
    if (!status && mesh.triangle_count == 0)
        status = error_set(err, STATUS_INPUT, "%s: no skin is left to be written", path);
    if (!status)
        status = mesh_repair(&mesh, &report, err);
    if (!status)
        status = mesh_save(&mesh, path, err);
    mesh_clear(&mesh);
    return status;
}

static void print_summary(struct sim *sim, double first_break)
{
    const struct sim_measures m = sim_measure(sim);
    printf("%g s in %" PRIu64 " steps: %u of %u edges and %u of %u triangles are left, in %u pieces; ",
           sim->time, sim->steps, m.edges_active, sim->edge_count, m.triangles_active, sim->triangle_count,
           m.pieces);
    if (first_break < 0)
        printf("nothing broke\n");
    else
        printf("the first edge broke at %g s\n", first_break);
}

static enum status simulate(const struct options *options, struct sim *sim, struct error *err)
{
    struct outputs outputs = {0};
    double first_break = -1;
    enum status status = open_outputs(&outputs, options, sim, err);
    if (!status)
        status = run(sim, &outputs, &first_break, err);
    status = close_outputs(&outputs, status, err);
    if (!status && options->mesh)
        status = save_skin(sim, options->mesh, err);
    if (status)
        return status;
    print_summary(sim, first_break);
    if (options->hash)
        printf("%016" PRIx64 "\n", sim_hash(sim));
    return STATUS_OK;
}

static enum status perform(const struct options *options, struct error *err)
{
    struct scene scene = {0};
    struct sim sim = {0};
    enum status status = load_scene(options, &scene, err);
    if (!status && !options->explain)
        status = open_sim(&sim, &scene, options, err);
    if (!status && options->explain)
        print_effects(&scene);
    else if (!status && options->check)
        print_check(&sim);
    else if (!status)
        status = simulate(options, &sim, err);
    sim_clear(&sim);
    scene_clear(&scene);
    return status;
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        option_table,
        parse_option,
        "SCENE.cfg\nMESH",
        "Inflates the balloons of a scene, or one mesh with the paper's settings, until they burst.",
        0,
        0,
        0};
    struct options options = {.set = array_new((size_t)argc, sizeof *options.set)};
    struct error err = {0};
    command_begin("balloon-sim");
    if (!options.set)
        return command_fail(&(struct error){.status = STATUS_NO_MEMORY});
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    enum status status = STATUS_OK;
    if (options.help_scene)
        scene_write_help(stdout);
    else
        status = perform(&options, &err);
    free(options.set);
    return status ? command_fail(&err) : command_end();
}
