/* Doing what a script says, without what it takes back. */
#include "common/array.h"
#include "sculpt/sculpt.h"

#include <stdlib.h>

/* Operations that are undone together: from first to before end. */
struct step {
    size_t first, end;
};

/* The steps of a script as undo and redo leave them: `done` of them are done. */
struct steps {
    struct step *items;
    size_t count, capacity, done;
};

/* Adds a step, if there is anything in it; what was undone before is then gone for good. */
static bool add_step(struct steps *steps, size_t first, size_t end)
{
    if (first == end)
        return true;
    steps->count = steps->done;
    if (!ARRAY_RESERVE(steps, 1))
        return false;
    steps->items[steps->count++] = (struct step){first, end};
    steps->done = steps->count;
    return true;
}

static bool has_steps(const struct chips *chips)
{
    for (size_t i = 0; i < chips->count; i++)
        if (chips->items[i].kind == CHIP_STEP)
            return true;
    return false;
}

static enum status find_steps(const struct chips *chips, struct steps *steps, struct error *err)
{
    const bool each = !has_steps(chips);
    size_t first = 0;
    for (size_t i = 0; i <= chips->count; i++) { /* the last step ends where the script does */
        enum chip_kind kind = i < chips->count ? chips->items[i].kind : CHIP_STEP;
        bool tool = kind < CHIP_STEP;
        if (tool && !each)
            continue;
        if (!add_step(steps, first, tool ? i + 1 : i))
            return error_no_memory(err, "the steps of the script");
        first = i + 1;
        if (kind == CHIP_UNDO && steps->done > 0)
            steps->done--;
        if (kind == CHIP_REDO && steps->done < steps->count)
            steps->done++;
    }
    return STATUS_OK;
}

static enum status run_step(struct octree *tree, const struct chips *chips, const struct step *step,
                            struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = step->first; i < step->end && !status; i++) {
        if (chips->progress && i % 1024 == 0)
            chips->progress((double)i);
        status = sculpt_chip(tree, &chips->items[i], err);
    }
    return status;
}

enum status chips_run(struct octree *tree, const struct chips *chips, struct error *err)
{
    struct steps steps = {0};
    enum status status = find_steps(chips, &steps, err);
    for (size_t i = 0; i < steps.done && !status; i++)
        status = run_step(tree, chips, &steps.items[i], err);
    free(steps.items);
    return status;
}

enum status chips_keep(const struct chips *chips, struct chips *kept, struct error *err)
{
    struct steps steps = {0};
    struct chips made = *chips;
    enum status status = find_steps(chips, &steps, err);
    made.items = status ? NULL : array_new(chips->count, sizeof *made.items);
    made.capacity = chips->count;
    made.count = 0;
    if (!status && !made.items)
        status = error_no_memory(err, "the script");
    for (size_t i = 0; i < steps.done && !status; i++)
        for (size_t k = steps.items[i].first; k < steps.items[i].end; k++)
            made.items[made.count++] = chips->items[k];
    free(steps.items);
    if (status)
        return status;
    chips_clear(kept);
    *kept = made;
    return STATUS_OK;
}
