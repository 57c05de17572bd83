/* Inside of the sculpting window: what its files share. window.c answers the hand, window_draw.c shows. */
#ifndef SCULPT_WINDOW_APP_H
#define SCULPT_WINDOW_APP_H

#include "render/orbit.h"
#include "render/overlay.h"
#include "render/solid.h"
#include "render/window.h"
#include "sculpt/bricks.h"
#include "sculpt/session.h"
#include "sculpt/window_balloon.h"

/* What the window asks, and what the next keys answer. */
enum question { ASK_NOTHING, ASK_RECOVER, ASK_QUIT, ASK_NAME };

/* What a button that is held does. */
enum drag { DRAG_NOTHING, DRAG_TOOL, DRAG_TURN, DRAG_PAN };

enum { STEP_MILLISECONDS = 25 }; /* the simulator's default step, at the speed of life */

struct app {
    const char *path;
    unsigned depth;
    bool open; /* the session is: not while ASK_RECOVER waits */
    struct session session;

    struct window *window;
    struct render *render;
    struct render_solid *solid;
    struct brick_faces found; /* of one brick, and as the renderer takes them */
    struct {
        struct render_face *items;
        size_t count, capacity;
    } faces;
    struct orbit orbit;
    struct render_view view;
    bool cell_edges, help;

    enum drag drag;
    int x, y; /* of the pointer */

    struct balloon balloon;
    bool preview; /* the balloon is shown in the sculpture's place */

    enum question question;
    char answer[1024];   /* typed so far */
    char message[1100];  /* the last thing there was to say */
    struct error failed; /* what ended the program */
};

/* window.c: begins to sculpt, with the work that a killed program left or without. */
enum status app_open_session(struct app *app, bool recover, struct error *err);

/* Saves, under another name unless that is NULL; says what came of it. */
bool app_save(struct app *app, const char *path);

/* Closes the window, or asks first. */
void app_quit(struct app *app);

/* A line for the user, "" for none; or the error's, if there is one. */
void app_say(struct app *app, const char *text);
void app_say_unless_ok(struct app *app, enum status status, const struct error *err);
void app_show_title(struct app *app);

/* Finds what is under the pointer. */
void app_aim(struct app *app);

/* The balloon that is shown follows the sculpture. */
void app_remake_balloon(struct app *app);

/* window_keys.c: a key was pressed (struct window_events). */
void app_key(void *self, int key, int modifiers);

/* window_draw.c: shows everything, into the window. */
void app_draw(struct app *app);

/* Brings the faces up to date with the session's changes. */
enum status app_update_solid(struct app *app, struct error *err);

/* A picture of the sculpture alone, 256 x 192, as the bytes of a PNG; *png is empty after a failure. */
enum status app_preview(struct app *app, struct bytes *png, struct error *err);

#endif
