/* Inside of the live window: what its files share. window.c answers the clock, window_mouse.c and
 * window_keys.c the hand; window_draw.c shows the skin, window_panel.c what lies over it, window_text.c what
 * there is to be read, window_news.c what the run has told; window_record.c films. */
#ifndef SIM_WINDOW_APP_H
#define SIM_WINDOW_APP_H

#include "render/frames.h"
#include "render/hints.h"
#include "render/orbit.h"
#include "render/overlay.h"
#include "render/window.h"
#include "sim/live.h"
#include "sim/log.h"
#include "sim/news.h"
#include "sim/skins.h"
#include "sim/window.h"

/* Dots (app_dot), from the upper left corner of an eye's picture. */
struct panel_box {
    int x, y, width, height;
};

/* What a button that is held does. */
enum drag { DRAG_NOTHING, DRAG_TOOL, DRAG_PULL, DRAG_TURN, DRAG_PAN, DRAG_DIAL, DRAG_TIME };

/* What is shown of the skin. */
enum wires { WIRES_OFF, WIRES_OVER_SKIN, WIRES_ALONE, WIRES_KINDS };

/* Triangles sorted by their stretch into bands, each a skin in one colour. */
enum { WINDOW_BANDS = 24 };
struct window_bands {
    struct mesh mesh[WINDOW_BANDS]; /* look into these arrays: not to be cleared */
    struct render_skin skin[WINDOW_BANDS];
    double (*position)[3], (*normal)[3]; /* [3 x sim->triangle_count] of each triangle's corners */
    uint32_t (*triangle)[3];             /* [sim->triangle_count] 0 1 2, 3 4 5, ... */
    unsigned char *band;                 /* [sim->triangle_count] */
};

/* What the run has told of late, the oldest first. */
enum { WINDOW_NEWS = 3, WINDOW_NEWS_SECONDS = 8 };
struct window_news {
    struct window_news_item {
        char line[512];
        double time, left; /* of the simulation; s for which it is still shown while time goes on */
    } items[WINDOW_NEWS];
    size_t count;
};

struct app {
    const struct sim_window_options *options;
    struct live live;
    struct estimate *estimate;
    bool touched;    /* the user changed something: what the estimate measures is another run */
    double error;    /* by the estimate, in radii; NAN: none */
    double rounding; /* energies up to this are none */
    double measured; /* app_seconds() when measures were taken, and how long that took */
    double measuring;
    struct sim_measures measures;
    struct sim_log *log;

    struct window *window;
    struct render *render;
    struct skins skins;
    struct window_bands bands;
    struct orbit orbit;
    struct render_view view, film_view; /* of films and pictures: order and samples */
    double ball[4];                     /* around all points at rest: centre, radius */
    double eye_distance;                /* over the distance to the target */
    enum wires wires;
    bool stretch_colours, panel;

    enum drag drag;
    enum live_dial dial;          /* that is dragged */
    int x, y;                     /* of the pointer */
    int pressed_x, pressed_y;     /* where the button went down, */
    struct panel_box pressed_eye; /* and in which eye's picture */

    double clock;       /* app_seconds() at the last tick */
    double due;         /* s of it that steps have not been taken for */
    double drawing;     /* seconds that the last picture took */
    double frames_rate; /* pictures a second, of late */
    double counting;    /* app_seconds() since when pictures are counted for that */
    int pictures;
    struct {
        bool on;
        double wait, until; /* s; app_seconds() when sampled ones are tried again */
    } filtered;             /* outlines, where sampled ones would be too slow to move */
    bool stale;             /* the state is another than the log's last row */

    struct frames *film; /* being recorded; NULL: nothing is */
    struct image image;
    char recording[512]; /* its name */
    double recorded;     /* time of its last picture */

    struct {
        struct render_line *items;
        size_t count, capacity;
    } lines;
    struct {
        struct render_box *items;
        size_t count, capacity;
    } boxes;
    struct hints hints;
    double message_left; /* s for which its message is still shown while time goes on; 0: it stays */
    struct news telling;
    struct window_news news;
    struct error failed; /* what ended the program */
};

/* window.c: of a clock that only goes forwards. */
double app_seconds(void);

/* A line for the user that goes by, as news do; one that stays until Escape or the next: what went wrong. */
void app_say(struct app *app, const char *text);
void app_complain(struct app *app, const char *text);
void app_show_title(struct app *app);

