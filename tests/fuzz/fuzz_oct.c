#include "common/crc.h"
#include "common/octree.h"
#include "fuzz.h"
#include "limits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { SIGNATURE_SIZE = 8, CHUNK_HEAD = 8, CHUNK_TAIL = 4 };

/* Puts the right checksum behind every chunk, for else hardly any damage gets past it. */
static void mend_checksums(uint8_t *bytes, size_t size)
{
    size_t at = SIGNATURE_SIZE;
    while (at < size && size - at >= CHUNK_HEAD + CHUNK_TAIL) {
        size_t length = 0;
        for (int i = 0; i < 4; i++)
            length |= (size_t)bytes[at + 4 + (size_t)i] << 8 * i;
        if (length > size - at - CHUNK_HEAD - CHUNK_TAIL)
            return;
        uint32_t crc = crc32_bytes(0, bytes + at, CHUNK_HEAD + length);
        at += CHUNK_HEAD + length;
        for (int i = 0; i < CHUNK_TAIL; i++)
            bytes[at++] = (uint8_t)(crc >> 8 * i);
    }
}

static enum status load(const uint8_t *bytes, size_t size, struct octree *tree, struct error *err)
{
    char path[40];
    int file = memfd_create("fuzz", 0);
    must(file >= 0 && write(file, bytes, size) == (ssize_t)size);
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    limits_begin();
    enum status status = octree_load(path, tree, err);
    limits_end(size);
    close(file);
    return status;
}

/* A tree that was read is whole: it can be walked, and shapes can be applied to it. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error err = {0};
    struct octree tree = {0}, copy = {0};
    uint8_t *bytes = malloc(size + 1);
    must(bytes != NULL);
    if (size > 0)
        memcpy(bytes, data, size);
    mend_checksums(bytes, size);
    enum status status = load(bytes, size, &tree, &err);
    free(bytes);
    must_say(status, &err);
    if (status) {
        must(tree.blocks == NULL);
        return 0;
    }
    struct octree_info info = octree_measure(&tree);
    must(info.full_leaves <= info.leaves && info.cells >= info.full_leaves);
    must(octree_copy(&copy, &tree, &err) == STATUS_OK && octree_equal(&copy, &tree));
    must(octree_set(&copy, 0, 0, 0, octree_at(&tree, 0, 0, 0) ^ 1, &err) == STATUS_OK);
    must(!octree_equal(&copy, &tree));
    must(octree_set(&copy, 0, 0, 0, octree_at(&tree, 0, 0, 0), &err) == STATUS_OK);
    must(octree_equal(&copy, &tree));
    octree_clear(&tree);
    octree_clear(&copy);
    return 0;
}
