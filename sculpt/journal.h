/*
 * The journal of a sculpture that is being carved: FILE.oct.journal holds each operation as soon as it is
 * done, so that a program that is killed at any moment loses none.
 *
 *     bool left;
 *     if (journal_is_left(path, &left, err)) ...                 somebody else is carving it
 *     if (left && journal_recover(path, &tree, &log, &report, err)) ...
 *     if (journal_open(path, &tree, &journal, err)) ...           goes on with what is left, or begins
 *     if (journal_append(journal, "chip sphere .5 .5 .5 .2\n", err)) ...       after each operation
 *     if (journal_mark(journal, err) || octree_save(&tree, path, err)) ...     before each save
 *     journal_close(journal, true);                              true: nothing in it is wanted any more
 *
 * A journal is a script (.chips) whose steps end where a line `step`, undo or redo says so. Every line ends
 * in a comment with its checksum, which covers the lines before it too; the first line is a comment that says
 * what the sculpture began as: a new cube, or a file of a certain hash. That file is kept beside the journal
 * as FILE.oct.journal-base (a second link to it; a copy where links are not possible) until the journal is
 * closed. So a journal is good for the whole session, undo of steps before a save included, and a save that
 * is interrupted does no harm. Each append is one write(2). While a journal is open it is locked.
 */
#ifndef SCULPT_JOURNAL_H
#define SCULPT_JOURNAL_H

#include "common/file.h"
#include "common/octree.h"
#include "sculpt/sculpt.h"

struct journal;

/* Sets *left when the sculpture has a journal with work in it that nobody is writing: its program was killed.
 * One whose work is all in the sculpture, or that has none and whose sculpture is what it began from, is as
 * good as none. Errors:
 * STATUS_RESOURCE when another program has it open, STATUS_FILE, STATUS_NO_MEMORY. */
enum status journal_is_left(const char *path, bool *left, struct error *err);

/* The same of any journal, with work in it or not. */
enum status journal_is_there(const char *path, bool *there, struct error *err);

struct journal_report {
    size_t operations; /* whole ones: steps, undo and redo count too */
    size_t lost_bytes; /* of a last line that is cut off, or from the first damaged line on */
    bool unsaved;      /* the result differs from the sculpture in `path`, or there is none */
};

/* Makes *tree (valid; it is replaced, or as it was after a failure) what the journal of the sculpture `path`
 * leads to: all operations up to the last whole line. *log (overwritten; free it with bytes_clear()) is the
 * chip log of the result, {0} when what the journal begins from has none; it may be NULL. The files stay as
 * they are. Errors: STATUS_INPUT when the sculpture was changed by something else since, or the journal is
 * none; STATUS_RESOURCE when another program has it open; STATUS_FILE, STATUS_NO_MEMORY. */
enum status journal_recover(const char *path, struct octree *tree, struct bytes *log,
                            struct journal_report *report, struct error *err);

/* Opens the journal of the sculpture `path` for appending and locks it. One that is left is gone on with
 * (what is behind its last whole line is cut off; a step ends there, and material and mirror are again those
 * of a script's beginning); else a new one begins: from the file,
 * or, where there is no file, from *tree. Errors: STATUS_RESOURCE when another program has it open;
 * STATUS_INPUT, STATUS_FILE, STATUS_NO_MEMORY. */
enum status journal_open(const char *path, const struct octree *tree, struct journal **journal,
                         struct error *err);

/* Appends lines of a script, each ending in a line feed, by one write. chip_write() makes them. After a
 * failure (STATUS_FILE, STATUS_NO_MEMORY: a full disk) the journal ends as it did before. */
enum status journal_append(struct journal *journal, const char *lines, struct error *err);

/* Notes that what there is now is about to be saved to the sculpture's own file.
 * Errors as journal_append(). */
enum status journal_mark(struct journal *journal, struct error *err);

/* What is carved was saved as another file, behind a mark: the journal goes along, with all there was before,
 * in place of one that is left there. Errors: STATUS_FILE, STATUS_NO_MEMORY; then it is where it was. */
enum status journal_move(struct journal *journal, const char *sculpture, struct error *err);

/* Closes and frees it; with `discard` it is removed, and the base beside it. NULL is fine. */
void journal_close(struct journal *journal, bool discard);

/* Removes a journal that is left, and its base: its work is saved or not wanted. Errors: STATUS_RESOURCE when
 * another program has it open, STATUS_FILE. */
enum status journal_remove(const char *path, struct error *err);

#endif
