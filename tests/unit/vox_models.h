/* MagicaVoxel files made by hand, byte by byte. */
#ifndef TESTS_UNIT_VOX_MODELS_H
#define TESTS_UNIT_VOX_MODELS_H

#include "folder.h"
#include "sculpt/sculpt.h"

/* A file being made. */
struct model {
    unsigned char data[16384];
    size_t size;
};

enum { MAIN_CHILDREN = 16, FIRST_CHUNK = 20 }; /* where they are in the file */

static inline void add_bytes(struct model *model, const void *bytes, size_t size)
{
    assert_true(size <= sizeof model->data - model->size);
    memcpy(model->data + model->size, bytes, size);
    model->size += size;
}

static inline void set_number(struct model *model, size_t at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        model->data[at + i] = (unsigned char)(value >> 8 * i);
}

static inline void add_number(struct model *model, uint32_t value)
{
    add_bytes(model, "\0\0\0", 4);
    set_number(model, model->size - 4, value);
}

static inline size_t begin_chunk(struct model *model, const char *name)
{
    add_bytes(model, name, 4);
    add_number(model, 0);
    add_number(model, 0);
    return model->size;
}

static inline void end_chunk(struct model *model, size_t contents)
{
    set_number(model, contents - 8, (uint32_t)(model->size - contents));
    set_number(model, MAIN_CHILDREN, (uint32_t)(model->size - FIRST_CHUNK));
}

static inline struct model new_model(void)
{
    struct model model = {.size = 0};
    add_bytes(&model, "VOX ", 4);
    add_number(&model, 150);
    begin_chunk(&model, "MAIN");
    return model;
}

static inline void add_size(struct model *model, uint32_t x, uint32_t y, uint32_t z)
{
    size_t contents = begin_chunk(model, "SIZE");
    add_number(model, x);
    add_number(model, y);
    add_number(model, z);
    end_chunk(model, contents);
}

static inline void add_voxels(struct model *model, const unsigned char (*voxels)[4], uint32_t count)
{
    size_t contents = begin_chunk(model, "XYZI");
    add_number(model, count);
    add_bytes(model, voxels, 4 * (size_t)count);
    end_chunk(model, contents);
}

static inline void add_string(struct model *model, const char *text)
{
    add_number(model, (uint32_t)strlen(text));
    add_bytes(model, text, strlen(text));
}

/* What transform nodes and layers say of themselves. */
static inline void add_attributes(struct model *model, bool hidden)
{
    add_number(model, hidden ? 2 : 1);
    add_string(model, "_name");
    add_string(model, "part");
    if (hidden) {
        add_string(model, "_hidden");
        add_string(model, "1");
    }
}

static inline void add_layer(struct model *model, uint32_t id, bool hidden)
{
    size_t contents = begin_chunk(model, "LAYR");
    add_number(model, id);
    add_attributes(model, hidden);
    add_number(model, UINT32_MAX);
    end_chunk(model, contents);
}

/* A transform node; texts that are NULL are left out. */
static inline void add_transform_of_layer(struct model *model, uint32_t layer, uint32_t id, uint32_t child,
                                          const char *rotation, const char *translation, bool hidden)
{
    size_t contents = begin_chunk(model, "nTRN");
    add_number(model, id);
    add_attributes(model, hidden);
    add_number(model, child);
    add_number(model, UINT32_MAX);
    add_number(model, layer);
    add_number(model, 1);
    add_number(model, (rotation != NULL) + (translation != NULL));
    if (rotation) {
        add_string(model, "_r");
        add_string(model, rotation);
    }
    if (translation) {
        add_string(model, "_t");
        add_string(model, translation);
    }
    end_chunk(model, contents);
}

static inline void add_transform(struct model *model, uint32_t id, uint32_t child, const char *rotation,
                                 const char *translation, bool hidden)
{
    add_transform_of_layer(model, 0, id, child, rotation, translation, hidden);
}

static inline void add_group(struct model *model, uint32_t id, const uint32_t *children, uint32_t count)
{
    size_t contents = begin_chunk(model, "nGRP");
    add_number(model, id);
    add_number(model, 0);
    add_number(model, count);
    for (uint32_t i = 0; i < count; i++)
        add_number(model, children[i]);
    end_chunk(model, contents);
}

static inline void add_shape(struct model *model, uint32_t id, uint32_t of_model)
{
    size_t contents = begin_chunk(model, "nSHP");
    add_number(model, id);
    add_number(model, 0);
    add_number(model, 1);
    add_number(model, of_model);
    add_number(model, 0);
    end_chunk(model, contents);
}

/* Makes a.vox. (A file that is cut to nothing and rewritten is flushed by some file
 * systems, which takes time.) */
static inline void write_model(const unsigned char *data, size_t size)
{
    unlink("a.vox");
    write_bytes("a.vox", data, size);
}

static inline struct octree load(const struct model *model)
{
    struct error err = {0};
    struct octree tree = {0};
    write_model(model->data, model->size);
    assert_ok(vox_load("a.vox", &tree, &err), &err);
    return tree;
}

/* An L: a foot that points along the file's x, a hand along its y, a tall body along its z. */
static const unsigned char letter[][4] = {
    {0, 0, 0, 1}, {1, 0, 0, 2}, {0, 1, 0, 3}, {0, 0, 1, 4}, {0, 0, 2, 5}};

#endif
