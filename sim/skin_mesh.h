/*
 * The skin at a moment as a mesh for other programs, with what is known of each of its points.
 *
 *     struct skin_mesh skin = {0};
 *     if (skin_mesh_init(&skin, &sim, false, err)) ...
 *     skin_mesh_take(&skin);                       at each moment: fills skin.mesh and skin.values, never fails
 *     if (mesh_save_values(&skin.mesh, skin.values, SKIN_VALUES, path, err)) ...
 *     skin_mesh_clear(&skin);
 *
 * Either the points that carry skin, as they are joined then; or each triangle with three points of its own,
 * 3 t + k for corner k of triangle t: so points are numbered alike at all times, and what will be torn is
 * apart from the start, for caches of motion that know places only. Of those a triangle that is gone is drawn
 * together to its middle.
 */
#ifndef SIM_SKIN_MESH_H
#define SIM_SKIN_MESH_H

#include "sim/sim.h"

enum { SKIN_VALUES = 3 };

struct skin_mesh {
    struct mesh mesh;                      /* positions and triangles */
    struct mesh_value values[SKIN_VALUES]; /* stretch and opacity, and piece: these */
    /* [mesh.point_count] area over that at rest, and opacity, of the triangles around the point; the
     * number of its piece (piece_table.h), of the last one where two of the paper's touch; 0, 0 and -1
     * where a triangle is gone. */
    float *stretch, *opacity;
    int32_t *piece;
    struct sim *sim;
    bool apart;
    uint32_t *number;              /* [sim->point_count] in the mesh; MESH_NONE: carries no skin */
    int32_t *first;                /* [sim->edge_count] at a piece's edge (measure.h): its first triangle */
    float *clearness, *shine;      /* [sim->triangle_count] scratch for sim_material() */
    double (*around)[SKIN_VALUES]; /* [sim->point_count] area, that at rest, and that times opacity */
    int32_t *piece_of;             /* [sim->point_count] */
};

/* `sim` is borrowed. apart: each triangle has points of its own. Errors: STATUS_NO_MEMORY, STATUS_RANGE where
 * there are too many; then *skin is empty. */
enum status skin_mesh_init(struct skin_mesh *skin, struct sim *sim, bool apart, struct error *err);
void skin_mesh_clear(struct skin_mesh *skin);

/* The state as it is. */
void skin_mesh_take(struct skin_mesh *skin);

#endif
