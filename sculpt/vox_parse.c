/* MagicaVoxel files: chunks. */
#include "common/array.h"
#include "common/little_endian.h"
#include "sculpt/vox.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

uint32_t vox_number(struct vox_cursor *cursor)
{
    const unsigned char *byte = vox_skip(cursor, 4);
    return byte ? (uint32_t)get_bits(byte, 4) : 0;
}

const unsigned char *vox_skip(struct vox_cursor *cursor, size_t size)
{
    if (size > cursor->left) {
        cursor->cut_short = true;
        cursor->left = 0;
        return NULL;
    }
    const unsigned char *at = cursor->at;
    cursor->at += size;
    cursor->left -= size;
    return at;
}

struct chunk {
    char name[5];
    size_t place; /* in the file */
    struct vox_cursor contents;
    size_t children; /* bytes of chunks behind the contents */
};

static enum status refuse(struct error *err, const struct chunk *chunk, const char *what)
{
    return error_set(err, STATUS_INPUT, "chunk %s at byte %zu: %s", chunk->name, chunk->place, what);
}

/* The chunk at the cursor, which moves past its contents. */
static enum status next_chunk(struct vox_cursor *cursor, const unsigned char *file, struct chunk *chunk,
                              struct error *err)
{
    size_t place = (size_t)(cursor->at - file);
    const unsigned char *name = vox_skip(cursor, 4);
    size_t size = vox_number(cursor), children = vox_number(cursor);
    if (cursor->cut_short)
        return error_set(err, STATUS_INPUT, "cut short at byte %zu, within the head of a chunk", place);
    for (int i = 0; i < 4; i++)
        chunk->name[i] = isprint(name[i]) ? (char)name[i] : '?';
    chunk->name[4] = '\0';
    chunk->place = place;
    chunk->children = children;
    if (size > cursor->left || children > cursor->left - size)
        return error_set(
            err, STATUS_INPUT,
            "chunk %s at byte %zu: claims %zu bytes where %zu are left; the file is cut short or "
            "damaged",
            chunk->name, place, size + children, cursor->left);
    chunk->contents = (struct vox_cursor){vox_skip(cursor, size), size, false};
    return STATUS_OK;
}

static enum status read_size(struct vox_scene *scene, struct chunk *chunk, struct error *err)
{
    struct vox_model model = {0};
    for (int k = 0; k < 3; k++) {
        uint32_t side = vox_number(&chunk->contents);
        if (!chunk->contents.cut_short && (side < 1 || side > VOX_SIDE_MAX))
            return error_set(err, STATUS_INPUT,
                             "chunk SIZE at byte %zu: a model of %u cells along %c; must be from 1 to %d",
                             chunk->place, side, "xyz"[k], VOX_SIDE_MAX);
        model.size[k] = (int)side;
    }
    if (chunk->contents.cut_short)
        return refuse(err, chunk, "must hold three numbers");
    if (!ARRAY_RESERVE(&scene->models, 1))
        return error_no_memory(err, "the models");
    scene->models.items[scene->models.count++] = model;
    return STATUS_OK;
}

/* The voxels of the model whose size came last. */
static enum status read_voxels(struct vox_scene *scene, struct chunk *chunk, struct error *err)
{
    struct vox_model *model = scene->models.count ? &scene->models.items[scene->models.count - 1] : NULL;
    if (!model || model->voxels)
        return refuse(err, chunk, "has no chunk SIZE before it");
    size_t count = vox_number(&chunk->contents);
    if (chunk->contents.cut_short)
        return refuse(err, chunk, "must begin with the number of voxels");
    size_t room = chunk->contents.left / 4;
    if (count > room)
        return error_set(err, STATUS_INPUT, "chunk XYZI at byte %zu: claims %zu voxels but has room for %zu",
                         chunk->place, count, room);
    model->voxels = chunk->contents.at;
    model->count = (uint32_t)count;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const int at = model->voxels[4 * i + (size_t)k], side = model->size[k];
            if (at >= side)
                return error_set(
                    err, STATUS_INPUT,
                    "chunk XYZI at byte %zu: voxel %zu has %c = %d in a model of %d cells along %c",
                    chunk->place, i, "xyz"[k], at, side, "xyz"[k]);
        }
    return STATUS_OK;
}

