#include "sculpt/chip_log.h"

#include <stdlib.h>

static void write_start(FILE *stream, const struct chips *chips, unsigned depth, struct chip_state *state)
{
    fprintf(stream, "depth %u\n", chips->depth_line ? (unsigned)chips->depth : depth);
    if (chips->start_material > 1)
        fprintf(stream, "material %u\n", chips->start_material);
    fputs(chips->start_material ? "start full\n" : "start empty\n", stream);
    state->material = chips->start_material > 1 ? chips->start_material : 1;
    state->mirror = 0;
}

/* Whatever the log before ends with, the first line that needs a material or a mirror says which. */
static void write_before(FILE *stream, const struct bytes *before, struct chip_state *state)
{
    fwrite(before->data, 1, before->size, stream);
    if (before->size > 0 && before->data[before->size - 1] != '\n')
        fputc('\n', stream);
    state->material = OCTREE_MATERIALS;
    state->mirror = CHIP_MIRROR_X | CHIP_MIRROR_Y | CHIP_MIRROR_Z | CHIP_MIRROR_Z << 1;
}

enum status chip_log_write(const struct bytes *before, const struct chips *chips, unsigned depth,
                           struct bytes *log, struct error *err)
{
    struct chips kept = {0};
    struct chip_state state;
    char *text = NULL;
    size_t size = 0;
    enum status status = chips_keep(chips, &kept, err);
    if (status)
        return status;
    FILE *stream = open_memstream(&text, &size);
    if (stream) {
        if (before)
            write_before(stream, before, &state);
        else
            write_start(stream, &kept, depth, &state);
        for (int m = 1; m < OCTREE_MATERIALS; m++)
            if (kept.has_coefficient[m])
                fprintf(stream, "coefficient %d %.9g\n", m, (double)kept.coefficient[m]);
        for (size_t i = 0; i < kept.count; i++)
            chip_write(stream, &kept.items[i], &state);
    }
    chips_clear(&kept);
    bool failed = !stream || ferror(stream);
    if ((stream && fclose(stream)) || failed) {
        free(text);
        return error_no_memory(err, "the chip log");
    }
    *log = (struct bytes){(unsigned char *)text, size};
    return STATUS_OK;
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
        status = chips_run(&made, &chips, NULL, &why);
    *holds = !status && octree_equal(&made, tree);
    chips_clear(&chips);
    octree_clear(&made);
    return status == STATUS_NO_MEMORY ? error_no_memory(err, "replaying the chip log") : STATUS_OK;
}
