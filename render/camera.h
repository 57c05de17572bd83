/*
 * From the scene to one or two pictures. Points are taken into camera space first, in double: the origin
 * between the eyes, x right, y up, z towards the viewer, the unit the distance from eye to target. An eye's
 * off-axis projection (never toe-in) follows in float.
 */
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "render/render.h"

struct camera_space {
    double origin[3];  /* the eye, or the middle between the two */
    double axis[3][3]; /* x, y, z of camera space in the scene: unit vectors */
    double scale;      /* 1 / distance from eye to target */
};

/* One eye's picture: its columns and rows in the whole one, and how it sees camera space. */
struct camera_eye {
    int left, width, bottom, height; /* bottom from below */
    double offset;                   /* of the eye along x */
    double half_width[2];            /* tangents: the window's half width and height at distance 1 */
    double shear;                    /* x of the window's middle at distance 1, seen from this eye */
};

/* Refuses (STATUS_RANGE) sizes and cameras that make no picture; says what is wrong. */
enum status camera_check(const struct render_view *view, struct error *err);

/* The rest take a view that camera_check() accepted. */
void camera_space_of(const struct render_camera *camera, struct camera_space *space);
void camera_to_space(const struct camera_space *space, const double point[3], double out[3]);
void camera_turn(const struct camera_space *space, const double direction[3], double out[3]);

/* Fills eyes[0 .. n) and returns n: 1, or in stereo 2, the one whose picture is on the left or above
 * first, or the left eye. */
int camera_eyes(const struct render_view *view, struct camera_eye eyes[2]);

/* Into how many columns and rows eyes divide the picture: 2 of one where each has a half. */
void camera_parts(enum render_stereo stereo, int parts[2]);

/* Width over height of what one eye sees. */
double camera_aspect(const struct render_view *view);

/* The part of the whole picture (x, y from below, width, height in pixels) that holds what this eye sees at
 * distances nearest .. farthest between low and high: x and y at distance 1 as seen from the origin. */
void camera_pixels(const struct camera_eye *eye, const double low[2], const double high[2], double nearest,
                   double farthest, int box[4]);

/* The OpenGL projection (column-major) of camera space between the distances nearest < farthest. */
void camera_projection(const struct camera_eye *eye, double nearest, double farthest, float matrix[16]);

#endif
