/* balloon-sculpt: carve a sculpture in an octree. */
#include "common/array.h"
#include "common/command.h"
#include "common/octree_chunks.h"
#include "sculpt/chip_log.h"
#include "sculpt/export.h"
#include "sculpt/import.h"
#include "sculpt/info.h"
#include "sculpt/journal.h"
#include "sculpt/main_picture.h"
#include "sculpt/sculpt.h"
#include "sculpt/session.h"
#include "sculpt/window.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    DEPTH_DEFAULT = 6,
    UNDO_MEGABYTES_DEFAULT = SESSION_HISTORY_BYTES >> 20,
    UNDO_MEGABYTES_MAX = 65536,
};

enum option_key {
    OPTION_SCRIPT = 256,
    OPTION_IMPORT,
    OPTION_EXPORT,
    OPTION_RENDER,
    OPTION_INFO,
    OPTION_DEPTH,
    OPTION_SOLID,
    OPTION_RECOVER,
    OPTION_UNDO_MEMORY,
};

static const struct argp_option option_list[] = {
    {"script", OPTION_SCRIPT, "FILE.chips", 0, "Carve what the script says", 0},
    {"import", OPTION_IMPORT, "FILE", 0,
     "Begin with a MagicaVoxel model (.vox) or a closed mesh (.stl, .ply, .obj; through assimp .gltf, .dae, .fbx and others)",
     0},
    {"depth", OPTION_DEPTH, "N", 0,
     "A new cube has 2^N cells a side, N from 0 to 10 (default 6); for a mesh from 2 (default 7)", 0},
    {"recover", OPTION_RECOVER, NULL, 0,
     "Begin with the work on FILE.oct that a killed program left in FILE.oct.journal", 0},
    {"solid", OPTION_SOLID, NULL, 0, "Fill the hollows of what is begun with", 0},
    {"output", 'o', "FILE.oct", 0, "Save the sculpture", 0},
    {"export", OPTION_EXPORT, "FILE", OPTION_REPEATS,
     "Write .vox (MagicaVoxel), .ply (the faces of the cubes) or .chips (a script); may be repeated", 0},
    {"render", OPTION_RENDER, "FILE.png", 0, "Draw the sculpture", 0},
    {"info", OPTION_INFO, NULL, 0, "Print figures about the sculpture", 0},
    {"undo-memory", OPTION_UNDO_MEMORY, "MB", 0,
     "What the window keeps to undo, 1 to 65536 (default 256); the oldest steps go first", 0},
    {"quiet", 'q', NULL, 0, "No notes, no progress", 0},
    {0},
};

struct options {
    const char *file, *script, *import, *output, *picture;
    const char **exports;
    size_t export_count;
    long depth, undo_megabytes; /* depth -1, memory 0: not given */
    bool info, solid, recover;
};

