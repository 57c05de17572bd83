/*
 * Draws meshes as balloon skin, and sculptures of cubes, in one picture or as a stereo pair, without a
 * display or in a window.
 *
 *     struct render_view view = {.width = 1280, .height = 480, .stereo = RENDER_PARALLEL, .order = RENDER_SORT};
 *     const double from[3] = {0.4, 0.3, 1};
 *     if (render_fit_camera(&view, lower, upper, from, 0.1, err)) ...
 *     struct render *render;
 *     if (render_open(view.width, view.height, &render, err)) ...
 *     struct image image = {0};
 *     struct render_skin skin = {.mesh = &mesh, .colour = {0.75f, 0.03f, 0.04f}};
 *     if (render_draw(render, &view, &skin, 1, &image, err)) ...       once a frame
 *     image_clear(&image);
 *     render_close(render);
 *
 * A struct render belongs to the thread that opened it. Colours are linear light, pictures are sRGB. Pixels
 * may differ by a unit or two of 255 between machines.
 */
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include "common/mesh.h"
#include "common/status.h"
#include "render/image.h"

#include <stdbool.h>
#include <stddef.h>

/* Where from and how wide; lengths in the scene's units. */
struct render_camera {
    double eye[3], target[3], up[3];
    double field_of_view_deg; /* vertical, of one eye's picture; above 0, below 180 */
    double eye_distance;      /* between the two eyes, in stereo; 0: both the same */
    double screen_distance;   /* from the eyes to the plane where both pictures agree; in stereo above 0 */
};

/* One picture, or one for each eye: in two halves of the whole, on one another, or an eye's alone. */
enum render_stereo {
    RENDER_MONO,
    RENDER_PARALLEL,   /* the left eye's on the left: for a viewer or mirror glasses, or parallel eyes */
    RENDER_CROSSED,    /* the left eye's on the right: for crossed eyes */
    RENDER_OVER_UNDER, /* the left eye's above */
    RENDER_RED_CYAN,   /* for glasses with the red before the left eye */
    RENDER_INTERLACED, /* rows in turn, the left eye's the first from above */
    RENDER_QUAD,       /* each in a buffer of its own of a window that has two (window.h), and in no image */
    RENDER_LEFT,       /* what the left eye sees */
    RENDER_RIGHT,
};

/* How skins look. */
enum render_style {
    RENDER_PAPER, /* opacity and shininess as they are given, for every skin's triangle */
    RENDER_LATEX, /* rubber: all that its stretch, its film's thickness, says */
};

/* In which order translucent triangles lie over one another. */
enum render_order {
    RENDER_NONE, /* as they come */
    RENDER_SORT, /* back to front, each by one distance (order.h): wrong where triangles overlap in depth */
    RENDER_PEEL, /* exact: layer by layer, as many times over as layers lie over one another */
    RENDER_LIST, /* exact: a list for each pixel; peeled where OpenGL has no storage buffers (4.3) */
};

/* How outlines are drawn where each pixel has one sample. */
enum render_outlines {
    RENDER_ROUGH, /* a pixel is within or without */
    /* Drawn rough, and then their steps smoothed: nearly as good as the next, for much less. */
    RENDER_FILTERED,
    RENDER_SAMPLED, /* with four samples a pixel; rough where order is exact */
};

enum { RENDER_SAMPLES_MAX = 4 };

struct render_view {
    int width, height; /* of the whole picture, 1 .. IMAGE_SIDE_MAX; what is halved, even */
    struct render_camera camera;
    enum render_stereo stereo;
    bool squeezed; /* halves hold pictures of the whole's proportions, for screens that stretch them again */
    enum render_style style;
    enum render_order order;
    int samples; /* each pixel is the mean of samples x samples; 0 or 1: one, at most RENDER_SAMPLES_MAX */
    enum render_outlines outlines; /* not looked at with several `samples` */
    bool floor;                    /* a soft shadow lies on the plane y = floor_height */
    double floor_height;
};

