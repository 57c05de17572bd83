/* The faces of the cubes as a mesh. */
#include "common/array.h"
#include "sculpt/sculpt.h"

#include <math.h>
#include <stdlib.h>

/* Corners of squares lie on a lattice as wide as the smallest face: a bit each that is one, rows along x. */
struct faces {
    int side;         /* of the smallest exposed face; 0: there is none */
    uint64_t area;    /* of all, in cells */
    size_t row, rows; /* words of a row; rows along y, and along z */
    uint64_t *corners;
    uint32_t *before; /* [rows * rows] corners in earlier rows */
    struct mesh *mesh;
    uint32_t count; /* of its triangles so far */
};

static bool count_face(void *context, const struct octree_face *face)
{
    struct faces *faces = context;
    if (faces->side == 0 || face->side < faces->side)
        faces->side = face->side;
    faces->area += (uint64_t)face->side * face->side;
    return true;
}

static size_t row_of(const struct faces *faces, const int at[3])
{
    return (size_t)at[2] * faces->rows + (size_t)at[1];
}

static bool mark_face(void *context, const struct octree_face *face)
{
    struct faces *faces = context;
    const int first = (face->axis + 1) % 3, second = (face->axis + 2) % 3, steps = face->side / faces->side;
    int at[3] = {0};
    at[face->axis] = face->corner[face->axis] / faces->side;
    for (int i = 0; i <= steps; i++)
        for (int k = 0; k <= steps; k++) {
            at[first] = face->corner[first] / faces->side + i;
            at[second] = face->corner[second] / faces->side + k;
            faces->corners[row_of(faces, at) * faces->row + (size_t)at[0] / 64] |= UINT64_C(1) << at[0] % 64;
        }
    return true;
}

/* Points are numbered along x, then y, then z. */
static uint32_t point_at(const struct faces *faces, const int at[3])
{
    const size_t row = row_of(faces, at);
    const uint64_t *word = faces->corners + row * faces->row;
    uint32_t number = faces->before[row];
    int x = at[0];
    for (; x >= 64; x -= 64)
        number += (uint32_t)__builtin_popcountll(*word++);
    return number + (uint32_t)__builtin_popcountll(*word & ((UINT64_C(1) << x) - 1));
}

static size_t count_points(struct faces *faces)
{
    size_t count = 0;
    for (size_t row = 0; row < faces->rows * faces->rows; row++) {
        faces->before[row] = (uint32_t)count;
        for (size_t i = row * faces->row; i < (row + 1) * faces->row; i++)
            count += (size_t)__builtin_popcountll(faces->corners[i]);
    }
    return count;
}

static void put_points(const struct faces *faces, double spacing)
{
    double(*position)[3] = faces->mesh->position;
    for (size_t i = 0; i < faces->rows * faces->rows * faces->row; i++)
        for (uint64_t word = faces->corners[i]; word; word &= word - 1, position++) {
            const size_t row = i / faces->row;
            (*position)[0] = (double)(i % faces->row * 64 + (size_t)__builtin_ctzll(word)) * spacing;
            (*position)[1] = (double)(row % faces->rows) * spacing;
            (*position)[2] = (double)(row / faces->rows) * spacing;
        }
}

/* Two triangles, counter-clockwise seen from where the face looks: the axis after the face's, then the one
 * after that, make a right-handed system with it. */
static void add_square(struct faces *faces, const int corner[3], int axis, bool upwards)
{
    static const int order[2][6] = {
        {0, 3, 1, 0, 2, 3}, /* looking down the axis */
        {0, 1, 3, 0, 3, 2}, /* looking up */
    };
    uint32_t point[4];
    for (int i = 0; i < 4; i++) {
        int at[3] = {corner[0], corner[1], corner[2]};
        at[(axis + 1) % 3] += i & 1;
        at[(axis + 2) % 3] += i >> 1;
        point[i] = point_at(faces, at);
    }
    for (int i = 0; i < 6; i++)
        faces->mesh->triangle[faces->count + (uint32_t)i / 3][i % 3] = point[order[upwards][i]];
    faces->count += 2;
}

static bool add_face(void *context, const struct octree_face *face)
{
    struct faces *faces = context;
    const int steps = face->side / faces->side;
    for (int i = 0; i < steps * steps; i++) {
        int corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = face->corner[k] / faces->side;
        corner[(face->axis + 1) % 3] += i / steps;
        corner[(face->axis + 2) % 3] += i % steps;
        add_square(faces, corner, face->axis, face->outward > 0);
    }
    return true;
}

enum status sculpt_faces(const struct octree *tree, struct mesh *mesh, struct error *err)
{
    struct mesh made;
    struct faces faces = {.mesh = &made};
    octree_visit_faces(tree, count_face, &faces);
    if (faces.side == 0)
        return error_set(err, STATUS_RANGE, "the sculpture is empty: it has no faces");
    uint64_t triangles = 2 * (faces.area / ((uint64_t)faces.side * faces.side));
    if (triangles >= MESH_NONE)
        return error_set(err, STATUS_RANGE, "%llu triangles of cube faces; a mesh holds at most %u",
                         (unsigned long long)triangles, MESH_NONE - 1);
    faces.rows = ((size_t)1 << tree->depth) / (size_t)faces.side + 1;
    faces.row = faces.rows / 64 + 1;
    faces.corners = calloc(faces.rows * faces.rows, faces.row * sizeof *faces.corners);
    faces.before = array_new(faces.rows * faces.rows, sizeof *faces.before);
    enum status status = faces.corners && faces.before ? STATUS_OK : error_no_memory(err, "the cube faces");
    if (!status) {
        octree_visit_faces(tree, mark_face, &faces);
        status = mesh_init(&made, count_points(&faces), triangles, false, err);
    }
    if (!status) {
        put_points(&faces, ldexp(faces.side, -(int)tree->depth));
        octree_visit_faces(tree, add_face, &faces);
        mesh_clear(mesh);
        *mesh = made;
    }
    free(faces.corners);
    free(faces.before);
    return status;
}
