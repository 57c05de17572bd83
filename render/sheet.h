/*
 * A contact sheet: twelve moments of a run on one picture, 4 x 3, evenly spaced in how much the picture
 * changes, each labelled with its time. Where something happens that is counted, three quarters of the way
 * are even in that count instead, and labels tell it. What a tile is too narrow for is left out of its label.
 *
 *     struct sheet sheet = {.counted = "edges broken", .counted_one = "edge broken"};
 *     sheet.count_now = 17;
 *     if (sheet_add(&sheet, &image, time, err)) ...       for each picture, all of one size
 *     if (sheet_draw(&sheet, &image_out, err)) ...
 *     sheet_clear(&sheet);
 *
 * It keeps at most SHEET_KEPT reduced pictures: when there is one too many, that one goes whose neighbours
 * differ least.
 */
#ifndef RENDER_SHEET_H
#define RENDER_SHEET_H

#include "render/image.h"

enum { SHEET_COLUMNS = 4, SHEET_ROWS = 3, SHEET_MOMENTS = 12, SHEET_KEPT = 48 };

struct sheet_moment {
    struct image image; /* reduced to a tile of the sheet */
    double time;
    double change; /* of the picture since the first: sum of mean absolute differences, in 1/255 */
    double counted;
};

struct sheet {
    struct sheet_moment moments[SHEET_KEPT + 1]; /* the last is always the last picture */
    int count;
    const char *counted;     /* what is counted, borrowed; NULL: nothing */
    const char *counted_one; /* the same of a single one */
    double count_now;        /* of that, in the next picture; it never falls */
};

/* Errors: STATUS_NO_MEMORY. */
enum status sheet_add(struct sheet *sheet, const struct image *image, double time, struct error *err);

/* Makes the sheet in *out; fewer tiles where there were fewer pictures. Errors: STATUS_RANGE without any,
 * STATUS_NO_MEMORY. */
enum status sheet_draw(const struct sheet *sheet, struct image *out, struct error *err);

/* The moments it shows, by their index, in `chosen`; returns how many. */
int sheet_choose(const struct sheet *sheet, int chosen[SHEET_MOMENTS]);

/* As many decimals of their times as tell each of the chosen moments from the next, 6 at most. */
int sheet_decimals(const struct sheet *sheet, const int chosen[], int count);

void sheet_clear(struct sheet *sheet);

/* Writes a line of text in dark grey with its upper left corner at x, y; each dot of the letters (font.h) is
 * scale x scale pixels. What lies outside the image is left out. label.c */
void label_draw(struct image *image, int x, int y, int scale, const char *text);

#endif
