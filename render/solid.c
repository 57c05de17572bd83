/* Keeps the blocks of a solid: found by a hash table, each with its faces in a
 * buffer on the graphics card. */
#include "common/array.h"
#include "render/parts.h"
#include "render/shaders.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum status render_solid_new(struct render *render, const double origin[3], double cell,
                             struct render_solid **result, struct error *err)
{
    if (!(cell > 0) || !isfinite(cell) || !isfinite(origin[0]) || !isfinite(origin[1]) ||
        !isfinite(origin[2]))
        return error_set(err, STATUS_RANGE,
                         "cells of %g at %g, %g, %g cannot be drawn; a finite size above 0 is needed", cell,
                         origin[0], origin[1], origin[2]);
    struct render_solid *solid = calloc(1, sizeof *solid);
    if (!solid)
        return error_no_memory(err, "the solid");
    *solid = (struct render_solid){.render = render, .cell = cell};
    memcpy(solid->origin, origin, sizeof solid->origin);
    *result = solid;
    return STATUS_OK;
}

/* The slot of this key, or the free one where it would be. Fibonacci hashing: Knuth, "The Art of Computer
 * Programming" 6.4, with 2^64 over the golden ratio. */
static size_t find_slot(const struct render_solid *solid, uint64_t key)
{
    size_t at = (size_t)(key * 0x9e3779b97f4a7c15u >> 32) & (solid->slot_count - 1);
    while (solid->slot[at] && solid->blocks.items[solid->slot[at] - 1].key != key)
        at = (at + 1) & (solid->slot_count - 1);
    return at;
}

static void fill_slots(struct render_solid *solid)
{
    memset(solid->slot, 0, solid->slot_count * sizeof *solid->slot);
    for (size_t i = 0; i < solid->blocks.count; i++)
        solid->slot[find_slot(solid, solid->blocks.items[i].key)] = (uint32_t)(i + 1);
}

/* Room for one more block, with at most half of the slots taken. */
static bool reserve_block(struct render_solid *solid)
{
    if (solid->blocks.count >= UINT32_MAX / 4 || !ARRAY_RESERVE(&solid->blocks, 1))
        return false;
    if (2 * (solid->blocks.count + 1) <= solid->slot_count)
        return true;
    size_t count = solid->slot_count ? 2 * solid->slot_count : 64;
    uint32_t *slot = array_new(count, sizeof *slot);
    if (!slot)
        return false;
    free(solid->slot);
    solid->slot = slot;
    solid->slot_count = count;
    fill_slots(solid);
    return true;
}

static struct solid_block *find_block(const struct render_solid *solid, uint64_t key)
{
    uint32_t number = solid->slot_count ? solid->slot[find_slot(solid, key)] : 0;
    return number ? &solid->blocks.items[number - 1] : NULL;
}

static void describe(const struct gl *gl, GLuint location, int size, GLenum type, bool unit, size_t offset)
{
    gl->EnableVertexAttribArray(location);
    gl->VertexAttribPointer(location, size, type, unit, sizeof(struct solid_vertex), (const void *)offset);
}

static struct solid_block *add_block(struct render_solid *solid, uint64_t key)
{
    const struct gl *gl = &solid->render->gl;
    struct solid_block *block = &solid->blocks.items[solid->blocks.count];
    *block = (struct solid_block){.key = key};
    gl->GenVertexArrays(1, &block->array);
    gl->GenBuffers(1, &block->buffer);
    gl->BindVertexArray(block->array);
    gl->BindBuffer(GL_ARRAY_BUFFER, block->buffer);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, solid->render->quads.buffer);
    describe(gl, SHADER_SOLID_PLACE, 4, GL_UNSIGNED_SHORT, false, offsetof(struct solid_vertex, place));
    describe(gl, SHADER_SOLID_COLOUR, 4, GL_UNSIGNED_INT_2_10_10_10_REV, true,
             offsetof(struct solid_vertex, colour));
    describe(gl, SHADER_SOLID_NORMAL, 3, GL_BYTE, true, offsetof(struct solid_vertex, normal));
    size_t slot = find_slot(solid, key);
    solid->slot[slot] = (uint32_t)++solid->blocks.count;
    return block;
}

static enum status check_faces(const struct render_face *faces, size_t count, struct error *err)
{
    if (count > UINT32_MAX / 8)
        return error_set(err, STATUS_RANGE, "%zu faces are more than a block can have", count);
    for (size_t i = 0; i < count; i++) {
        const struct render_face *face = &faces[i];
        int axis = face->side / 2;
        if (face->side > 5 || face->corner[(axis + 1) % 3] + face->size[0] > UINT16_MAX ||
            face->corner[(axis + 2) % 3] + face->size[1] > UINT16_MAX)
            return error_set(
                err, STATUS_RANGE,
                "face %zu of a solid: side %d, corner %d %d %d, size %d %d; the side must be 0 to 5 "
                "and no corner beyond 65535",
                i, face->side, face->corner[0], face->corner[1], face->corner[2], face->size[0],
                face->size[1]);
    }
    return STATUS_OK;
}

/* sRGB's curve, IEC 61966-2-1, to 10 bits of linear light. */
static uint32_t linear_10(uint8_t value)
{
    double v = value / 255.0;
    return (uint32_t)lrint(1023 * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4)));
}

