/* The balloons of a simulation as render sees them: the program layer's bridge between the two modules. */
#ifndef SIM_SKINS_H
#define SIM_SKINS_H

#include "render/overlay.h"
#include "render/render.h"
#include "sim/sim.h"

struct skins {
    struct sim *sim;
    struct mesh *meshes;   /* [sim->balloon_count] look into these arrays and the sim's: not to be cleared */
    double (*position)[3]; /* [sim->point_count] */
    double (*normal)[3];   /* [sim->point_count] */
    struct render_skin *skins;            /* [sim->balloon_count] what render_draw() takes */
    float *opacity, *shininess, *stretch; /* [sim->triangle_count]; of area */
    double lowest;                        /* y of all that is drawn; infinite where that is nothing */
    struct render_line *lines;            /* [line_count] strings, needles, obstacles (props.h) */
    size_t line_count;
};

/* `sim` is borrowed. Errors: STATUS_NO_MEMORY; then *skins is empty. */
enum status skins_init(struct skins *skins, struct sim *sim, struct error *err);
void skins_clear(struct skins *skins);

/* Normals, opacity, shininess, stretch and bottom of the state as it is: before each picture. */
void skins_update(struct skins *skins);

/* What render_draw_scene() takes of it, with the lines of all that is there beside the balloons. After
 * skins_update(). */
struct render_scene skins_scene(struct skins *skins, const struct render_view *view);

enum render_order skins_order(enum scene_order order);

/* What the scene says of the picture but its camera: size, stereo, style, order, samples. Eyes that are
 * separate in files are side by side where there is one picture. */
void skins_view(const struct scene_view *scene, struct render_view *view);

/* All of a film's picture: that, and the scene's camera on the ball around all points at rest (skins_ball()
 * before the first step), smooth outlines. */
void skins_camera(const struct sim *sim, const double centre[3], double radius, struct render_view *view);

/* The picture's floor, that shadows lie on: the scene's ground where that is level; else skins stand on it as
 * they are, and it sinks as they swell, but it does not follow what flies away; or strings' ends and weights
 * do, as they were at first, where they are lower. `ball`: around all points at
 * rest, centre and radius. After skins_update(). */
void skins_floor(const struct skins *skins, const double ball[4], struct render_view *view);

/* The ball around all points as they are; returns its radius. */
double skins_ball(const struct sim *sim, double centre[3]);

#endif
