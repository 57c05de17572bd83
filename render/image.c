#include "render/image.h"

#include <stdlib.h>

enum status image_init(struct image *image, int width, int height, struct error *err)
{
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX)
        return error_set(err, STATUS_RANGE, "a picture of %d x %d is not possible; each side must be 1 to %d",
                         width, height, IMAGE_SIDE_MAX);
    unsigned char *rgb = calloc((size_t)width * (size_t)height, 3);
    if (!rgb)
        return error_no_memory(err, "a picture");
    *image = (struct image){width, height, rgb};
    return STATUS_OK;
}

enum status image_resize(struct image *image, int width, int height, struct error *err)
{
    if (image->rgb && image->width == width && image->height == height)
        return STATUS_OK;
    struct image other;
    enum status status = image_init(&other, width, height, err);
    if (status)
        return status;
    image_clear(image);
    *image = other;
    return STATUS_OK;
}

void image_clear(struct image *image)
{
    free(image->rgb);
    *image = (struct image){0};
}
