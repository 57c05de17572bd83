/* Reads what checkpoint.c writes, chunk by chunk. */
#include "common/array.h"
#include "common/crc.h"
#include "common/file.h"
#include "common/little_endian.h"
#include "sim/checkpoint.h"
#include "sim/checkpoint_chunks.h"
#include "sim/guard.h"
#include "sim/ledger.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A chunk as it lies in the file. */
struct chunk {
    char name[CHECKPOINT_NAME + 1];
    const unsigned char *contents;
    size_t size, at;
};

struct reader {
    struct bytes file;
    size_t at;
    struct sim *sim;
    uint64_t fingerprint;
};

static enum status refuse(const struct chunk *chunk, const char *what, struct error *err)
{
    return error_set(err, STATUS_INPUT, "chunk %s at byte %zu: %s", chunk->name, chunk->at, what);
}

/* The next chunk, with a sound checksum; it must have this name. */
static enum status next_chunk(struct reader *reader, const char *name, struct chunk *chunk, struct error *err)
{
    const unsigned char *head = reader->file.data + reader->at;
    const size_t left = reader->file.size - reader->at,
                 overhead = CHECKPOINT_CHUNK_HEAD + CHECKPOINT_CHUNK_TAIL;
    if (left < overhead)
        return error_set(err, STATUS_INPUT, "cut short at byte %zu: chunk %s and what follows it are missing",
                         reader->at, name);
    for (int i = 0; i < CHECKPOINT_NAME; i++)
        chunk->name[i] = isprint(head[i]) ? (char)head[i] : '?';
    chunk->name[CHECKPOINT_NAME] = '\0';
    chunk->at = reader->at;
    const uint64_t size = get_bits(head + CHECKPOINT_NAME, 8);
    if (size > left - overhead)
        return error_set(err, STATUS_INPUT,
                         "chunk %s at byte %zu: claims %llu bytes where %zu are left; the file is cut short "
                         "or damaged",
                         chunk->name, chunk->at, (unsigned long long)size, left - overhead);
    chunk->size = (size_t)size;
    chunk->contents = head + CHECKPOINT_CHUNK_HEAD;
    if (crc32_bytes(0, head, CHECKPOINT_CHUNK_HEAD + chunk->size) !=
        get_bits(chunk->contents + chunk->size, CHECKPOINT_CHUNK_TAIL))
        return refuse(chunk, "the checksum does not match; the file is damaged", err);
    if (strcmp(chunk->name, name) != 0)
        return error_set(err, STATUS_INPUT, "chunk %s at byte %zu: here chunk %s must be", chunk->name,
                         chunk->at, name);
    reader->at += overhead + chunk->size;
    return STATUS_OK;
}

static enum status read_head(struct reader *reader, struct error *err)
{
    struct chunk chunk;
    enum status status = next_chunk(reader, "HEAD", &chunk, err);
    if (status)
        return status;
    const uint64_t version = chunk.size < 4 ? 0 : get_bits(chunk.contents, 4);
    if (version != CHECKPOINT_VERSION)
        return error_set(err, STATUS_INPUT,
                         "chunk HEAD: version %llu of the format; this program reads version %d",
                         (unsigned long long)version, CHECKPOINT_VERSION);
    uint32_t order = 0;
    if (chunk.size == CHECKPOINT_HEAD_SIZE)
        memcpy(&order, chunk.contents + 4, sizeof order);
    if (order != CHECKPOINT_ORDER)
        return refuse(&chunk, "was written by a machine with another order of bytes, or is damaged", err);
    reader->fingerprint = get_bits(chunk.contents + 8, 8);
    return STATUS_OK;
}

/* A copy with a NUL behind it. */
static char *copy_text(const struct chunk *chunk)
{
    char *text = array_new(chunk->size + 1, 1);
    if (!text)
        return NULL;
    memcpy(text, chunk->contents, chunk->size);
    text[chunk->size] = '\0';
    return text;
}

