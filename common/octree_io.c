/*
 * Octrees as files. An .oct file is a signature and chunks; all numbers are little endian:
 *
 *     8 bytes          0x89 'o' 'c' 't' '\r' '\n' 0x1a '\n': as in PNG, so that a transfer that changes line
 *                      ends or drops the eighth bit is found out at once
 *     chunks           4 bytes name, 4 bytes size of the contents, the contents, 4 bytes CRC-32 of all those
 *
 *     "HEAD"  first    4 bytes version, 4 bytes depth, 8 bytes number of leaves (empty ones too)
 *     "COEF"  optional for each coefficient b_k that is not 1, materials ascending: 1 byte material, 4 bytes
 *                      IEEE float
 *     "TREE"           the cells: see octree_code.h
 *     others  optional behind TREE, see octree_chunks.h: "CHIP" the chip log, "PREV" a preview picture
 *     "END "  last     nothing
 *
 * Chunks with other names are skipped, so that later versions can add some without locking out this one; a
 * change that it would misread has a new version number.
 */
#include "common/array.h"
#include "common/crc.h"
#include "common/little_endian.h"
#include "common/octree_chunks.h"
#include "common/octree_code.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const unsigned char signature[8] = {0x89, 'o', 'c', 't', '\r', '\n', 0x1a, '\n'};

enum {
    NAME_SIZE = 4,
    HEAD_SIZE = 16,
    COEFFICIENT_SIZE = 5,
    CHUNK_OVERHEAD = NAME_SIZE + 4 + 4,
};

static void write_chunk(FILE *stream, const char *name, const unsigned char *contents, size_t size)
{
    unsigned char head[NAME_SIZE + 4], tail[4];
    memcpy(head, name, NAME_SIZE);
    put_bits(head + NAME_SIZE, size, 4);
    put_bits(tail, crc32_bytes(crc32_bytes(0, head, sizeof head), contents, size), 4);
    fwrite(head, 1, sizeof head, stream);
    if (size > 0)
        fwrite(contents, 1, size, stream);
    fwrite(tail, 1, sizeof tail, stream);
}

static void write_head(FILE *stream, const struct octree *tree)
{
    unsigned char head[HEAD_SIZE];
    put_bits(head, OCTREE_FORMAT_VERSION, 4);
    put_bits(head + 4, tree->depth, 4);
    put_bits(head + 8, octree_leaf_count(tree), 8);
    write_chunk(stream, "HEAD", head, sizeof head);
}

static void write_coefficients(FILE *stream, const struct octree *tree)
{
    unsigned char list[OCTREE_MATERIALS * COEFFICIENT_SIZE];
    size_t size = 0;
    for (unsigned m = 1; m < OCTREE_MATERIALS; m++) {
        if (tree->coefficient[m] == 1)
            continue;
        uint32_t bits;
        memcpy(&bits, &tree->coefficient[m], sizeof bits);
        list[size] = (unsigned char)m;
        put_bits(list + size + 1, bits, 4);
        size += COEFFICIENT_SIZE;
    }
    if (size > 0)
        write_chunk(stream, "COEF", list, size);
}

static enum status check_sizes(const struct octree_chunks *chunks, const char *path, struct error *err)
{
    for (size_t i = 0; i < chunks->count; i++)
        if (chunks->items[i].data.size > UINT32_MAX)
            return error_set(err, STATUS_RANGE, "%s: chunk %s has %zu bytes; at most %u are possible", path,
                             chunks->items[i].name, chunks->items[i].data.size, UINT32_MAX);
    return STATUS_OK;
}

enum status octree_save(const struct octree *tree, const char *path, struct error *err)
{
    return octree_save_with(tree, NULL, path, err);
}

enum status octree_save_with(const struct octree *tree, const struct octree_chunks *chunks, const char *path,
                             struct error *err)
{
    static const struct octree_chunks none = {0};
    chunks = chunks ? chunks : &none;
    struct octree_code code = {0};
    struct file_out *out = NULL;
    enum status status = check_sizes(chunks, path, err);
    if (!status)
        status = octree_encode(tree, &code, err);
    if (!status)
        status = file_out_open(path, &out, err);
    if (!status) {
        FILE *stream = file_out_stream(out);
        fwrite(signature, 1, sizeof signature, stream);
        write_head(stream, tree);
        write_coefficients(stream, tree);
        write_chunk(stream, "TREE", code.items, code.count);
        for (size_t i = 0; i < chunks->count; i++)
            write_chunk(stream, chunks->items[i].name, chunks->items[i].data.data,
                        chunks->items[i].data.size);
        write_chunk(stream, "END ", NULL, 0);
        status = file_out_commit(out, err);
    }
    free(code.items);
    return status;
}

