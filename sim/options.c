#include "sim/options.h"
#include "common/array.h"
#include "common/command.h"
#include "common/file.h"
#include "common/mesh.h"
#include "common/plot.h"
#include "common/threads.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_FRAMES = 256,
    OPTION_MOVIE,
    OPTION_SHEET,
    OPTION_LOG,
    OPTION_CHECKPOINT,
    OPTION_CHECKPOINT_EVERY,
    OPTION_RESUME,
    OPTION_ESTIMATE,
    OPTION_ACCURACY_COST,
    OPTION_EFFECT_COST,
    OPTION_SET,
    OPTION_THREADS,
    OPTION_HASH,
    OPTION_CHECK,
    OPTION_EXPLAIN,
    OPTION_HELP_SCENE,
    OPTION_WINDOW,
    OPTION_PLOT,
    OPTION_PIECES,
    OPTION_TURNTABLE,
    OPTION_SERIES,
    OPTION_SERIES_FORMAT,
    OPTION_SERIES_CONSTANT,
    OPTION_CACHE
};

static const struct argp_option option_table[] = {
    {"frames", OPTION_FRAMES, "DIR", 0, "Draw the frames into this folder: frame_0000.png, ...", 1},
    {"movie", OPTION_MOVIE, "FILE", 0, "Make a movie (.mp4, .webm or .gif; needs the program ffmpeg)", 1},
    {"contact-sheet", OPTION_SHEET, "FILE.png", 0, "Draw twelve moments into one picture", 1},
    {"turntable", OPTION_TURNTABLE, "N", OPTION_ARG_OPTIONAL,
     "The camera goes once round the balloons over the film; with N, over so many pictures of the last state, and "
     "these are the film",
     1},
    {"mesh-series", OPTION_SERIES, "DIR", 0,
     "Write a mesh a frame into this folder, with stretch, opacity and piece of each point, and the list that ParaView opens",
     1},
    {"mesh-series-format", OPTION_SERIES_FORMAT, "FORMAT", 0,
     "ply (default), or vtp, of which VTK and ParaView read stretch, opacity and piece", 1},
    {"mesh-series-constant", OPTION_SERIES_CONSTANT, 0, 0,
     "Number points alike in all frames: three of its own for each triangle", 1},
    {"point-cache", OPTION_CACHE, "FILE.pc2", 0,
     "Write the skin's motion for Blender's modifier Mesh Cache, and the mesh that it moves as FILE.ply", 1},
    {"log", OPTION_LOG, "FILE.tsv", 0, "Write a row of measures a frame", 1},
    {"plot", OPTION_PLOT, "FILE.png", 0,
     "Draw pressure, radius, energy and pieces over time (.png or .svg; needs the program gnuplot)", 1},
    {"estimate", OPTION_ESTIMATE, 0, 0,
     "Measure the error beside the run, and say what halving it would cost", 1},
    {"accuracy-cost", OPTION_ACCURACY_COST, "FILE", 0,
     "Instead of a run: what each integrator's accuracy costs on this scene, as a table (.tsv) or a plot with the table "
     "beside it (.png, .svg); takes about a minute",
     1},
    {"effect-cost", OPTION_EFFECT_COST, "FILE", 0,
     "Instead of a run: what each effect of this scene costs, and what the answer would be without it, likewise",
     1},
    {"checkpoint", OPTION_CHECKPOINT, "FILE", 0, "Keep the run in this file, now and then and at the end", 1},
    {"checkpoint-every", OPTION_CHECKPOINT_EVERY, "SECONDS", 0, "How often (default: 60)", 1},
    {"resume", OPTION_RESUME, "FILE", 0, "Go on with the run that is kept in this file", 1},
    {"output", 'o', "FILE", 0, "Write the skin as it is at the end (.ply, .stl or .obj)", 1},
    {"pieces", OPTION_PIECES, "FILE.tsv", 0,
     "Write a table of the pieces at the end: area, mass, centre, velocity, spin", 1},
    {"hash", OPTION_HASH, 0, 0, "Print a 64-bit hash of the final state as the last line", 1},
    {"window", OPTION_WINDOW, 0, 0,
     "Open the window also beside --log and --estimate; without any output it opens anyway", 1},
    {"set", OPTION_SET, "KEY=VALUE", OPTION_REPEATS,
     "Change a key of the scene, by its path: balloons[0].pressure=12", 2},
    {"threads", OPTION_THREADS, "N", 0,
     "How many threads work on a step (default: the machine's); results are equal to the bit", 2},
    {"check", OPTION_CHECK, 0, 0, "Read the scene and its meshes, say what is there, and stop", 3},
    {"explain", OPTION_EXPLAIN, 0, 0, "Say which effects are on or off, and why, and stop", 3},
    {"help-scene", OPTION_HELP_SCENE, 0, 0, "Print every key that a scene can have, and stop", 3},
    {"quiet", 'q', 0, 0, "No notes, no progress", 4},
    {0},
};

