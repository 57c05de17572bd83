/* A black picture of a size. */
#ifndef TESTS_UNIT_PICTURES_H
#define TESTS_UNIT_PICTURES_H

#include "check.h"
#include "render/image.h"

static inline struct image a_picture(int width, int height)
{
    struct error err;
    struct image image = {0};
    assert_ok(image_init(&image, width, height, &err), &err);
    return image;
}

#endif
