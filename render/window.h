/*
 * A window with an OpenGL context, and what the hand does in it, through freeglut.
 *
 *     static const struct window_events events = {.draw = draw, .key = key, .button = button, ...};
 *     struct window *window;
 *     if (window_open("fox.oct", 960, 720, &events, self, &window, err)) ...
 *     struct render *render;
 *     if (render_open_window(window, &render, err)) ...        render.h
 *     window_run(window);                                      calls the events until the window is closed
 *     render_close(render);                                    solids before it, if any
 *     window_free(window);
 *
 * One window at a time in a process, and all its calls from one thread. Positions are pixels from the upper
 * left corner, as the hand sees the picture.
 */
#ifndef RENDER_WINDOW_H
#define RENDER_WINDOW_H

#include "common/status.h"
#include "render/image.h"

#include <stdbool.h>

struct window;

/* Held while something else happened; together by `|`. */
enum window_modifier { WINDOW_SHIFT = 1, WINDOW_CTRL = 2, WINDOW_ALT = 4 };

enum window_button { WINDOW_LEFT, WINDOW_MIDDLE, WINDOW_RIGHT };

/* A key is the character it writes (with shift: 'Z', '?'; with ctrl the small letter: 'z' for ctrl-z), one of
 * these characters, or a special key. X cannot tell ctrl with backspace, tab, enter, escape and delete from
 * ctrl with h, i, m, 3 and 8: they come as those. */
enum window_key {
    WINDOW_BACKSPACE = 8,
    WINDOW_TAB = 9,
    WINDOW_ENTER = 13,
    WINDOW_ESCAPE = 27,
    WINDOW_DELETE = 127,
    WINDOW_F1 = 0x100, /* F2 .. F12 follow */
    WINDOW_F12 = WINDOW_F1 + 11,
    WINDOW_LEFT_ARROW,
    WINDOW_RIGHT_ARROW,
    WINDOW_UP_ARROW,
    WINDOW_DOWN_ARROW,
    WINDOW_PAGE_UP,
    WINDOW_PAGE_DOWN,
    WINDOW_HOME,
    WINDOW_END,
    WINDOW_INSERT,
};

/* What the program is called for; NULL where it does not care. `modifiers` are as above. */
struct window_events {
    void (*draw)(void *self);      /* show the picture, with render_show(); the window swaps it in */
    void (*meanwhile)(void *self); /* after draw(), while the picture is being made: no OpenGL */
    void (*resize)(void *self, int width, int height); /* once before the first draw() too */
    void (*key)(void *self, int key, int modifiers);   /* pressed, or repeated while held */
    void (*button)(void *self, enum window_button button, bool pressed, int x, int y, int modifiers);
    void (*wheel)(void *self, int steps, int x, int y, int modifiers); /* up: 1, down: -1 */
    void (*motion)(void *self, int x, int y,
                   int modifiers); /* the pointer moved, with a button held or not */
    void (*leave)(void *self);     /* the pointer left the window */
    void (*timer)(void *self);     /* see window_timer() */
    bool (*close)(void *self); /* someone wants to close the window: true lets it close. NULL: it closes */
};

/* Opens a window whose picture is width x height pixels, at a place of the window manager's choice. `events`
 * and `self` are borrowed. Errors, each one line: STATUS_RESOURCE where there is no display, or none that
 * gives OpenGL 3.3; STATUS_NO_MEMORY. Where the screen has buffers for two eyes the window has them.
 * SIGPIPE is ignored from then on. */
enum status window_open(const char *title, int width, int height, const struct window_events *events,
                        void *self, struct window **window, struct error *err);

/* Shows the window and calls the events until it is closed. */
void window_run(struct window *window);

/* Ends window_run() after the event at hand, without asking close(). */
void window_close(struct window *window);

/* NULL is fine. */
void window_free(struct window *window);

/* draw() is called once after the events that wait have been dealt with, however often this was called. */
void window_redraw(struct window *window);

/* timer() is called once, after so many milliseconds (0: as soon as no event waits). A later call takes the
 * place of one that has not come yet; a negative number takes it back. */
void window_timer(struct window *window, int milliseconds);

void window_title(struct window *window, const char *title);

/* True where each eye has a buffer of its own to show, in turn: quad-buffered stereo
 * (render.h: RENDER_QUAD). */
bool window_has_quad(const struct window *window);

/* Calls draw() and copies the window's picture into *image, which is resized. Errors: STATUS_NO_MEMORY. */
enum status window_screenshot(struct window *window, struct image *image, struct error *err);

/* Inside of render: makes the window's context current, anew where an off-screen one has been in between, and
 * finds OpenGL's functions there. */
void window_use(struct window *window, bool anew);
void (*window_function(const char *name))(void);

#endif
