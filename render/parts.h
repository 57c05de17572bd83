/* What a struct render is made of, for those who draw a part of the picture. */
#ifndef RENDER_PARTS_H
#define RENDER_PARTS_H

#include "render/behind.h"
#include "render/context.h"
#include "render/draw.h"
#include "render/light.h"
#include "render/outlines.h"
#include "render/overlay_draw.h"
#include "render/program.h"
#include "render/solid_draw.h"
#include "render/stereo.h"
#include "render/target.h"
#include "render/window.h"

struct render {
    struct context *context; /* one of these */
    struct window *window;
    struct gl gl;
    struct draw draw;
    struct solid_draw solid;
    struct overlay overlay;
    struct quads quads;
    struct target target;
    struct behind behind;
    struct light light;       /* open only once a picture wants it */
    struct stereo stereo;     /* the same */
    struct outlines outlines; /* the same */
    struct geometry geometry;
    struct cells cells[2]; /* of each eye, where triangles are sorted */
    struct {
        double (*items)[3];
        size_t count, capacity;
    } points; /* of solid and lines, for the geometry */
};

/* Makes its context current. */
enum status render_use(struct render *render, struct error *err);

/* Draws the scene, whose geometry is built and uploaded, band by band: into *out, or, where that is NULL, the
 * window. bands.c */
enum status render_bands(struct render *render, const struct render_view *view,
                         const struct render_scene *scene, struct image *out, struct error *err);

/* True where the picture is made in linear light first: latex, exact order, several samples. */
bool render_in_light(const struct render_view *view);

/* Opens what that and the stereo need. */
enum status render_ready(struct render *render, const struct render_view *view, struct error *err);

/* Makes the target as large as a band of such a picture and binds it. */
enum status render_bind_band(struct render *render, const struct render_view *view, struct error *err);

#endif
