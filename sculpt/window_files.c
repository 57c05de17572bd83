/* How the sculpting window opens, imports, saves and exports, and what it asks before. */
#include "sculpt/export.h"
#include "sculpt/import.h"
#include "sculpt/info.h"
#include "sculpt/window_app.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Another sculpture under the same hand. */
static void keep_tools(struct session *session, const struct session *before)
{
    session->tool = before->tool;
    session->fill = before->fill;
    session->mirror = before->mirror;
    session->snap = before->snap;
    session->depth = before->depth;
    session->material = before->material;
    session->radius = before->radius;
    session_resize_brush(session, 0);
}

/* Takes over *fresh. */
static void replace_session(struct app *app, struct session *fresh)
{
    session_limit_undo(fresh, app->options->undo_memory);
    if (app->open) {
        keep_tools(fresh, &app->session);
        session_clear(&app->session);
    }
    app->session = *fresh;
    app_forget_faces(app);
    app->open = true;
    app->question = ASK_NOTHING;
    app->preview = false;
    app->written = NULL;
    app->forgotten = 0;
    app_see_all(app);
}

enum status app_open_session(struct app *app, const char *path, bool recover, struct error *err)
{
    struct session fresh;
    struct error reason = {0};
    enum status status = session_open(&fresh, path, app->options->depth, recover, &reason);
    if (status) {
        *err = reason;
        return status;
    }
    replace_session(app, &fresh);
    app_say(app, recover ? "The work that was not saved is back." : app->session.warning);
    app_show_title(app);
    return STATUS_OK;
}

/* A name for the sculpture that a model becomes: in this folder, and new. */
static bool name_model(const char *model, char *name, size_t size)
{
    const char *slash = strrchr(model, '/'), *stem = slash ? slash + 1 : model, *dot = strrchr(stem, '.');
    const int length = dot ? (int)(dot - stem) : (int)strlen(stem);
    for (int number = 1; number < 1000; number++) {
        const int written = number == 1 ? snprintf(name, size, "%.*s.oct", length, stem)
                                        : snprintf(name, size, "%.*s-%d.oct", length, stem, number);
        bool left;
        struct error ignored;
        if (written > 0 && (size_t)written < size && access(name, F_OK) &&
            !journal_is_left(name, &left, &ignored) && !left)
            return true;
    }
    return false;
}

static void tell_of_model(struct app *app)
{
    char text[sizeof app->session.warning + sizeof app->notes];
    const char *warning = app->session.warning;
    snprintf(text, sizeof text, "%s%s%s", app->notes, *app->notes && *warning ? "\n" : "", warning);
    app_say(app, text);
}

void app_take_model(struct app *app, bool fill)
{
    char name[1024];
    struct error err = {0};
    struct session fresh;
    uint64_t cells;
    enum status status = STATUS_OK;
    app->question = ASK_NOTHING;
    if (fill)
        status = octree_fill_hollows(&app->model, info_main_material(&app->model), &cells, &err);
    if (!status && !name_model(app->opening, name, sizeof name))
        status = error_set(&err, STATUS_FILE, "%s: no name is left for its sculpture", app->opening);
    if (!status)
        status = session_begin(&fresh, name, &app->model, &err);
    if (!status)
        replace_session(app, &fresh);
    octree_clear(&app->model);
    if (status)
        app_say(app, err.text);
    else
        tell_of_model(app);
    app_show_title(app);
}

static void take_or_ask(struct app *app, const struct voxelise_report *report)
{
    sculpt_import_notes(app->opening, report, app->notes, sizeof app->notes);
    if (app->hollow > 0)
        app->question = ASK_HOLLOW;
    else
        app_take_model(app, false);
}

static void import(struct app *app)
{
    struct error err = {0};
    struct voxelise_report report;
    if (sculpt_import(app->opening, VOXELISE_DEPTH_DEFAULT, &app->model, &report, &app->hollow, &err))
        app_say(app, err.text);
    else
        take_or_ask(app, &report);
}

static void open_sculpture(struct app *app)
{
    bool left = false;
    struct error err = {0};
    const char *path = app->opening;
    enum status status = STATUS_OK;
    if (access(path, F_OK))
        status = error_set(&err, STATUS_FILE, "%.900s: there is no such file", path);
    else if (file_same(path, app->session.path))
        status = error_set(&err, STATUS_FILE, "%.900s: is open", path);
    else
        status = journal_is_left(path, &left, &err);
    if (!status && left)
        app->question = ASK_RECOVER;
    else if (!status)
        status = app_open_session(app, path, false, &err);
    app_say_unless_ok(app, status, &err);
}

