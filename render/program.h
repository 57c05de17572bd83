/* A program of the graphics card, from its sources; and the indices that draw four
 * corners as two triangles. */
#ifndef RENDER_PROGRAM_H
#define RENDER_PROGRAM_H

#include "render/gl.h"

#include <stddef.h>

/* Makes a program of GLSL sources. *program is to be deleted also after an error. Errors: STATUS_RESOURCE
 * with the compiler's message. */
enum status program_link(const struct gl *gl, const char *vertex, const char *fragment, GLuint *program,
                         struct error *err);

/* 0 1 2 2 1 3, 4 5 6 6 5 7, ...: one buffer for all that is drawn as quads. `{0}` is an empty one. */
struct quads {
    GLuint buffer;
    size_t capacity; /* quads */
};

/* Makes it hold `count` quads and keeps its name, so that vertex arrays that know it stay good. Binds it to
 * the vertex array that is bound. Errors: STATUS_NO_MEMORY. */
enum status quads_reserve(struct quads *quads, const struct gl *gl, size_t count, struct error *err);
void quads_clear(struct quads *quads, const struct gl *gl);

#endif
