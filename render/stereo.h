/* Two eyes' pictures on one another: red and cyan, or row by row. */
#ifndef RENDER_STEREO_H
#define RENDER_STEREO_H

#include "render/gl.h"
#include "render/render.h"
#include "render/target.h"

struct stereo {
    GLuint program, nothing; /* and an empty vertex array */
    GLuint pictures[2];      /* textures: the left eye's, the right one's */
    GLint first_row, red_cyan;
};

/* True for RENDER_RED_CYAN and RENDER_INTERLACED. */
bool stereo_is_mixed(enum render_stereo stereo);

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status stereo_open(struct stereo *stereo, const struct gl *gl, struct error *err);
void stereo_close(struct stereo *stereo, const struct gl *gl);

/* Copies the target's picture as that of eye 0 (left) or 1. */
void stereo_keep(const struct stereo *stereo, const struct gl *gl, const struct target *target, int eye);

/* Draws both into the target, whose lowest row is the picture's row `below` from below. */
void stereo_mix(const struct stereo *stereo, const struct gl *gl, const struct target *target,
                const struct render_view *view, int below);

#endif
