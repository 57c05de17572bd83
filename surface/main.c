/* balloon-surface: from a sculpture to a balloon's mesh. */
#include "common/command.h"
#include "common/file.h"
#include "common/octree.h"
#include "common/plot.h"
#include "common/threads.h"
#include "render/render.h"
#include "surface/main_coarse.h"
#include "surface/main_cost.h"
#include "surface/main_info.h"
#include "surface/main_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum option_key {
    KEY_CUBE_SIZE = 256,
    KEY_TRIANGLES,
    KEY_PER_CUBE,
    KEY_PER_AREA,
    KEY_SIGMA,
    KEY_THRESHOLD,
    KEY_CUTOFF,
    KEY_RELAX,
    KEY_SEEDS,
    KEY_SEED,
    KEY_THREADS,
    KEY_INFO,
    KEY_JSON,
    KEY_FORCE,
    KEY_RENDER,
    KEY_COST,
};

static const struct argp_option option_list[] = {
    {"output", 'o', "FILE", 0, "Write the mesh to FILE: .ply (with normals), .stl or .obj", 0},
    {"cube-size", KEY_CUBE_SIZE, "H", 0, "Side of the marching cubes, the first cube of material having 1",
     0},
    {"triangles", KEY_TRIANGLES, "N", 0, "Choose the cube size for about N triangles", 0},
    {"fields-per-cube", KEY_PER_CUBE, "N", 0,
     "Gaussians in each finest cell: 0, 1, 8, 27, 64 ... 4096, or exact (default): infinitely many", 0},
    {"fields-per-area", KEY_PER_AREA, "A", 0,
     "Gaussians on each unit of area of material that borders on emptiness (default 0)", 0},
    {"sigma", KEY_SIGMA, "S", 0,
     "Width of the Gaussians, in sides of the finest cell (default 0.35), or of the first cube: 0.02u", 0},
    {"threshold", KEY_THRESHOLD, "T", 0, "The surface is where the field is T (default 0.5)", 0},
    {"cutoff", KEY_CUTOFF, "R", 0, "Gaussians end at R sigma (default 6)", 0},
    {"relax", KEY_RELAX, "N", 0,
     "Rounds of smoothing along the surface that make the triangles regular (default 10); 0: plain marching cubes",
     0},
    {"seeds", KEY_SEEDS, "HOW", 0, "Where following begins: descent (default) or random", 0},
    {"seed", KEY_SEED, "N", 0, "Of the random points (default 1)", 0},
    {"threads", KEY_THREADS, "N", 0, "Threads to work with (default: as many as there are processors)", 0},
    {"info", KEY_INFO, NULL, 0, "Print figures about the mesh, its parts and its triangles", 0},
    {"json", KEY_JSON, NULL, 0, "Print them as JSON", 0},
    {"force", KEY_FORCE, NULL, 0, "Go on where memory is estimated not to hold the mesh", 0},
    {"render", KEY_RENDER, "FILE.png", 0, "Draw the mesh", 0},
    {"accuracy-cost", KEY_COST, "FILE", 0,
     "Walk each dial through a ladder on this sculpture and print what accuracy costs: the table in FILE.tsv, "
     "or drawn in FILE.png or .svg",
     0},
    {"quiet", 'q', NULL, 0, "No notes, no progress", 0},
    {0},
};

struct arguments {
    const char *input, *output, *render, *cost;
    bool info, json, sigma_in_units, seed_given;
    struct surface_options options;
};

static long fields_per_cube(struct argp_state *state, const char *argument)
{
    if (strcmp(argument, "exact") == 0)
        return FIELDS_EXACT;
    char *end;
    long fields = strtol(argument, &end, 10);
    long side = lround(cbrt((double)fields));
    if (end == argument || *end || fields < 0 || side > FIELDS_SIDE_MAX || side * side * side != fields)
        argp_error(
            state,
            "--fields-per-cube %s: must be exact, 0, or a regular grid's number of points: 1, 8, 27, 64, "
            "125, 216, 343, 512 ... 4096",
            argument);
    return fields;
}

static void set_sigma(struct arguments *arguments, struct argp_state *state, const char *argument)
{
    char number[64];
    size_t length = strlen(argument);
    arguments->sigma_in_units = length && argument[length - 1] == 'u';
    if (length >= sizeof number)
        argp_error(state, "--sigma is of %zu characters; no number needs as many as %zu", length,
                   sizeof number);
    snprintf(number, sizeof number, "%.*s", (int)(length - arguments->sigma_in_units), argument);
    double least = arguments->sigma_in_units ? 1e-5 : 0.01, most = arguments->sigma_in_units ? 10 : 1000;
    const char *unit = arguments->sigma_in_units ? "u" : "";
    double sigma = 0;
    if (!number_parse(number, &sigma) || !(sigma >= least && sigma <= most))
        argp_error(state, "--sigma %s: must be a number from %g%s to %g%s", argument, least, unit, most,
                   unit);
    arguments->options.field.sigma = sigma;
}

