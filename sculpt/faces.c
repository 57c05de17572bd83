/* The faces of the cubes as a mesh. */
#include "common/array.h"
#include "sculpt/sculpt.h"

#include <math.h>
#include <stdlib.h>

struct faces {
    int side;            /* of the smallest exposed face; 0: there is none */
    uint64_t area;       /* of all, in cells */
    double (*corner)[3]; /* [3 triangles] a soup */
    size_t count;        /* of corners */
    double cell;
};

static bool count_face(void *context, const struct octree_face *face)
{
    struct faces *faces = context;
    if (faces->side == 0 || face->side < faces->side)
        faces->side = face->side;
    faces->area += (uint64_t)face->side * face->side;
    return true;
}

/* Two triangles, counter-clockwise seen from where the face looks: the axis after the face's, then the one
 * after that, make a right-handed system with it. */
static void add_square(struct faces *faces, const struct octree_face *face, int along, int across)
{
    static const int order[2][6][2] = {
        {{0, 0}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {1, 1}}, /* looking down the axis */
        {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}, /* looking up */
    };
    const int first = (face->axis + 1) % 3, second = (face->axis + 2) % 3;
    for (int i = 0; i < 6; i++) {
        const int *step = order[face->outward > 0][i];
        double *corner = faces->corner[faces->count++];
        corner[face->axis] = face->corner[face->axis] * faces->cell;
        corner[first] = (face->corner[first] + along + step[0] * faces->side) * faces->cell;
        corner[second] = (face->corner[second] + across + step[1] * faces->side) * faces->cell;
    }
}

static bool add_face(void *context, const struct octree_face *face)
{
    struct faces *faces = context;
    for (int along = 0; along < face->side; along += faces->side)
        for (int across = 0; across < face->side; across += faces->side)
            add_square(faces, face, along, across);
    return true;
}

enum status sculpt_faces(const struct octree *tree, struct mesh *mesh, struct error *err)
{
    struct faces faces = {.cell = ldexp(1, -(int)tree->depth)};
    octree_visit_faces(tree, count_face, &faces);
    if (faces.side == 0)
        return error_set(err, STATUS_RANGE, "the sculpture is empty: it has no faces");
    uint64_t triangles = 2 * (faces.area / ((uint64_t)faces.side * faces.side));
    if (triangles >= MESH_NONE)
        return error_set(err, STATUS_RANGE, "%llu triangles of cube faces; a mesh holds at most %u",
                         (unsigned long long)triangles, MESH_NONE - 1);
    faces.corner = array_new(triangles, 3 * sizeof *faces.corner);
    if (!faces.corner)
        return error_no_memory(err, "the cube faces");
    octree_visit_faces(tree, add_face, &faces);
    enum status status = mesh_from_soup((const double(*)[3])faces.corner, triangles, mesh, err);
    free(faces.corner);
    return status;
}
