/* The picture that the graphics card draws into, off-screen: sRGB, depth, one or four samples a pixel. */
#ifndef RENDER_TARGET_H
#define RENDER_TARGET_H

#include "render/gl.h"
#include "render/image.h"

#include <stdbool.h>

struct target {
    GLuint drawn, colour, depth;      /* framebuffer and its buffers */
    GLuint resolved, resolved_colour; /* with one sample a pixel, to read from; 0 when `drawn` has that */
    int width, height, samples;
    unsigned char *pixels; /* [height][width][4] read back, the bottom row first */
};

/* Makes it that size and binds what is drawn into; kept where it is so already. `{0}` is an empty target.
 * Errors: STATUS_NO_MEMORY, STATUS_RESOURCE (more than this OpenGL can draw); then it is empty. */
enum status target_bind(struct target *target, const struct gl *gl, int width, int height, int samples,
                        struct error *err);

/* With several samples a pixel: binds the picture of one sample that is read in the end, so that what needs
 * no smooth edges is drawn there; binds what is drawn into again; and copies a box (x, y from below, width,
 * height) of that over. */
GLuint target_read_from(const struct target *target); /* the framebuffer of one sample */
void target_bind_drawn(const struct target *target, const struct gl *gl);
void target_bind_resolved(const struct target *target, const struct gl *gl);
void target_resolve(const struct target *target, const struct gl *gl, const int box[4]);

/* Copies the lowest `rows` rows to the image, as wide as the target, from its row `below` from below upwards.
 * Errors: STATUS_NO_MEMORY. */
enum status target_read(struct target *target, const struct gl *gl, struct image *out, int below, int rows,
                        struct error *err);

/* The same, to a buffer of the window: GL_BACK, or of two GL_BACK_LEFT or GL_BACK_RIGHT. */
void target_show(const struct target *target, const struct gl *gl, GLenum buffer, int below, int rows);

void target_clear(struct target *target, const struct gl *gl);

#endif
