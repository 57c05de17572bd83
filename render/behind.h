/* The backdrop of each eye, kept from frame to frame: copying bytes costs a tenth of drawing them anew. */
#ifndef RENDER_BEHIND_H
#define RENDER_BEHIND_H

#include "render/target.h"

struct behind {
    GLuint framebuffer, colour; /* 0: nothing is kept */
    int width, height;
    int kept[2][4]; /* rectangles (x, y from below, width, height) that it holds */
    int count;
};

/* Copies the rectangle into what the target is read from, and binds that; false where it holds none such. The
 * scissor's test is off afterwards. */
bool behind_fetch(struct behind *behind, const struct gl *gl, const struct target *target,
                  const int rectangle[4]);

/* Keeps what lies there, which is the backdrop alone. The same afterwards. */
void behind_keep(struct behind *behind, const struct gl *gl, const struct target *target,
                 const int rectangle[4]);

void behind_clear(struct behind *behind, const struct gl *gl);

#endif
