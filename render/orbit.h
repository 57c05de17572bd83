/*
 * A camera led by the hand: it looks at a target from a distance and turns around it, y always up. No OpenGL.
 *
 *     struct orbit orbit = orbit_start();
 *     orbit_frame(&orbit, &view, lower, upper);
 *     orbit_turn(&orbit, dx, dy);                       while a button is held
 *     orbit_camera(&orbit, &view.camera);               before drawing
 *     orbit_ray(&view, x + 0.5, y + 0.5, origin, direction);
 */
#ifndef RENDER_ORBIT_H
#define RENDER_ORBIT_H

#include "render/render.h"

struct orbit {
    double target[3], distance; /* what it looks at, and from how far */
    /* Of the eye: 0, 0 on the target's +z side; 90, 0 on +x; any, 90 above. */
    double azimuth_deg, elevation_deg;
    double field_of_view_deg; /* vertical */
};

enum orbit_side { ORBIT_FRONT, ORBIT_BACK, ORBIT_RIGHT, ORBIT_LEFT, ORBIT_TOP, ORBIT_BOTTOM };

/* From the front, a little from the right and above, at the unit cube. */
struct orbit orbit_start(void);

/* The pointer was dragged by dx to the right and dy down: the object turns with it, half a degree a pixel. */
void orbit_turn(struct orbit *orbit, double dx, double dy);

/* The same, moving: the point of the target plane under the pointer stays under it. */
void orbit_pan(struct orbit *orbit, const struct render_view *view, double dx, double dy);

/* Nearer by a tenth a step; negative: further. */
void orbit_zoom(struct orbit *orbit, double steps);

/* From a standard side, at the same target and distance. */
void orbit_look(struct orbit *orbit, enum orbit_side side);

/* The keys for that, the same in every window: 1 front, 3 right, 7 top; `other`: the side across.
 * False for any other key. */
bool orbit_key(struct orbit *orbit, int key, bool other);

/* From one eye to two: side by side, crossed, one over the other, red and cyan, in rows, where the window has
 * two buffers in these (`quad`), and back to one. Where an eye's picture gets narrower than high, it goes as
 * much further away as the thing needs to stay whole. Returns a line that says which it is now. */
const char *orbit_change_stereo(struct orbit *orbit, struct render_view *view, bool quad);

/* Takes off the last column or row where the eyes' halves would be unlike. */
void orbit_make_even(struct render_view *view);

/* Width and height of one eye's picture; and the place of the picture (x, y in pixels) in that of
 * the eye whose half it is. */
void orbit_eye_size(const struct render_view *view, int size[2]);
void orbit_eye_place(const struct render_view *view, int place[2]);

/* Takes the box lower .. upper into the middle of the picture, as large as fits from any side: its enclosing
 * ball touches the picture's nearer borders. An empty or infinite box changes nothing. */
void orbit_frame(struct orbit *orbit, const struct render_view *view, const double lower[3],
                 const double upper[3]);

/* The camera; stereo: the eyes are 1/30 of the distance apart, the screen plane goes through the target. */
void orbit_camera(const struct orbit *orbit, struct render_camera *camera);

/* The ray from the eye through a place of the picture, in pixels from its upper left corner (the middle of
 * the first pixel is 0.5, 0.5): from the eye whose half it is, and where both see all of it, from between
 * them. `direction` gets unit length. False where the view's size or camera makes no picture. */
bool orbit_ray(const struct render_view *view, double x, double y, double origin[3], double direction[3]);

#endif
