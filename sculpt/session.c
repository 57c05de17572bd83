#include "sculpt/session.h"

#include "common/array.h"
#include "common/vec3.h"

#include <stdlib.h>
#include <string.h>

void session_take_changes(struct session *session, struct octree_regions *regions)
{
    *regions = session->changed;
    session->changed = (struct octree_regions){0};
}

static void changed_in(struct session *session, const struct octree_regions *regions)
{
    for (int i = 0; i < regions->count; i++)
        octree_regions_add(&session->changed, &regions->items[i]);
}

/* Puts operations into the journal, all or none, and then into the log. */
static enum status record(struct session *session, const struct chip *chips, size_t count, struct error *err)
{
    if (!ARRAY_RESERVE(&session->log, count))
        return error_no_memory(err, "the chip log");
    char *lines = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&lines, &size);
    if (!stream)
        return error_no_memory(err, "the journal");
    struct chip_state state = session->written;
    for (size_t i = 0; i < count; i++)
        chip_write(stream, &chips[i], &state);
    enum status status = fclose(stream) ? error_no_memory(err, "the journal") : STATUS_OK;
    if (!status && session->journal)
        status = journal_append(session->journal, lines, err);
    free(lines);
    if (status)
        return status;
    session->written = state;
    session->unsaved = true;
    session->changes++;
    memcpy(session->log.items + session->log.count, chips, count * sizeof *chips);
    session->log.count += count;
    return STATUS_OK;
}

/* One operation within the step that is open. */
static enum status operate(struct session *session, struct chip *chip, struct error *err)
{
    chip->mirror = session->mirror;
    enum status status = chip_check(chip, err);
    if (!status && !ARRAY_RESERVE(&session->step, 2)) /* one for the line that ends the step */
        status = error_no_memory(err, "the chip log");
    if (!status && (status = sculpt_chip(&session->tree, chip, err)))
        session->step.failed = true;
    if (!status)
        session->step.items[session->step.count++] = *chip;
    changed_in(session, &session->history.tape.regions);
    return status;
}

/* The tree is again what it was when the step began, where the tape holds it all. */
static void take_back(struct session *session)
{
    changed_in(session, &session->history.tape.regions); /* once more: what was shown may have been drawn */
    if (history_cancel(&session->history, &session->tree))
        return;
    session->unsaved = session->log_lost = true;
    session->changes++;
}

/* Steps that changed nothing are forgotten. What was done in part, or the journal cannot keep, is taken
 * back. */
static enum status end_step(struct session *session, struct error *err)
{
    const struct octree_tape *tape = &session->history.tape;
    const bool changed = tape->count > 0 || tape->lost || tape->before.root != session->tree.root;
    size_t steps = session->history.done;
    enum status status = STATUS_OK;
    if (changed && !session->step.failed) {
        session->step.items[session->step.count++] = (struct chip){.kind = CHIP_STEP, .material = 1};
        status = record(session, session->step.items, session->step.count, err);
    }
    if (status || session->step.failed) {
        take_back(session);
    } else {
        history_end(&session->history, &session->tree, NULL);
        steps += changed;
    }
    session->forgotten += steps - session->history.done;
    session->step.count = 0;
    session->step.failed = false;
    return status;
}

static bool can_record(struct session *session, enum chip_kind kind, struct error *err)
{
    const struct chip chip = {.kind = kind, .material = 1};
    return !session->dragging && !record(session, &chip, 1, err);
}

bool session_undo(struct session *session, struct error *err)
{
    struct octree_regions regions;
    if (!history_can_undo(&session->history) || !can_record(session, CHIP_UNDO, err))
        return false;
    history_undo(&session->history, &session->tree, &regions);
    changed_in(session, &regions);
    return true;
}

bool session_redo(struct session *session, struct error *err)
{
    struct octree_regions regions;
    if (!history_can_redo(&session->history) || !can_record(session, CHIP_REDO, err))
        return false;
    history_redo(&session->history, &session->tree, &regions);
    changed_in(session, &regions);
    return true;
}