static void fill_corners(struct solid_vertex *out, const struct render_face *face, const uint32_t linear[256])
{
    int axis = face->side / 2, along = (axis + 1) % 3, across = (axis + 2) % 3;
    for (int k = 0; k < 4; k++) {
        struct solid_vertex *v = &out[k];
        *v = (struct solid_vertex){.side = face->side};
        memcpy(v->place, face->corner, sizeof v->place);
        v->place[along] = (uint16_t)(v->place[along] + (k & 1 ? face->size[0] : 0));
        v->place[across] = (uint16_t)(v->place[across] + (k & 2 ? face->size[1] : 0));
        v->colour = linear[face->colour[0]] | linear[face->colour[1]] << 10 | linear[face->colour[2]] << 20;
        memcpy(v->normal, face->normal, sizeof face->normal);
    }
}

/* The faces' corners into solid->spare, sorted by side, and the block's bounds. */
static void fill_block(struct render_solid *solid, struct solid_block *block, const struct render_face *faces,
                       size_t count)
{
    uint32_t linear[256], next[6];
    for (int i = 0; i < 256; i++)
        linear[i] = linear_10((uint8_t)i);
    memset(block->first, 0, sizeof block->first);
    for (size_t i = 0; i < count; i++)
        block->first[faces[i].side + 1]++;
    for (int side = 0; side < 6; side++) {
        block->first[side + 1] += block->first[side];
        next[side] = block->first[side];
    }
    memset(block->low, 0xff, sizeof block->low);
    memset(block->high, 0, sizeof block->high);
    for (size_t i = 0; i < count; i++) {
        struct solid_vertex *corners = &solid->spare.items[4 * (size_t)next[faces[i].side]++];
        fill_corners(corners, &faces[i], linear);
        for (int axis = 0; axis < 3; axis++) {
            uint16_t low = corners[0].place[axis], high = corners[3].place[axis];
            block->low[axis] = low < block->low[axis] ? low : block->low[axis];
            block->high[axis] = high > block->high[axis] ? high : block->high[axis];
        }
    }
}

enum status render_solid_set(struct render_solid *solid, uint64_t key, const struct render_face *faces,
                             size_t count, struct error *err)
{
    struct render *render = solid->render;
    const struct gl *gl = &render->gl;
    if (!count) {
        render_solid_remove(solid, key);
        return STATUS_OK;
    }
    enum status status = check_faces(faces, count, err);
    if (!status && (!reserve_block(solid) || !ARRAY_RESERVE(&solid->spare, 4 * count)))
        status = error_no_memory(err, "the sculpture's faces");
    if (!status)
        status = render_use(render, err);
    if (status)
        return status;
    gl->BindVertexArray(0);
    status = quads_reserve(&render->quads, gl, count, err);
    if (status)
        return status;
    struct solid_block *block = find_block(solid, key);
    if (!block)
        block = add_block(solid, key);
    fill_block(solid, block, faces, count);
    gl->BindBuffer(GL_ARRAY_BUFFER, block->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(4 * count * sizeof *solid->spare.items), solid->spare.items,
                   GL_STATIC_DRAW);
    return STATUS_OK;
}

static void drop_block(const struct render_solid *solid, const struct solid_block *block)
{
    solid->render->gl.DeleteVertexArrays(1, &block->array);
    solid->render->gl.DeleteBuffers(1, &block->buffer);
}

/* Moves keys that were pushed past the slot that becomes free back to where they are found without it. */
static void free_slot(struct render_solid *solid, size_t slot)
{
    size_t mask = solid->slot_count - 1;
    solid->slot[slot] = 0;
    for (size_t at = (slot + 1) & mask; solid->slot[at]; at = (at + 1) & mask) {
        uint32_t number = solid->slot[at];
        solid->slot[at] = 0;
        solid->slot[find_slot(solid, solid->blocks.items[number - 1].key)] = number;
    }
}

void render_solid_remove(struct render_solid *solid, uint64_t key)
{
    struct error ignored;
    struct solid_block *block = find_block(solid, key);
    if (!block || render_use(solid->render, &ignored))
        return;
    drop_block(solid, block);
    free_slot(solid, find_slot(solid, key));
    struct solid_block *last = &solid->blocks.items[solid->blocks.count - 1];
    if (block != last) {
        solid->slot[find_slot(solid, last->key)] = (uint32_t)(block - solid->blocks.items) + 1;
        *block = *last;
    }
    solid->blocks.count--;
}

void render_solid_remove_all(struct render_solid *solid)
{
    struct error ignored;
    if (!solid->blocks.count || render_use(solid->render, &ignored))
        return;
    for (size_t i = 0; i < solid->blocks.count; i++)
        drop_block(solid, &solid->blocks.items[i]);
    solid->blocks.count = 0;
    fill_slots(solid);
}

size_t render_solid_faces(const struct render_solid *solid)
{
    size_t sum = 0;
    for (size_t i = 0; i < solid->blocks.count; i++)
        sum += solid->blocks.items[i].first[6];
    return sum;
}

void render_solid_free(struct render_solid *solid)
{
    if (!solid)
        return;
    render_solid_remove_all(solid);
    free(solid->blocks.items);
    free(solid->slot);
    free(solid->spare.items);
    free(solid);
}
