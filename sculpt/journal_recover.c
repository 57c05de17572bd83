/* Reading journals: from what a sculpture was to what it had become. */
#include "sculpt/journal.h"

#include "common/array.h"
#include "common/octree_chunks.h"
#include "sculpt/chip_log.h"
#include "sculpt/journal_text.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct recovery {
    const char *path;  /* of the sculpture */
    char *name, *base; /* of the journal and of the file that it begins from */
    struct bytes file; /* the journal */
    struct journal_text text;
    struct octree_chunks chunks;    /* of the file that it begins from */
    struct octree begun;            /* what the journal begins from */
    struct octree saved;            /* what there is in `path`, unless that is damaged */
    bool exists, is_base, is_whole; /* the file `path`: is there, is the base itself, could be read */
};

/* Loads `path` when its hash is the one that the journal begins from; *found says whether it is. Not
 * to be there is no error. */
static enum status load_base(struct recovery *recovery, const char *path, bool *found, struct error *err)
{
    struct bytes file = {0};
    *found = false;
    if (access(path, F_OK))
        return STATUS_OK;
    enum status status = file_read(path, &file, err);
    const bool same = !status && journal_hash(&file) == recovery->text.start.hash;
    bytes_clear(&file);
    if (same)
        status = octree_load_with(path, &recovery->begun, &recovery->chunks, err);
    *found = same && !status;
    return status;
}

static enum status refuse(const struct recovery *recovery, struct error *err)
{
    return error_set(err, STATUS_INPUT,
                     "%s: belongs to another version of %s, which something else has changed since; put the "
                     "version it began with back, or remove the journal",
                     recovery->name, recovery->path);
}

/* The file that the journal begins from, under either name. Where one cannot be read the other may be it. */
static enum status find_base(struct recovery *recovery, struct error *err)
{
    struct error failure = {0}, ignored = {0};
    bool found;
    load_base(recovery, recovery->path, &recovery->is_base, &failure);
    if (recovery->is_base)
        return STATUS_OK;
    load_base(recovery, recovery->base, &found, failure.status ? &ignored : &failure);
    if (found)
        return STATUS_OK;
    return failure.status ? error_set(err, failure.status, "%s", failure.text) : refuse(recovery, err);
}

static enum status find_begin(struct recovery *recovery, struct error *err)
{
    const struct journal_start *start = &recovery->text.start;
    struct error damage = {0};
    recovery->exists = !access(recovery->path, F_OK);
    recovery->is_whole = recovery->exists && !octree_load(recovery->path, &recovery->saved, &damage);
    if (damage.status == STATUS_NO_MEMORY)
        return error_no_memory(err, recovery->path);
    return start->is_cube ? octree_init(&recovery->begun, start->depth, start->material, err)
                          : find_base(recovery, err);
}

/* In a journal a step ends only where a line says so, even while there is no such line yet. */
static enum status end_steps_by_lines(struct chips *chips, struct error *err)
{
    if (!ARRAY_RESERVE(chips, 1))
        return error_no_memory(err, "the journal");
    chips->items[chips->count++] = (struct chip){.kind = CHIP_STEP};
    return STATUS_OK;
}

/* The lines up to `end` as a script. */
static enum status parse(const struct recovery *recovery, size_t end, struct chips *chips, struct error *err)
{
    enum status status = chips_parse(recovery->name, recovery->file.data, end, chips, err);
    return status ? status : end_steps_by_lines(chips, err);
}

/* What they make of what the journal begins from. */
static enum status replay(const struct recovery *recovery, size_t end, struct octree *tree, struct error *err)
{
    struct chips chips = {0};
    enum status status = octree_copy(tree, &recovery->begun, err);
    if (!status)
        status = parse(recovery, end, &chips, err);
    if (!status)
        chips_set_coefficients(&chips, tree);
    if (!status)
        status = chips_run(tree, &chips, err);
    chips_clear(&chips);
    return status;
}

/* Where the last mark of a save before `limit` ends; 0: there is none. */
static size_t last_mark(const struct recovery *recovery, size_t limit)
{
    size_t last = 0;
    for (size_t at = recovery->text.first_end; at < recovery->text.end;) {
        const char *line;
        size_t length = journal_next_line(&recovery->file, &at, &line);
        if (at < limit && length == strlen(JOURNAL_MARK) && !memcmp(line, JOURNAL_MARK, length))
            last = at;
    }
    return last;
}