/* The first of some options that was given; NULL: none was. */
struct given {
    const char *name;
    bool wanted;
};

static const char *first_given(const struct given *options, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (options[i].wanted)
            return options[i].name;
    return NULL;
}

#define FIRST_GIVEN(list) first_given(list, sizeof(list) / sizeof(list)[0])

/* What only a run from the start to the end gives; --log and --estimate go with a window too. */
static const char *run_option_of(const struct options *o)
{
    const struct given given[] = {{"--frames", o->frames},
                                  {"--movie", o->movie},
                                  {"--contact-sheet", o->sheet},
                                  {"--checkpoint", o->checkpoint},
                                  {"--resume", o->resume},
                                  {"-o", o->mesh},
                                  {"--pieces", o->pieces},
                                  {"--mesh-series", o->series},
                                  {"--point-cache", o->cache},
                                  {"--hash", o->hash},
                                  {"--plot", o->plot}};
    return FIRST_GIVEN(given);
}

/* What a run, or a window, has besides. */
static const char *any_run_option_of(const struct options *o)
{
    const struct given given[] = {
        {"--log", o->log}, {"--estimate", o->estimate}, {"--threads", o->threads > 0}};
    const char *of_run = run_option_of(o);
    return of_run ? of_run : FIRST_GIVEN(given);
}

/* What takes the place of a run. */
static const char *cost_option_of(const struct options *o)
{
    const struct given given[] = {{"--accuracy-cost", o->accuracy_cost}, {"--effect-cost", o->effect_cost}};
    return FIRST_GIVEN(given);
}

static void choose_window(struct options *o, struct argp_state *state)
{
    const char *cost = cost_option_of(o), *run = run_option_of(o), *other = run ? run : cost;
    if (o->window && other)
        argp_error(state, "%s runs to the end without a window: leave one of the two out", other);
    o->window = !other && (o->window || (!o->log && !o->estimate));
}

/* What is given beside an option that takes a run's place, and will not be done. */
static void tell_idle(const struct options *o)
{
    const char *of_run = any_run_option_of(o), *cost = cost_option_of(o);
    const char *instead = o->help_scene ? "--help-scene" : o->explain && !o->check ? "--explain" : NULL;
    const char *idle = instead && !of_run ? cost : of_run;
    if (!instead)
        instead = cost;
    if (instead && idle)
        command_note("%s is for a run, whose place %s takes: it does nothing", idle, instead);
}

/* What only all of them together can tell. */
static void finish(struct options *o, struct argp_state *state)
{
    if (!o->scene && !o->help_scene)
        argp_error(state, "give a scene (.cfg) or a mesh (.ply, .stl, .obj)");
    if (o->estimate && o->resume)
        argp_error(state, "--estimate measures a run from its start: leave --resume out");
    if (o->accuracy_cost && o->effect_cost)
        argp_error(
            state,
            "--accuracy-cost and --effect-cost each take the place of a run: leave one of the two out");
    choose_window(o, state);
    tell_idle(o);
    if (o->turntable && !o->frames && !o->movie && !o->sheet)
        argp_error(state, "--turntable: give --frames DIR, --movie FILE or --contact-sheet FILE too");
    if ((o->series_vtp || o->series_constant) && !o->series)
        argp_error(state, "--mesh-series-%s: give --mesh-series DIR too",
                   o->series_vtp ? "format" : "constant");
    if (o->checkpoint_every >= 0 && !o->checkpoint)
        argp_error(state, "--checkpoint-every: give --checkpoint FILE too");
    if (o->checkpoint_every < 0)
        o->checkpoint_every = 60;
}