/* Goes on or stops; one step; sets a dial; shows a frame of the past; begins anew. */
void app_pause(struct app *app, bool paused);
void app_step(struct app *app);
void app_turn(struct app *app, enum live_dial dial, double value);
void app_show(struct app *app, double frame);
void app_restart(struct app *app);

/* All that is left of the skin in the middle of the picture. */
void app_see_all(struct app *app);

/* What lies over the picture is made of dots, of so many pixels a side: more than one in a large window,
 * which is looked at from further away. */
int app_dot(const struct app *app);

/* The eye's picture that the pointer is in; each has all sliders and texts. Its corner is in pixels of the
 * window, its size in dots. */
struct panel_box app_eye(const struct app *app);

/* window_keys.c: a key was pressed (struct window_events). */
void app_key(void *self, int key, int modifiers);

/* window_mouse.c: what the mouse did (struct window_events). */
void app_moved(void *self, int x, int y, int modifiers);
void app_pressed(void *self, enum window_button button, bool down, int x, int y, int modifiers);
void app_wheel(void *self, int steps, int x, int y, int modifiers);

/* window_draw.c: the picture as it is drawn and aimed at: halves are alike. */
struct render_view app_drawn_view(const struct app *app);

/* Shows everything, into the window; the skin alone, into app->image. */
enum status app_open_pictures(struct app *app, struct error *err); /* STATUS_NO_MEMORY */
void app_close_pictures(struct app *app);
void app_draw(struct app *app);
enum status app_draw_image(struct app *app, struct error *err);

/* window_scale.c: where the scale of stretch ends, and which part of it a stretch is: 0 at rest and below, 1
 * at its end. The colour of a part, in linear light: grey through glasses that have hues of their own. */
double app_stretch_most(const struct app *app);
double app_stretch_part(const struct app *app, double stretch);
bool app_scale_is_grey(const struct app *app);
void app_scale_colour(const struct app *app, double part, float colour[3]);

/* window_panel.c: the boxes of sliders, plot and legend, into app->boxes. False: no memory. */
bool app_make_boxes(struct app *app);

/* Where there is something to be dragged at a place of one eye's picture: DRAG_DIAL with the dial,
 * DRAG_TIME, or DRAG_NOTHING. */
enum drag app_find_slider(const struct app *app, int x, int y, enum live_dial *dial);

/* The value of a slider that is dragged to x; and where on it, from 0 to 1, a value is. */
double app_dial_value(const struct app *app, enum live_dial dial, double part);
double app_dial_part(const struct app *app, enum live_dial dial);
void app_drag_slider(struct app *app, int x);

struct panel_box app_slider(const struct app *app, enum live_dial dial);
struct panel_box app_time_slider(const struct app *app);
/* What has no room is left out. */
bool app_has_sliders(const struct app *app);
bool app_has_plot(const struct app *app);
bool app_has_legend(const struct app *app);
struct panel_box app_plot(const struct app *app);
struct panel_box app_legend(const struct app *app);
/* How wide texts at the upper border may be: up to the legend, where it is shown. */
int app_text_width(const struct app *app);

/* An axis that ends here or below it is of no pressure: it has been widened to be seen at all. */
extern const double app_no_pressure;

/* The ranges of the plot's axes; false: there is nothing to plot. */
bool app_plot_ranges(const struct app *app, double stretch[2], double pressure[2]);

/* window_text.c: which energies are rounding, from the skins at rest. */
double app_find_rounding(const struct sim *sim);

/* What there is to be read; it is good until the next call. */
enum { WINDOW_TEXTS_MAX = 17 };
size_t app_texts(struct app *app, struct render_text texts[WINDOW_TEXTS_MAX]);

/* The keys are listed, and there is no room for anything beside them. */
bool app_help_alone(const struct app *app);

/* window_news.c: hears a line, as struct news asks for; so many seconds have passed with time going on, for
 * what goes by: of news they do not count while the list of keys is in their place; what is later than the
 * state that is shown has not happened. */
void app_hear(void *self, double time, const char *line);
void app_pass_news(struct app *app, double seconds);
void app_forget_news(struct app *app);

/* window_record.c: begins or ends a film; takes a picture where the film is due one; one PNG. */
void app_record(struct app *app);
void app_record_frame(struct app *app);
void app_end_recording(struct app *app);
void app_save_picture(struct app *app);

#endif
