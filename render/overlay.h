/* What lies over a picture: lines in space; boxes and, over them, lines of text on the glass.
 * See struct render_scene. */
#ifndef RENDER_OVERLAY_H
#define RENDER_OVERLAY_H

#include <stdbool.h>

/* A straight line in space, as wide everywhere. */
struct render_line {
    double from[3], to[3];
    float colour[3]; /* linear light, 0 .. 1 */
    float opacity;   /* 0 .. 1 */
    float width;     /* pixels, 0.5 or more */
    bool on_top;     /* seen through everything; else hidden by what lies before it, or dimmed by such skin */
};

enum { OVERLAY_BOX_MARGIN = 4 }; /* between a text and its box's border, in the text's dots */

/* Text in UTF-8, of the letters that font.h has; '\n' begins a new line, and what is none of them shows as a
 * box. In stereo each eye's picture carries it at the same place. */
struct render_text {
    const char *text;
    int x, y;        /* upper left corner (of the box, if any), from that of one eye's picture, in pixels */
    int scale;       /* 1: letters 7 pixels high; 2: 14; ... */
    float colour[3]; /* linear light, 0 .. 1 */
    bool boxed;      /* a dim box behind it keeps it readable on any picture */
};

/* A rectangle in one colour on the glass: what sliders, legends and small plots are made of. In stereo each
 * eye's picture carries it at the same place. */
struct render_box {
    int x, y, width, height; /* upper left corner from that of one eye's picture, in pixels */
    float colour[3];         /* linear light, 0 .. 1 */
    float opacity;           /* 0 .. 1 */
};

/* How much room it takes, in pixels. */
void render_text_size(const struct render_text *text, int *width, int *height);

#endif