static struct chip brush_chip(const struct session *session)
{
    const double r = session->radius;
    const double *m = session->middle;
    struct chip chip = {.material = session->fill ? session->material : 0};
    switch (session->tool) {
    case TOOL_BOX:
        chip.shape = CHIP_BOX;
        for (int i = 0; i < 3; i++) {
            chip.value[i] = m[i] - r;
            chip.value[3 + i] = m[i] + r;
        }
        break;
    case TOOL_CYLINDER:
        chip.shape = CHIP_CYLINDER;
        for (int i = 0; i < 3; i++) {
            chip.value[i] = m[i] - r * session->normal[i];
            chip.value[3 + i] = m[i] + r * session->normal[i];
        }
        chip.value[6] = r;
        break;
    default:
        chip.shape = CHIP_SPHERE;
        chip.kind = session->tool == TOOL_SANDPAPER ? CHIP_SANDPAPER
                    : session->tool == TOOL_HEAT    ? CHIP_HEAT
                                                    : CHIP_CARVE;
        memcpy(chip.value, m, 3 * sizeof *m);
        chip.value[3] = r;
        break;
    }
    return chip;
}

/* A sphere swept from the stroke's end to where the brush is now. */
static enum status sweep(struct session *session, struct error *err)
{
    struct chip chip = {.shape = CHIP_CAPSULE, .material = session->fill ? session->material : 0};
    memcpy(chip.value, session->last, sizeof session->last);
    memcpy(chip.value + 3, session->middle, sizeof session->middle);
    chip.value[6] = chip.value[7] = session->radius;
    memcpy(session->last, session->middle, sizeof session->last);
    return operate(session, &chip, err);
}

/* The plane through the eye and both ends of the dragged line; its right-hand side goes. A line
 * without length cuts nothing. */
static enum status cut(struct session *session, struct error *err)
{
    struct chip chip = {.shape = CHIP_HALF_SPACE, .material = session->fill ? session->material : 0};
    memcpy(chip.value, session->pressed.origin, sizeof session->pressed.origin);
    vec3_cross(session->pressed.direction, session->ray.direction, chip.value + 3);
    if (vec3_length(chip.value + 3) < 1e-6)
        return STATUS_OK;
    return operate(session, &chip, err);
}

/* What the tool does where the pointer is. */
static enum status use_tool(struct session *session, struct error *err)
{
    session->used = session->ray;
    if (session->tool == TOOL_CUT)
        return STATUS_OK; /* at the end of the line */
    if (session->tool == TOOL_STROKE)
        return sweep(session, err);
    struct chip chip = brush_chip(session);
    return operate(session, &chip, err);
}

static bool can_begin(const struct session *session)
{
    return session->aimed || session->tool == TOOL_CUT; /* the cut's line may begin anywhere */
}

const char *session_why_nothing(const struct session *session)
{
    if (can_begin(session))
        return NULL;
    if (session->tree.root != 0)
        return "There is nothing under the pointer: tools begin on the sculpture.";
    return history_can_undo(&session->history)
               ? "The cube is empty; ctrl+z takes the last step back."
               : "The cube is empty; k, tab and a drawn line fill half of it.";
}

enum status session_press(struct session *session, struct error *err)
{
    if (session->dragging || !can_begin(session))
        return STATUS_OK;
    session->dragging = true;
    session->pressed = session->ray;
    memcpy(session->last, session->middle, sizeof session->last);
    history_begin(&session->history, &session->tree);
    return use_tool(session, err);
}

/* A stroke goes on, sandpaper and heat rub on where they meet the sculpture; other tools do
 * their work at one press. */
enum status session_drag(struct session *session, struct error *err)
{
    const bool moved = memcmp(&session->used, &session->ray, sizeof session->ray) != 0;
    const bool rubs = session->tool == TOOL_SANDPAPER || session->tool == TOOL_HEAT;
    if (!session->dragging || !moved || !(session->tool == TOOL_STROKE || (rubs && session->aimed)))
        return STATUS_OK;
    return use_tool(session, err);
}

const char *session_why_no_drag(const struct session *session)
{
    if (!session->dragging || session->tool > TOOL_CYLINDER)
        return NULL;
    double from_eye[3], beside[3];
    for (int i = 0; i < 3; i++)
        from_eye[i] = session->last[i] - session->ray.origin[i];
    vec3_cross(from_eye, session->ray.direction, beside);
    return vec3_length(beside) > session->radius ? "This tool works once a press; d draws strokes." : NULL;
}

enum status session_release(struct session *session, struct error *err)
{
    if (!session->dragging)
        return STATUS_OK;
    enum status status = session->tool == TOOL_CUT ? cut(session, err) : STATUS_OK;
    session->dragging = false;
    enum status ended = end_step(session, status ? NULL : err);
    return status ? status : ended;
}
