/* How the faces of a solid get onto the picture. */
#ifndef RENDER_SOLID_DRAW_H
#define RENDER_SOLID_DRAW_H

#include "render/camera.h"
#include "render/geometry.h"
#include "render/gl.h"
#include "render/solid.h"

struct solid_draw {
    GLuint program;
    GLint to_clip, sides, smooth_light, edges; /* its uniforms */
};

/* A corner of a face. */
struct solid_vertex {
    uint16_t place[3], side;
    uint32_t colour; /* linear, 10 bits each, red lowest */
    int8_t normal[4];
};

/* The faces of a block, sorted by side: those of side s are first[s] .. first[s + 1]. */
struct solid_block {
    uint64_t key;
    GLuint array, buffer; /* 4 solid_vertex a face */
    uint32_t first[7];
    uint16_t low[3], high[3]; /* its bounds in cells */
};

struct render_solid {
    struct render *render;
    double origin[3], cell;
    struct {
        struct solid_block *items;
        size_t count, capacity;
    } blocks;
    uint32_t *slot; /* [slot_count] a hash table of the keys: block + 1, 0 where free */
    size_t slot_count;
    struct {
        struct solid_vertex *items;
        size_t count, capacity;
    } spare; /* the vertices of a block on their way */
};

/* Errors: STATUS_RESOURCE with the compiler's message. */
enum status solid_draw_open(struct solid_draw *draw, const struct gl *gl, struct error *err);
void solid_draw_close(struct solid_draw *draw, const struct gl *gl);

/* Opaque, by depth. */
void solid_draw_eye(const struct solid_draw *draw, const struct gl *gl, const struct render_view *view,
                    const struct camera_eye *eye, const struct geometry *geometry,
                    const struct render_scene *scene);

/* Its bounds in the scene; false when it is empty. */
bool solid_bounds(const struct render_solid *solid, double low[3], double high[3]);

#endif
