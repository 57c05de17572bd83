#include "common/text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t text_mark_length(const void *data, size_t size)
{
    static const char mark[3] = "\xEF\xBB\xBF";
    return size >= sizeof mark && !memcmp(data, mark, sizeof mark) ? sizeof mark : 0;
}

struct text text_of(const char *path, const void *data, size_t size)
{
    const char *bytes = data;
    return (struct text){
        .path = path, .at = bytes + text_mark_length(data, size), .end = bytes + size, .line = 1};
}

bool text_ended(const struct text *text)
{
    return text->at == text->end;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The length of a backslash and line end at text->at; 0 where there is none, or where they mean nothing. */
static size_t joint_length(const struct text *text)
{
    size_t left = (size_t)(text->end - text->at);
    if (!text->backslash_joins || left < 2 || text->at[0] != '\\')
        return 0;
    if (text->at[1] == '\n')
        return 2;
    return left > 2 && text->at[1] == '\r' && text->at[2] == '\n' ? 3 : 0;
}

bool text_word(struct text *text, struct word *word)
{
    for (size_t joint; !text_ended(text); text->at += joint ? joint : 1) {
        joint = joint_length(text);
        if (joint)
            text->line++;
        else if (!is_blank(*text->at))
            break;
    }
    const char *start = text->at;
    while (!text_ended(text) && !is_blank(*text->at) && *text->at != '\n' && !joint_length(text))
        text->at++;
    *word = (struct word){start, (size_t)(text->at - start)};
    return word->length > 0;
}

bool text_any_word(struct text *text, struct word *word)
{
    while (!text_word(text, word)) {
        if (text_ended(text))
            return false;
        text_next_line(text);
    }
    return true;
}

void text_next_line(struct text *text)
{
    struct word word;
    if (text->backslash_joins) {
        while (text_word(text, &word))
            ;
    }
    const char *newline = memchr(text->at, '\n', (size_t)(text->end - text->at));
    text->at = newline ? newline + 1 : text->end;
    text->line += newline != NULL;
}

bool word_is(struct word word, const char *name)
{
    return word.length == strlen(name) && !memcmp(word.start, name, word.length);
}

bool word_number(struct word word, double *number)
{
    char *end; /* a word does not begin with a space, so strtod cannot skip into the next one */
    *number = strtod(word.start, &end);
    return word.length > 0 && end == word.start + word.length;
}

bool word_whole(struct word word, long long *number)
{
    char *end;
    errno = 0;
    *number = strtoll(word.start, &end, 10);
    return word.length > 0 && end == word.start + word.length && errno == 0;
}

const char *word_show(struct word word, char shown[WORD_SHOWN_SIZE])
{
    size_t length = word.length < WORD_SHOWN_SIZE ? word.length : WORD_SHOWN_SIZE - 1;
    for (size_t i = 0; i < length; i++)
        shown[i] = word.start[i] >= ' ' && word.start[i] <= '~' ? word.start[i] : '?';
    shown[length] = '\0';
    if (word.length > length)
        memcpy(shown + length - 3, "...", 3);
    return shown;
}

enum status text_fail(const struct text *text, struct error *err, const char *format, ...)
{
    char what[ERROR_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(err, STATUS_INPUT, "%s:%zu: %s", text->path, text->line, what);
}
