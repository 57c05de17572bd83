/*
 * A sculpture of cubes on the graphics card: square faces in blocks, each of which is replaced as a whole
 * when something in it changes. It is drawn by render_draw_scene() and render_show().
 *
 *     struct render_solid *solid;
 *     if (render_solid_new(render, origin, 1.0 / 256, &solid, err)) ...
 *     if (render_solid_set(solid, block, faces, count, err)) ...       for each block that changed
 *     render_solid_free(solid);                                        before render_close()
 *
 * Blocks of 32 to 64 cells a side make good drawing: each is left out when it is out of sight, and of each
 * only the sides that may face the eye are drawn.
 */
#ifndef RENDER_SOLID_H
#define RENDER_SOLID_H

#include "render/render.h"

#include <stdint.h>

/* A rectangle of cell faces, seen from outside the material. */
struct render_face {
    uint16_t corner[3]; /* lowest corner of the rectangle, in cells from the solid's origin */
    uint16_t size[2];   /* in cells: along y, z for sides of x; along z, x for y; along x, y for z */
    uint8_t side;       /* where it looks: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z */
    uint8_t colour[3];  /* red, green, blue (sRGB) */
    int8_t normal[3];   /* of the smooth surface there, any length; 0, 0, 0: that of the side */
};

/* An empty solid whose cell 0, 0, 0 begins at `origin`, each cell `cell` wide. Errors: STATUS_RANGE for a
 * cell or origin that is no number, STATUS_NO_MEMORY. */
enum status render_solid_new(struct render *render, const double origin[3], double cell,
                             struct render_solid **solid, struct error *err);

/* Makes these the faces of the block with this key (any number); with count
 * 0 the block is gone. The faces are copied. Corner + size must not pass 65535. Errors: STATUS_RANGE naming
 * the face, STATUS_NO_MEMORY; then the block is as it was. */
enum status render_solid_set(struct render_solid *solid, uint64_t block, const struct render_face *faces,
                             size_t count, struct error *err);

/* A block that is not there is fine. */
void render_solid_remove(struct render_solid *solid, uint64_t block);
void render_solid_remove_all(struct render_solid *solid);

size_t render_solid_faces(const struct render_solid *solid);

/* NULL is fine. */
void render_solid_free(struct render_solid *solid);

#endif
