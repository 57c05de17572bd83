#include "common/point_cache.h"
#include "common/file.h"
#include "common/little_endian.h"

#include <stdlib.h>

enum { SAMPLES_AT = 28 }; /* in the file */

struct point_cache {
    struct file_out *out;
    uint32_t point_count, samples;
};

enum status point_cache_open(const char *path, uint32_t point_count, double first_frame,
                             struct point_cache **result, struct error *err)
{
    struct point_cache *cache = calloc(1, sizeof *cache);
    if (!cache)
        return error_no_memory(err, path);
    cache->point_count = point_count;
    enum status status = file_out_open(path, &cache->out, err);
    if (!status && fseek(file_out_stream(cache->out), 0, SEEK_SET))
        status = error_set_errno(err, path, "go back in it, as a cache of points must be");
    if (status) {
        point_cache_abandon(cache);
        return status;
    }
    unsigned char head[SAMPLES_AT + 4] = "POINTCACHE2", *to = put_bits(head + 12, 1, 4);
    to = put_bits(to, point_count, 4);
    to = put_float(put_float(to, first_frame), 1);
    put_bits(to, 0, 4);
    fwrite(head, 1, sizeof head, file_out_stream(cache->out));
    *result = cache;
    return STATUS_OK;
}

void point_cache_add(struct point_cache *cache, double (*position)[3])
{
    for (uint32_t p = 0; p < cache->point_count; p++) {
        unsigned char row[12], *to = row;
        for (int i = 0; i < 3; i++)
            to = put_float(to, position[p][i]);
        fwrite(row, 1, sizeof row, file_out_stream(cache->out));
    }
    cache->samples++;
}

enum status point_cache_close(struct point_cache *cache, struct error *err)
{
    unsigned char samples[4];
    FILE *stream = file_out_stream(cache->out);
    put_bits(samples, cache->samples, 4);
    if (!fseek(stream, SAMPLES_AT, SEEK_SET)) /* else what is before could not be written, as commit tells */
        fwrite(samples, 1, sizeof samples, stream);
    enum status status = file_out_commit(cache->out, err);
    cache->out = NULL;
    point_cache_abandon(cache);
    return status;
}

void point_cache_abandon(struct point_cache *cache)
{
    if (!cache)
        return;
    file_out_abandon(cache->out);
    free(cache);
}
