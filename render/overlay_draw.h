/* How lines and text get onto the picture. */
#ifndef RENDER_OVERLAY_DRAW_H
#define RENDER_OVERLAY_DRAW_H

#include "render/camera.h"
#include "render/geometry.h"
#include "render/gl.h"
#include "render/overlay.h"
#include "render/program.h"

struct overlay_line_vertex {
    float from[3], to[3]; /* in camera space */
    float end, side;      /* 0 or 1; -1 or 1 */
    float width;
    float colour[4];
};

struct overlay_text_vertex {
    float place[2]; /* pixels from the upper left corner of an eye's picture */
    float dot[2];   /* in the letter's grid of FONT_WIDTH x FONT_HEIGHT */
    uint32_t dots[2];
    float colour[4];
};

struct overlay {
    GLuint line_program, text_program, line_array, text_array, line_buffer, text_buffer;
    GLint line_projection, line_eye, line_size, text_size; /* uniforms */
    struct {
        struct overlay_line_vertex *items;
        size_t count, capacity;
    } lines; /* 4 a line; those that are hidden by depth first */
    struct {
        struct overlay_text_vertex *items;
        size_t count, capacity;
    } text;
    size_t hidden_lines; /* how many of the lines are hidden by depth */
    double widest;       /* line, in pixels */
};

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status overlay_open(struct overlay *overlay, const struct gl *gl, struct error *err);
void overlay_close(struct overlay *overlay, const struct gl *gl);

/* Hands a frame's lines and texts over. Errors: STATUS_RANGE naming a line, STATUS_NO_MEMORY. */
enum status overlay_upload(struct overlay *overlay, const struct gl *gl, struct quads *quads,
                           const struct render_view *view, const struct render_scene *scene,
                           struct error *err);

/* Over what is drawn: what is nearer than the depth there, and what is on top. */
void overlay_draw_lines(const struct overlay *overlay, const struct gl *gl, const struct camera_eye *eye,
                        const struct geometry *geometry);

/* The rest: what is as far as the depth there, or farther. */
void overlay_draw_lines_behind(const struct overlay *overlay, const struct gl *gl,
                               const struct camera_eye *eye, const struct geometry *geometry);

/* Over everything. The viewport is that of the eye's picture. */
void overlay_draw_text(const struct overlay *overlay, const struct gl *gl, const struct camera_eye *eye);

#endif
