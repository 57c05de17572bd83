#include "sim/checkpoint.h"
#include "common/crc.h"
#include "common/file.h"
#include "common/hash.h"
#include "common/little_endian.h"
#include "sim/checkpoint_chunks.h"

#include <stdlib.h>
#include <string.h>

const unsigned char checkpoint_signature[8] = {0x89, 'b', 'c', 'k', '\r', '\n', 0x1a, '\n'};

char *checkpoint_keys(const struct sim *sim)
{
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    scene_write_keys(sim->scene, stream);
    if (!fclose(stream))
        return text;
    free(text);
    return NULL;
}

uint64_t checkpoint_fingerprint(const struct sim *sim)
{
    if (sim->fingerprint)
        return sim->fingerprint;
    uint64_t hash = HASH_START;
    hash = hash_bytes(hash, sim->edge_point, sim->edge_count * sizeof *sim->edge_point);
    hash = hash_bytes(hash, sim->rest_length, sim->edge_count * sizeof *sim->rest_length);
    hash = hash_bytes(hash, sim->triangle_point, sim->triangle_count * sizeof *sim->triangle_point);
    return hash_bytes(hash, sim->mass, sim->point_count * sizeof *sim->mass);
}

/* A chunk whose contents are `first` and then `rest`; either may be empty. */
static void write_chunk(FILE *stream, const char *name, const void *first, size_t first_size,
                        const void *rest, size_t rest_size)
{
    unsigned char head[CHECKPOINT_CHUNK_HEAD], tail[CHECKPOINT_CHUNK_TAIL];
    memcpy(head, name, CHECKPOINT_NAME);
    put_bits(head + CHECKPOINT_NAME, first_size + rest_size, 8);
    uint32_t crc = crc32_bytes(crc32_bytes(0, head, sizeof head), first, first_size);
    put_bits(tail, crc32_bytes(crc, rest, rest_size), 4);
    fwrite(head, 1, sizeof head, stream);
    if (first_size > 0)
        fwrite(first, 1, first_size, stream);
    if (rest_size > 0)
        fwrite(rest, 1, rest_size, stream);
    fwrite(tail, 1, sizeof tail, stream);
}

static void write_head(FILE *stream, const struct sim *sim)
{
    unsigned char head[CHECKPOINT_HEAD_SIZE];
    const uint32_t order = CHECKPOINT_ORDER;
    put_bits(head, CHECKPOINT_VERSION, 4);
    memcpy(head + 4, &order, sizeof order);
    put_bits(head + 8, checkpoint_fingerprint(sim), 8);
    write_chunk(stream, "HEAD", head, sizeof head, NULL, 0);
}

static void write_run(FILE *stream, const struct checkpoint_run *run)
{
    unsigned char contents[CHECKPOINT_RUN_SIZE];
    uint64_t bits[2];
    memcpy(&bits[0], &run->first_break, sizeof bits[0]);
    memcpy(&bits[1], &run->seconds, sizeof bits[1]);
    put_bits(contents, bits[0], 8);
    put_bits(contents + 8, bits[1], 8);
    put_bits(contents + 16, run->shown, 8);
    write_chunk(stream, "RUN ", contents, sizeof contents, NULL, 0);
    write_chunk(stream, "ROWS", run->rows, run->row_bytes, NULL, 0);
}

static void write_state(FILE *stream, struct sim *sim)
{
    size_t count;
    const struct sim_block *blocks = sim_blocks(sim, &count);
    for (size_t i = 0; i < count; i++) {
        unsigned char title[4 + 64];
        const size_t length = strnlen(blocks[i].name, 64);
        put_bits(title, length, 4);
        memcpy(title + 4, blocks[i].name, length);
        write_chunk(stream, "DATA", title, 4 + length, blocks[i].data, blocks[i].size);
    }
}

enum status checkpoint_save(struct sim *sim, const struct checkpoint_run *run, const char *path,
                            struct error *err)
{
    char *keys = checkpoint_keys(sim);
    if (!keys)
        return error_no_memory(err, "the checkpoint");
    struct file_out *out = NULL;
    enum status status = file_out_open(path, &out, err);
    if (!status) {
        FILE *stream = file_out_stream(out);
        fwrite(checkpoint_signature, 1, sizeof checkpoint_signature, stream);
        write_head(stream, sim);
        write_chunk(stream, "KEYS", keys, strlen(keys), NULL, 0);
        write_run(stream, run);
        write_state(stream, sim);
        write_chunk(stream, "END ", NULL, 0, NULL, 0);
        status = file_out_commit(out, err);
    }
    free(keys);
    return status;
}
