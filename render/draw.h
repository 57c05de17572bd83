/*
 * Draws geometry into whatever framebuffer is bound, with the functions of whatever context is current: the
 * off-screen one or a window's. The framebuffer should be sRGB.
 *
 *     struct draw draw = {0};
 *     if (draw_open(&draw, &gl, err)) ...
 *     draw_upload(&draw, &gl, &geometry);                         for each frame
 *     draw_behind(&draw, &gl, &view, &eye, &geometry, 0);         for each eye
 *     draw_eye(&draw, &gl, &eye, &geometry);
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

/* Hands the geometry over, once a frame. */
void draw_upload(const struct draw *draw, const struct gl *gl, const struct geometry *geometry);

/* Sets the viewport; draws backdrop and shadow as one eye sees them, within the scissor's rectangle, and begins
 * the depth there anew. The framebuffer's lowest row is the picture's row `below` from below: a large picture
 * may be drawn in bands. */
void draw_behind(const struct draw *draw, const struct gl *gl, const struct render_view *view,
                 const struct camera_eye *eye, const struct geometry *geometry, int below);

/* The skins, over that and whatever has been drawn since. */
void draw_eye(const struct draw *draw, const struct gl *gl, const struct camera_eye *eye,
              const struct geometry *geometry);

#endif