/* A chunk as it lies in the file. */
struct chunk {
    char name[NAME_SIZE + 1];
    const unsigned char *contents;
    size_t size;
};

struct loader {
    struct octree tree;
    struct octree_chunks *chunks; /* where the others go; NULL: nowhere */
    uint64_t leaves;              /* as HEAD has it */
    bool has_head, has_coefficients, has_tree;
};

static enum status refuse_chunk(struct error *err, const struct chunk *chunk, const char *what)
{
    return error_set(err, STATUS_INPUT, "chunk %s: %s", chunk->name, what);
}

/* The chunk at *at of the file, with a sound checksum; *at then leads to the next. */
static enum status next_chunk(const struct bytes *file, size_t *at, struct chunk *chunk, struct error *err)
{
    const unsigned char *head = file->data + *at;
    size_t left = file->size - *at;
    if (left < CHUNK_OVERHEAD)
        return error_set(err, STATUS_INPUT, "cut short at byte %zu: the last chunk, END, is missing", *at);
    for (int i = 0; i < NAME_SIZE; i++)
        chunk->name[i] = isprint(head[i]) ? (char)head[i] : '?';
    chunk->name[NAME_SIZE] = '\0';
    chunk->size = get_bits(head + NAME_SIZE, 4);
    chunk->contents = head + NAME_SIZE + 4;
    if (chunk->size > left - CHUNK_OVERHEAD)
        return error_set(
            err, STATUS_INPUT,
            "chunk %s at byte %zu: claims %zu bytes where %zu are left; the file is cut short or "
            "damaged",
            chunk->name, *at, chunk->size, left - CHUNK_OVERHEAD);
    if (crc32_bytes(0, head, NAME_SIZE + 4 + chunk->size) != get_bits(chunk->contents + chunk->size, 4))
        return error_set(err, STATUS_INPUT,
                         "chunk %s at byte %zu: the checksum does not match; the file is damaged",
                         chunk->name, *at);
    *at += CHUNK_OVERHEAD + chunk->size;
    return STATUS_OK;
}

static enum status load_head(struct loader *loader, const struct chunk *chunk, struct error *err)
{
    if (loader->has_head)
        return refuse_chunk(err, chunk, "is there twice");
    if (chunk->size < 4)
        return refuse_chunk(err, chunk, "has no version");
    uint64_t version = get_bits(chunk->contents, 4);
    if (version != OCTREE_FORMAT_VERSION)
        return error_set(err, STATUS_INPUT,
                         "chunk %s: version %u of the format; this program reads version %d", chunk->name,
                         (unsigned)version, OCTREE_FORMAT_VERSION);
    if (chunk->size != HEAD_SIZE)
        return error_set(err, STATUS_INPUT, "chunk %s: has %zu bytes, must have %d", chunk->name, chunk->size,
                         HEAD_SIZE);
    uint64_t depth = get_bits(chunk->contents + 4, 4);
    if (depth > OCTREE_DEPTH_MAX)
        return error_set(err, STATUS_INPUT, "chunk %s: depth %u; at most %d is possible", chunk->name,
                         (unsigned)depth, OCTREE_DEPTH_MAX);
    loader->leaves = get_bits(chunk->contents + 8, 8);
    loader->has_head = true;
    return octree_init(&loader->tree, (unsigned)depth, 0, err);
}

static enum status load_coefficients(struct loader *loader, const struct chunk *chunk, struct error *err)
{
    if (loader->has_coefficients)
        return refuse_chunk(err, chunk, "is there twice");
    loader->has_coefficients = true;
    if (chunk->size % COEFFICIENT_SIZE)
        return refuse_chunk(err, chunk, "its size is no multiple of 5 bytes");
    unsigned before = 0;
    for (size_t at = 0; at < chunk->size; at += COEFFICIENT_SIZE) {
        unsigned material = chunk->contents[at];
        uint32_t bits = (uint32_t)get_bits(chunk->contents + at + 1, 4);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (material <= before)
            return refuse_chunk(err, chunk, "its materials are not in ascending order from 1");
        if (!(fabsf(value) <= (float)OCTREE_COEFFICIENT_MAX))
            return error_set(err, STATUS_INPUT,
                             "chunk %s: coefficient %g of material %u; must be within +-%g", chunk->name,
                             (double)value, material, OCTREE_COEFFICIENT_MAX);
        loader->tree.coefficient[material] = value;
        before = material;
    }
    return STATUS_OK;
}

