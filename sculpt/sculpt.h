/*
 * Carving: chips and fills in an octree, scripts of them (.chips), voxel models in and out (.vox), and the
 * faces of the cubes as a mesh.
 *
 *     struct chips chips = {0};
 *     struct octree tree = {0};
 *     if (chips_load("cat.chips", &chips, err) || chips_begin(&chips, 6, &tree, err)) ...
 *     for (size_t i = 0; i < chips.count; i++)
 *         if (sculpt_chip(&tree, &chips.items[i], err)) ...
 *     chips_clear(&chips);
 *
 * Coordinates are those of the octree's cube [0,1]^3: x right, y up, z towards the viewer. A cell belongs to a
 * shape when its centre does. Shapes may reach out of the cube, or lie outside altogether.
 */
#ifndef SCULPT_SCULPT_H
#define SCULPT_SCULPT_H

#include "common/mesh.h"
#include "common/octree.h"

enum chip_shape {
    CHIP_BOX,        /* x0 y0 z0 x1 y1 z1: two opposite corners */
    CHIP_SPHERE,     /* x y z r */
    CHIP_ELLIPSOID,  /* x y z rx ry rz: half axes along x, y, z */
    CHIP_HALF_SPACE, /* x y z nx ny nz: a point of its border; all that lies where n points */
    CHIP_CYLINDER,   /* x0 y0 z0 x1 y1 z1 r: the ends of its axis; flat ends */
    CHIP_CONE,       /* x0 y0 z0 x1 y1 z1 r0 r1: the same with a radius at each end, one of them may be 0 */
    CHIP_CAPSULE, /* x0 y0 z0 x1 y1 z1 r0 r1: a sphere swept from one end to the other as it changes size */
    CHIP_SHAPES,
};

enum { CHIP_VALUES_MAX = 8 };

/* Values are finite and not beyond this, either way; radii and lengths are not below the second. */
#define CHIP_VALUE_MAX  1e6
#define CHIP_LENGTH_MIN 1e-9

/* One operation: what the shape covers becomes this material (0 takes it away). */
struct chip {
    enum chip_shape shape;
    unsigned material;
    double value[CHIP_VALUES_MAX]; /* as listed at enum chip_shape */
};

/* A shape's name in scripts, its values' names ("X Y Z R"), and how many there are. */
struct chip_shape_name {
    const char *name, *values;
    int count;
};
extern const struct chip_shape_name chip_shape_names[CHIP_SHAPES];

/* Refuses (STATUS_RANGE) what is no shape: values that are not finite or beyond CHIP_VALUE_MAX; radii, sides of
 * a box, axes (but a capsule's) and normals shorter than CHIP_LENGTH_MIN. */
enum status chip_check(const struct chip *chip, struct error *err);

/* Carves one chip, which chip_check() accepts. Errors: those of octree_apply(). */
enum status sculpt_chip(struct octree *tree, const struct chip *chip, struct error *err);

/* A script. Lines hold one of these; words are parted by spaces, # begins a comment:
 *
 *     depth N                   halvings along each axis, 0 to 10
 *     start full | empty        what there is before the first chip; full, unless this says otherwise
 *     material N                what `start full` and `fill` make, 1 to 255; 1 at first
 *     coefficient N B           b_k of the Gaussian field of material N
 *     chip SHAPE VALUES...      takes away
 *     fill SHAPE VALUES...      puts there
 *
 * depth and start come at most once each and before the first chip or fill. */
struct chips {
    struct chip *items;
    size_t count, capacity;
    int depth, depth_line;               /* both 0 without a line `depth` */
    unsigned start_material;             /* 0: empty */
    int start_line;                      /* 0 without a line `start` */
    float coefficient[OCTREE_MATERIALS]; /* where the next says so */
    bool has_coefficient[OCTREE_MATERIALS];
};

/* Reads a script; *chips must be valid ({0} is) and is replaced, or as it was after a failure. Errors:
 * STATUS_FILE; STATUS_INPUT as "FILE:LINE: ..."; STATUS_NO_MEMORY. */
enum status chips_load(const char *path, struct chips *chips, struct error *err);
void chips_clear(struct chips *chips);

/* Makes *tree (valid; it is replaced) the cube that the script begins with; `depth` counts where the script
 * names none. Errors: STATUS_RANGE for a depth that is too large. */
enum status chips_begin(const struct chips *chips, unsigned depth, struct octree *tree, struct error *err);

/* Gives the tree the script's coefficients; chips_begin() has done so. */
void chips_set_coefficients(const struct chips *chips, struct octree *tree);

/* Writes a script that makes an equal octree, one fill a leaf. Errors: STATUS_FILE. */
enum status chips_save(const struct octree *tree, const char *path, struct error *err);

/* Reads a MagicaVoxel model (versions 150 and 200): every model of the file, moved and turned as its scene
 * graph says, hidden parts left out; of an animation the first frame. Its z is up, so (x, y, z) becomes
 * (x, z, -y): turned upright, not mirrored. The model stands in the middle of the smallest cube that leaves a
 * cell free all around it, and colour numbers become materials. *tree must be valid and is replaced, or as it
 * was after a failure. Errors: STATUS_FILE; STATUS_INPUT with the chunk and its place; STATUS_RANGE for a model
 * of more than 1022 cells a side; STATUS_NO_MEMORY. */
enum status vox_load(const char *path, struct octree *tree, struct error *err);

/* Writes the cells within the sculpture's bounds as a MagicaVoxel model; above 256 cells a side as several
 * with a scene graph. Errors: STATUS_RANGE for a sculpture that is empty or has more cells than the format
 * can count; STATUS_FILE; STATUS_NO_MEMORY. */
enum status vox_save(const struct octree *tree, const char *path, struct error *err);

/* The exposed faces of the sculpture as triangles, counter-clockwise seen from outside, points shared: squares
 * all of the size of the smallest exposed face, so that the mesh has no cracks. (Where cubes touch in an edge
 * only, four triangles share it.) *mesh is overwritten; it is as it was after a failure. Errors: STATUS_RANGE
 * for an empty sculpture or more faces than a mesh holds, STATUS_NO_MEMORY. */
enum status sculpt_faces(const struct octree *tree, struct mesh *mesh, struct error *err);

#endif
