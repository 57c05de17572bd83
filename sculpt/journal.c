/* Writing journals. */
#include "sculpt/journal.h"

#include "sculpt/journal_text.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

struct journal {
    int file;
    off_t size;
    uint32_t sum; /* of the last line */
    bool torn;    /* behind `size` lies a part of a line, which could not be taken back yet */
    char *path, *base;
};

/* Where locks are not possible (some network file systems) there is none. */
static enum status lock(int file, int how, const char *path, struct error *err)
{
    if (!flock(file, how | LOCK_NB) || errno != EWOULDBLOCK)
        return STATUS_OK;
    return error_set(err, STATUS_RESOURCE,
                     "%s: another balloon-sculpt is carving this sculpture; close it first", path);
}

enum status journal_is_there(const char *path, bool *there, struct error *err)
{
    char *name = journal_path(path, JOURNAL_SUFFIX);
    if (!name)
        return error_no_memory(err, "a journal");
    enum status status = STATUS_OK;
    int file = open(name, O_RDONLY | O_CLOEXEC);
    *there = file >= 0;
    if (file >= 0) {
        status = lock(file, LOCK_SH, path, err);
        close(file);
    } else if (errno != ENOENT && errno != ENOTDIR) {
        status = error_set_errno(err, name, "open");
    }
    free(name);
    return status;
}

/* Whether a journal has its first line alone, and what it begins from is still what the sculpture is: nothing
 * was done to that. */
static bool is_idle(const struct bytes *journal, const struct journal_text *text, const char *path)
{
    struct bytes file = {0};
    struct error ignored;
    if (!text->begun || journal->size != text->first_end)
        return false;
    if (text->start.is_cube)
        return access(path, F_OK) != 0;
    const bool same = !file_read(path, &file, &ignored) && journal_hash(&file) == text->start.hash;
    bytes_clear(&file);
    return same;
}

/* Whether all work in a journal is in the sculpture: it was saved, and nothing came of what was done since.
 * Without a mark none was. */
static bool is_saved(const struct bytes *journal, const struct journal_text *text, const char *path)
{
    static const char mark[] = "\n" JOURNAL_MARK " #";
    struct octree tree = {0};
    struct journal_report report;
    struct error ignored;
    if (journal->size != text->end || !memmem(journal->data, text->end, mark, sizeof mark - 1))
        return false;
    const bool saved = !journal_recover(path, &tree, NULL, &report, &ignored) && !report.unsaved;
    octree_clear(&tree);
    return saved;
}

enum status journal_is_left(const char *path, bool *left, struct error *err)
{
    struct bytes file = {0};
    struct journal_text text;
    struct error ignored;
    enum status status = journal_is_there(path, left, err);
    if (status || !*left)
        return status;
    char *name = journal_path(path, JOURNAL_SUFFIX);
    status = name ? file_read(name, &file, err) : error_no_memory(err, "a journal");
    if (!status && !journal_text_read(&file, &text, &ignored))
        *left = !is_idle(&file, &text, path) && !is_saved(&file, &text, path);
    bytes_clear(&file);
    free(name);
    return status;
}

/* True when the name still leads to the file: its last owner may have removed it
 * while we waited to open it. */
static bool is_still(int file, const char *path)
{
    struct stat opened, named;
    return !fstat(file, &opened) && !stat(path, &named) && opened.st_ino == named.st_ino &&
           opened.st_dev == named.st_dev;
}

