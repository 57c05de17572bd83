#include "render/sheet.h"

#include "render/font.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILE_MAX = 480, GAP = 6 };

/* What a picture that does not change still counts, so that a still run is spaced evenly in time. */
static const double least_change = 1e-4;

/* The mean of each box of pixels that falls into one pixel of `to`, which is no larger. */
static void reduce_row(const struct image *from, struct image *to, int row, uint32_t *sums)
{
    int top = (int)((int64_t)row * from->height / to->height);
    int bottom = (int)((int64_t)(row + 1) * from->height / to->height);
    memset(sums, 0, 3 * (size_t)from->width * sizeof *sums);
    for (int y = top; y < bottom; y++) {
        const unsigned char *line = from->rgb + 3 * (size_t)from->width * (size_t)y;
        for (size_t i = 0; i < 3 * (size_t)from->width; i++)
            sums[i] += line[i];
    }
    unsigned char *out = to->rgb + 3 * (size_t)to->width * (size_t)row;
    for (int x = 0; x < to->width; x++) {
        int left = (int)((int64_t)x * from->width / to->width);
        int right = (int)((int64_t)(x + 1) * from->width / to->width);
        uint64_t total[3] = {0}, count = (uint64_t)(right - left) * (uint64_t)(bottom - top);
        for (int i = left; i < right; i++)
            for (int c = 0; c < 3; c++)
                total[c] += sums[3 * (size_t)i + (size_t)c];
        for (int c = 0; c < 3; c++)
            out[3 * (size_t)x + (size_t)c] = (unsigned char)((total[c] + count / 2) / count);
    }
}

static enum status reduce(const struct image *from, struct image *to, struct error *err)
{
    double scale = fmin(1, (double)TILE_MAX / fmax(from->width, from->height));
    int width = (int)fmax(1, round(from->width * scale)), height = (int)fmax(1, round(from->height * scale));
    uint32_t *sums = malloc(3 * (size_t)from->width * sizeof *sums);
    enum status status = sums ? image_init(to, width, height, err)
                              : error_no_memory(err, "the contact sheet");
    for (int row = 0; row < height && !status; row++)
        reduce_row(from, to, row, sums);
    free(sums);
    return status;
}

static double difference(const struct image *a, const struct image *b)
{
    uint64_t sum = 0;
    size_t count = 3 * (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < count; i++)
        sum += (uint64_t)abs(a->rgb[i] - b->rgb[i]);
    return (double)sum / (double)count;
}

/* Of the way from the first picture to the last: most of what moves after a burst is debris that leaves. */
static const double counted_share = 0.75;

/* How far along the way a moment is, from 0 to 1. */
static double way_of(const struct sheet *sheet, int moment)
{
    const struct sheet_moment *first = &sheet->moments[0], *last = &sheet->moments[sheet->count - 1],
                              *m = &sheet->moments[moment];
    const double change = last->change > 0 ? m->change / last->change : 0;
    const double counted = last->counted - first->counted;
    return counted > 0
               ? counted_share * (m->counted - first->counted) / counted + (1 - counted_share) * change
               : change;
}

/* Drops the inner moment whose going leaves the smallest step. */
static void drop_one(struct sheet *sheet)
{
    int dropped = 1;
    double least = INFINITY;
    for (int i = 1; i + 1 < sheet->count; i++) {
        const double step = way_of(sheet, i + 1) - way_of(sheet, i - 1);
        if (step < least) {
            least = step;
            dropped = i;
        }
    }
    image_clear(&sheet->moments[dropped].image);
    memmove(sheet->moments + dropped, sheet->moments + dropped + 1,
            (size_t)(sheet->count - dropped - 1) * sizeof *sheet->moments);
    sheet->count--;
}

enum status sheet_add(struct sheet *sheet, const struct image *image, double time, struct error *err)
{
    struct sheet_moment moment = {.time = time, .counted = sheet->count_now};
    enum status status = reduce(image, &moment.image, err);
    if (status)
        return status;
    if (sheet->count) {
        const struct sheet_moment *last = &sheet->moments[sheet->count - 1];
        moment.change = last->change + least_change + difference(&last->image, &moment.image);
    }
    sheet->moments[sheet->count++] = moment;
    if (sheet->count > SHEET_KEPT)
        drop_one(sheet);
    return STATUS_OK;
}

/* Takes the moments nearest to so many places that are even along the way; returns how many that are, since
 * steps of the way may be longer than those between places. */
static int take_nearest(const struct sheet *sheet, int places, bool taken[SHEET_KEPT])
{
    int count = 0, at = 0;
    memset(taken, 0, SHEET_KEPT * sizeof *taken);
    for (int k = 0; k < places; k++) {
        const double wanted = (double)k / (places > 1 ? places - 1 : 1);
        while (at + 1 < sheet->count &&
               fabs(way_of(sheet, at + 1) - wanted) <= fabs(way_of(sheet, at) - wanted))
            at++;
        count += !taken[at];
        taken[at] = true;
    }
    return count;
}

/* Takes one more: in the longest step between two that are taken and have others between them, that
 * which is nearest to its middle. */
