/*
 * Sculpting by hand, without a window: the sculpture, its tools, its history and its files. A window hands
 * rays and keys in and draws what it finds here; whatever a hand does becomes operations of a chip script.
 *
 *     struct session session = {0};
 *     if (session_open(&session, "fox.oct", 6, false, &err)) ...
 *     session_aim(&session, origin, direction);                 the pointer moved
 *     session_press(&session, &err); session_drag(...); session_release(...);
 *     session_take_changes(&session, &regions);                 what to draw anew
 *     session_undo(&session, &err);
 *     session_clear(&session);
 */
#ifndef SCULPT_SESSION_H
#define SCULPT_SESSION_H

#include "common/octree_chunks.h"
#include "sculpt/history.h"
#include "sculpt/journal.h"
#include "sculpt/sculpt.h"

#include <stdbool.h>

enum session_tool {
    TOOL_SPHERE,
    TOOL_BOX,
    TOOL_CYLINDER, /* its axis along the face that is hit */
    TOOL_STROKE,   /* a sphere swept along the drag */
    TOOL_CUT,      /* a dragged line takes away what lies to its right */
    TOOL_SANDPAPER,
    TOOL_HEAT,
    TOOLS,
};
extern const char *const session_tool_names[TOOLS];

struct session_save; /* what is being written; session_save.c */

struct session_ray {
    double origin[3], direction[3]; /* direction of unit length */
};

struct session {
    struct octree tree;
    struct history history;
    struct journal *journal;   /* NULL: none could be kept; then `warning` says why */
    struct chip_state written; /* what the journal's lines so far leave set */
    struct chips log;          /* all that was done since it was opened */
    struct {
        struct chip *items;
        size_t count, capacity;
        bool failed; /* one of them may be done in part */
    } step; /* operations of the step that is open; they become the journal's and the log's at its end */
    struct bytes log_before;     /* the chip log that the file had; empty: none */
    bool log_lost;               /* no script describes what the sculpture began as */
    struct octree_chunks others; /* what its file carries that is not known here */
    char *path;                  /* of the .oct */
    bool unsaved;                /* changed since it was opened or saved */
    size_t changes;              /* how often since it was opened */
    size_t forgotten; /* steps that can no longer be undone, as there was no more memory for them */
    struct session_save *saving; /* NULL: nothing is */
    char warning[ERROR_TEXT_SIZE];

    enum session_tool tool;
    bool fill;       /* puts material there instead of taking it away */
    unsigned mirror; /* CHIP_MIRROR_ bits */
    bool snap;       /* the brush's middle goes from cell to cell */
    double radius;   /* of the brush, in units of the cube */
    double depth;    /* of the brush's middle under the surface, in radii: -1 to 1 */
    unsigned material;

    bool aimed; /* the pointer is on the sculpture: */
    struct octree_hit hit;
    double middle[3], normal[3];           /* of the brush; out of the face that is hit */
    struct session_ray ray, pressed, used; /* now, where the button went down, where the tool was used last */
    bool dragging;
    double last[3]; /* end of the stroke so far */

    struct octree_regions changed; /* since session_take_changes() */
};

enum { SESSION_HISTORY_BYTES = 256 << 20 };

/* Opens path, or begins a full cube of this depth where there is no such file yet. Where a journal of a
 * program that was killed is left, its work is taken up with `recover`, and forgotten without. Errors: those
 * of octree_load(), and of the journal where another program has it open or its work cannot be taken up. On
 * failure *session is empty. */
enum status session_open(struct session *session, const char *path, unsigned depth, bool recover,
                         struct error *err);

/* Begins with this tree, which has no file yet (imported) and is to become `path`: unsaved work, with a
 * journal. The tree is taken over, and {0} then. Errors: STATUS_FILE when there is such a file, and those of
 * session_open(); then *session is empty and the tree is the caller's. */
enum status session_begin(struct session *session, const char *path, struct octree *tree, struct error *err);

/* Steps are kept for undo up to this many bytes (SESSION_HISTORY_BYTES unless this is
 * called); those there are go. */
void session_limit_undo(struct session *session, size_t bytes);

/* Frees it, waiting for what is being written; the journal is removed: what was not saved is not wanted. */
void session_clear(struct session *session);

/* Where the pointer is. During a drag the tool goes on from there. */
void session_aim(struct session *session, const double origin[3], const double direction[3]);
void session_aim_nowhere(struct session *session);

/* The tool's button goes down, moves, goes up: one step for undo. Errors: STATUS_NO_MEMORY, STATUS_FILE (the
 * journal); then the step is taken back at its end where that is possible. */
enum status session_press(struct session *session, struct error *err);
enum status session_drag(struct session *session, struct error *err);
enum status session_release(struct session *session, struct error *err);

/* Why a press would begin nothing where the pointer is, in words for whoever presses; NULL: it would. */
const char *session_why_nothing(const struct session *session);

/* Likewise why a drag does no more than its press did, once it has led away from there; NULL: it does. */
const char *session_why_no_drag(const struct session *session);

/* False where there is nothing to undo or redo. */
bool session_undo(struct session *session, struct error *err);
bool session_redo(struct session *session, struct error *err);

/* Brush: a step up or down, by a tenth; never below half a cell or above half the cube. */
void session_resize_brush(struct session *session, int steps);
void session_sink_brush(struct session *session, int steps);

/* Saving and exporting write a snapshot on a thread of its own, while carving goes on. One at a
 * time. Each begins with
 *
 *     session_save_begin(&session, NULL, &png, &err);        to session->path; with a name: under that one
 *     session_export_begin(&session, "fox.vox", &err);       a name that sculpt_export_is_name() knows
 *
 * and ends when session_write_ended() has said so. `preview` is a PNG's bytes, taken over, or NULL. A name
 * that another program is carving is refused with STATUS_RESOURCE. Errors: STATUS_FILE, STATUS_NO_MEMORY;
 * then nothing was begun. */
enum status session_save_begin(struct session *session, const char *path, struct bytes *preview,
                               struct error *err);
enum status session_export_begin(struct session *session, const char *path, struct error *err);

/* True, once, when what was begun has been written, or has failed: then *status says how, and the old file,
 * the journal and the session are as they were. Under a new name the session is that file's from then on,
 * its journal too. What was carved meanwhile is unsaved work. With `wait` it returns when that is so. False
 * when nothing was begun. */
bool session_write_ended(struct session *session, bool wait, enum status *status, struct error *err);

/* Hands over, and forgets, where cells changed. */
void session_take_changes(struct session *session, struct octree_regions *regions);

/* The brush as line segments, in units of the cube: what the next press would touch, mirror images included.
 * Returns how many there are, at most `most`. */
size_t session_outline(const struct session *session, double segments[][2][3], size_t most);

#endif
