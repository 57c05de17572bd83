#include "common/scene_syntax.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum kind { END, WORD, NUMBER, TEXT, MARK };

struct token {
    enum kind kind;
    const char *from;
    size_t length;
    unsigned line;
};

struct scan {
    const char *at;
    unsigned line;
};

/* As much of the text as belongs to a comment or is empty. */
static size_t gap(const char *at)
{
    if (isspace((unsigned char)*at))
        return 1;
    if (*at == '#' || *at == '@' || !strncmp(at, "//", 2))
        return strcspn(at, "\n");
    if (strncmp(at, "/*", 2))
        return 0;
    const char *end = strstr(at + 2, "*/");
    return end ? (size_t)(end - at) + 2 : strlen(at);
}

static size_t number_length(const char *at)
{
    size_t length = *at == '-' || *at == '+';
    if (!isdigit((unsigned char)at[length + (at[length] == '.')]))
        return 0;
    while (isalnum((unsigned char)at[length]) || at[length] == '.' ||
           ((at[length] == '-' || at[length] == '+') && tolower((unsigned char)at[length - 1]) == 'e'))
        length++;
    return length;
}

static bool is_beyond_ascii(char c)
{
    return (unsigned char)c >= 0x80;
}

static size_t text_length(const char *at)
{
    size_t length = 1;
    while (at[length] && at[length] != '"')
        length += at[length] == '\\' && at[length + 1] ? 2 : 1;
    return length + (at[length] == '"');
}

static size_t word_length(const char *at)
{
    size_t length = 0;
    while (isalnum((unsigned char)at[length]) || (at[length] && strchr("-_*.", at[length])))
        length++;
    return length;
}

/* A letter of UTF-8, as a quote that a word processor set, is one mark. */
static size_t mark_length(const char *at)
{
    size_t length = 1;
    while (is_beyond_ascii(*at) && ((unsigned char)at[length] & 0xC0) == 0x80)
        length++;
    return length;
}

static void pass(struct scan *scan, size_t length)
{
    for (; length > 0; length--)
        scan->line += *scan->at++ == '\n';
}

static struct token next(struct scan *scan)
{
    for (size_t empty; (empty = gap(scan->at)) > 0;)
        pass(scan, empty);
    const char *at = scan->at;
    struct token token = {END, at, 0, scan->line};
    size_t length = number_length(at);
    if (length > 0)
        token.kind = NUMBER;
    else if (*at == '"') {
        token.kind = TEXT;
        length = text_length(at);
    } else if (isalpha((unsigned char)*at) || *at == '*') {
        token.kind = WORD;
        length = word_length(at);
    } else if (*at) {
        token.kind = MARK;
        length = mark_length(at);
    }
    token.length = length;
    pass(scan, length);
    return token;
}

/* As much of it as a message shows. */
static int shown(const struct token *token)
{
    enum { MOST = 40 };
    return token->length < MOST ? (int)token->length : MOST;
}

static bool is(const struct token *token, char mark)
{
    return token->kind == MARK && *token->from == mark;
}

static bool opens(const struct token *token)
{
    return is(token, '{') || is(token, '(') || is(token, '[');
}

static bool closes(const struct token *token)
{
    return is(token, '}') || is(token, ')') || is(token, ']');
}

