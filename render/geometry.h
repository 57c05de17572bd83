/*
 * What the graphics card gets: the skins' triangles in camera space, built once a frame for both eyes, opaque
 * ones first, translucent ones behind them in the order they are drawn.
 *
 *     struct geometry geometry = {0};
 *     if (geometry_build(&geometry, view, skins, count, NULL, 0, err)) ...    once a frame; keeps its memory
 *     geometry_clear(&geometry);
 */
#ifndef RENDER_GEOMETRY_H
#define RENDER_GEOMETRY_H

#include "render/camera.h"
#include "render/order.h"
#include "render/render.h"

#include <stdint.h>

struct geometry_vertex {
    float position[3], normal[3]; /* in camera space; the normal outward, unit length or nearly so */
    float film, gloss;            /* opacity and shininess; of latex optical depth over K + S and roughness */
    uint16_t colour[4];           /* linear, 65535 = 1; the last: how closed the latex is */
};

/* What tells whether the triangles around a point close: sums over them of the difference between their other
 * two points, as numbers and as places. Both vanish where they do; else the second leads along the rim. */
struct geometry_fan {
    uint64_t numbers;
    float places[3];
};

/* A latex skin as a whole. */
struct geometry_latex {
    float film;      /* optical depth over K + S where the stretch is 1 */
    float roughness; /* there */
    float closed;    /* 1: light bounces inside, 0: it is torn open */
};

/* The shadow that a skin casts from above onto the floor: a Gaussian with its area's mean and covariance. */
struct geometry_shadow {
    float corner[4][3]; /* in camera space, at +-3 standard deviations: (-,-), (+,-), (-,+), (+,+) */
    float colour[3];    /* of the light that is left in its middle, for white light from above */
};

struct geometry {
    struct {
        struct geometry_vertex *items;
        size_t count, capacity;
    } vertices;
    struct {
        struct order_triangle *items;
        size_t count, capacity;
    } translucent, spare;
    struct {
        uint32_t *items;
        size_t count, capacity;
    } indices;     /* 3 for each triangle, opaque ones first */
    size_t opaque; /* triangles */
    struct {
        uint32_t *items;
        size_t count, capacity;
    } links; /* the first vertex of each point of a skin, and behind each vertex the next one of its point */
    struct {
        float *items;
        size_t count, capacity;
    } sums; /* of film, gloss, triangles for each point of a skin */
    struct {
        struct geometry_fan *items;
        size_t count, capacity;
    } fans;                   /* of a latex skin's points */
    double low[2], high[2];   /* x and y at distance 1 between which every corner appears */
    double nearest, farthest; /* distances that hold every triangle in sight, and the shadows */
    struct {
        struct geometry_shadow *items;
        size_t count, capacity;
    } shadows; /* one for each skin that casts one: each takes its share of the light that the others leave */
};

/* `view` has been checked. `others` are points of the scene that shall be in sight too (low .. farthest):
 * those of what is drawn by others. Errors: STATUS_RANGE naming the skin and element, STATUS_NO_MEMORY. */
enum status geometry_build(struct geometry *geometry, const struct render_view *view,
                           const struct render_skin *skins, size_t skin_count, const double (*others)[3],
                           size_t other_count, struct error *err);
void geometry_clear(struct geometry *geometry);

/* Finds how closed a skin is and, in `fans` ([point_count]), where its rims are. latex.c */
void latex_measure(struct geometry_latex *latex, const struct render_skin *skin, struct geometry_fan *fans);

/* Optical depth and roughness of a film of that area stretch. */
float latex_film(const struct geometry_latex *latex, float stretch);
float latex_roughness(const struct geometry_latex *latex, float stretch);

/* True on a torn edge or another rim, where rubber is thicker. */
bool latex_is_rim(const struct geometry_fan *fan);
extern const float latex_rim;    /* how much thicker */
extern const float latex_opaque; /* film from which on nothing shows through */

/* Lays the skin's shadow on the floor y = height. False where there is none. shadow.c */
bool geometry_cast_shadow(struct geometry_shadow *shadow, const struct camera_space *space, double height,
                          const struct render_skin *skin);

#endif