/* The sculpture's file must be what the journal begins from, or what it had led to when a save began; the
 * last such save is the likeliest. A file that is damaged cannot be told, and stands in nobody's way. */
static enum status check_saved(const struct recovery *recovery, struct error *err)
{
    if (!recovery->is_whole || recovery->is_base || octree_equal(&recovery->saved, &recovery->begun))
        return STATUS_OK;
    for (size_t mark = last_mark(recovery, SIZE_MAX); mark > 0; mark = last_mark(recovery, mark)) {
        struct octree then = {0};
        enum status status = replay(recovery, mark, &then, err);
        bool same = !status && octree_equal(&then, &recovery->saved);
        octree_clear(&then);
        if (status || same)
            return status;
    }
    return refuse(recovery, err);
}

/* A journal that ends within its first line: nothing was done yet. */
static enum status recover_nothing(struct recovery *recovery, struct octree *tree, struct error *err)
{
    if (access(recovery->path, F_OK))
        return error_set(err, STATUS_INPUT, "%s: nothing was written to it yet; remove it", recovery->name);
    return octree_load(recovery->path, tree, err);
}

static enum status recover(struct recovery *recovery, struct octree *tree, struct journal_report *report,
                           struct error *err)
{
    enum status status = file_read(recovery->name, &recovery->file, err);
    if (status)
        return status;
    status = journal_text_read(&recovery->file, &recovery->text, err);
    if (status)
        return err ? error_prefix(err, recovery->name) : status;
    report->operations = recovery->text.operations;
    report->lost_bytes = recovery->file.size - recovery->text.end;
    if (!recovery->text.begun)
        return recover_nothing(recovery, tree, err);
    status = find_begin(recovery, err);
    if (!status)
        status = check_saved(recovery, err);
    if (!status)
        status = replay(recovery, recovery->text.end, tree, err);
    report->unsaved = !status && !(recovery->is_whole && octree_equal(tree, &recovery->saved));
    return status;
}

/* The chip log of the result: that of what the journal begins from, and the journal's operations. */
static enum status make_log(const struct recovery *recovery, struct bytes *log, struct error *err)
{
    const struct journal_start *start = &recovery->text.start;
    const struct octree_chunk *before = octree_chunks_find(&recovery->chunks, OCTREE_CHUNK_LOG);
    struct chips chips = {0};
    *log = (struct bytes){0};
    if (!recovery->text.begun || (!start->is_cube && !before))
        return STATUS_OK;
    enum status status = parse(recovery, recovery->text.end, &chips, err);
    if (!status && start->is_cube)
        chips.start_material = start->material;
    if (!status)
        status = chip_log_write(before ? &before->data : NULL, &chips, recovery->begun.depth, log, err);
    chips_clear(&chips);
    return status;
}

static enum status recovery_init(struct recovery *recovery, const char *path, struct error *err)
{
    bool left;
    *recovery = (struct recovery){.path = path,
                                  .name = journal_path(path, JOURNAL_SUFFIX),
                                  .base = journal_path(path, JOURNAL_BASE_SUFFIX)};
    if (!recovery->name || !recovery->base)
        return error_no_memory(err, "the journal");
    enum status status = journal_is_there(path, &left, err);
    if (!status && !left)
        return error_set(err, STATUS_FILE, "%s: has no journal, so no work on it was lost", path);
    return status;
}

static void recovery_clear(struct recovery *recovery)
{
    octree_clear(&recovery->begun);
    octree_clear(&recovery->saved);
    octree_chunks_clear(&recovery->chunks);
    bytes_clear(&recovery->file);
    free(recovery->name);
    free(recovery->base);
}

enum status journal_recover(const char *path, struct octree *tree, struct bytes *log,
                            struct journal_report *report, struct error *err)
{
    struct recovery recovery;
    struct octree made = {0};
    *report = (struct journal_report){0};
    enum status status = recovery_init(&recovery, path, err);
    if (!status)
        status = recover(&recovery, &made, report, err);
    if (!status && log)
        status = make_log(&recovery, log, err);
    if (status) {
        octree_clear(&made);
    } else {
        octree_clear(tree);
        *tree = made;
    }
    recovery_clear(&recovery);
    return status;
}
