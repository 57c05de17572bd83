/*
 * Carving: chips and fills in an octree, scripts of them (.chips), voxel models in and out (.vox), and the
 * faces of the cubes as a mesh.
 *
 *     struct chips chips = {0};
 *     struct octree tree = {0};
 *     if (chips_load("cat.chips", &chips, err) || chips_begin(&chips, 6, &tree, err)) ...
 *     if (chips_run(&tree, &chips, err)) ...
 *     chips_clear(&chips);
 *
 * Coordinates are those of the octree's cube [0,1]^3: x right, y up, z towards the viewer. A cell belongs to
 * a shape when its centre does. Shapes may reach out of the cube, or lie outside altogether.
 */
#ifndef SCULPT_SCULPT_H
#define SCULPT_SCULPT_H

#include "common/mesh.h"
#include "common/octree.h"

#include <stdio.h>

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

/* What an operation does. Sandpaper and heat are tools of Galyean and Hughes, "Sculpting: an interactive
 * volumetric modeling technique", SIGGRAPH 1991: within a ball, x y z r, the one takes away what stands out
 * (a cell is kept that has 14 full ones, half of them, among the 27 around it, itself included), the other
 * every cell with an exposed face. Both decide from the sculpture before the operation, mirror images
 * included; beyond the cube all is empty. */
enum chip_kind {
    CHIP_CARVE, /* what the shape covers becomes this material (0 takes it away) */
    CHIP_SANDPAPER,
    CHIP_HEAT,
    CHIP_STEP, /* a step for undo ends here */
    CHIP_UNDO, /* takes back the last step that is done, if there is one */
    CHIP_REDO, /* does again what was taken back last, unless something else was done since */
    CHIP_KINDS,
};

/* Bits of struct chip's mirror: the operation is done with its images about the middle planes x = 1/2, y =
 * 1/2, z = 1/2 (one, three or seven of them), as one. */
enum { CHIP_MIRROR_X = 1, CHIP_MIRROR_Y = 2, CHIP_MIRROR_Z = 4 };

/* One operation. */
struct chip {
    enum chip_shape shape; /* of CHIP_CARVE */
    unsigned material;
    double value[CHIP_VALUES_MAX]; /* as listed at enum chip_shape and enum chip_kind */
    enum chip_kind kind;
    unsigned mirror;
};

/* A shape's name in scripts, its values' names ("X Y Z R"), and how many there are. */
struct chip_shape_name {
    const char *name, *values;
    int count;
};
extern const struct chip_shape_name chip_shape_names[CHIP_SHAPES];
extern const struct chip_shape_name chip_kind_names[CHIP_KINDS]; /* the first is of no use */

/* Refuses (STATUS_RANGE) what is no shape: values that are not finite or beyond CHIP_VALUE_MAX; radii, sides
 * of a box, axes (but a capsule's) and normals shorter than CHIP_LENGTH_MIN. */
enum status chip_check(const struct chip *chip, struct error *err);

/* The operation's image about the middle planes of these axes (bits as in `mirror`; 0: about none),
 * without further mirroring. */
struct chip chip_image(const struct chip *chip, unsigned axes);

/* Does one operation, which chip_check() accepts, with its mirror images. A step, undo and redo
 * do nothing here: see chips_run(). Errors: STATUS_NO_MEMORY, with the tree whole but the
 * operation perhaps done in part. */
enum status sculpt_chip(struct octree *tree, const struct chip *chip, struct error *err);

/* A script. Lines hold one of these; words are parted by spaces, # begins a comment:
 *
 *     depth N                   halvings along each axis, 0 to 10
 *     start full | empty        what there is before the first chip; full, unless this says otherwise
 *     material N                what `start full` and `fill` make, 1 to 255; 1 at first
 *     coefficient N B           b_k of the Gaussian field of material N
 *     chip SHAPE VALUES...      takes away
 *     fill SHAPE VALUES...      puts there
 *     mirror none | x | xy ...  later operations are done with their mirror images; none at first
 *     sandpaper X Y Z R         smooths what stands out within a ball
 *     heat X Y Z R              shrinks the surface within a ball by one cell
 *     step                      ends a step for undo; without such lines each operation is a step
 *     undo, redo                take back, or do again, a step; they end the step before
 *
 * depth and start come at most once each and before the first operation. */
