/* Inside of the sculpting window: what its files share. window.c and
 * window_keys.c answer the hand, window_files.c opens and saves, window_draw.c and
 * window_text.c show. */
#ifndef SCULPT_WINDOW_APP_H
#define SCULPT_WINDOW_APP_H

#include "render/hints.h"
#include "render/orbit.h"
#include "render/overlay.h"
#include "render/solid.h"
#include "render/window.h"
#include "sculpt/bricks.h"
#include "sculpt/session.h"
#include "sculpt/window.h"
#include "sculpt/window_balloon.h"

#include <limits.h>

/* What the window asks, and what the next keys answer. */
enum question { ASK_NOTHING, ASK_RECOVER, ASK_UNSAVED, ASK_HOLLOW, ASK_NAME };

/* What a name is typed for. */
enum naming { NAME_SAVE, NAME_OPEN, NAME_EXPORT };

/* What follows when unsaved work is saved, or given up. */
enum next { NEXT_NOTHING, NEXT_QUIT, NEXT_OPEN };

/* What a button that is held does. */
enum drag { DRAG_NOTHING, DRAG_TOOL, DRAG_TURN, DRAG_PAN };

enum { STEP_MILLISECONDS = 25 }; /* the simulator's default step, at the speed of life */

/* A hand that does nothing for this long rests. */
#define REST_SECONDS 0.2

enum {
    WINDOW_COARSEST = 7, /* depth of the coarsest level: it is made within a frame */
    WINDOW_LEVELS_MAX = OCTREE_DEPTH_MAX - WINDOW_COARSEST + 1,
};

/* The sculpture as it is drawn, in cells of one size. */
struct window_level {
    struct octree tree; /* cut off there; of level 0 it is the session's */
    struct render_solid *solid;
    struct octree_regions changed; /* in the session's cells, since the tree was cut */
    struct {
        struct window_brick *items;
        size_t count, capacity;
    } waiting; /* bricks to be made */
};

struct app {
    const struct sculpt_window_options *options;
    bool open; /* the session is: not while ASK_RECOVER waits */
    struct session session;

    struct window *window;
    struct render *render;
    /* [level_count] 0: every cell; 1: twice as large ones; ... */
    struct window_level levels[WINDOW_LEVELS_MAX];
    struct window_level *shown;
    int level_count, coarser;
    bool fine;                /* the last frame showed all that can be told apart */
    double moved;             /* when the hand did something last */
    struct brick_faces found; /* of one brick, and as the renderer takes them */
    struct {
        struct render_face *items;
        size_t count, capacity;
    } faces;
    struct orbit orbit;
    struct render_view view;
    bool cell_edges, smooth_light;

    enum drag drag;
    int x, y; /* of the pointer */

    struct balloon balloon;
    bool preview; /* the balloon is shown in the sculpture's place */

    enum question question;
    enum naming naming;
    enum next next;              /* after ASK_UNSAVED */
    bool next_when_saved;        /* it waits for the end of a save */
    bool sure;                   /* a file of the name that was typed may be replaced */
    bool proposed;               /* the answer is not the hand's: what is typed takes its place */
    char answer[PATH_MAX];       /* typed so far */
    char opening[PATH_MAX];      /* the sculpture that ASK_RECOVER, or the model that ASK_HOLLOW, is about */
    struct octree model;         /* imported, while ASK_HOLLOW waits */
    uint64_t hollow;             /* its empty cells within */
    char notes[ERROR_TEXT_SIZE]; /* what is to be told of it once it is taken */
    const char *written;         /* of the last file: "saving...", "saved" */
    bool exports;                /* that file is no sculpture */
    size_t forgotten;            /* session.forgotten, when that was told last */
    struct hints hints;
    struct error failed; /* what ended the program */
};

/* window_files.c: opens the sculpture `path` in the place of the one that is there, with the work that a
 * killed program left or without. On failure everything is as it was. */
enum status app_open_session(struct app *app, const char *path, bool recover, struct error *err);

/* Begins to save, under another name unless that is NULL. False when it could not be
 * begun; it has been said why. */
bool app_save(struct app *app, const char *path);

/* Looks whether what is being written has been: then it is said, and what waited for it is done. */
void app_follow_write(struct app *app);

/* Does something for which unsaved work would be lost, or asks first. */
void app_leave(struct app *app, enum next next);
void app_do_next(struct app *app);

/* Asks for a name; does what it was typed for. */
void app_ask_name(struct app *app, enum naming naming);
void app_take_name(struct app *app);

/* Goes on with the model that was imported. */
void app_take_model(struct app *app, bool fill);

/* window.c: what the hand does ends where it is, whether its button is still down or not. */
void app_end_drag(struct app *app);

/* The timer comes when there is something to be done by then. */
void app_schedule(struct app *app);

/* The whole sculpture in the middle of the picture. */
void app_see_all(struct app *app);

/* A line for the user, "" for none; or the error's, if there is one. */
void app_say(struct app *app, const char *text);
void app_say_unless_ok(struct app *app, enum status status, const struct error *err);
void app_show_title(struct app *app);

/* The picture as it is drawn and aimed at: halves are alike. */
struct render_view app_drawn_view(const struct app *app);

/* Finds what is under the pointer. */
void app_aim(struct app *app);

/* The balloon that is shown follows the sculpture. */
void app_remake_balloon(struct app *app);

/* window_keys.c: a key was pressed (struct window_events). */
void app_key(void *self, int key, int modifiers);

/* window_draw.c: shows everything, into the window. */
void app_draw(struct app *app);

/* window_text.c: what there is to be read; it is good until the next call. */
enum { WINDOW_TEXTS_MAX = 4 };
size_t app_texts(struct app *app, struct render_text texts[WINDOW_TEXTS_MAX]);

/* window_bricks.c: brings the faces of a level up to date with the session's changes, for this long, and sets
 * app->shown: a coarser one where that was not enough. */
enum status app_update_solid(struct app *app, int level, double most_seconds, struct error *err);

/* All faces are made anew when they are wanted. */
void app_forget_faces(struct app *app);

/* The finest level whose cells can be told apart, and what is drawn while the hand moves: app->coarser levels
 * above, which follows the time that the last such frame took. */
int app_rest_level(const struct app *app);
void app_adapt(struct app *app, int rest, double seconds);

/* Of a clock that only goes forwards. */
double app_seconds(void);

/* A picture of the sculpture alone, 256 x 192, as the bytes of a PNG; *png is empty after a failure. */
enum status app_preview(struct app *app, struct bytes *png, struct error *err);

#endif