static const char *write_name(const struct app *app)
{
    return app->naming == NAME_SAVE && file_same(app->answer, app->session.path) ? NULL : app->answer;
}

/* A file that is there is replaced when enter is pressed once more. */
static bool may_replace(struct app *app)
{
    const char *path = write_name(app);
    if (!path || app->sure || access(path, F_OK))
        return true;
    char text[1100];
    snprintf(text, sizeof text, "%.1000s is there already: enter replaces it", path);
    app->sure = true;
    app_say(app, text);
    return false;
}

/* That a file is being written from now on, or why it is not; then another that is goes on. */
static void say_writing(struct app *app, bool exports, enum status status, const struct error *err)
{
    app_say(app, status ? err->text : "");
    app_schedule(app);
    if (status && app->session.saving)
        return;
    app->written = status ? NULL : exports ? "exporting..." : "saving...";
    app->exports = exports;
}

static void export(struct app *app)
{
    struct error err = {0};
    enum status status = STATUS_OK;
    if (!sculpt_export_is_name(app->answer))
        status = error_set(&err, STATUS_RANGE, "%.900s: .vox, .ply and .chips are written", app->answer);
    if (!status)
        status = session_export_begin(&app->session, app->answer, &err);
    say_writing(app, true, status, &err);
    app->question = status ? ASK_NAME : ASK_NOTHING;
}

void app_ask_name(struct app *app, enum naming naming)
{
    const char *path = app->session.path, *dot = strrchr(path, '.');
    if (naming == NAME_OPEN)
        app->answer[0] = '\0';
    else if (naming == NAME_SAVE || !dot || strchr(dot, '/'))
        snprintf(app->answer, sizeof app->answer, "%s", path);
    else
        snprintf(app->answer, sizeof app->answer, "%.*s.vox", (int)(dot - path), path);
    app->question = ASK_NAME;
    app->naming = naming;
    app->sure = false;
    app->proposed = app->answer[0] != '\0';
}

/* As -o does: what has another's ending could not be opened again, or was a model that it came from. */
static bool is_name_of_sculpture(struct app *app)
{
    const char *path = write_name(app);
    if (!path || file_has_extension(path, "oct"))
        return true;
    char text[1100];
    snprintf(text, sizeof text, "%.1000s: the name must end in .oct; ctrl+e exports other files", path);
    app_say(app, text);
    return false;
}

void app_take_name(struct app *app)
{
    if (app->naming == NAME_OPEN) {
        app->question = ASK_NOTHING;
        snprintf(app->opening, sizeof app->opening, "%s", app->answer);
        if (sculpt_import_is_name(app->opening))
            import(app);
        else
            open_sculpture(app);
    } else if (app->naming == NAME_SAVE && !is_name_of_sculpture(app)) {
        return;
    } else if (may_replace(app)) {
        if (app->naming == NAME_EXPORT)
            export(app);
        else if (app_save(app, write_name(app)))
            app->question = ASK_NOTHING;
    }
}

bool app_save(struct app *app, const char *path)
{
    struct error err = {0};
    struct bytes png = {0};
    app_preview(app, &png, &err); /* a sculpture without a preview is whole */
    enum status status = session_save_begin(&app->session, path, &png, &err);
    bytes_clear(&png);
    say_writing(app, false, status, &err);
    return !status;
}

void app_follow_write(struct app *app)
{
    struct error err = {0};
    enum status status;
    if (!app->open || !session_write_ended(&app->session, false, &status, &err))
        return;
    app->written = status ? NULL : app->exports ? "exported" : "saved";
    app_say(app, status ? err.text : app->session.warning);
    app_show_title(app);
    if (!app->next_when_saved)
        return;
    app->next_when_saved = false;
    if (!status)
        app_leave(app, app->next);
}

void app_do_next(struct app *app)
{
    app->question = ASK_NOTHING;
    if (app->next == NEXT_QUIT)
        window_close(app->window);
    else if (app->next == NEXT_OPEN)
        app_ask_name(app, NAME_OPEN);
}

void app_leave(struct app *app, enum next next)
{
    app->next = next;
    app_end_drag(app);
    if (app->open && app->session.saving)
        app->next_when_saved = true;
    else if (app->open && app->session.unsaved)
        app->question = ASK_UNSAVED;
    else
        app_do_next(app);
    window_redraw(app->window);
}