static bool say(struct scene_slip *slip, unsigned line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static bool say(struct scene_slip *slip, unsigned line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(slip->text, sizeof slip->text, format, arguments);
    va_end(arguments);
    slip->line = line;
    return true;
}

/* Whether the reader is before one, which begins its line. */
static bool is_include(const char *text, const struct scan *scan, struct scene_include *include)
{
    static const char word[] = "@include";
    const char *begin = scan->at, *name = scan->at + strlen(word);
    while (begin > text && (begin[-1] == ' ' || begin[-1] == '\t'))
        begin--;
    if ((begin > text && begin[-1] != '\n') || strncmp(scan->at, word, strlen(word)))
        return false;
    name += strspn(name, " \t");
    const size_t length = *name == '"' ? text_length(name) : 0;
    if (length < 2 || name[length - 1] != '"' || memchr(name, '\n', length))
        return false;
    *include = (struct scene_include){scan->at, name + length, name + 1, name + length - 1, scan->line};
    return true;
}

bool scene_find_include(const char *text, struct scene_include *include)
{
    struct scan scan = {include->end, include->line};
    for (struct token token = {.kind = MARK}; token.kind != END; token = next(&scan))
        for (size_t empty; (empty = gap(scan.at)) > 0; pass(&scan, empty))
            if (is_include(text, &scan, include))
                return true;
    return false;
}

bool scene_find_cut_number(const char *text, struct scene_slip *slip)
{
    static const char most[] = "a whole number without a point goes to 2147483647; write";
    struct scan scan = {text, 1};
    for (struct token token = next(&scan); token.kind != END; token = next(&scan)) {
        const bool hexadecimal = !strncasecmp(token.from, "0x", 2);
        char *end;
        const long long value = token.kind == NUMBER ? strtoll(token.from, &end, hexadecimal ? 16 : 10) : 0;
        if ((value <= INT32_MAX && value >= INT32_MIN) || end != token.from + token.length)
            continue;
        if (hexadecimal)
            return say(slip, token.line, "%.*s: %s it in decimals", shown(&token), token.from, most);
        return say(slip, token.line, "%.*s: %s %.*s.0", shown(&token), token.from, most, shown(&token),
                   token.from);
    }
    return false;
}

enum { DEEPEST = 64 }; /* brackets in brackets */

/* As long as the row of numbers is whose `[` was just read, its `]` included; 0: it is none. */
static size_t row_length(struct scan scan)
{
    const char *from = scan.at;
    for (int open = 1; open > 0;) {
        const struct token token = next(&scan);
        if (is(&token, '[') || is(&token, ']'))
            open += is(&token, '[') ? 1 : -1;
        else if (token.kind != NUMBER && !is(&token, ','))
            return 0;
        if (open > DEEPEST) /* or time would grow with the square of what is open */
            return 0;
    }
    return (size_t)(scan.at - from);
}

void scene_loosen_arrays(char *text)
{
    struct scan scan = {text, 1};
    size_t end = 0; /* of the row that is being loosened */
    for (struct token token = next(&scan); token.kind != END; token = next(&scan)) {
        const size_t at = (size_t)(token.from - text);
        if (is(&token, '[') && at >= end) {
            const size_t length = row_length(scan);
            end = length > 0 ? at + 1 + length : end;
        }
        if (at < end && (is(&token, '[') || is(&token, ']')))
            text[at] = *token.from == '[' ? '(' : ')';
    }
}

/* Where in the grammar the reader is. */
enum state { KEY, EQUALS, VALUE, AFTER };

struct reader {
    struct scan scan;
    struct token open[DEEPEST]; /* brackets that are not closed */
    int depth;
    enum state state;
    struct token key, before; /* the last key, the last token */
    struct scene_slip *slip;
};

static bool in_group(const struct reader *r)
{
    return r->depth == 0 || is(&r->open[r->depth - 1], '{');
}

/* The bracket that is to come, for one that is open. */
static char partner(const struct token *open)
{
    return is(open, '{') ? '}' : is(open, '(') ? ')' : ']';
}

/* A bracket that closes, or the end of the text. True: that is wrong. */
static bool close_one(struct reader *r, const struct token *token)
{
    if (r->depth == 0)
        return token->kind != END && say(r->slip, token->line, "`%c` closes nothing", *token->from);
    const struct token *open = &r->open[--r->depth];
    const char wanted = partner(open);
    if (token->kind == END)
        return say(r->slip, open->line, "`%c` is never closed; a `%c` is missing", *open->from, wanted);
    r->state = AFTER;
    if (is(token, wanted))
        return false;
    r->slip->open = open->line;
    return say(r->slip, token->line, "`%c` comes before the `%c` that closes the `%c`", *token->from, wanted,
               *open->from);
}

/* Where a key is wanted. */
static bool read_key(struct reader *r, const struct token *token)
{
    const struct token before = r->before;
    if (token->kind == END || closes(token))
        return close_one(r, token);
    if (token->kind == NUMBER && is(&before, ',') && before.from[-1] >= '0' && before.from[-1] <= '9')
        return say(r->slip, token->line,
                   "`,%.*s`: decimals stand behind a point, several numbers in brackets: [0, 1, 2.5]",
                   shown(token), token->from);
    if (token->kind == TEXT)
        return say(r->slip, token->line, "%.*s: the names of keys stand without quotes", shown(token),
                   token->from);
    if (opens(token))
        return say(r->slip, token->line, "`%c` has no name; write name = %c ... %c", *token->from,
                   *token->from, partner(token));
    if (token->kind == NUMBER && is(&before, '{'))
        return say(r->slip, token->line, "`{ %.*s`: numbers stand in brackets: [0, 1, 2.5]", shown(token),
                   token->from);
    if (token->kind != WORD)
        return say(r->slip, token->line, "`%.*s` stands where a key is wanted", shown(token), token->from);
    r->key = *token;
    r->state = EQUALS;
    return false;
}

static bool read_equals(struct reader *r, const struct token *token, const struct token *before_key)
{
    r->state = VALUE;
    if (is(token, '=') || is(token, ':'))
        return false;
    if (before_key->kind == NUMBER && before_key->line == r->key.line)
        return say(r->slip, r->key.line, "`%.*s %.*s`: numbers stand without units", shown(before_key),
                   before_key->from, shown(&r->key), r->key.from);
    return say(r->slip, r->key.line, "`=` is missing behind `%.*s`", shown(&r->key), r->key.from);
}

/* Where a value is wanted: behind a key, or in a list. */
static bool read_value(struct reader *r, const struct token *token)
{
    r->state = AFTER;
    if (opens(token)) {
        if (r->depth == DEEPEST)
            return say(r->slip, token->line, "more than %d brackets are open", DEEPEST);
        if (is(token, '{') && r->depth > 0 && is(&r->open[r->depth - 1], '['))
            return say(r->slip, token->line, "blocks stand in parentheses: ( { ... }, { ... } )");
        r->open[r->depth++] = *token;
        r->state = in_group(r) ? KEY : VALUE;
        return false;
    }
    if (!in_group(r) && (token->kind == END || closes(token)))
        return is(&r->before, ',') ? say(r->slip, r->before.line, "nothing stands behind the last `,`")
                                   : close_one(r, token);
    if (token->kind == NUMBER) {
        char *end;
        (void)strtod(token->from, &end);
        const bool whole = end == token->from + token->length;
        return !whole && !(*end == 'L') &&
               say(r->slip, token->line, "`%.*s` is no number; numbers stand without units", shown(token),
                   token->from);
    }
    if (token->kind == TEXT)
        return memchr(token->from, '\n', token->length) &&
               say(r->slip, token->line, "a quote is not closed in its line");
    if (token->kind == WORD &&
        (!strncasecmp(token->from, "true", 4) || !strncasecmp(token->from, "false", 5)))
        return false;
    struct scan ahead = r->scan;
    const struct token then = next(&ahead);
    if (token->kind == WORD && !in_group(r) && is(&then, '='))
        return say(r->slip, token->line, "a list is made of blocks: ( { %.*s = ...; }, { ... } )",
                   shown(token), token->from);
    if (token->kind == WORD || is_beyond_ascii(*token->from))
        return say(r->slip, token->line,
                   "`%.*s` is no value; numbers are written with digits, text in quotes", shown(token),
                   token->from);
    return say(r->slip, token->line, "nothing stands behind `%.*s =`", shown(&r->key), r->key.from);
}

static bool read_after(struct reader *r, const struct token *token)
{
    if (token->kind == TEXT && r->before.kind == TEXT) /* one text in two pieces */
        return false;
    const bool part = is(token, ',') || (in_group(r) && is(token, ';'));
    if (part || in_group(r)) {
        r->state = in_group(r) ? KEY : VALUE;
        return !part && read_key(r, token);
    }
    if (token->kind == END || closes(token))
        return close_one(r, token);
    const struct token *open = &r->open[r->depth - 1];
    if (is(token, ';')) {
        r->slip->open = open->line;
        return say(r->slip, token->line, "`;` stands where a `,` is wanted, or the `%c` that closes the `%c`",
                   partner(open), *open->from);
    }
    return say(r->slip, token->line, "a `,` is missing before `%.*s`", shown(token), token->from);
}

bool scene_find_slip(const char *text, struct scene_slip *slip)
{
    struct reader r = {.scan = {text, 1}, .slip = slip};
    slip->open = 0;
    struct token token, before_key = {0};
    do {
        token = next(&r.scan);
        bool wrong;
        if (r.state == KEY)
            wrong = read_key(&r, &token);
        else if (r.state == EQUALS)
            wrong = read_equals(&r, &token, &before_key);
        else if (r.state == VALUE)
            wrong = read_value(&r, &token);
        else
            wrong = read_after(&r, &token);
        if (wrong)
            return true;
        before_key = r.before;
        r.before = token;
    } while (token.kind != END);
    return false;
}
