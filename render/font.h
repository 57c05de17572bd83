/* A small font of dots, for labels on pictures and text in windows. */
#ifndef RENDER_FONT_H
#define RENDER_FONT_H

#include <stddef.h>
#include <stdint.h>

/* In dots: a letter's grid; how much of its height is above the line; from one line's top to the next.
 * Letters are FONT_WIDTH + 1 apart. */
enum { FONT_WIDTH = 5, FONT_HEIGHT = 9, FONT_LINE = 7, FONT_STEP = 12 };

/* The dots of the letter that a text in UTF-8 begins with, and the text behind it: bit FONT_WIDTH * row +
 * column, from the upper left. Latin letters have their accents, capitals have none, marks that stand on
 * their own are passed over; a full block for what is none of these. */
uint64_t font_next(const char **text);

/* How many letters the text has up to its end or that of its line. */
size_t font_letters(const char *text);

/* The pixels that a text of lines takes, each dot scale x scale. */
void font_size(const char *text, int scale, int *width, int *height);

#endif
