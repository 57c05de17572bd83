/* balloon-sculpt: carve a sculpture in an octree. */
#include "common/array.h"
#include "common/command.h"
#include "common/file.h"
#include "render/render.h"
#include "sculpt/info.h"
#include "sculpt/sculpt.h"

#include <stdlib.h>
#include <string.h>

enum {
    DEPTH_DEFAULT = 6,
};

enum option_key {
    OPTION_SCRIPT = 256,
    OPTION_IMPORT,
    OPTION_EXPORT,
    OPTION_RENDER,
    OPTION_INFO,
    OPTION_DEPTH,
    OPTION_SOLID,
};

static const struct argp_option option_list[] = {
    {"script", OPTION_SCRIPT, "FILE.chips", 0, "carve what the script says", 0},
    {"import", OPTION_IMPORT, "FILE.vox", 0, "begin with a MagicaVoxel model", 0},
    {"depth", OPTION_DEPTH, "N", 0, "a new cube has 2^N cells a side, N from 0 to 10 (6)", 0},
    {"solid", OPTION_SOLID, NULL, 0, "fill the hollows of what is begun with", 0},
    {"output", 'o', "FILE.oct", 0, "save the sculpture", 0},
    {"export", OPTION_EXPORT, "FILE", 0,
     "write .vox (MagicaVoxel), .ply (the faces of the cubes) or .chips (a script); may be repeated", 0},
    {"render", OPTION_RENDER, "FILE.png", 0, "draw the sculpture", 0},
    {"info", OPTION_INFO, NULL, 0, "print its figures", 0},
    {"quiet", 'q', NULL, 0, "no notes and no progress", 0},
    {0},
};

struct options {
    const char *file, *script, *import, *output, *picture;
    const char **exports;
    size_t export_count;
    long depth; /* -1: not given */
    bool info, solid;
};

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    case OPTION_SCRIPT:
        options->script = argument;
        return 0;
    case OPTION_IMPORT:
        options->import = argument;
        return 0;
    case OPTION_EXPORT:
        options->exports[options->export_count++] = argument;
        return 0;
    case OPTION_RENDER:
        options->picture = argument;
        return 0;
    case OPTION_INFO:
        options->info = true;
        return 0;
    case OPTION_SOLID:
        options->solid = true;
        return 0;
    case OPTION_DEPTH:
        options->depth = command_whole(state, "--depth", argument, 0, OCTREE_DEPTH_MAX);
        return 0;
    case 'o':
        options->output = argument;
        return 0;
    case 'q':
        command_set_quiet(true);
        return 0;
    case ARGP_KEY_ARG:
        if (options->file)
            argp_error(state, "%s: one FILE.oct is carved at a time, and %s comes before it", argument,
                       options->file);
        options->file = argument;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static enum status save_faces(const struct octree *tree, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    enum status status = sculpt_faces(tree, &mesh, err);
    if (status)
        error_prefix(err, path);
    else
        status = mesh_save(&mesh, path, err);
    mesh_clear(&mesh);
    return status;
}

static const struct {
    const char *extension;
    enum status (*save)(const struct octree *tree, const char *path, struct error *err);
} exporters[] = {{"vox", vox_save}, {"ply", save_faces}, {"chips", chips_save}};

enum { EXPORTERS = sizeof exporters / sizeof *exporters };

static int exporter_of(const char *path)
{
    for (int i = 0; i < EXPORTERS; i++)
        if (file_has_extension(path, exporters[i].extension))
            return i;
    return -1;
}

/* What argp cannot see: options that contradict each other, and names that say nothing is possible. */
static enum status check_options(const struct options *options, struct error *err)
{
    if (options->import && options->file)
        return error_set(err, STATUS_USAGE, "--import %s and %s: give one of them to begin with",
                         options->import, options->file);
    if (options->import && !file_has_extension(options->import, "vox"))
        return error_set(err, STATUS_USAGE, "--import %s: .vox is read", options->import);
    if (options->depth >= 0 && (options->import || options->file))
        return error_set(err, STATUS_USAGE, "--depth %ld: %s has its own; give --depth for a new cube only",
                         options->depth, options->import ? options->import : options->file);
    for (size_t i = 0; i < options->export_count; i++)
        if (exporter_of(options->exports[i]) < 0)
            return error_set(err, STATUS_USAGE, "--export %s: .vox, .ply and .chips are written",
                             options->exports[i]);
    if (options->solid && !options->import && !options->file)
        return error_set(err, STATUS_USAGE, "--solid: a new cube has no hollows; give FILE.oct or --import");
    bool asks = options->output || options->export_count || options->picture || options->info;
    if (!asks && (options->script || options->import || options->depth >= 0))
        return error_set(err, STATUS_USAGE,
                         "nothing is done with the sculpture: give -o, --export, --render or --info");
    if (!asks)
        return error_set(err, STATUS_RESOURCE,
                         "there is no window to carve in: carve with --script FILE.chips, look with --render "
                         "FILE.png (see --help)");
    return STATUS_OK;
}