/* Keys first, since they say more: what a key changes may change the meshes too. */
static enum status compare_scenes(struct reader *reader, struct error *err)
{
    struct chunk chunk;
    enum status status = next_chunk(reader, "KEYS", &chunk, err);
    if (status)
        return status;
    char *was = copy_text(&chunk), *is = checkpoint_keys(reader->sim), what[512];
    if (!was || !is)
        status = error_no_memory(err, "the checkpoint");
    else if (scene_keys_differ(was, is, what, sizeof what))
        status = error_set(err, STATUS_INPUT, "is of another scene: %s", what);
    else if (reader->fingerprint != checkpoint_fingerprint(reader->sim))
        status = error_set(err, STATUS_INPUT,
                           "is of another scene: the meshes of %s have other points, edges or triangles",
                           reader->sim->scene->path);
    free(was);
    free(is);
    return status;
}

static enum status read_run(struct reader *reader, struct checkpoint_run *run, struct error *err)
{
    struct chunk chunk;
    enum status status = next_chunk(reader, "RUN ", &chunk, err);
    if (status)
        return status;
    if (chunk.size != CHECKPOINT_RUN_SIZE)
        return refuse(&chunk, "has another size than it must have", err);
    const uint64_t bits[2] = {get_bits(chunk.contents, 8), get_bits(chunk.contents + 8, 8)};
    memcpy(&run->first_break, &bits[0], sizeof bits[0]);
    memcpy(&run->seconds, &bits[1], sizeof bits[1]);
    run->shown = get_bits(chunk.contents + 16, 8);
    if (!isfinite(run->first_break) || !(run->seconds >= 0) || !isfinite(run->seconds))
        return refuse(&chunk, "its times are none", err);
    status = next_chunk(reader, "ROWS", &chunk, err);
    if (status)
        return status;
    run->row_bytes = chunk.size;
    run->rows = copy_text(&chunk);
    return run->rows ? STATUS_OK : error_no_memory(err, "the checkpoint");
}

/* Blocks that no future depends on: they may be missing, or be there for nothing. */
static bool only_records(const char *name)
{
    return !strncmp(name, "ledger", strlen("ledger"));
}

/* Parts a DATA chunk into the block's name and its bytes. */
static enum status take_block(const struct chunk *chunk, char name[65], const unsigned char **data,
                              size_t *size, struct error *err)
{
    const uint64_t length = chunk->size < 4 ? UINT64_MAX : get_bits(chunk->contents, 4);
    if (length > 64 || length > chunk->size - 4)
        return refuse(chunk, "has no name", err);
    memcpy(name, chunk->contents + 4, length);
    name[length] = '\0';
    *data = chunk->contents + 4 + length;
    *size = chunk->size - 4 - length;
    return STATUS_OK;
}

/* Whether the next chunk is one of this name, sound or not. */
static bool comes_next(const struct reader *reader, const char *name)
{
    return reader->file.size - reader->at >= CHECKPOINT_NAME &&
           !memcmp(reader->file.data + reader->at, name, CHECKPOINT_NAME);
}

static enum status refuse_block(const struct chunk *chunk, const char *name, const struct sim_block *wanted,
                                size_t size, struct error *err)
{
    if (wanted && !strcmp(name, wanted->name))
        return error_set(err, STATUS_INPUT,
                         "chunk DATA at byte %zu: `%s` has %zu bytes, and must have %zu here", chunk->at,
                         name, size, wanted->size);
    return error_set(err, STATUS_INPUT,
                     "chunk DATA at byte %zu: `%s` where `%s` must be; was it written by another version?",
                     chunk->at, name, wanted ? wanted->name : "END ");
}

