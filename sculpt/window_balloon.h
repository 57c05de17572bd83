/*
 * The sculpture as a balloon: the surface around it as it stands, and what becomes of that under pressure.
 *
 *     struct balloon balloon = {0};
 *     if (balloon_mesh(&balloon, &tree, err)) ...      the smooth surface
 *     if (balloon_inflate(&balloon, err)) ...          hands it to the simulator, as rubber
 *     if (balloon_step(&balloon, err)) ...
 *     balloon_clear(&balloon);
 */
#ifndef SCULPT_WINDOW_BALLOON_H
#define SCULPT_WINDOW_BALLOON_H

#include "common/octree.h"
#include "render/render.h"
#include "sim/skins.h"

struct balloon {
    struct mesh mesh;        /* in the cube's units */
    struct render_skin skin; /* of that mesh, at rest */
    double kept;             /* of the sculpture's volume, this share */
    bool inflated;           /* from here on it is the sim's: */
    struct scene scene;
    struct sim sim;
    struct skins skins;
    double middle[3], scale; /* a place x of the cube is at (x - middle) scale in the sim */
};

/* Errors: those of surface_make(), then the balloon is empty. */
enum status balloon_mesh(struct balloon *balloon, const struct octree *tree, struct error *err);
enum status balloon_inflate(struct balloon *balloon, struct error *err);
enum status balloon_step(struct balloon *balloon, struct error *err);
void balloon_clear(struct balloon *balloon);

/* The skins to draw, and the camera moved to where they are. */
const struct render_skin *balloon_skins(struct balloon *balloon, size_t *count, struct render_camera *camera);

#endif