/* A mesh and how it looks. Everything is borrowed for the call. */
struct render_skin {
    const struct mesh *mesh;     /* position, triangle, and normal: NULL for flat facets */
    const unsigned char *active; /* [triangle_count] 0: not drawn; NULL: all are */
    const float *opacity;        /* [triangle_count] 0 .. 1 when seen straight on; NULL: opaque */
    const float *shininess; /* [triangle_count] exponent of the highlight, 0: none, 100: gloss; NULL: 0 */
    const float *stretch;   /* [triangle_count] area over area at rest, for RENDER_LATEX; NULL: 1 */
    float rest_opacity;     /* of latex, straight on, where the stretch is 1; its opacity is not looked at */
    float rest_shininess;   /* the same, exponent of the highlight */
    float colour[3];        /* red, green, blue, 0 .. 1, linear light */
    bool facets;            /* each triangle keeps its own opacity and shininess, as in the paper; else
                                    they are averaged at the points and drawn smoothly */
};

struct render_solid; /* solid.h */
struct render_line;  /* overlay.h */
struct render_text;
struct render_box;
struct window; /* window.h */

/* All that a picture shows. Everything is borrowed for the call; `{0}` is an empty picture. */
struct render_scene {
    const struct render_skin *skins;
    size_t skin_count;
    const struct render_solid *solid; /* made with the same struct render; or NULL */
    bool cell_edges;                  /* the solid's cells have darker edges */
    bool smooth_light;                /* its faces are lit by their normals, not by their sides */
    const struct render_line *lines;
    size_t line_count;
    const struct render_box *boxes; /* in this order, below the texts */
    size_t box_count;
    const struct render_text *texts;
    size_t text_count;
};

struct render;

/* Opens the off-screen OpenGL context and makes room for pictures of this size; others are possible later.
 * Errors: STATUS_RANGE (size), STATUS_RESOURCE (no OpenGL 3.3), STATUS_NO_MEMORY. */
enum status render_open(int width, int height, struct render **render, struct error *err);

/* Draws all skins into *out, which is resized to the view. Of the distance from eye to target, what is nearer
 * than 0.004 or further than 1e4 times is cut off, and a triangle with a corner 1e9 times away is left out.
 * Where a normal is zero or not finite the facet's own is taken; opacity and shininess out of range are
 * clamped. Large pictures are drawn in bands and need little more memory than the image itself. Errors:
 * STATUS_RANGE for a size or camera that is not possible, and for a drawn triangle with a corner that is out
 * of range or at no finite place, or whose opacity or shininess is nan; the message names it.
 * STATUS_NO_MEMORY. */
enum status render_draw(struct render *render, const struct render_view *view,
                        const struct render_skin *skins, size_t skin_count, struct image *out,
                        struct error *err);

/* The same with all that a scene holds. Lines with an end at no finite place are refused by their number. */
enum status render_draw_scene(struct render *render, const struct render_view *view,
                              const struct render_scene *scene, struct image *out, struct error *err);

/* Draws in the window's own context, which it keeps until render_close(). Pictures for images can be drawn as
 * well. Errors: STATUS_RESOURCE, STATUS_NO_MEMORY. */
enum status render_open_window(struct window *window, struct render **render, struct error *err);

/* Draws the scene into the window that `render` was opened in, pixel for pixel as render_draw_scene() would;
 * the view should have the window's size. Called from the window's draw(). Errors as render_draw_scene(). */
enum status render_show(struct render *render, const struct render_view *view,
                        const struct render_scene *scene, struct error *err);

/* NULL is fine. */
void render_close(struct render *render);

/* All of the above for one still: the skin stands on the floor and fills a picture, which is saved as the PNG
 * file `path` with the program's name in it. Errors: those of render_open(), render_draw() and
 * image_save_png(), with the path in front. */
enum status render_still(const struct render_skin *skin, const char *path, const char *software,
                         struct error *err);

/* The same picture in another size, as the bytes of a PNG file; *png is overwritten, free
 * it with bytes_clear(). */
enum status render_still_png(const struct render_skin *skin, int width, int height, const char *software,
                             struct bytes *png, struct error *err);

/* Sets view->camera so that the box lower .. upper fits the picture (view's width, height and stereo are
 * read) with `margin`, a fraction of the half picture, left free around it: 0 for none, below 1. `direction`
 * points from the box to the eye and has any length; y is up unless direction is along it. In stereo the
 * screen plane passes through the middle of the box and the eyes are 1/30 of its distance apart, the usual
 * rule for comfortable pairs. Errors: STATUS_RANGE for bounds that are not finite or empty (lower > upper),
 * a direction of no length, a margin or size out of range; then the camera is as it was. */
enum status render_fit_camera(struct render_view *view, const double lower[3], const double upper[3],
                              const double direction[3], double margin, struct error *err);

#endif