static void take_one(const struct sheet *sheet, bool taken[SHEET_KEPT])
{
    double longest = -1, least = INFINITY;
    int from = 0, to = 0, found = 0;
    for (int i = 1, before = 0; i < sheet->count; i++) {
        if (!taken[i])
            continue;
        if (i > before + 1 && way_of(sheet, i) - way_of(sheet, before) > longest) {
            longest = way_of(sheet, i) - way_of(sheet, before);
            from = before;
            to = i;
        }
        before = i;
    }
    const double middle = (way_of(sheet, from) + way_of(sheet, to)) / 2;
    for (int i = from + 1; i < to; i++)
        if (fabs(way_of(sheet, i) - middle) < least) {
            least = fabs(way_of(sheet, i) - middle);
            found = i;
        }
    taken[found] = true;
}

int sheet_choose(const struct sheet *sheet, int chosen[SHEET_MOMENTS])
{
    enum { PLACES_MOST = 1000 };
    const int count = sheet->count < SHEET_MOMENTS ? sheet->count : SHEET_MOMENTS;
    bool taken[SHEET_KEPT], more[SHEET_KEPT];
    int have = take_nearest(sheet, count, taken);
    for (int places = count + 1; places < PLACES_MOST; places++) {
        const int found = take_nearest(sheet, places, more);
        if (found > count)
            break;
        have = found;
        memcpy(taken, more, sizeof taken);
    }
    for (; have < count; have++)
        take_one(sheet, taken);
    for (int i = 0, k = 0; i < sheet->count && k < count; i++)
        if (taken[i])
            chosen[k++] = i;
    return count;
}

int sheet_decimals(const struct sheet *sheet, const int chosen[], int count)
{
    double least = INFINITY;
    for (int k = 1; k < count; k++) {
        const double gap = sheet->moments[chosen[k]].time - sheet->moments[chosen[k - 1]].time;
        if (gap > 0)
            least = fmin(least, gap);
    }
    if (least == INFINITY)
        return 3; /* all of one moment */
    const double decimals = ceil(-log10(least) - 1e-9);
    return (int)fmin(fmax(decimals, 0), 6);
}

static int text_width(const char *text, int scale)
{
    return ((int)strlen(text) * (FONT_WIDTH + 1) + 1) * scale;
}

/* Text at the lower border of a tile, on a lighter ground: debris may be anywhere. */
static void draw_text(struct image *out, int left, int bottom, int scale, const char *text)
{
    const int right = left + text_width(text, scale), top = bottom - (FONT_LINE + 2) * scale;
    for (int y = top < 0 ? 0 : top; y < bottom; y++)
        for (int x = left; x < right && x < out->width; x++)
            for (int c = 0; c < 3; c++) {
                unsigned char *value =
                    &out->rgb[3 * ((size_t)y * (size_t)out->width + (size_t)x) + (size_t)c];
                *value = (unsigned char)((*value + 2 * 0xd8) / 3);
            }
    label_draw(out, left + scale, top + scale, scale, text);
}

static void draw_tile(struct image *out, const struct sheet *sheet, const struct sheet_moment *moment,
                      int left, int top, int decimals)
{
    const struct image *tile = &moment->image;
    for (int y = 0; y < tile->height; y++)
        memcpy(out->rgb + 3 * ((size_t)(top + y) * (size_t)out->width + (size_t)left),
               tile->rgb + 3 * (size_t)tile->width * (size_t)y, 3 * (size_t)tile->width);
    char time[64], count[128];
    snprintf(time, sizeof time, fabs(moment->time) < 1e6 ? "%.*f s" : "%.*e s", decimals, moment->time);
    const int scale = tile->height < 120 || 6 + text_width(time, 2) > tile->width ? 1 : 2;
    const int bottom = top + tile->height - 3 * scale;
    if (3 * scale + text_width(time, scale) > tile->width)
        return;
    draw_text(out, left + 3 * scale, bottom, scale, time);
    if (!sheet->counted || !(moment->counted > 0))
        return;
    const int beside = 6 * scale + text_width(time, scale), above = (FONT_LINE + 4) * scale;
    snprintf(count, sizeof count, "%.0f %s", moment->counted,
             moment->counted == 1 ? sheet->counted_one : sheet->counted);
    const int width = text_width(count, 1);
    if (beside + width <= tile->width)
        draw_text(out, left + beside, bottom, 1, count);
    else if (3 * scale + width <= tile->width)
        draw_text(out, left + 3 * scale, bottom - above, 1, count);
}

enum status sheet_draw(const struct sheet *sheet, struct image *out, struct error *err)
{
    if (!sheet->count)
        return error_set(err, STATUS_RANGE, "a contact sheet needs at least one picture");
    int chosen[SHEET_MOMENTS], count = sheet_choose(sheet, chosen);
    const int decimals = sheet_decimals(sheet, chosen, count);
    int columns = count < SHEET_COLUMNS ? count : SHEET_COLUMNS, rows = (count + columns - 1) / columns;
    int width = sheet->moments[0].image.width, height = sheet->moments[0].image.height;
    enum status status = image_init(out, columns * (width + GAP) + GAP, rows * (height + GAP) + GAP, err);
    if (status)
        return status;
    memset(out->rgb, 0xff, 3 * (size_t)out->width * (size_t)out->height);
    for (int k = 0; k < count; k++)
        draw_tile(out, sheet, &sheet->moments[chosen[k]], GAP + k % columns * (width + GAP),
                  GAP + k / columns * (height + GAP), decimals);
    return STATUS_OK;
}

void sheet_clear(struct sheet *sheet)
{
    for (int i = 0; i < sheet->count; i++)
        image_clear(&sheet->moments[i].image);
    *sheet = (struct sheet){0};
}
