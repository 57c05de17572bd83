/*
 * What is wrong with the text of a scene, in words, where libconfig says no more than "syntax error", or
 * nothing: it cuts whole numbers to 32 bits. And what it would refuse although everybody can read it:
 * [0, 1, 2.5].
 *
 *     struct scene_slip slip;
 *     if (scene_find_cut_number(text, &slip)) ...             before libconfig reads it
 *     scene_loosen_arrays(text);                              likewise
 *     if (!config_read_string(&config, text) && scene_find_slip(text, &slip)) ...
 */
#ifndef COMMON_SCENE_SYNTAX_H
#define COMMON_SCENE_SYNTAX_H

#include <stdbool.h>

struct scene_slip {
    unsigned line;  /* from 1 */
    char text[200]; /* "a comma is missing before `{`" */
    unsigned open;  /* the line of the bracket that the text ends with; 0: it ends with none */
};

/* `@include "NAME"` in a text: from `begin` to `end`, on that line. */
struct scene_include {
    const char *begin, *end, *name, *name_end;
    unsigned line;
};

/* The first that begins a line of `text` at or behind include->end, which is on include->line. False: there
 * is none. */
bool scene_find_include(const char *text, struct scene_include *include);

/* The first whole number of `text` beyond 32 bits. False: there is none. */
bool scene_find_cut_number(const char *text, struct scene_slip *slip);

/*
 * Rows of numbers in brackets, also rows of such rows, get parentheses in their place, in which libconfig
 * lets whole numbers stand beside others. No line changes its number, and no place its column.
 */
void scene_loosen_arrays(char *text);

/* The first place where `text`, which libconfig refused, leaves its grammar. False: none is found. */
bool scene_find_slip(const char *text, struct scene_slip *slip);

#endif
