#include "sculpt/chip_log.h"

#include "common/array.h"

#include <stdlib.h>
#include <string.h>

static void write_start(FILE *stream, const struct chips *chips, unsigned depth, struct chip_state *state)
{
    fprintf(stream, "depth %u\n", chips->depth_line ? (unsigned)chips->depth : depth);
    if (chips->start_material > 1)
        fprintf(stream, "material %u\n", chips->start_material);
    fputs(chips->start_material ? "start full\n" : "start empty\n", stream);
    state->material = chips->start_material > 1 ? chips->start_material : 1;
    state->mirror = 0;
}

/* Puts the chips behind those of the log before, as if all were one script. */
static enum status append(struct chips *all, const struct chips *chips, struct error *err)
{
    if (!ARRAY_RESERVE(all, chips->count))
        return error_no_memory(err, "the chip log");
    if (chips->count > 0)
        memcpy(all->items + all->count, chips->items, chips->count * sizeof *chips->items);
    all->count += chips->count;
    for (int m = 1; m < OCTREE_MATERIALS; m++)
        if (chips->has_coefficient[m]) {
            all->coefficient[m] = chips->coefficient[m];
            all->has_coefficient[m] = true;
        }
    return STATUS_OK;
}

static enum status write_all(const struct chips *chips, unsigned depth, struct bytes *log, struct error *err)
{
    struct chip_state state;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return error_no_memory(err, "the chip log");
    write_start(stream, chips, depth, &state);
    for (int m = 1; m < OCTREE_MATERIALS; m++)
        if (chips->has_coefficient[m])
            fprintf(stream, "coefficient %d %.9g\n", m, (double)chips->coefficient[m]);
    for (size_t i = 0; i < chips->count; i++)
        chip_write(stream, &chips->items[i], &state);
    bool failed = ferror(stream);
    if (fclose(stream) || failed) {
        free(text);
        return error_no_memory(err, "the chip log");
    }
    *log = (struct bytes){(unsigned char *)text, size};
    return STATUS_OK;
}

/* A log that is no script is as none: what is written then does not hold, and is not believed. */
static enum status read_before(const struct bytes *before, struct chips *chips, struct error *err)
{
    struct error why = {0};
    enum status status = chips_parse("the chip log", before->data, before->size, chips, &why);
    if (status != STATUS_NO_MEMORY)
        return STATUS_OK;
    return error_no_memory(err, "the chip log");
}

enum status chip_log_write(const struct bytes *before, const struct chips *chips, unsigned depth,
                           struct bytes *log, struct error *err)
{
    struct chips kept = {0}, all = {0};
    enum status status = chips_keep(chips, &kept, err);
    if (!status && before)
        status = read_before(before, &all, err);
    if (!status && before)
        status = append(&all, &kept, err);
    if (!status)
        status = write_all(before ? &all : &kept, depth, log, err);
    chips_clear(&kept);
    chips_clear(&all);
    return status;
}

enum status chip_log_holds(const struct bytes *log, const struct octree *tree, bool *holds, struct error *err)
{
    struct chips chips = {0};
    struct octree made = {0};
    struct error why = {0};
    enum status status = chips_parse("the chip log", log->data, log->size, &chips, &why);
    if (!status)
        status = chips_begin(&chips, tree->depth, &made, &why);
    if (!status)
        status = chips_run(&made, &chips, &why);
    *holds = !status && octree_equal(&made, tree);
    chips_clear(&chips);
    octree_clear(&made);
    return status == STATUS_NO_MEMORY ? error_no_memory(err, "replaying the chip log") : STATUS_OK;
}
