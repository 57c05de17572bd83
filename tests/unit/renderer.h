/* A renderer for the tests of a program, what it draws, and how its pixels are read. */
#ifndef TESTS_UNIT_RENDERER_H
#define TESTS_UNIT_RENDERER_H

#include "check.h"
#include "render/render.h"

static struct render *renderer; /* from open_renderer() to close_renderer(): a group's setup and teardown */

static inline int open_renderer(void **state)
{
    struct error err;
    (void)state;
    assert_ok(render_open(200, 200, &renderer, &err), &err);
    return 0;
}

static inline int close_renderer(void **state)
{
    (void)state;
    render_close(renderer);
    return 0;
}

/* From (0, 0, 10), y up, 4 units high at the origin, which lies in the screen plane; eyes 1 apart. */
static inline struct render_camera front_camera(void)
{
    return (struct render_camera){.eye = {0, 0, 10},
                                  .up = {0, 1, 0},
                                  .field_of_view_deg = 2 * atan(0.2) * 180 / M_PI,
                                  .eye_distance = 1,
                                  .screen_distance = 10};
}

static inline struct image drawn(const struct render_view *view, const struct render_skin *skins,
                                 size_t count)
{
    struct error err;
    struct image image = {0};
    assert_ok(render_draw(renderer, view, skins, count, &image, &err), &err);
    assert_int_equal(image.width, view->width);
    assert_int_equal(image.height, view->height);
    return image;
}

/* sRGB's curve, IEC 61966-2-1, from 0 .. 255 to linear light 0 .. 1. */
static inline double linear(unsigned char value)
{
    double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

#endif