/* A script that goes on with a sculpture cannot say what that was in the beginning. */
static enum status check_script(const struct options *options, const struct chips *chips,
                                const struct octree *tree, struct error *err)
{
    const char *begun = options->file ? options->file : options->import;
    if (begun && chips->start_line)
        return error_set(err, STATUS_INPUT, "%s:%d: start: %s is there to be carved; leave out one of them",
                         options->script, chips->start_line, begun);
    if (begun && chips->depth_line && (unsigned)chips->depth != tree->depth)
        return error_set(err, STATUS_INPUT, "%s:%d: depth %d: %s has depth %u; leave out the line",
                         options->script, chips->depth_line, chips->depth, begun, tree->depth);
    if (options->depth >= 0 && chips->depth_line && chips->depth != options->depth)
        return error_set(err, STATUS_INPUT, "%s:%d: depth %d, but --depth is %ld; leave out one of them",
                         options->script, chips->depth_line, chips->depth, options->depth);
    return STATUS_OK;
}

static enum status carve(const struct options *options, struct octree *tree, struct error *err)
{
    struct chips chips = {0};
    enum status status = chips_load(options->script, &chips, err);
    if (!status)
        status = check_script(options, &chips, tree, err);
    if (!status && !options->file && !options->import)
        status = chips_begin(&chips, tree->depth, tree, err);
    else if (!status)
        chips_set_coefficients(&chips, tree);
    chips.progress = progress_update;
    progress_begin("carving", "chips", (double)chips.count);
    if (!status)
        status = chips_run(tree, &chips, NULL, err);
    progress_end();
    chips_clear(&chips);
    return status;
}

/* Models are often shells, and a shell makes a balloon inside a balloon: so hollows are filled, or told of. */
static enum status fill_hollows(const struct options *options, struct octree *tree, struct error *err)
{
    uint64_t cells;
    if (!options->solid && !options->import)
        return STATUS_OK;
    enum status status = octree_fill_hollows(tree, options->solid ? info_main_material(tree) : 0, &cells,
                                             err);
    if (!status && cells > 0 && !options->solid)
        command_note("%s is hollow: %llu cells within are empty; --solid fills them", options->import,
                     (unsigned long long)cells);
    return status;
}

static enum status make(const struct options *options, struct octree *tree, struct error *err)
{
    enum status status;
    if (options->file)
        status = octree_load(options->file, tree, err);
    else if (options->import)
        status = vox_load(options->import, tree, err);
    else
        status = octree_init(tree, options->depth >= 0 ? (unsigned)options->depth : DEPTH_DEFAULT, 1, err);
    if (!status)
        status = fill_hollows(options, tree, err);
    if (!status && options->script)
        status = carve(options, tree, err);
    return status;
}

static enum status draw(const struct octree *tree, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    const struct render_skin skin = {.mesh = &mesh, .colour = {0.62f, 0.42f, 0.26f}, .facets = true};
    enum status status = sculpt_faces(tree, &mesh, err);
    status = status ? error_prefix(err, path) : render_still(&skin, path, "balloon-sculpt", err);
    mesh_clear(&mesh);
    return status;
}

static enum status hand_out(const struct options *options, const struct octree *tree, struct error *err)
{
    enum status status = STATUS_OK;
    if (options->output)
        status = octree_save(tree, options->output, err);
    for (size_t i = 0; i < options->export_count && !status; i++)
        status = exporters[exporter_of(options->exports[i])].save(tree, options->exports[i], err);
    if (!status && options->picture)
        status = draw(tree, options->picture, err);
    if (!status && options->info)
        info_print(tree, stdout);
    return status;
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        option_list,
        parse_option,
        "[FILE.oct]",
        "Carves a sculpture out of a cube of material.\v"
        "Without FILE.oct and --import a full cube is begun with. A script has a line for each chip, such as\n"
        "\n"
        "  chip sphere 0.5 0.5 0.5 0.2\n"
        "  fill capsule 0.2 0.2 0.5 0.8 0.8 0.5 0.1 0.05\n"
        "\n"
        "in a cube from 0 to 1; the manual page has them all.",
        NULL,
        NULL,
        NULL};
    struct error err = {0};
    struct octree tree = {0};
    struct options options = {.depth = -1, .exports = array_new((size_t)argc, sizeof *options.exports)};
    command_begin("balloon-sculpt");
    if (!options.exports) {
        error_no_memory(&err, "the options");
        return command_fail(&err);
    }
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    enum status status = check_options(&options, &err);
    if (!status)
        status = make(&options, &tree, &err);
    if (!status)
        status = hand_out(&options, &tree, &err);
    octree_clear(&tree);
    free(options.exports);
    return status ? command_fail(&err) : command_end();
}