static const char *table_name(struct argp_state *state, const char *option, const char *argument)
{
    if (!file_has_extension(argument, "tsv") && !plot_is_file_name(argument))
        argp_error(state, "%s %s: the name must end in .tsv, .png or .svg", option, argument);
    return argument;
}

/* Options that are a name or a yes, and no more. */
static const struct {
    int key;
    size_t field; /* a const char * of struct options */
} name_options[] = {{OPTION_FRAMES, offsetof(struct options, frames)},
                    {OPTION_MOVIE, offsetof(struct options, movie)},
                    {OPTION_LOG, offsetof(struct options, log)},
                    {OPTION_CHECKPOINT, offsetof(struct options, checkpoint)},
                    {OPTION_RESUME, offsetof(struct options, resume)},
                    {OPTION_PLOT, offsetof(struct options, plot)},
                    {OPTION_SERIES, offsetof(struct options, series)},
                    {OPTION_PIECES, offsetof(struct options, pieces)}};
static const struct {
    int key;
    size_t field; /* a bool of struct options */
} flag_options[] = {{OPTION_ESTIMATE, offsetof(struct options, estimate)},
                    {OPTION_HASH, offsetof(struct options, hash)},
                    {OPTION_CHECK, offsetof(struct options, check)},
                    {OPTION_EXPLAIN, offsetof(struct options, explain)},
                    {OPTION_HELP_SCENE, offsetof(struct options, help_scene)},
                    {OPTION_SERIES_CONSTANT, offsetof(struct options, series_constant)},
                    {OPTION_WINDOW, offsetof(struct options, window)}};

static bool parse_plain(struct options *o, int key, const char *argument)
{
    for (size_t i = 0; i < sizeof name_options / sizeof name_options[0]; i++)
        if (name_options[i].key == key) {
            *(const char **)((char *)o + name_options[i].field) = argument;
            return true;
        }
    for (size_t i = 0; i < sizeof flag_options / sizeof flag_options[0]; i++)
        if (flag_options[i].key == key)
            return *(bool *)((char *)o + flag_options[i].field) = true;
    return false;
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    struct options *o = state->input;
    if (parse_plain(o, key, argument))
        return 0;
    switch (key) {
    case OPTION_SHEET:
        command_extension(state, "--contact-sheet", argument, "png");
        o->sheet = argument;
        break;
    case OPTION_TURNTABLE:
        o->turntable = true;
        if (argument)
            o->turntable_frames = command_whole(state, "--turntable", argument, 1, 1000000);
        break;
    case OPTION_CHECKPOINT_EVERY:
        o->checkpoint_every = command_number(state, "--checkpoint-every", argument, 0, 1e9);
        break;
    case OPTION_ACCURACY_COST:
        o->accuracy_cost = table_name(state, "--accuracy-cost", argument);
        break;
    case OPTION_EFFECT_COST:
        o->effect_cost = table_name(state, "--effect-cost", argument);
        break;
    case 'o':
        if (!mesh_is_file_name(argument))
            argp_error(state, "-o %s: must end in .ply, .stl or .obj", argument);
        o->mesh = argument;
        break;
    case OPTION_THREADS:
        o->threads = (unsigned)command_whole(state, "--threads", argument, 1, THREADS_MAX);
        break;
    case OPTION_SET:
        o->set[o->set_count++] = argument;
        break;
    case OPTION_SERIES_FORMAT:
        o->series_vtp = !strcmp(argument, "vtp");
        if (!o->series_vtp && strcmp(argument, "ply"))
            argp_error(state, "--mesh-series-format %s: must be ply or vtp", argument);
        break;
    case OPTION_CACHE:
        if (!file_has_extension(argument, "pc2"))
            argp_error(state, "--point-cache %s: the name must end in .pc2", argument);
        o->cache = argument;
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
        finish(o, state);
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

bool options_parse(struct options *options, int argc, char **argv)
{
    static const struct argp argp = {
        option_table,
        parse_option,
        "SCENE.cfg\nMESH",
        "Inflates the balloons of a scene, or one mesh with the paper's settings, until they burst.",
        0,
        0,
        0};
    *options = (struct options){.set = array_new((size_t)argc, sizeof *options->set), .checkpoint_every = -1};
    if (!options->set)
        return false;
    command_parse(&argp, argc, argv, options);
    return true;
}

void options_clear(struct options *options)
{
    free(options->set);
    *options = (struct options){0};
}
