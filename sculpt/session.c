#include "sculpt/session.h"

#include "common/array.h"
#include "common/octree_chunks.h"
#include "common/vec3.h"
#include "sculpt/chip_log.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void everything_changed(struct session *session)
{
    const int last = (1 << session->tree.depth) - 1;
    session->changed = (struct octree_regions){0};
    octree_regions_add(&session->changed, &(struct octree_region){{0, 0, 0}, {last, last, last}});
}

static enum status load(struct session *session, struct error *err)
{
    struct octree_chunks chunks = {0};
    enum status status = octree_load_with(session->path, &session->tree, &chunks, err);
    for (size_t i = 0; i < chunks.count && !status; i++)
        if (!strncmp(chunks.items[i].name, OCTREE_CHUNK_LOG, 4)) {
            session->log_before = chunks.items[i].data;
            chunks.items[i].data = (struct bytes){0}; /* it is the session's now */
        }
    octree_chunks_clear(&chunks);
    session->log_lost = !session->log_before.data;
    return status;
}

/* Takes up the work of a program that was killed. */
static enum status recover_work(struct session *session, struct error *err)
{
    struct journal_report report;
    enum status status = journal_recover(session->path, &session->tree, &session->log_before, &report, err);
    if (status)
        return status;
    session->unsaved = report.unsaved;
    session->log_lost = !session->log_before.data;
    return STATUS_OK;
}

/* A sculpture can be carved without a journal (in a folder that is read-only), but not without being told. */
static enum status begin_journal(struct session *session, struct error *err)
{
    struct error reason = {0};
    enum status status = journal_open(session->path, &session->tree, &session->journal, &reason);
    if (status == STATUS_FILE) {
        session->journal = NULL;
        snprintf(session->warning, sizeof session->warning, "nothing is kept until you save: %.900s",
                 reason.text);
        return STATUS_OK;
    }
    if (status && err)
        *err = reason;
    return status;
}

static enum status open_tree(struct session *session, unsigned depth, bool recover, struct error *err)
{
    bool left = false;
    enum status status = journal_is_left(session->path, &left, err);
    if (status)
        return status;
    if (left && recover)
        return recover_work(session, err);
    if (left)
        status = journal_remove(session->path, err);
    if (!status)
        status = access(session->path, F_OK) ? octree_init(&session->tree, depth, 1, err)
                                             : load(session, err);
    return status;
}

enum status session_open(struct session *session, const char *path, unsigned depth, bool recover,
                         struct error *err)
{
    *session = (struct session){.radius = 0.08, .material = 1, .written = {.material = 1}};
    history_init(&session->history, SESSION_HISTORY_BYTES);
    session->path = strdup(path);
    enum status status = session->path ? open_tree(session, depth, recover, err) : error_no_memory(err, path);
    if (!status)
        status = begin_journal(session, err);
    if (status) {
        session_clear(session);
        return status;
    }
    session->log.depth = (int)session->tree.depth;
    session->log.depth_line = 1;
    session->log.start_material = 1;
    everything_changed(session);
    return STATUS_OK;
}

void session_clear(struct session *session)
{
    journal_close(session->journal, true);
    history_clear(&session->history);
    octree_clear(&session->tree);
    chips_clear(&session->log);
    free(session->step.items);
    bytes_clear(&session->log_before);
    free(session->path);
    *session = (struct session){0};
}

static enum status save_to(struct session *session, const char *path, struct bytes *preview,
                           struct error *err)
{
    struct octree_chunks chunks = {0};
    struct bytes log = {0};
    enum status status = STATUS_OK;
    if (!session->log_lost) {
        status = chip_log_write(session->log_before.data ? &session->log_before : NULL, &session->log,
                                session->tree.depth, &log, err);
        if (!status)
            status = octree_chunks_put(&chunks, OCTREE_CHUNK_LOG, &log, err);
    }
    if (!status && preview && preview->data)
        status = octree_chunks_put(&chunks, OCTREE_CHUNK_PREVIEW, preview, err);
    if (!status)
        status = octree_save_with(&session->tree, &chunks, path, err);
    octree_chunks_clear(&chunks);
    bytes_clear(&log);
    if (!status)
        session->unsaved = false;
    return status;
}

enum status session_save(struct session *session, struct bytes *preview, struct error *err)
{
    enum status status = session->journal ? journal_mark(session->journal, err) : STATUS_OK;
    return status ? status : save_to(session, session->path, preview, err);
}

enum status session_save_as(struct session *session, const char *path, struct bytes *preview,
                            struct error *err)
{
    if (file_same(path, session->path))
        return session_save(session, preview, err);
    bool left;
    enum status status = journal_is_left(path, &left, err); /* nobody else is carving it */
    if (status)
        return status;
    char *name = strdup(path);
    if (!name)
        return error_no_memory(err, path);
    status = save_to(session, path, preview, err);
    if (status) {
        free(name);
        return status;
    }
    journal_close(session->journal, true);
    session->journal = NULL;
    free(session->path);
    session->path = name;
    session->written = (struct chip_state){.material = 1};
    return begin_journal(session, err);
}

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
    if (!status)
        status = sculpt_chip(&session->tree, chip, err);
    if (!status)
        session->step.items[session->step.count++] = *chip;
    changed_in(session, &session->history.tape.regions);
    return status;
}

/* Steps that changed nothing are forgotten. What the journal cannot keep is taken back. */
static enum status end_step(struct session *session, struct error *err)
{
    struct octree_regions regions;
    const bool changed = session->history.tape.count > 0 || session->history.tape.lost;
    history_end(&session->history, &session->tree, NULL);
    enum status status = STATUS_OK;
    if (changed && session->step.count > 0) {
        session->step.items[session->step.count++] = (struct chip){.kind = CHIP_STEP, .material = 1};
        status = record(session, session->step.items, session->step.count, err);
    }
    session->step.count = 0;
    if (status && history_undo(&session->history, &session->tree, &regions))
        changed_in(session, &regions);
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

/* The plane through the eye and both ends of the dragged line; its right-hand side goes. A line without length cuts
 * nothing. */
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

enum status session_press(struct session *session, struct error *err)
{
    if (session->dragging || (!session->aimed && session->tool != TOOL_CUT))
        return STATUS_OK;
    session->dragging = true;
    session->pressed = session->ray;
    memcpy(session->last, session->middle, sizeof session->last);
    history_begin(&session->history, &session->tree);
    return use_tool(session, err);
}

/* A stroke goes on, sandpaper and heat rub on where they meet the sculpture; other tools do their work at one press. */
enum status session_drag(struct session *session, struct error *err)
{
    const bool moved = memcmp(&session->used, &session->ray, sizeof session->ray) != 0;
    const bool rubs = session->tool == TOOL_SANDPAPER || session->tool == TOOL_HEAT;
    if (!session->dragging || !moved || !(session->tool == TOOL_STROKE || (rubs && session->aimed)))
        return STATUS_OK;
    return use_tool(session, err);
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
