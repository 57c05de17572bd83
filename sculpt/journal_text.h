/* Inside the sculptor: a journal as it is written, between journal.c (writing) and
 * journal_recover.c (reading).
 *
 *     # balloon-sculpt journal 1, cube of depth 6, material 1 #1b2c3d4e          the first line is this one
 *     # balloon-sculpt journal 1, file of hash 0123456789abcdef #1b2c3d4e        or this one
 *     chip sphere 0.5 0.5 0.5 0.2 #5f607182                                      then lines of a script
 *     # save #93a4b5c6                                                           and marks of saves */
#ifndef SCULPT_JOURNAL_TEXT_H
#define SCULPT_JOURNAL_TEXT_H

#include "common/file.h"

#include <stdint.h>

#define JOURNAL_MARK "# save"

enum {
    JOURNAL_FIRST_SIZE = 96, /* enough for a first line */
    JOURNAL_SUM_SIZE = 11,   /* " #xxxxxxxx\n" behind a line */
};

/* What the sculpture was when the journal began. */
struct journal_start {
    bool is_cube; /* a new cube, of this depth and material; else the file of this hash */
    unsigned depth, material;
    uint64_t hash;
};

struct journal_text {
    struct journal_start start;
    bool begun;            /* the first line is whole; else nothing was written yet */
    size_t first_end, end; /* where the first line, and the last whole one, end */
    size_t operations;     /* lines that are no comments */
    uint32_t sum;          /* of the last whole line */
};

/* "FILE.oct" + suffix; free() it. NULL when memory is not enough. */
char *journal_path(const char *path, const char *suffix);
#define JOURNAL_SUFFIX      ".journal"
#define JOURNAL_BASE_SUFFIX ".journal-base"

/* The hash of a file of these bytes. No CRC: that of a file of chunks, each with its own CRC behind it,
 * depends on their sizes alone. */
uint64_t journal_hash(const struct bytes *file);

/* The first line, without checksum, into `line`. */
void journal_first_line(const struct journal_start *start, char line[JOURNAL_FIRST_SIZE]);

/* The checksum of a line (without its own and without the line feed) that follows one with
 * the checksum `before`. */
uint32_t journal_sum(uint32_t before, const char *line, size_t length);

/* Finds the whole lines at the beginning of a journal. Errors, without the file's name: STATUS_INPUT for what
 * is no journal, or one whose first line is damaged. */
enum status journal_text_read(const struct bytes *file, struct journal_text *text, struct error *err);

/* The line at *at of the whole ones: its beginning and, as the result, its length without checksum; *at
 * then leads to the next. */
size_t journal_next_line(const struct bytes *file, size_t *at, const char **line);

#endif