static enum status load_cells(struct loader *loader, const struct chunk *chunk, struct error *err)
{
    if (loader->has_tree)
        return refuse_chunk(err, chunk, "is there twice");
    loader->has_tree = true;
    enum status status = octree_decode(chunk->contents, chunk->size, &loader->tree, err);
    if (status == STATUS_INPUT && err)
        error_prefix(err, "chunk TREE");
    if (status)
        return status;
    uint64_t leaves = octree_leaf_count(&loader->tree);
    if (leaves != loader->leaves)
        return error_set(err, STATUS_INPUT, "chunk HEAD: claims %llu leaves, chunk TREE has %llu",
                         (unsigned long long)loader->leaves, (unsigned long long)leaves);
    return STATUS_OK;
}

static enum status keep_chunk(struct loader *loader, const struct chunk *chunk, struct error *err)
{
    if (!loader->chunks)
        return STATUS_OK;
    unsigned char *data = array_new(chunk->size + 1, 1);
    if (!data || !ARRAY_RESERVE(loader->chunks, 1)) {
        free(data);
        return error_no_memory(err, "a chunk");
    }
    memcpy(data, chunk->contents, chunk->size);
    data[chunk->size] = '\0';
    struct octree_chunk *kept = &loader->chunks->items[loader->chunks->count++];
    memcpy(kept->name, chunk->name, sizeof kept->name);
    kept->data = (struct bytes){data, chunk->size};
    return STATUS_OK;
}

static enum status load_chunk(struct loader *loader, const struct chunk *chunk, struct error *err)
{
    if (!strcmp(chunk->name, "HEAD"))
        return load_head(loader, chunk, err);
    if (!loader->has_head)
        return refuse_chunk(err, chunk, "comes before the chunk HEAD");
    if (!strcmp(chunk->name, "COEF"))
        return load_coefficients(loader, chunk, err);
    if (!strcmp(chunk->name, "TREE"))
        return load_cells(loader, chunk, err);
    return strcmp(chunk->name, "END ") ? keep_chunk(loader, chunk, err) : STATUS_OK;
}

static enum status load_bytes(struct loader *loader, const struct bytes *file, struct error *err)
{
    if (file->size == 0)
        return error_set(err, STATUS_INPUT, "the file is empty; an .oct file is wanted");
    if (file->size < sizeof signature || memcmp(file->data, signature, sizeof signature) != 0)
        return error_set(
            err, STATUS_INPUT,
            "not an .oct file: it does not begin with the signature of one; balloon-sculpt --script or --import makes one");
    struct chunk chunk = {0};
    size_t at = sizeof signature;
    while (strcmp(chunk.name, "END ") != 0) {
        enum status status = next_chunk(file, &at, &chunk, err);
        if (!status)
            status = load_chunk(loader, &chunk, err);
        if (status)
            return status;
    }
    if (at != file->size)
        return error_set(err, STATUS_INPUT, "chunk END: %zu bytes follow it; the file must end there",
                         file->size - at);
    if (!loader->has_tree)
        return error_set(err, STATUS_INPUT, "the chunk %s is missing", loader->has_head ? "TREE" : "HEAD");
    return STATUS_OK;
}

enum status octree_load(const char *path, struct octree *tree, struct error *err)
{
    return octree_load_with(path, tree, NULL, err);
}

enum status octree_load_with(const char *path, struct octree *tree, struct octree_chunks *chunks,
                             struct error *err)
{
    struct bytes file = {0};
    enum status status = file_read_signed(path, signature, sizeof signature, &file, err);
    if (status)
        return status;
    struct octree_chunks others = {0};
    struct loader loader = {.chunks = chunks ? &others : NULL};
    status = load_bytes(&loader, &file, err);
    bytes_clear(&file);
    if (status) {
        octree_clear(&loader.tree);
        octree_chunks_clear(&others);
        if (err)
            error_prefix(err, path);
        return status;
    }
    octree_clear(tree);
    *tree = loader.tree;
    if (chunks) {
        octree_chunks_clear(chunks);
        *chunks = others;
    }
    return STATUS_OK;
}
