/* What a window has to say besides its picture: its last message, and on F1 the list of its keys, page by
 * page where the picture is too small for all. */
#ifndef RENDER_HINTS_H
#define RENDER_HINTS_H

#include <stdbool.h>
#include <stddef.h>

struct hints {
    bool help;          /* the keys are shown */
    int page, pages;    /* which page of them, from 0, and of how many, when they were last shown */
    char message[1100]; /* the last thing there was to say; "": nothing */
};

/* The text is cut off where it is longer than any error. */
void hints_say(struct hints *hints, const char *text);

/* The keys for that, the same in every window: F1 and ? show the list, its next page, and hide it; Escape
 * takes all away. False for any other key. */
bool hints_key(struct hints *hints, int key);

/* Breaks lines that are longer than this many letters, at a space where there is one. */
void hints_wrap(char *text, int columns);

/* What is to be shown of a list of keys where a text in a box, in small letters, may have so many pixels:
 * into text, which has room for the list and a line more. The number of pages is noted. */
void hints_page(struct hints *hints, const char *keys, int width, int height, char *text, size_t size);

#endif
