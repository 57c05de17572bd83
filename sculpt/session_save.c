/* Saving and exporting on a thread of its own: it writes a snapshot, which nobody else touches. */
#include "sculpt/chip_log.h"
#include "sculpt/export.h"
#include "sculpt/session.h"
#include "sculpt/session_parts.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct session_save {
    struct octree tree; /* the snapshot */
    struct octree_chunks chunks;
    char *path;
    bool exported, renames; /* no .oct; the session gets this name */
    size_t changes;         /* session->changes at the snapshot */
    pthread_t thread;
    bool threaded;
    atomic_bool ended; /* then: */
    enum status status;
    struct error err;
};

static void *write_snapshot(void *context)
{
    struct session_save *save = context;
    save->status = save->exported ? sculpt_export(&save->tree, &save->chunks, save->path, &save->err)
                                  : octree_save_with(&save->tree, &save->chunks, save->path, &save->err);
    atomic_store(&save->ended, true);
    return NULL;
}

static void save_free(struct session_save *save)
{
    if (!save)
        return;
    octree_clear(&save->tree);
    octree_chunks_clear(&save->chunks);
    free(save->path);
    free(save);
}

static enum status copy_others(const struct session *session, struct octree_chunks *chunks, struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; i < session->others.count && !status; i++) {
        const struct octree_chunk *from = &session->others.items[i];
        struct bytes copy = {malloc(from->data.size + 1), from->data.size};
        if (!copy.data)
            return error_no_memory(err, "a chunk of the sculpture");
        memcpy(copy.data, from->data.data, from->data.size + 1);
        status = octree_chunks_put(chunks, from->name, &copy, err);
        bytes_clear(&copy);
    }
    return status;
}

static enum status take_snapshot(const struct session *session, struct session_save *save,
                                 struct bytes *preview, struct error *err)
{
    struct bytes log = {0};
    enum status status = octree_copy(&save->tree, &session->tree, err);
    if (!status)
        status = copy_others(session, &save->chunks, err);
    if (!status && !session->log_lost) {
        status = chip_log_write(session->log_before.data ? &session->log_before : NULL, &session->log,
                                session->tree.depth, &log, err);
        if (!status)
            status = octree_chunks_put(&save->chunks, OCTREE_CHUNK_LOG, &log, err);
    }
    if (!status && preview && preview->data)
        status = octree_chunks_put(&save->chunks, OCTREE_CHUNK_PREVIEW, preview, err);
    bytes_clear(&log);
    return status;
}

static enum status save_new(const struct session *session, const char *path, struct bytes *preview,
                            struct session_save **result, struct error *err)
{
    struct session_save *save = calloc(1, sizeof *save);
    if (save)
        save->path = strdup(path);
    enum status status = save && save->path ? take_snapshot(session, save, preview, err)
                                            : error_no_memory(err, path);
    if (status) {
        save_free(save);
        return status;
    }
    save->changes = session->changes;
    *result = save;
    return STATUS_OK;
}

/* Where no thread can be had it is written at once. */
static void start(struct session *session, struct session_save *save)
{
    session->saving = save;
    save->threaded = !pthread_create(&save->thread, NULL, write_snapshot, save);
    if (!save->threaded)
        write_snapshot(save);
}

static enum status refuse_second(const struct session *session, struct error *err)
{
    return error_set(err, STATUS_RESOURCE, "%s is being written; wait a moment", session->saving->path);
}

/* The journal's mark tells where the snapshot was taken, under whichever name. */
enum status session_save_begin(struct session *session, const char *path, struct bytes *preview,
                               struct error *err)
{
    struct session_save *save = NULL;
    bool left;
    if (session->saving)
        return refuse_second(session, err);
    const bool renames = path && strcmp(path, session->path) != 0 && !file_same(path, session->path);
    enum status status = renames ? journal_is_left(path, &left, err)
                                 : STATUS_OK; /* nobody else is carving it */
    if (!status)
        status = save_new(session, renames ? path : session->path, preview, &save, err);
    if (!status && session->journal)
        status = journal_mark(session->journal, err);
    if (status) {
        save_free(save);
        return status;
    }
    save->renames = renames;
    start(session, save);
    return STATUS_OK;
}

enum status session_export_begin(struct session *session, const char *path, struct error *err)
{
    struct session_save *save;
    if (session->saving)
        return refuse_second(session, err);
    enum status status = save_new(session, path, NULL, &save, err);
    if (status)
        return status;
    save->exported = true;
    start(session, save);
    return STATUS_OK;
}

/* The journal goes along, with the steps before that can still be undone. Without one a new one begins, and
 * undo with it: what it does not hold it cannot take back. */
static enum status rename_session(struct session *session, struct session_save *save, struct error *err)
{
    enum status status = session->journal ? journal_move(session->journal, save->path, err) : STATUS_OK;
    if (status)
        return status;
    free(session->path);
    session->path = save->path;
    save->path = NULL;
    if (session->journal || session->unsaved)
        return STATUS_OK;
    history_clear(&session->history);
    session->written = (struct chip_state){.material = 1};
    return session_begin_journal(session, err);
}

bool session_write_ended(struct session *session, bool wait, enum status *status, struct error *err)
{
    struct session_save *save = session->saving;
    if (!save || (!wait && !atomic_load(&save->ended)))
        return false;
    if (save->threaded)
        pthread_join(save->thread, NULL);
    session->saving = NULL;
    *status = save->status;
    if (save->status && err)
        *err = save->err;
    if (!save->status && !save->exported) {
        session->unsaved = session->changes != save->changes;
        if (save->renames)
            *status = rename_session(session, save, err);
    }
    save_free(save);
    return true;
}
