/* A sculpting session begins and ends: what it is opened from, and the journal beside it. */
#include "common/array.h"
#include "sculpt/session.h"
#include "sculpt/session_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void everything_changed(struct session *session)
{
    const int last = (1 << session->tree.depth) - 1;
    session->changed = (struct octree_regions){0};
    octree_regions_add(&session->changed, &(struct octree_region){{0, 0, 0}, {last, last, last}});
}

/* What the file carries becomes the session's: its chip log, and what is not known here. The preview is
 * made anew with each save. */
static enum status keep_chunks(struct session *session, struct octree_chunks *chunks, struct error *err)
{
    for (size_t i = 0; i < chunks->count; i++) {
        struct octree_chunk *chunk = &chunks->items[i];
        if (!strcmp(chunk->name, OCTREE_CHUNK_PREVIEW))
            continue;
        if (!strcmp(chunk->name, OCTREE_CHUNK_LOG)) {
            bytes_clear(&session->log_before);
            session->log_before = chunk->data;
        } else if (ARRAY_RESERVE(&session->others, 1)) {
            session->others.items[session->others.count++] = *chunk;
        } else {
            return error_no_memory(err, session->path);
        }
        chunk->data = (struct bytes){0}; /* it is the session's now */
    }
    return STATUS_OK;
}

static enum status load(struct session *session, struct error *err)
{
    struct octree_chunks chunks = {0};
    enum status status = octree_load_with(session->path, &session->tree, &chunks, err);
    if (!status)
        status = keep_chunks(session, &chunks, err);
    octree_chunks_clear(&chunks);
    session->log_lost = !session->log_before.data;
    return status;
}

/* Takes up the work of a program that was killed. What the journal leads to is newer than the file, where
 * that can be read at all. */
static enum status recover_work(struct session *session, struct error *err)
{
    struct journal_report report;
    struct bytes log;
    struct error ignored;
    (void)load(session, &ignored);
    enum status status = journal_recover(session->path, &session->tree, &log, &report, err);
    if (status)
        return status;
    bytes_clear(&session->log_before);
    session->log_before = log;
    session->log_lost = !log.data;
    session->unsaved = report.unsaved;
    return STATUS_OK;
}

enum status session_begin_journal(struct session *session, struct error *err)
{
    struct error reason = {0};
    enum status status = journal_open(session->path, &session->tree, &session->journal, &reason);
    session->warning[0] = '\0';
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

static enum status prepare(struct session *session, const char *path, struct error *err)
{
    *session = (struct session){.radius = 0.08, .material = 1, .written = {.material = 1}};
    history_init(&session->history, SESSION_HISTORY_BYTES);
    session->path = strdup(path);
    return session->path ? STATUS_OK : error_no_memory(err, path);
}

static void begin(struct session *session)
{
    session->log.depth = (int)session->tree.depth;
    session->log.depth_line = 1;
    session->log.start_material = 1;
    everything_changed(session);
}

enum status session_open(struct session *session, const char *path, unsigned depth, bool recover,
                         struct error *err)
{
    enum status status = prepare(session, path, err);
    if (!status)
        status = open_tree(session, depth, recover, err);
    if (!status)
        status = session_begin_journal(session, err);
    if (status)
        session_clear(session);
    else
        begin(session);
    return status;
}

static enum status check_new(const char *path, struct error *err)
{
    bool left;
    if (!access(path, F_OK))
        return error_set(err, STATUS_FILE, "%s: is there already; give a new name", path);
    enum status status = journal_is_left(path, &left, err);
    if (!status && left)
        status = error_set(err, STATUS_FILE, "%s.journal holds work that was not saved; give another name",
                           path);
    return status;
}

enum status session_begin(struct session *session, const char *path, struct octree *tree, struct error *err)
{
    enum status status = prepare(session, path, err);
    if (!status)
        status = check_new(path, err);
    session->tree = *tree;
    if (!status)
        status = session_begin_journal(session, err);
    if (status) {
        session->tree = (struct octree){0}; /* the caller's still */
        session_clear(session);
        return status;
    }
    *tree = (struct octree){0};
    session->log_lost = true;
    session->unsaved = true;
    begin(session);
    return STATUS_OK;
}

void session_limit_undo(struct session *session, size_t bytes)
{
    history_clear(&session->history);
    history_init(&session->history, bytes);
}

void session_clear(struct session *session)
{
    struct error ignored;
    enum status status;
    (void)session_write_ended(session, true, &status, &ignored);
    journal_close(session->journal, true);
    history_clear(&session->history);
    octree_clear(&session->tree);
    chips_clear(&session->log);
    free(session->step.items);
    bytes_clear(&session->log_before);
    octree_chunks_clear(&session->others);
    free(session->path);
    *session = (struct session){0};
}