/* What is carved, and what its file carries besides. */
struct work {
    struct octree tree;
    struct octree_chunks chunks; /* of the file that was begun with; the chip log where one is known */
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
        command_extension(state, "--render", argument, "png");
        options->picture = argument;
        return 0;
    case OPTION_INFO:
        options->info = true;
        return 0;
    case OPTION_SOLID:
        options->solid = true;
        return 0;
    case OPTION_RECOVER:
        options->recover = true;
        return 0;
    case OPTION_DEPTH:
        options->depth = command_whole(state, "--depth", argument, 0, OCTREE_DEPTH_MAX);
        return 0;
    case OPTION_UNDO_MEMORY:
        options->undo_megabytes = command_whole(state, "--undo-memory", argument, 1, UNDO_MEGABYTES_MAX);
        return 0;
    case 'o':
        command_extension(state, "-o", argument, "oct"); /* --export writes the others */
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

static bool asks_for_result(const struct options *options)
{
    return options->output || options->export_count || options->picture || options->info;
}

/* What argp cannot see: options that contradict each other, and names that say nothing is possible. */
static enum status check_options(const struct options *options, struct error *err)
{
    if (options->import && options->file)
        return error_set(err, STATUS_USAGE, "--import %s and %s: give one of them to begin with",
                         options->import, options->file);
    const bool mesh = options->import && mesh_is_readable_name(options->import);
    if (options->import && !sculpt_import_is_name(options->import))
        return error_set(
            err, STATUS_USAGE,
            "--import %s: .vox, .stl, .ply and .obj are read, and through assimp .gltf, .dae and others",
            options->import);
    if (options->recover && !options->file)
        return error_set(err, STATUS_USAGE, "--recover: give the FILE.oct that was being carved");
    if (mesh && options->depth >= 0 && options->depth < VOXELISE_DEPTH_MIN)
        return error_set(err, STATUS_USAGE, "--depth %ld: a mesh needs one from %d to %d", options->depth,
                         VOXELISE_DEPTH_MIN, OCTREE_DEPTH_MAX);
    const bool begun = options->file && (asks_for_result(options) || !access(options->file, F_OK));
    if (options->depth >= 0 && ((options->import && !mesh) || begun))
        return error_set(err, STATUS_USAGE,
                         "--depth %ld: %s has its own; give --depth for a new cube or a mesh only",
                         options->depth, options->import ? options->import : options->file);
    for (size_t i = 0; i < options->export_count; i++)
        if (!sculpt_export_is_name(options->exports[i]))
            return error_set(err, STATUS_USAGE, "--export %s: .vox, .ply and .chips are written",
                             options->exports[i]);
    if (options->solid && !options->import && !options->file)
        return error_set(err, STATUS_USAGE, "--solid: a new cube has no hollows; give FILE.oct or --import");
    if (asks_for_result(options) && options->undo_megabytes)
        command_note("--undo-memory does nothing: only the window undoes");
    if (!asks_for_result(options) && (options->script || options->import || options->solid))
        return error_set(err, STATUS_USAGE,
                         "nothing is done with the sculpture: give -o, --export, --render or --info");
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

/* The log goes on with what was done; what is not known to have been made by chips has none. */
static enum status keep_log(const struct options *options, struct work *work, const struct chips *chips,
                            struct error *err)
{
    const struct octree_chunk *before = octree_chunks_find(&work->chunks, OCTREE_CHUNK_LOG);
    struct bytes log;
    if (!before && (options->file || options->import))
        return STATUS_OK;
    enum status status = chip_log_write(before ? &before->data : NULL, chips, work->tree.depth, &log, err);
    if (!status && (status = octree_chunks_put(&work->chunks, OCTREE_CHUNK_LOG, &log, err)))
        bytes_clear(&log);
    return status;
}

static enum status carve(const struct options *options, struct work *work, struct error *err)
{
    struct chips chips = {.start_material = 1};
    enum status status = options->script ? chips_load(options->script, &chips, err) : STATUS_OK;
    if (!status)
        status = check_script(options, &chips, &work->tree, err);
    if (!status && !options->file && !options->import)
        status = chips_begin(&chips, work->tree.depth, &work->tree, err);
    else if (!status)
        chips_set_coefficients(&chips, &work->tree);
    char size[64];
    snprintf(size, sizeof size, "%zu chips", chips.count);
    chips.progress = progress_update;
    progress_begin("carving", size, "chips", (double)chips.count);
    if (!status)
        status = chips_run(&work->tree, &chips, err);
    progress_end();
    if (!status)
        status = keep_log(options, work, &chips, err);
    chips_clear(&chips);
    return status;
}

/* Of the material that most cells have. No chip says so: the log is lost with it. */
static enum status fill_hollows(struct work *work, struct error *err)
{
    uint64_t cells;
    enum status status = octree_fill_hollows(&work->tree, info_main_material(&work->tree), &cells, err);
    if (!status && cells > 0)
        octree_chunks_drop(&work->chunks, OCTREE_CHUNK_LOG);
    return status;
}

static enum status import(const struct options *options, struct octree *tree, struct error *err)
{
    struct voxelise_report report;
    uint64_t hollow;
    char notes[ERROR_TEXT_SIZE];
    unsigned depth = options->depth >= 0 ? (unsigned)options->depth : VOXELISE_DEPTH_DEFAULT;
    enum status status = sculpt_import(options->import, depth, tree, &report, &hollow, err);
    if (status)
        return status;
    sculpt_import_notes(options->import, &report, notes, sizeof notes);
    for (char *line = strtok(notes, "\n"); line; line = strtok(NULL, "\n"))
        command_note("%s", line);
    if (hollow > 0 && !options->solid)
        command_note("%s is hollow: %llu cells within are empty; --solid fills them", options->import,
                     (unsigned long long)hollow);
    return STATUS_OK;
}

static enum status recover(const char *path, struct work *work, struct error *err)
{
    struct journal_report report;
    struct bytes log = {0};
    struct error ignored;
    (void)octree_load_with(path, &work->tree, &work->chunks, &ignored); /* what else the file carries */
    octree_chunks_drop(&work->chunks, OCTREE_CHUNK_LOG);
    enum status status = journal_recover(path, &work->tree, &log, &report, err);
    if (!status && log.data)
        status = octree_chunks_put(&work->chunks, OCTREE_CHUNK_LOG, &log, err);
    bytes_clear(&log);
    if (status)
        return status;
    command_note("%s: %zu operations recovered%s", path, report.operations,
                 report.unsaved ? "" : "; they had been saved");
    if (report.lost_bytes > 0)
        command_note("%s.journal: its last %zu bytes are cut off or damaged, and left out", path,
                     report.lost_bytes);
    return STATUS_OK;
}

static enum status load(const struct options *options, struct work *work, struct error *err)
{
    struct error ignored;
    bool left;
    if (options->recover)
        return recover(options->file, work, err);
    if (!journal_is_left(options->file, &left, &ignored) && left)
        command_note("%s.journal holds work that was not saved: --recover begins with it", options->file);
    return octree_load_with(options->file, &work->tree, &work->chunks, err);
}

static enum status make(const struct options *options, struct work *work, struct error *err)
{
    enum status status;
    if (options->file)
        status = load(options, work, err);
    else if (options->import)
        status = import(options, &work->tree, err);
    else
        status = octree_init(&work->tree, options->depth >= 0 ? (unsigned)options->depth : DEPTH_DEFAULT, 1,
                             err);
    if (!status && options->solid)
        status = fill_hollows(work, err);
    return status ? status : carve(options, work, err);
}

static enum status save(const struct options *options, struct work *work, struct error *err)
{
    bool left;
    enum status status = journal_is_left(options->output, &left, err); /* nobody else is carving it */
    if (status)
        return status;
    const bool recovered = options->recover && (!strcmp(options->file, options->output) ||
                                                file_same(options->file, options->output));
    if (left && !recovered)
        command_note("%s.journal belongs to the sculpture that is replaced", options->output);
    struct error reason = {0};
    if (picture_preview(&work->tree, &work->chunks, &reason)) /* a sculpture without one is as good */
        command_note("the sculpture is saved without a preview: %s", reason.text);
    status = octree_save_with(&work->tree, &work->chunks, options->output, err);
    if (!status && (recovered || !left))
        status = journal_remove(options->output, err);
    return status;
}

static enum status hand_out(const struct options *options, struct work *work, struct error *err)
{
    enum status status = options->output ? save(options, work, err) : STATUS_OK;
    for (size_t i = 0; i < options->export_count && !status; i++)
        status = sculpt_export(&work->tree, &work->chunks, options->exports[i], err);
    if (!status && options->picture)
        status = picture_draw(&work->tree, options->picture, err);
    if (!status && options->info)
        info_print(&work->tree, &work->chunks, stdout);
    return status;
}

/* Without anything to do for a script it is a person who wants to carve. */
static enum status open_window(const struct options *options, struct error *err)
{
    const struct sculpt_window_options window = {
        .path = options->file ? options->file : "sculpture.oct",
        .depth = options->depth >= 0 ? (unsigned)options->depth : DEPTH_DEFAULT,
        .recover = options->recover,
        .undo_memory = (size_t)(options->undo_megabytes ? options->undo_megabytes : UNDO_MEGABYTES_DEFAULT)
                       << 20,
    };
    return sculpt_window(&window, err);
}

/* FILE.oct may be carved into itself; what it is begun with otherwise, or carved by, stays. */
static enum status check_files(const struct options *options, struct error *err)
{
    const char *read[] = {options->script, options->import};
    const char **written = array_new(options->export_count + 2, sizeof *written);
    size_t count = 0;
    if (!written)
        return error_no_memory(err, "the names of files");
    written[count++] = options->output;
    written[count++] = options->picture;
    for (size_t i = 0; i < options->export_count; i++)
        written[count++] = options->exports[i];
    enum status status = file_check_clash(read, sizeof read / sizeof *read, written, count, err);
    free(written);
    return status;
}

static enum status carve_in_batch(const struct options *options, struct error *err)
{
    struct work work = {0};
    enum status status = check_files(options, err);
    if (!status)
        status = make(options, &work, err);
    if (!status)
        status = hand_out(options, &work, err);
    octree_clear(&work.tree);
    octree_chunks_clear(&work.chunks);
    return status;
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        option_list,
        parse_option,
        "[FILE.oct]",
        "Carves a sculpture out of a cube of material: in a window, or with the options below by a script.\v"
        "Without FILE.oct and --import a full cube is begun with; in the window F1 lists the keys.\n"
        "A script has a line for each chip, such as\n"
        "\n"
        "  chip sphere 0.5 0.5 0.5 0.2\n"
        "  fill capsule 0.2 0.2 0.5 0.8 0.8 0.5 0.1 0.05\n"
        "\n"
        "in a cube from 0 to 1; the manual page has them all.",
        NULL,
        NULL,
        NULL};
    struct error err = {0};
    struct options options = {.depth = -1, .exports = array_new((size_t)argc, sizeof *options.exports)};
    command_begin("balloon-sculpt");
    if (!options.exports) {
        error_no_memory(&err, "the options");
        return command_fail(&err);
    }
    command_parse(&argp, argc, argv, &options);
    enum status status = check_options(&options, &err);
    if (!status)
        status = asks_for_result(&options) ? carve_in_batch(&options, &err) : open_window(&options, &err);
    free(options.exports);
    return status ? command_fail(&err) : command_end();
}
