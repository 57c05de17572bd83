#include "common/octree_chunks.h"

#include "common/array.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static struct octree_chunk *find(const struct octree_chunks *chunks, const char *name)
{
    for (size_t i = 0; i < chunks->count; i++)
        if (!strcmp(chunks->items[i].name, name))
            return &chunks->items[i];
    return NULL;
}

const struct octree_chunk *octree_chunks_find(const struct octree_chunks *chunks, const char *name)
{
    return find(chunks, name);
}

enum status octree_chunks_put(struct octree_chunks *chunks, const char *name, struct bytes *data,
                              struct error *err)
{
    assert(strlen(name) == sizeof chunks->items->name - 1);
    struct octree_chunk *chunk = find(chunks, name);
    if (chunk) {
        bytes_clear(&chunk->data);
    } else {
        if (!ARRAY_RESERVE(chunks, 1))
            return error_no_memory(err, "a chunk");
        chunk = &chunks->items[chunks->count++];
        memcpy(chunk->name, name, sizeof chunk->name);
    }
    chunk->data = *data;
    *data = (struct bytes){0};
    return STATUS_OK;
}

void octree_chunks_drop(struct octree_chunks *chunks, const char *name)
{
    struct octree_chunk *chunk = find(chunks, name);
    if (!chunk)
        return;
    bytes_clear(&chunk->data);
    const size_t behind = (size_t)(chunks->items + chunks->count - (chunk + 1));
    memmove(chunk, chunk + 1, behind * sizeof *chunk);
    chunks->count--;
}

void octree_chunks_clear(struct octree_chunks *chunks)
{
    for (size_t i = 0; i < chunks->count; i++)
        bytes_clear(&chunks->items[i].data);
    free(chunks->items);
    *chunks = (struct octree_chunks){0};
}
