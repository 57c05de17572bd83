/* Checkpoints of a run of which little is known, written and read. */
#ifndef TESTS_UNIT_CHECKPOINTS_H
#define TESTS_UNIT_CHECKPOINTS_H

#include "balloon.h"
#include "folder.h"
#include "sim/checkpoint.h"

static inline enum status save(struct sim *sim, const char *path, struct error *err)
{
    const struct checkpoint_run run = {
        .first_break = -1, .seconds = 2.5, .shown = 7, .rows = "row\n", .row_bytes = 4};
    return checkpoint_save(sim, &run, path, err);
}

static inline enum status load(struct sim *sim, const char *path, struct error *err)
{
    struct checkpoint_run run = {0};
    enum status status = checkpoint_load(path, sim, &run, err);
    free(run.rows);
    return status;
}

#endif
