/*
 * Reading a text file word by word, with the line at hand for messages. Words are what lies between spaces,
 * tabs and line ends (LF or CR LF). Nothing is copied and nothing behind the end is looked at.
 *
 *     struct text text = text_of(path, bytes.data, bytes.size);
 *     for (; !text_ended(&text); text_next_line(&text)) {
 *         struct word word;
 *         while (text_word(&text, &word)) ...            the words of this line
 *     }
 */
#ifndef COMMON_TEXT_H
#define COMMON_TEXT_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>

struct text {
    const char *path;     /* for messages */
    const char *at, *end; /* what is still to be read; *end is readable and no part of a number */
    size_t line;          /* of `at`, from 1 */
    bool backslash_joins; /* a backslash at the end of a line continues it on the next */
};

struct word {
    const char *start;
    size_t length;
};

/* How many bytes the byte order mark takes that editors of Windows put before UTF-8; 0: there is none. */
size_t text_mark_length(const void *data, size_t size);

/* The text of a file's bytes behind that mark, with the NUL behind them that file_read() promises. */
struct text text_of(const char *path, const void *data, size_t size);

bool text_ended(const struct text *text);

/* The next word of this line; false when there is none. */
bool text_word(struct text *text, struct word *word);

/* The next word of this line or a later one; false at the end of the text. */
bool text_any_word(struct text *text, struct word *word);

/* Skips the rest of this line and its end. */
void text_next_line(struct text *text);

bool word_is(struct word word, const char *name);

/* The word as a number (see strtod; "nan" and "inf" are numbers here); false unless all of it is one. */
bool word_number(struct word word, double *number);

/* The word as a whole number; false unless all of it is one and it fits. */
bool word_whole(struct word word, long long *number);

/* The word for a message: cut to a few letters, whatever cannot be printed as "?". Returns shown. */
enum { WORD_SHOWN_SIZE = 32 };
const char *word_show(struct word word, char shown[WORD_SHOWN_SIZE]);

/* Sets err to "PATH:LINE: ..." with STATUS_INPUT and returns that. */
enum status text_fail(const struct text *text, struct error *err, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