struct chips {
    struct chip *items;
    size_t count, capacity;
    int depth, depth_line;               /* both 0 without a line `depth` */
    unsigned start_material;             /* 0: empty */
    int start_line;                      /* 0 without a line `start` */
    float coefficient[OCTREE_MATERIALS]; /* where the next says so */
    bool has_coefficient[OCTREE_MATERIALS];
    void (*progress)(double done); /* unless NULL, chips_run() tells it how many operations are done */
};

/* Reads a script; *chips must be valid ({0} is) and is replaced, or as it was after a failure. Errors:
 * STATUS_FILE; STATUS_INPUT as "FILE:LINE: ..."; STATUS_NO_MEMORY. */
enum status chips_load(const char *path, struct chips *chips, struct error *err);
void chips_clear(struct chips *chips);

/* The same for a text in memory; `name` is what messages call it. */
enum status chips_parse(const char *name, const void *text, size_t size, struct chips *chips,
                        struct error *err);

/* Does all operations of a script; what it takes back for good is not done in the first place. Errors:
 * STATUS_NO_MEMORY, with the tree whole and the operations before the failed one done. */
enum status chips_run(struct octree *tree, const struct chips *chips, struct error *err);

/* Makes *kept (valid; it is replaced) the same script without what it takes back and without steps, undo and
 * redo: it makes an equal octree. Errors: STATUS_NO_MEMORY; then *kept is as it was. */
enum status chips_keep(const struct chips *chips, struct chips *kept, struct error *err);

/* What a line of a script means depends on lines before it: the material and the mirror. */
struct chip_state {
    unsigned material, mirror; /* 1 and 0 at the beginning of a script */
};

/* Writes the line of an operation, its numbers exact to the bit, behind lines `material` and `mirror` where
 * *state differs from what the operation needs. */
void chip_write(FILE *stream, const struct chip *chip, struct chip_state *state);

/* Makes *tree (valid; it is replaced) the cube that the script begins with; `depth` counts where the script
 * names none. Errors: STATUS_RANGE for a depth that is too large. */
enum status chips_begin(const struct chips *chips, unsigned depth, struct octree *tree, struct error *err);

/* Gives the tree the script's coefficients; chips_begin() has done so. */
void chips_set_coefficients(const struct chips *chips, struct octree *tree);

/* Writes a script that makes an equal octree, one fill a leaf. Errors: STATUS_FILE. */
enum status chips_save(const struct octree *tree, const char *path, struct error *err);

/* Reads a MagicaVoxel model (versions 150 and 200): every model of the file, moved and turned as its scene
 * graph says, hidden parts and layers left out; of an animation the first frame. Its z is up, so (x, y, z)
 * becomes (x, z, -y): turned upright, not mirrored. The model stands in the middle of the smallest cube that
 * leaves a cell free all around it, and colour numbers become materials. *tree must be valid and is replaced,
 * or as it was after a failure. Errors: STATUS_FILE; STATUS_INPUT with the chunk and its place; STATUS_RANGE
 * for a model of more than 1022 cells a side; STATUS_NO_MEMORY. */
enum status vox_load(const char *path, struct octree *tree, struct error *err);

/* Writes the cells within the sculpture's bounds as a MagicaVoxel model; above 256 cells a side as several
 * with a scene graph. Errors: STATUS_RANGE for a sculpture that is empty or has more cells than the format
 * can count; STATUS_FILE; STATUS_NO_MEMORY. */
enum status vox_save(const struct octree *tree, const char *path, struct error *err);

/* The exposed faces of the sculpture as triangles, counter-clockwise seen from outside, points shared:
 * squares all of the size of the smallest exposed face, so that the mesh has no cracks. (Where cubes touch in
 * an edge only, four triangles share it.) *mesh is overwritten; it is as it was after a failure. Errors:
 * STATUS_RANGE for an empty sculpture or more faces than a mesh holds, STATUS_NO_MEMORY. */
enum status sculpt_faces(const struct octree *tree, struct mesh *mesh, struct error *err);

#endif
