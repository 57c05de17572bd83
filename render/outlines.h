/*
 * Smooths the steps of outlines in a picture that is drawn already, with one sample a pixel: for a fraction
 * of the price of several samples, and nearly as well where both sides of an outline are even.
 *
 * Where neighbours differ in lightness an edge lies between them. It is followed both ways to where it steps
 * into the next row of pixels; a line from the middle of one step to the middle of the other is about what
 * was cut into steps, and a pixel takes from its neighbour what lies beyond that line. So A. Reshetov,
 * "Morphological antialiasing" (HPG 2009); that each pixel looks for itself, in one pass, is after T. Lottes,
 * "FXAA" (NVIDIA white paper, 2009).
 */
#ifndef RENDER_OUTLINES_H
#define RENDER_OUTLINES_H

#include "render/gl.h"
#include "render/target.h"

struct outlines {
    GLuint program, nothing; /* and an empty vertex array */
    GLuint picture;          /* texture: what was drawn */
    GLint box;
    int width, height; /* of the texture */
};

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status outlines_open(struct outlines *outlines, const struct gl *gl, struct error *err);
void outlines_close(struct outlines *outlines, const struct gl *gl);

/* Filters what the target, of one sample a pixel, holds in the box (x, y from below, width, height); what
 * lies beyond is not looked at. The viewport is the box afterwards. */
void outlines_filter(struct outlines *outlines, const struct gl *gl, const struct target *target,
                     const int box[4]);

#endif
