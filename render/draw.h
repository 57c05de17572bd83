/*
 * Draws geometry into whatever framebuffer is bound, with the functions of whatever context is current: the
 * off-screen one or a window's. The framebuffer should be sRGB.
 *
 *     struct draw draw = {0};
 *     if (draw_open(&draw, &gl, err)) ...
 *     draw_upload(&draw, &gl, &geometry, NULL);                   for each frame
 *     draw_backdrop(&draw, &gl, &place);                          for each eye
 *     draw_shadow(&draw, &gl, &place, &eye, &geometry);
 *     draw_eye(&draw, &gl, &place, &eye, &geometry);
 *     draw_close(&draw, &gl);
 */
#ifndef RENDER_DRAW_H
#define RENDER_DRAW_H

#include "render/cells.h"
#include "render/gl.h"
#include "render/light.h"

/* The skins' program of one style and way, made when it is first wanted, and its uniforms. */
struct draw_program {
    GLuint program;
    GLint projection, eye, width, room;
};

struct draw {
    struct draw_program skins[2][LIGHT_WAYS]; /* by enum render_style */
    GLuint backdrop, shadow;
    GLint backdrop_brightness, shadow_projection, shadow_corner, shadow_left;
    GLuint arrays, nothing;   /* vertex arrays: the skin's, and one without attributes */
    GLuint vertices, indices; /* buffers */
    const struct cells *cells;
};

/* Where an eye's whole picture lies in the framebuffer, and which part of it is drawn (x, y, width,
 * height); how bright 1 is. */
struct draw_place {
    int viewport[4], scissor[4];
    float brightness;
    int eye; /* which of draw_upload()'s cells are its */
};

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status draw_open(struct draw *draw, const struct gl *gl, struct error *err);
void draw_close(struct draw *draw, const struct gl *gl);

/* Hands the geometry over, once a frame. `cells`: [2] one for each eye, of the translucent
 * triangles, which are drawn by them where they are blended; borrowed until the next time. NULL:
 * they are drawn as they come. */
void draw_upload(struct draw *draw, const struct gl *gl, const struct geometry *geometry,
                 const struct cells *cells);

/* Makes ready what draws skins of that style that way. Errors: STATUS_RESOURCE with
 * the compiler's message. */
enum status draw_ready(struct draw *draw, const struct gl *gl, enum render_style style, enum light_way way,
                       struct error *err);

/* Sets the viewport and draws the backdrop within the scissor's rectangle. */
void draw_backdrop(const struct draw *draw, const struct gl *gl, const struct draw_place *place);

/* Over it the shadows as one eye sees them; and begins the depth there anew. */
void draw_shadow(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
                 const struct camera_eye *eye, const struct geometry *geometry);

/* The skins' opaque triangles, by depth. */
void draw_opaque(const struct draw *draw, const struct gl *gl, enum render_style style,
                 const struct camera_eye *eye, const struct geometry *geometry);

/* The translucent ones as the pass wants them; blending and depth are the caller's. The program is ready. */
void draw_translucent(const struct draw *draw, const struct gl *gl, enum render_style style,
                      const struct draw_place *place, const struct camera_eye *eye,
                      const struct geometry *geometry, const struct light_pass *pass);

/* The depth of all skins where there is none that is nearer, and no colour. */
void draw_depths(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
                 const struct camera_eye *eye, const struct geometry *geometry);

/* All skins, the translucent ones blended in the geometry's order. */
void draw_eye(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
              const struct camera_eye *eye, const struct geometry *geometry);

#endif