static void set_seeds(struct arguments *arguments, struct argp_state *state, const char *argument)
{
    if (strcmp(argument, "random") == 0)
        arguments->options.seeds = SURFACE_RANDOM;
    else if (strcmp(argument, "descent") == 0)
        arguments->options.seeds = SURFACE_DESCENT;
    else
        argp_error(state, "--seeds %s: must be descent or random", argument);
}

static void set_input(struct arguments *arguments, struct argp_state *state, const char *argument)
{
    if (arguments->input)
        argp_error(state, "%s: one sculpture at a time, and %s was named before", argument, arguments->input);
    arguments->input = argument;
}

static void check_arguments(const struct arguments *arguments, struct argp_state *state)
{
    const struct surface_options *options = &arguments->options;
    if (!arguments->input)
        argp_error(state, "which sculpture? balloon-surface FILE.oct -o FILE.ply");
    if (!arguments->output && !arguments->info && !arguments->render && !arguments->cost)
        argp_error(state,
                   "nothing to do: give -o FILE.ply, --info, --render FILE.png or --accuracy-cost FILE.tsv");
    if (arguments->cost && !file_has_extension(arguments->cost, "tsv") && !plot_is_file_name(arguments->cost))
        argp_error(state, "--accuracy-cost %s: the name must end in .tsv, .png or .svg", arguments->cost);
    if (arguments->output && !file_has_extension(arguments->output, "ply") &&
        !file_has_extension(arguments->output, "stl") && !file_has_extension(arguments->output, "obj"))
        argp_error(state, "-o %s: the name must end in .ply, .stl or .obj", arguments->output);
    if (arguments->render && !file_has_extension(arguments->render, "png"))
        argp_error(state, "--render %s: the name must end in .png", arguments->render);
    if (options->cube_size > 0 && options->triangles)
        argp_error(state, "--cube-size and --triangles: give one of them, each decides the other");
    if (arguments->seed_given && options->seeds != SURFACE_RANDOM)
        command_note("--seed does nothing: there are random points with --seeds random only");
    if (options->field.fields_per_cube == 0 && options->field.fields_per_area == 0)
        argp_error(state,
                   "--fields-per-cube 0: then --fields-per-area must be above 0, or there is no field");
}

/* What decides the mesh. */
static error_t parse_dial(int key, const char *argument, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    struct surface_options *options = &arguments->options;
    switch (key) {
    case KEY_CUBE_SIZE:
        options->cube_size = command_number(state, "--cube-size", argument, 1e-6, 1e6);
        break;
    case KEY_TRIANGLES:
        options->triangles = (uint32_t)command_whole(state, "--triangles", argument, 8, 2000000000);
        break;
    case KEY_PER_CUBE:
        options->field.fields_per_cube = fields_per_cube(state, argument);
        break;
    case KEY_PER_AREA:
        options->field.fields_per_area = command_number(state, "--fields-per-area", argument, 0, 1e7);
        break;
    case KEY_SIGMA:
        set_sigma(arguments, state, argument);
        break;
    case KEY_THRESHOLD:
        options->threshold = command_number(state, "--threshold", argument, 1e-6, 1e6);
        break;
    case KEY_CUTOFF:
        options->field.cutoff = command_number(state, "--cutoff", argument, 2, 8);
        break;
    case KEY_RELAX:
        options->relax = (unsigned)command_whole(state, "--relax", argument, 0, 1000);
        break;
    case KEY_SEEDS:
        set_seeds(arguments, state, argument);
        break;
    case KEY_SEED:
        options->seed = (uint64_t)command_whole(state, "--seed", argument, 0, INT64_MAX);
        arguments->seed_given = true;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case 'o':
        arguments->output = argument;
        break;
    case 'q':
        command_set_quiet(true);
        break;
    case KEY_THREADS:
        arguments->options.threads = (unsigned)command_whole(state, "--threads", argument, 1, THREADS_MAX);
        break;
    case KEY_INFO:
        arguments->info = true;
        break;
    case KEY_JSON:
        arguments->info = arguments->json = true;
        break;
    case KEY_FORCE:
        arguments->options.force = true;
        break;
    case KEY_COST:
        arguments->cost = argument;
        break;
    case KEY_RENDER:
        arguments->render = argument;
        break;
    case ARGP_KEY_ARG:
        set_input(arguments, state, argument);
        break;
    case ARGP_KEY_END:
        check_arguments(arguments, state);
        break;
    default:
        return parse_dial(key, argument, state);
    }
    return 0;
}

/* Of work that a sculpture is put to. */
static void begin_progress(const char *what, const struct octree *tree)
{
    static char size[96];
    const size_t boxes = octree_leaf_count(tree);
    snprintf(size, sizeof size, "%zu box%s in %d cells a side", boxes, boxes == 1 ? "" : "es",
             1 << tree->depth);
    progress_begin(what, size, "%", 100);
}

static void show_progress(void *context, double done)
{
    (void)context;
    progress_update(100 * done);
}

