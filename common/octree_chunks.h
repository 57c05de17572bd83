/*
 * What an .oct file may carry besides the sculpture: chunks that a reader who does not know them skips.
 *
 *     struct octree_chunks chunks = {0};
 *     if (octree_load_with("cat.oct", &tree, &chunks, err)) ...
 *     const struct octree_chunk *log = octree_chunks_find(&chunks, OCTREE_CHUNK_LOG);       NULL: there is none
 *     if (octree_chunks_put(&chunks, OCTREE_CHUNK_PREVIEW, &png, err)) ...                  png is now {0}
 *     if (octree_save_with(&tree, &chunks, "cat.oct", err)) ...
 *     octree_chunks_clear(&chunks);
 *
 * See octree_io.c for the layout.
 */
#ifndef COMMON_OCTREE_CHUNKS_H
#define COMMON_OCTREE_CHUNKS_H

#include "common/file.h"
#include "common/octree.h"

#define OCTREE_CHUNK_PREVIEW "PREV" /* a small picture, as the bytes of a PNG file */
#define OCTREE_CHUNK_LOG     "CHIP" /* a script (.chips) that makes this sculpture from the start */

struct octree_chunk {
    char name[5]; /* four printable letters; not HEAD, COEF, TREE or "END " */
    struct bytes data;
};

/* A growable array (see common/array.h). */
struct octree_chunks {
    struct octree_chunk *items;
    size_t count, capacity;
};

/* Like octree_load(); *chunks (valid; {0} is) is replaced by the chunks that are no part of the octree, in
 * the file's order, or as it was after a failure. */
enum status octree_load_with(const char *path, struct octree *tree, struct octree_chunks *chunks,
                             struct error *err);

/* Like octree_save(), with these chunks (NULL: none) behind the octree. Equal chunks are saved as equal
 * bytes. Errors: also STATUS_RANGE for a chunk of 4 GB or more. */
enum status octree_save_with(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                             struct error *err);

/* The first chunk of this name, or NULL. */
const struct octree_chunk *octree_chunks_find(const struct octree_chunks *chunks, const char *name);

/* Puts a chunk in the place of the one of this name, or at the end. Takes over *data, which becomes {0};
 * after STATUS_NO_MEMORY it is the caller's still. */
enum status octree_chunks_put(struct octree_chunks *chunks, const char *name, struct bytes *data,
                              struct error *err);

/* Takes the chunk of this name out, if there is one. */
void octree_chunks_drop(struct octree_chunks *chunks, const char *name);

void octree_chunks_clear(struct octree_chunks *chunks);

#endif
