/*
 * What the order of translucent triangles and samples cost, in one picture of the user's own scene: the
 * program layer's bridge from prices to render.
 *
 * The state is that at a given time; the picture is the film's, with both eyes where the scene has them.
 * The reference has the exact order of each pixel's layers, by lists, and the most samples: nothing here
 * is nearer to the picture without pixels. Its own outlines are wrong by about as much as those of one
 * sample less are off from it.
 */
#ifndef SIM_PRICE_PICTURE_H
#define SIM_PRICE_PICTURE_H

#include "sim/accuracy.h"

enum { PRICE_PICTURES_MAX = 16 }; /* 4 orders, each with 1 x 1 to 4 x 4 samples a pixel */

struct price_picture {
    int order;          /* enum scene_order */
    int samples;        /* along a pixel's side, as view.samples */
    double seconds;     /* a frame, of all threads' time on processors: other programs hardly add to them */
    double mean, worst; /* how far the channels of the pixels are from the reference's, of 255 */
    bool best;          /* no other row has less of both mean and seconds */
};

struct price_pictures {
    /* Order by order, coarse to fine; the last is the reference. */
    struct price_picture rows[PRICE_PICTURES_MAX];
    size_t count;
    double time;                /* s: of the state */
    int size[2];                /* pixels */
    int samples;                /* of the reference */
    int own_order, own_samples; /* the scene's */
    char reason[256];           /* why there are no rows, or "" */
};

/* Steps the scene until `time` by auto, as the first run that found how far there is time to go, and draws.
 * meshes as for sim_open(); options->go_on is asked before each step and each picture, options->seconds is
 * not looked at. What cannot be stepped or drawn is no error but pictures->reason. Errors:
 * STATUS_INTERRUPTED, STATUS_NO_MEMORY. */
enum status price_pictures_measure(const struct scene *scene, const struct mesh *meshes, double time,
                                   const struct pricing_options *options, struct price_pictures *pictures,
                                   struct error *err);

#endif
