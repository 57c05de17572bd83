/*
 * A picture in linear light, of half floats, with layers in exact order and several samples a pixel side by
 * side; and its way to the screen through a tone curve. It holds a strip of the whole picture at a time.
 *
 *     struct light light = {0};
 *     if (light_open(&light, &gl, err)) ...                             once
 *     if (light_bind(&light, &gl, width, height, samples, err)) ...     for each strip; then draw what is opaque
 *     light_layers(&light, &gl, order, draw, self);                     the translucent, in order
 *     light_finish(&light, &gl);                                        no more is drawn
 *     light_tone(&light, &gl, corner, side, exposure);                  into what is bound
 *     light_close(&light, &gl);
 */
#ifndef RENDER_LIGHT_H
#define RENDER_LIGHT_H

#include "render/gl.h"
#include "render/render.h"

enum light_texture {
    LIGHT_COLOUR,
    LIGHT_DEPTH,
    LIGHT_LAYER,
    LIGHT_PASSING,
    LIGHT_PEELED,
    LIGHT_PEELED_TOO,
    LIGHT_TEXTURES
};

enum { LIGHT_NODE_WORDS = 5 }; /* of a fragment in a list */

struct light {
    GLuint texture[LIGHT_TEXTURES];   /* the last four only once layers are peeled */
    GLuint drawn, layer;              /* framebuffers: of colour and depth, and for peeling */
    GLuint smooth, smooth_buffers[2]; /* the same with four samples a pixel, to be resolved; 0 without */
    GLuint tone, compose, list;       /* programs */
    GLint tone_corner, tone_side, tone_exposure, list_width;
    GLuint nothing, query, heads, nodes; /* an empty vertex array; buffers of the lists */
    size_t room, most;                   /* fragments that the lists hold, and can */
    int width, height, samples;          /* of the textures, which may be larger than the strip */
    int strip[2];                        /* its width and height */
    bool lists;                          /* this OpenGL has storage buffers */
};

/* What draws the translucent triangles: all of them, with the shaders of one way. `width`, `room`: of the
 * lists. */
enum light_way { LIGHT_BLENDED, LIGHT_PEELING, LIGHT_LISTED, LIGHT_WAYS };
struct light_pass {
    enum light_way way;
    int width;
    uint32_t room;
};
typedef void light_draw(void *self, const struct light_pass *pass);

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status light_open(struct light *light, const struct gl *gl, struct error *err);
void light_close(struct light *light, const struct gl *gl);

/* Makes it at least that large and binds what is drawn into; 4 samples a pixel or 1. Errors: STATUS_RESOURCE,
 * STATUS_NO_MEMORY. */
enum status light_bind(struct light *light, const struct gl *gl, int width, int height, int samples,
                       struct error *err);

/* The translucent triangles over what is drawn, hidden by its depth. RENDER_LIST peels where there are no
 * storage buffers or more fragments than one holds. layers.c */
void light_layers(struct light *light, const struct gl *gl, enum render_order order, light_draw *draw,
                  void *self);

/* After the last triangle: with four samples a pixel, takes their mean. */
void light_finish(const struct light *light, const struct gl *gl);

/* Draws the strip with its lower left corner at `corner` (pixels), side x side samples a pixel, into the
 * framebuffer that is bound. exposure 0: without the tone curve. */
void light_tone(const struct light *light, const struct gl *gl, const int corner[2], int side,
                float exposure);

/* Makes one of the textures, in the light's size. */
void light_texture_new(struct light *light, const struct gl *gl, enum light_texture which);

#endif
