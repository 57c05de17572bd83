/* A small font of dots, for labels on pictures and text in windows. */
#ifndef RENDER_FONT_H
#define RENDER_FONT_H

#include <stdint.h>

/* In dots: a letter's grid; how much of its height is above the line; from one line's top to the next.
 * Letters are FONT_WIDTH + 1 apart. */
enum { FONT_WIDTH = 5, FONT_HEIGHT = 9, FONT_LINE = 7, FONT_STEP = 12 };

/* Bit FONT_WIDTH * row + column, from the upper left, for each dot of a letter; a full block for what is not
 * printable ASCII. */
uint64_t font_dots(char letter);

/* The pixels that a text of lines takes, each dot scale x scale. */
void font_size(const char *text, int scale, int *width, int *height);

#endif