static enum status inform(struct mesh *mesh, const struct arguments *arguments, const struct octree *tree,
                          const struct surface_stats *stats, struct error *err)
{
    struct surface_info info = {.mesh = mesh, .options = &arguments->options, .stats = stats};
    if (mesh_connect(mesh, err) || surface_measure(mesh, &info.shape, err) ||
        surface_compare(tree, info.options, mesh, &info.distance, err) ||
        surface_count(mesh, &info.shape, &info.census, err))
        return err->status;
    (arguments->json ? info_print_json : info_print_text)(&info);
    surface_census_clear(&info.census);
    return STATUS_OK;
}

static enum status report(struct mesh *mesh, const struct arguments *arguments, struct octree *tree,
                          const struct surface_stats *stats, struct error *err)
{
    if (arguments->output && mesh_save(mesh, arguments->output, err))
        return err->status;
    const struct render_skin skin = {.mesh = mesh, .colour = {0.75f, 0.03f, 0.04f}};
    if (arguments->render && render_still(&skin, arguments->render, "balloon-surface", err))
        return err->status;
    if (arguments->info && inform(mesh, arguments, tree, stats, err))
        return err->status;
    bool several = false;
    char parts[PARTS_TEXT], text[COARSE_TEXT];
    if (!arguments->info && parts_tell(mesh, arguments->input, &several, parts, err))
        return err->status;
    if (several)
        command_note("%s", parts);
    if (coarse_tell(tree, arguments->input, &arguments->options, mesh, stats->cube_size, text))
        command_note("%s", text);
    double wanted = arguments->options.triangles;
    if (wanted > 0 && fabs(mesh->triangle_count / wanted - 1) > 0.05)
        command_note("%u triangles: at no cube size tried were there %.0f; their number goes in steps",
                     mesh->triangle_count, wanted);
    return STATUS_OK;
}

/* What cannot be written is known before the work. */
static enum status check_files(const struct arguments *arguments, struct error *err)
{
    const char *cost = arguments->cost;
    char *table = cost ? plot_table_name(cost) : NULL;
    if (cost && !table)
        return error_no_memory(err, cost);
    const char *written[] = {arguments->output, arguments->render, table,
                             cost && plot_is_file_name(cost) ? cost : NULL};
    const size_t count = sizeof written / sizeof *written;
    enum status status = file_check_clash(&arguments->input, 1, written, count, err);
    for (size_t i = 0; i < count && !status; i++)
        status = written[i] ? file_out_check(written[i], err) : STATUS_OK;
    free(table);
    return status;
}

/* Where gnuplot is missing the table is still printed, and the failure told at the end. */
static enum status price(const struct arguments *arguments, const struct octree *tree, struct error *err)
{
    struct cost_table table;
    begin_progress("pricing", tree);
    enum status status = surface_cost(tree, &arguments->options, &table, err);
    progress_end();
    if (status != STATUS_OK)
        return error_prefix(err, arguments->input);
    cost_print(&table, stdout);
    return cost_save(&table, arguments->input, arguments->cost, err);
}

static enum status make(struct arguments *arguments, struct octree *tree, struct error *err)
{
    struct mesh mesh = {0};
    struct surface_stats stats;
    if (arguments->sigma_in_units) {
        arguments->options.field.sigma *= 1 << tree->depth;
        if (arguments->options.field.sigma < 0.01)
            return error_set(err, STATUS_RANGE, "--sigma %gu: too small for cells of %g; at least %gu",
                             arguments->options.field.sigma / (1 << tree->depth), 1.0 / (1 << tree->depth),
                             0.01 / (1 << tree->depth));
    }
    if (arguments->cost && price(arguments, tree, err))
        return err->status;
    if (!arguments->output && !arguments->info && !arguments->render)
        return STATUS_OK;
    begin_progress("meshing", tree);
    enum status status = surface_make(tree, &arguments->options, &mesh, &stats, err);
    progress_end();
    if (status != STATUS_OK)
        return error_prefix(err, arguments->input);
    status = report(&mesh, arguments, tree, &stats, err);
    mesh_clear(&mesh);
    return status;
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        option_list,
        parse,
        "FILE.oct",
        "Lays Gaussians over a sculpture and writes the surface where their sum passes a threshold as a closed "
        "mesh of triangles.",
        NULL,
        NULL,
        NULL};
    struct arguments arguments = {.options = surface_defaults()};
    struct error err = {0};
    struct octree tree = {0};
    command_begin("balloon-surface");
    arguments.options.seed = 1;
    arguments.options.progress = show_progress;
    command_parse(&argp, argc, argv, &arguments);
    enum status status = check_files(&arguments, &err);
    if (status == STATUS_OK)
        status = octree_load(arguments.input, &tree, &err);
    if (status == STATUS_OK)
        status = make(&arguments, &tree, &err);
    octree_clear(&tree);
    return status == STATUS_OK ? command_end() : command_fail(&err);
}
