/* Inside the sculptor: a MagicaVoxel file taken apart, between vox_parse.c (chunks), vox_scene.c (where
 * models stand) and vox.c (cells).
 *
 * The format: https://github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt and
 * MagicaVoxel-file-format-vox-extension.txt. All numbers are little endian. */
#ifndef SCULPT_VOX_H
#define SCULPT_VOX_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    VOX_SIDE_MAX = 256,    /* of one model: its coordinates are bytes */
    VOX_HEAD_SIZE = 12,    /* of a chunk: 4 letters, size of its contents, size of its children */
    VOX_NESTING_MAX = 256, /* of scene graph nodes */
};

/* One model: the contents of its chunks SIZE and XYZI. */
struct vox_model {
    int size[3];
    uint32_t count;
    const unsigned char *voxels; /* [count][4] x, y, z, colour; in the file's bytes */
};

enum vox_node_kind { VOX_TRANSFORM, VOX_GROUP, VOX_SHAPE, VOX_LAYER };

/* One node of the scene graph: a chunk nTRN, nGRP or nSHP. Or a layer: LAYR, numbered by itself. */
struct vox_node {
    int32_t id;
    enum vox_node_kind kind;
    const unsigned char *contents; /* behind the id; in the file's bytes */
    size_t size, place;            /* of the contents; of the chunk in the file, for messages */
    bool used;                     /* met on the way from the root */
};

/* Where a model's cells go: along axis k of the scene by sign[k] along axis[k] of the model, then `shift`. */
struct vox_pose {
    int axis[3], sign[3];
    int64_t shift[3];
};

/* A model put into the scene. */
struct vox_placement {
    size_t model;
    struct vox_pose pose;
};

struct vox_scene {
    struct {
        struct vox_model *items;
        size_t count, capacity;
    } models;
    struct {
        struct vox_node *items;
        size_t count, capacity;
    } nodes; /* those of the graph by ascending id, then the layers by theirs */
    struct {
        struct vox_placement *items;
        size_t count, capacity;
    } placements;
};

/* What messages call it. */
static inline const char *vox_node_name(const struct vox_node *node)
{
    return node->kind == VOX_LAYER ? "layer" : "scene graph node";
}

/* Reads models and nodes, which point into the bytes. Errors, without the file's name: STATUS_INPUT,
 * STATUS_NO_MEMORY; the scene needs vox_scene_clear() either way. */
enum status vox_parse(const unsigned char *bytes, size_t size, struct vox_scene *scene, struct error *err);

/* Follows the scene graph from its root, or, where there is none, puts each model at the same place. Errors
 * as vox_parse(). */
enum status vox_place_models(struct vox_scene *scene, struct error *err);

void vox_scene_clear(struct vox_scene *scene);

/* Where a voxel of this model ends up, in the axes of the file. A model turns about the corner of cells
 * nearest to its middle. */
void vox_voxel_place(const struct vox_model *model, const struct vox_pose *pose, const unsigned char voxel[3],
                     int64_t place[3]);

/* Bytes being read: what is wanted beyond the end reads as 0 and is remembered. */
struct vox_cursor {
    const unsigned char *at;
    size_t left;
    bool cut_short;
};

uint32_t vox_number(struct vox_cursor *cursor);

/* Skips that many bytes and returns where they are; NULL when there are not as many. */
const unsigned char *vox_skip(struct vox_cursor *cursor, size_t size);

#endif