static enum status open_locked(struct journal *journal, const char *path, struct error *err)
{
    for (;;) {
        journal->file = open(journal->path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        if (journal->file < 0)
            return error_set_errno(err, journal->path, "open");
        enum status status = lock(journal->file, LOCK_EX, path, err);
        if (status || is_still(journal->file, journal->path))
            return status;
        close(journal->file);
    }
}

/* What was written in part is taken back, so that the next line begins where it must: now, or before that
 * line, since nothing that follows such a part is read. */
static enum status write_once(struct journal *journal, const char *text, size_t size, struct error *err)
{
    if (journal->torn && ftruncate(journal->file, journal->size))
        return error_set_errno(err, journal->path, "write");
    ssize_t written = write(journal->file, text, size);
    journal->torn = false;
    if (written == (ssize_t)size) {
        journal->size += written;
        return STATUS_OK;
    }
    int reason = written < 0 ? errno : ENOSPC;
    journal->torn = ftruncate(journal->file, journal->size) != 0;
    errno = reason;
    return error_set_errno(err, journal->path, "write");
}

enum status journal_append(struct journal *journal, const char *lines, struct error *err)
{
    char *text = NULL;
    size_t size = 0;
    uint32_t sum = journal->sum;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return error_no_memory(err, "the journal");
    while (*lines) {
        const char *end = strchr(lines, '\n');
        assert(end);
        sum = journal_sum(sum, lines, (size_t)(end - lines));
        fprintf(stream, "%.*s #%08" PRIx32 "\n", (int)(end - lines), lines, sum);
        lines = end + 1;
    }
    bool failed = ferror(stream);
    if (fclose(stream) || failed) {
        free(text);
        return error_no_memory(err, "the journal");
    }
    enum status status = size > 0 ? write_once(journal, text, size, err) : STATUS_OK;
    free(text);
    if (!status)
        journal->sum = sum;
    return status;
}

enum status journal_mark(struct journal *journal, struct error *err)
{
    return journal_append(journal, JOURNAL_MARK "\n", err);
}

static enum status copy_file(const struct bytes *file, const char *to, struct error *err)
{
    struct file_out *out;
    enum status status = file_out_open(to, &out, err);
    if (status)
        return status;
    fwrite(file->data, 1, file->size, file_out_stream(out));
    return file_out_commit(out, err);
}

/* Keeps the file that the journal begins from: a save puts another in its place but leaves
 * this one's other link. */
static enum status keep_base(struct journal *journal, const char *path, struct journal_start *start,
                             struct error *err)
{
    struct bytes file = {0};
    enum status status = file_read(path, &file, err);
    if (status)
        return status;
    start->hash = journal_hash(&file);
    unlink(journal->base);
    if (linkat(AT_FDCWD, path, AT_FDCWD, journal->base, AT_SYMLINK_FOLLOW))
        status = copy_file(&file, journal->base, err);
    bytes_clear(&file);
    return status;
}

/* What has no file yet gets one beside the journal. */
static enum status make_base(struct journal *journal, const struct octree *tree, struct journal_start *start,
                             struct error *err)
{
    struct bytes file = {0};
    enum status status = octree_save(tree, journal->base, err);
    if (!status)
        status = file_read(journal->base, &file, err);
    if (!status)
        start->hash = journal_hash(&file);
    bytes_clear(&file);
    return status;
}

static enum status begin(struct journal *journal, const char *path, const struct octree *tree,
                         struct error *err)
{
    const bool exists = !access(path, F_OK);
    struct journal_start start = {.is_cube = !exists && tree->root < OCTREE_MATERIALS};
    char first[JOURNAL_FIRST_SIZE + 1];
    if (ftruncate(journal->file, 0))
        return error_set_errno(err, journal->path, "write");
    if (start.is_cube) {
        start.depth = tree->depth;
        start.material = tree->root;
    } else {
        enum status status = exists ? keep_base(journal, path, &start, err)
                                    : make_base(journal, tree, &start, err);
        if (status)
            return status;
    }
    journal_first_line(&start, first);
    strcat(first, "\n");
    return journal_append(journal, first, err);
}

/* A step ends where the program was killed: what comes now was not undone together with what was before. It
 * is written as at a script's beginning, whatever material and mirror the lines before leave set. */
static enum status go_on(struct journal *journal, const struct journal_text *text, struct error *err)
{
    journal->size = (off_t)text->end;
    journal->sum = text->sum;
    if (ftruncate(journal->file, journal->size))
        return error_set_errno(err, journal->path, "write");
    return text->operations > 0 ? journal_append(journal, "step\nmaterial 1\nmirror none\n", err) : STATUS_OK;
}

/* One that was made just now, or never got its first line, is not left behind. */
static void remove_if_empty(const struct journal *journal)
{
    struct stat info;
    if (!fstat(journal->file, &info) && info.st_size == 0)
        unlink(journal->path);
}

static enum status open_file(struct journal *journal, const char *path, const struct octree *tree,
                             struct error *err)
{
    struct bytes file = {0};
    struct journal_text text;
    enum status status = open_locked(journal, path, err);
    if (status)
        return status;
    status = file_read(journal->path, &file, err);
    if (status) {
        remove_if_empty(journal);
        return status;
    }
    status = journal_text_read(&file, &text, err);
    const bool other_cube = !status && text.start.is_cube && is_idle(&file, &text, path); /* than *tree */
    bytes_clear(&file);
    if (status)
        return err ? error_prefix(err, journal->path) : status;
    if (text.begun && !other_cube)
        return go_on(journal, &text, err);
    status = begin(journal, path, tree, err);
    if (status) {
        unlink(journal->path);
        unlink(journal->base);
    }
    return status;
}

enum status journal_open(const char *path, const struct octree *tree, struct journal **result,
                         struct error *err)
{
    struct journal *journal = calloc(1, sizeof *journal);
    if (!journal)
        return error_no_memory(err, "the journal");
    journal->file = -1;
    journal->path = journal_path(path, JOURNAL_SUFFIX);
    journal->base = journal_path(path, JOURNAL_BASE_SUFFIX);
    enum status status = journal->path && journal->base ? open_file(journal, path, tree, err)
                                                        : error_no_memory(err, "the journal");
    if (status)
        journal_close(journal, false);
    else
        *result = journal;
    return status;
}

static enum status link_or_copy(const char *from, const char *to, struct error *err)
{
    struct bytes file = {0};
    unlink(to);
    if (!link(from, to))
        return STATUS_OK;
    enum status status = file_read(from, &file, err);
    if (!status)
        status = copy_file(&file, to, err);
    bytes_clear(&file);
    return status;
}

/* To another file system: a file of its own. */
static enum status copy_journal(struct journal *journal, const char *to, struct error *err)
{
    enum status status = link_or_copy(journal->path, to, err);
    int file = status ? -1 : open(to, O_RDWR | O_APPEND | O_CLOEXEC);
    if (!status && file < 0)
        status = error_set_errno(err, to, "open");
    if (!status)
        status = lock(file, LOCK_EX, to, err);
    if (status) {
        if (file >= 0)
            close(file);
        unlink(to);
        return status;
    }
    close(journal->file);
    journal->file = file;
    unlink(journal->path);
    return STATUS_OK;
}

static enum status move_files(struct journal *journal, const char *path, const char *base, struct error *err)
{
    const bool has_base = !access(journal->base, F_OK);
    enum status status = has_base ? link_or_copy(journal->base, base, err) : STATUS_OK;
    if (!status && rename(journal->path, path))
        status = errno == EXDEV ? copy_journal(journal, path, err)
                                : error_set_errno(err, path, "make the journal");
    if (has_base)
        unlink(status ? base : journal->base);
    return status;
}

/* The base first: at each moment one of both names has a journal with its base. */
enum status journal_move(struct journal *journal, const char *sculpture, struct error *err)
{
    char *path = journal_path(sculpture, JOURNAL_SUFFIX),
         *base = journal_path(sculpture, JOURNAL_BASE_SUFFIX);
    enum status status = path && base ? move_files(journal, path, base, err)
                                      : error_no_memory(err, "the journal");
    if (!status) {
        char *old_path = journal->path, *old_base = journal->base;
        journal->path = path;
        journal->base = base;
        path = old_path;
        base = old_base;
    }
    free(path);
    free(base);
    return status;
}

/* The journal goes first: without it the base means nothing, but not the other way round. */
void journal_close(struct journal *journal, bool discard)
{
    if (!journal)
        return;
    if (discard) {
        unlink(journal->path);
        unlink(journal->base);
    }
    if (journal->file >= 0)
        close(journal->file);
    free(journal->path);
    free(journal->base);
    free(journal);
}

enum status journal_remove(const char *path, struct error *err)
{
    bool there;
    char *name = journal_path(path, JOURNAL_SUFFIX), *base = journal_path(path, JOURNAL_BASE_SUFFIX);
    enum status status = name && base ? journal_is_there(path, &there, err)
                                      : error_no_memory(err, "the journal");
    if (!status && there) {
        if (unlink(name))
            status = error_set_errno(err, name, "remove");
        unlink(base);
    }
    free(name);
    free(base);
    return status;
}