/* Fills the state with the DATA chunks that come next. */
static enum status read_blocks(struct reader *reader, struct error *err)
{
    size_t count, filled = 0;
    const struct sim_block *blocks = sim_blocks(reader->sim, &count);
    while (comes_next(reader, "DATA")) {
        struct chunk chunk;
        const unsigned char *data = NULL;
        char name[65];
        size_t size = 0;
        enum status status = next_chunk(reader, "DATA", &chunk, err);
        if (!status)
            status = take_block(&chunk, name, &data, &size, err);
        if (status)
            return status;
        const struct sim_block *block = filled < count ? &blocks[filled] : NULL;
        if (block && !strcmp(name, block->name) && size == block->size) {
            if (size > 0)
                memcpy(block->data, data, size);
            filled++;
        } else if (!only_records(name)) {
            return refuse_block(&chunk, name, block, size, err);
        }
    }
    struct chunk missing;
    if (filled < count && !only_records(blocks[filled].name))
        return next_chunk(reader, "DATA", &missing, err); /* which says what is there instead */
    if (filled < count)
        ledger_begin(reader->sim);
    return STATUS_OK;
}

static bool all_flags(const void *data, size_t count)
{
    const unsigned char *byte = data;
    unsigned char all = 0;
    for (size_t i = 0; i < count; i++)
        all |= byte[i];
    return all <= 1;
}

static bool all_finite(double (*const row)[4], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(row[i][0]) || !isfinite(row[i][1]) || !isfinite(row[i][2]))
            return false;
    return true;
}

/* Bytes with a sound checksum may still be no state: flags that are no flags, a time that does not advance,
 * points that are nowhere. */
static bool is_state(const struct sim *sim)
{
    const double least = 1e-9, most = 1e6; /* the range of time.step */
    return all_flags(sim->edge_active, sim->edge_count) &&
           all_flags(sim->triangle_active, sim->triangle_count) && all_flags(&sim->edges_broke, 1) &&
           all_flags(&sim->changed, 1) && all_finite(sim->position, sim->point_count) &&
           all_finite(sim->velocity, sim->point_count) && isfinite(sim->time) && sim->time >= 0 &&
           sim->time_base >= 0 && sim->time_base <= sim->time && sim->whole_step >= least &&
           sim->whole_step <= most && sim->substeps >= 1 && sim->substeps <= GUARD_PARTS_MAX &&
           sim->step > 0 && sim->step <= most;
}

static enum status read_state(struct reader *reader, struct error *err)
{
    const size_t at = reader->at;
    enum status status = read_blocks(reader, err);
    if (!status && (!is_state(reader->sim) || !sim_restored(reader->sim)))
        return error_set(
            err, STATUS_INPUT,
            "the chunks DATA from byte %zu on are no state: a flag, a time or a point is out of its range",
            at);
    return status;
}

static enum status read_all(struct reader *reader, struct checkpoint_run *run, struct error *err)
{
    if (reader->file.size < sizeof checkpoint_signature ||
        memcmp(reader->file.data, checkpoint_signature, sizeof checkpoint_signature) != 0)
        return error_set(err, STATUS_INPUT, "not a checkpoint: it does not begin with the signature of one");
    reader->at = sizeof checkpoint_signature;
    struct chunk chunk;
    enum status status = read_head(reader, err);
    if (!status)
        status = compare_scenes(reader, err);
    if (!status)
        status = read_run(reader, run, err);
    if (!status)
        status = read_state(reader, err);
    if (!status)
        status = next_chunk(reader, "END ", &chunk, err);
    if (!status && reader->at != reader->file.size)
        status = error_set(err, STATUS_INPUT, "%zu bytes follow chunk END; the file must end there",
                           reader->file.size - reader->at);
    return status;
}

enum status checkpoint_load(const char *path, struct sim *sim, struct checkpoint_run *run, struct error *err)
{
    struct reader reader = {.sim = sim};
    struct checkpoint_run got = {0};
    enum status status = file_read_signed(path, checkpoint_signature, sizeof checkpoint_signature,
                                          &reader.file, err);
    if (status)
        return status;
    status = read_all(&reader, &got, err);
    bytes_clear(&reader.file);
    if (status) {
        free(got.rows);
        return err ? error_prefix(err, path) : status;
    }
    *run = got;
    return STATUS_OK;
}
