/*
 * A picture in memory, and how it becomes a PNG file.
 *
 *     struct image image = {0};
 *     if (image_init(&image, 640, 480, err)) ...        black
 *     struct image_text text = {"Title", "fox"};
 *     if (image_save_png(&image, "fox.png", &text, 1, err)) ...
 *     image_clear(&image);
 */
#ifndef RENDER_IMAGE_H
#define RENDER_IMAGE_H

#include "common/file.h"
#include "common/status.h"

#include <stddef.h>

enum { IMAGE_SIDE_MAX = 16384 };

struct image {
    int width, height;
    unsigned char *rgb; /* [height][width][3], sRGB, the top row first */
};

/* Allocates a black picture; what *image held is not freed. Errors: STATUS_RANGE for a side outside
 * 1 .. IMAGE_SIDE_MAX, STATUS_NO_MEMORY; then *image is as it was. */
enum status image_init(struct image *image, int width, int height, struct error *err);
void image_clear(struct image *image);

/* Makes *image that size, keeping its memory where the size is the same already. Pixels are not defined
 * then. Errors as image_init(). */
enum status image_resize(struct image *image, int width, int height, struct error *err);

/* A text chunk of a PNG file: key is 1 to 79 characters of Latin-1 ("Title", "Software"). Text that is not
 * ASCII is stored as UTF-8. */
struct image_text {
    const char *key, *value;
};

/* Writes path, complete or not at all. Chosen for speed: RGB of 8 bits, filter "sub", zlib's level 1.
 * Errors: STATUS_FILE, STATUS_NO_MEMORY. Different pictures may be saved from different threads at once. */
enum status image_save_png(const struct image *image, const char *path, const struct image_text *texts,
                           size_t text_count, struct error *err);

/* The same as bytes in memory; *png is overwritten, free it with bytes_clear(). Errors: STATUS_NO_MEMORY. */
enum status image_encode_png(const struct image *image, const struct image_text *texts, size_t text_count,
                             struct bytes *png, struct error *err);

#endif
