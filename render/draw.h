/*
 * Draws geometry into whatever framebuffer is bound, with the functions of whatever context is current: the
 * off-screen one of render.c, or a window's. The framebuffer should be sRGB.
 *
 *     struct draw draw = {0};
 *     if (draw_open(&draw, &gl, err)) ...
 *     draw_frame(&draw, &gl, &view, &geometry);     for each frame
 *     draw_close(&draw, &gl);
 */
#ifndef RENDER_DRAW_H
#define RENDER_DRAW_H

#include "render/geometry.h"
#include "render/gl.h"

struct draw {
    GLuint skin, backdrop, shadow;   /* programs */
    GLint skin_projection, skin_eye; /* their uniforms */
    GLint shadow_projection, shadow_corner, shadow_left;
    GLuint arrays, nothing;   /* vertex arrays: the skin's, and one without attributes */
    GLuint vertices, indices; /* buffers */
};

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status draw_open(struct draw *draw, const struct gl *gl, struct error *err);
void draw_close(struct draw *draw, const struct gl *gl);

/* Backdrop, shadow and skins for each eye of the view. */
void draw_frame(const struct draw *draw, const struct gl *gl, const struct render_view *view,
                const struct geometry *geometry);

#endif