static enum status read_node(struct vox_scene *scene, struct chunk *chunk, enum vox_node_kind kind,
                             struct error *err)
{
    struct vox_node node = {.id = (int32_t)vox_number(&chunk->contents), .kind = kind, .place = chunk->place};
    if (chunk->contents.cut_short)
        return refuse(err, chunk, "must begin with the number of the node");
    node.contents = chunk->contents.at;
    node.size = chunk->contents.left;
    if (!ARRAY_RESERVE(&scene->nodes, 1))
        return error_no_memory(err, "the scene graph");
    scene->nodes.items[scene->nodes.count++] = node;
    return STATUS_OK;
}

static enum status read_chunk(struct vox_scene *scene, struct chunk *chunk, struct error *err)
{
    if (!strcmp(chunk->name, "XYZI"))
        return read_voxels(scene, chunk, err);
    if (scene->models.count > 0 && !scene->models.items[scene->models.count - 1].voxels)
        return refuse(err, chunk, "the chunk SIZE before it must be followed by a chunk XYZI");
    if (!strcmp(chunk->name, "SIZE"))
        return read_size(scene, chunk, err);
    if (!strcmp(chunk->name, "nTRN"))
        return read_node(scene, chunk, VOX_TRANSFORM, err);
    if (!strcmp(chunk->name, "nGRP"))
        return read_node(scene, chunk, VOX_GROUP, err);
    if (!strcmp(chunk->name, "nSHP"))
        return read_node(scene, chunk, VOX_SHAPE, err);
    if (!strcmp(chunk->name, "LAYR"))
        return read_node(scene, chunk, VOX_LAYER, err);
    return STATUS_OK;
}

static int by_id(const void *a, const void *b)
{
    const struct vox_node *one = a, *other = b;
    const int layers = (one->kind == VOX_LAYER) - (other->kind == VOX_LAYER);
    return layers ? layers : (one->id > other->id) - (one->id < other->id);
}

static enum status sort_nodes(struct vox_scene *scene, struct error *err)
{
    if (scene->nodes.count == 0)
        return STATUS_OK;
    qsort(scene->nodes.items, scene->nodes.count, sizeof *scene->nodes.items, by_id);
    for (size_t i = 1; i < scene->nodes.count; i++) {
        const struct vox_node *one = &scene->nodes.items[i - 1], *other = one + 1;
        if (!by_id(one, other))
            return error_set(err, STATUS_INPUT, "%s %d is there twice, at bytes %zu and %zu",
                             vox_node_name(one), one->id, one->place, other->place);
    }
    return STATUS_OK;
}

/* The signature, the version, and the chunk MAIN, which holds all others. */
static enum status open_main(struct vox_cursor *cursor, const unsigned char *file, struct error *err)
{
    if (cursor->left == 0)
        return error_set(err, STATUS_INPUT, "the file is empty; a .vox file is wanted");
    const unsigned char *magic = vox_skip(cursor, 4);
    if (!magic || memcmp(magic, "VOX ", 4) != 0)
        return error_set(err, STATUS_INPUT, "not a .vox file: it does not begin with \"VOX \"");
    uint32_t version = vox_number(cursor);
    if (cursor->cut_short)
        return error_set(err, STATUS_INPUT, "cut short at byte 4: the version is missing");
    if (version < 150 || version > 200)
        return error_set(err, STATUS_INPUT, "version %u of the format; 150 to 200 are read", version);
    struct chunk chunk = {0};
    enum status status = next_chunk(cursor, file, &chunk, err);
    if (!status && strcmp(chunk.name, "MAIN") != 0)
        status = refuse(err, &chunk, "the first chunk must be MAIN");
    if (!status)
        cursor->left = chunk.children;
    return status;
}

enum status vox_parse(const unsigned char *bytes, size_t size, struct vox_scene *scene, struct error *err)
{
    struct vox_cursor cursor = {bytes, size, false};
    struct chunk chunk = {.name = "MAIN"};
    enum status status = open_main(&cursor, bytes, err);
    while (!status && cursor.left > 0) {
        status = next_chunk(&cursor, bytes, &chunk, err);
        if (!status)
            status = read_chunk(scene, &chunk, err);
        if (!status)
            vox_skip(&cursor, chunk.children);
    }
    if (status)
        return status;
    if (scene->models.count == 0)
        return error_set(err, STATUS_INPUT, "there is no model: chunks SIZE and XYZI are missing");
    if (!scene->models.items[scene->models.count - 1].voxels)
        return error_set(err, STATUS_INPUT, "the last chunk SIZE must be followed by a chunk XYZI");
    return sort_nodes(scene, err);
}

void vox_scene_clear(struct vox_scene *scene)
{
    free(scene->models.items);
    free(scene->nodes.items);
    free(scene->placements.items);
    *scene = (struct vox_scene){0};
}
