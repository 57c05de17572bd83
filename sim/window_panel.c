/* What lies over the picture in the live window: sliders, the plot of pressure against stretch,
 * the legend of colours. */
#include "common/array.h"
#include "sim/window_app.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Dots (app_dot). */
enum {
    MARGIN = 8,
    ROW = 16,          /* a slider and its name */
    NAME_WIDTH = 124,  /* room for "pressure 12.34" */
    TRACK_WIDTH = 130, /* of a slider */
    TRACK_HEIGHT = 4,
    KNOB_WIDTH = 6,
    KNOB_HEIGHT = 12,
    PLOT_WIDTH = 190,
    PLOT_HEIGHT = 120,
    PLOT_HEAD = 28,     /* above the curve: title and a number */
    PLOT_FOOT = 14,     /* below: numbers */
    PLOT_SAMPLES = 400, /* frames that are plotted of however many */
    LEGEND_WIDTH = 14,
    LEGEND_NUMBER = 28, /* how wide its numbers are, with some room */
    LEGEND_HEIGHT = 120,
    LEGEND_ROOM = LEGEND_WIDTH + LEGEND_NUMBER + 3 * MARGIN, /* with its number, from the right border */
    STATE_HEIGHT = 64,                                       /* what the lines at the upper border take */
    BOXES_MAX = 8192,
};

/* A slider of pressure ends at this many times the scene's, and where that is 0 at the other; that of a
 * pump, or of a pressure from outside, has 0 in its middle, and before it gas that is let out, or that
 * pressure. The others go from a tenth to ten times theirs. */
static const double pressure_most = 2.5, other_pressure_most = 25, other_pump_most = 1;

const double app_no_pressure = 2e-9;

static const float dark[3] = {0.02f, 0.02f, 0.025f}, light[3] = {0.75f, 0.75f, 0.72f},
                   yellow[3] = {0.9f, 0.6f, 0.05f}, blue[3] = {0.15f, 0.35f, 0.9f};

/* Shorter where an eye's picture is narrow: each value can be reached. */
static int track_width(const struct app *app)
{
    const int room = app_eye(app).width - NAME_WIDTH - 3 * MARGIN;
    return room > TRACK_WIDTH ? TRACK_WIDTH : room > 1 ? room : 1;
}

struct panel_box app_slider(const struct app *app, enum live_dial dial)
{
    const int bottom = app_eye(app).height - MARGIN - 2 * ROW;
    return (struct panel_box){MARGIN + NAME_WIDTH,
                              bottom - (LIVE_DIALS - (int)dial) * ROW + ROW / 2 - TRACK_HEIGHT / 2,
                              track_width(app), TRACK_HEIGHT};
}

struct panel_box app_time_slider(const struct app *app)
{
    const int left = MARGIN + NAME_WIDTH, width = app_eye(app).width - left - 2 * MARGIN;
    return (struct panel_box){left, app_eye(app).height - MARGIN - ROW, width > 1 ? width : 1, TRACK_HEIGHT};
}

/* Where they would leave no room for what is written, or for a knob to be moved, they are left out. */
bool app_has_sliders(const struct app *app)
{
    enum { SHORTEST = 12 };
    return app->panel && track_width(app) >= SHORTEST &&
           app_slider(app, 0).y - ROW / 2 >= STATE_HEIGHT + MARGIN;
}

/* The upper border of a plot beside the sliders, */
static int plot_top(const struct app *app)
{
    return app_eye(app).height - 2 * MARGIN - 2 * ROW - PLOT_HEIGHT;
}

/* which goes to the left of the legend where that reaches so far down. */
static int plot_right(const struct app *app)
{
    const struct panel_box legend = app_legend(app);
    const bool meets = app_has_legend(app) && plot_top(app) < legend.y + legend.height + MARGIN;
    return app_eye(app).width - (meets ? LEGEND_ROOM : MARGIN);
}

/* Whether the plot has room beside the sliders. */
static bool is_wide(const struct app *app)
{
    return plot_right(app) >= 3 * MARGIN + NAME_WIDTH + TRACK_WIDTH + PLOT_WIDTH &&
           plot_top(app) >= STATE_HEIGHT;
}

/* Where it would cover the balloons or what is written it is left out. */
bool app_has_plot(const struct app *app)
{
    enum { HIGH = 600 };
    return app_has_sliders(app) && (is_wide(app) || app_eye(app).height >= HIGH);
}

/* Beside the sliders, or above them where an eye's picture is too narrow. */
struct panel_box app_plot(const struct app *app)
{
    const bool beside = is_wide(app);
    const int right = beside ? plot_right(app) : app_eye(app).width - MARGIN;
    return (struct panel_box){right - PLOT_WIDTH, plot_top(app) - (beside ? 0 : LIVE_DIALS * ROW), PLOT_WIDTH,
                              PLOT_HEIGHT};
}

/* Shorter where it would stand on the sliders, or below the picture. */
struct panel_box app_legend(const struct app *app)
{
    const struct panel_box eye = app_eye(app);
    const bool meets = app_has_sliders(app) &&
                       eye.width - LEGEND_ROOM < NAME_WIDTH + TRACK_WIDTH + 3 * MARGIN;
    const int top = 2 * MARGIN + ROW, bottom = meets ? app_slider(app, 0).y - ROW / 2 - MARGIN : eye.height;
    const int room = bottom - MARGIN - top;
    return (struct panel_box){eye.width - MARGIN - LEGEND_WIDTH, top, LEGEND_WIDTH,
                              room < LEGEND_HEIGHT ? room : LEGEND_HEIGHT};
}

/* Where its numbers, or a few words beside it, have no room it is left out. */
bool app_has_legend(const struct app *app)
{
    enum { LOWEST = 30, WORDS = 72 };
    return app->stretch_colours && app_legend(app).height >= LOWEST &&
           app_eye(app).width - LEGEND_ROOM >= WORDS;
}

int app_text_width(const struct app *app)
{
    return app_eye(app).width - (app_has_legend(app) ? LEGEND_ROOM : 0);
}

/* The ends of the pressure's or the pump's slider. */
static void pressure_range(const struct app *app, double range[2])
{
    const bool pumps = live_pumps(&app->live);
    const double most = pressure_most * fabs(app->live.standard[LIVE_PRESSURE]);
    range[1] = most > 0 ? most : pumps ? other_pump_most : other_pressure_most;
    range[0] = pumps || app->live.standard[LIVE_PRESSURE] < 0 ? -range[1] : 0;
}

static double standard_of(const struct app *app, enum live_dial dial)
{
    return app->live.standard[dial] > 0 ? app->live.standard[dial] : 1;
}

double app_dial_value(const struct app *app, enum live_dial dial, double part)
{
    double range[2];
    pressure_range(app, range);
    return dial == LIVE_PRESSURE ? range[0] + part * (range[1] - range[0])
                                 : standard_of(app, dial) * pow(10, 2 * part - 1);
}

double app_dial_part(const struct app *app, enum live_dial dial)
{
    const double value = live_value(&app->live, dial);
    double range[2];
    pressure_range(app, range);
    return dial == LIVE_PRESSURE ? (value - range[0]) / (range[1] - range[0])
                                 : (log10(fmax(value / standard_of(app, dial), 1e-12)) + 1) / 2;
}

/* How far along x is, from 0 to 1. */
static double part_of(const struct panel_box *track, int x)
{
    const double part = (double)(x - track->x) / track->width;
    return fmin(fmax(part, 0), 1);
}

static bool is_near(const struct panel_box *track, int x, int y)
{
    return x >= track->x - KNOB_WIDTH && x < track->x + track->width + KNOB_WIDTH &&
           y >= track->y - ROW / 2 + 2 && y < track->y + ROW / 2 + 2;
}

enum drag app_find_slider(const struct app *app, int x, int y, enum live_dial *dial)
{
    if (!app_has_sliders(app) || app_help_alone(app))
        return DRAG_NOTHING;
    for (int i = 0; i < LIVE_DIALS; i++) {
        const struct panel_box track = app_slider(app, (enum live_dial)i);
        if (is_near(&track, x, y)) {
            *dial = (enum live_dial)i;
            return DRAG_DIAL;
        }
    }
    const struct panel_box track = app_time_slider(app);
    return is_near(&track, x, y) ? DRAG_TIME : DRAG_NOTHING;
}

static double first_time(const struct app *app)
{
    return app->live.past.items[0].marks.time;
}

static double last_time(const struct app *app)
{
    return app->live.past.items[app->live.past.count - 1].marks.time;
}

void app_drag_slider(struct app *app, int x)
{
    if (app->drag == DRAG_DIAL) {
        const struct panel_box track = app_slider(app, app->dial);
        app_turn(app, app->dial, app_dial_value(app, app->dial, part_of(&track, x)));
        return;
    }
    const struct panel_box track = app_time_slider(app);
    const double time = first_time(app) + part_of(&track, x) * (last_time(app) - first_time(app));
    app_show(app, (double)live_past_nearest(&app->live.past, time));
}

static void add(struct app *app, int x, int y, int width, int height, const float colour[3], float opacity)
{
    if (app->boxes.count >= BOXES_MAX)
        return;
    struct render_box *box = &app->boxes.items[app->boxes.count++];
    *box = (struct render_box){x, y, width, height, {colour[0], colour[1], colour[2]}, opacity};
}

static void add_slider(struct app *app, const struct panel_box *track, double part)
{
    const int at = track->x + (int)lround(fmin(fmax(part, 0), 1) * track->width);
    add(app, track->x, track->y, track->width, track->height, light, 0.45f);
    add(app, track->x, track->y, at - track->x, track->height, yellow, 0.8f);
    add(app, at - KNOB_WIDTH / 2, track->y + (TRACK_HEIGHT - KNOB_HEIGHT) / 2, KNOB_WIDTH, KNOB_HEIGHT, light,
        1);
}

static void add_sliders(struct app *app)
{
    const struct panel_box first = app_slider(app, 0), time = app_time_slider(app);
    add(app, MARGIN / 2, first.y - ROW / 2, NAME_WIDTH + first.width + 2 * MARGIN, LIVE_DIALS * ROW, dark,
        0.6f);
    add(app, MARGIN / 2, time.y - ROW / 2, app_eye(app).width - MARGIN, ROW + TRACK_HEIGHT / 2, dark, 0.72f);
    for (int i = 0; i < LIVE_DIALS; i++) {
        const struct panel_box track = app_slider(app, (enum live_dial)i);
        add_slider(app, &track, app_dial_part(app, (enum live_dial)i));
    }
    const double length = last_time(app) - first_time(app);
    add_slider(app, &time, length > 0 ? (app->live.sim->time - first_time(app)) / length : 1);
}

/* A little room around what is plotted, also where it is a single value. */
static void widen(double range[2])
{
    const double room = fmax(0.06 * (range[1] - range[0]),
                             0.02 * fmax(fabs(range[0]), fabs(range[1])) + app_no_pressure / 2);
    range[0] -= room;
    range[1] += room;
}

bool app_plot_ranges(const struct app *app, double stretch[2], double pressure[2])
{
    const struct live_past *past = &app->live.past;
    stretch[0] = pressure[0] = INFINITY;
    stretch[1] = pressure[1] = -INFINITY;
    for (size_t i = 0; i < past->count; i++) {
        const struct live_marks *marks = &past->items[i].marks;
        if (!isfinite(marks->stretch) || !isfinite(marks->pressure))
            continue;
        stretch[0] = fmin(stretch[0], marks->stretch);
        stretch[1] = fmax(stretch[1], marks->stretch);
        pressure[0] = fmin(pressure[0], marks->pressure);
        pressure[1] = fmax(pressure[1], marks->pressure);
    }
    if (!(stretch[0] <= stretch[1]))
        return false;
    pressure[0] = fmin(pressure[0], 0);
    widen(stretch);
    widen(pressure);
    return true;
}

static void add_segment(struct app *app, const int from[2], const int to[2], const float colour[3])
{
    const int dx = to[0] - from[0], dy = to[1] - from[1];
    const int dots = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
    for (int i = 0; i <= dots; i++)
        add(app, from[0] + (dots ? dx * i / dots : 0), from[1] + (dots ? dy * i / dots : 0), 2, 2, colour, 1);
}

/* The frames up to the one that is shown are bright, those after it dim. */
static void add_plot(struct app *app)
{
    const struct live_past *past = &app->live.past;
    const struct panel_box plot = app_plot(app);
    double stretch[2], pressure[2];
    add(app, plot.x, plot.y, plot.width, plot.height, dark, 0.72f);
    if (!app_plot_ranges(app, stretch, pressure))
        return;
    const size_t stride = past->count / PLOT_SAMPLES + 1;
    int before[2] = {-1, -1}, here[2] = {-1, -1};
    for (size_t i = 0; i < past->count; i += stride) {
        const struct live_marks *marks = &past->items[i].marks;
        if (!isfinite(marks->stretch) || !isfinite(marks->pressure))
            continue;
        const int at[2] = {
            plot.x + (int)((marks->stretch - stretch[0]) / (stretch[1] - stretch[0]) * (plot.width - 2)),
            plot.y + plot.height - PLOT_FOOT -
                (int)((marks->pressure - pressure[0]) / (pressure[1] - pressure[0]) *
                      (plot.height - PLOT_HEAD - PLOT_FOOT))};
        add_segment(app, before[0] < 0 ? at : before, at, i <= app->live.shown ? yellow : blue);
        memcpy(before, at, sizeof before);
        if (i <= app->live.shown)
            memcpy(here, at, sizeof here);
    }
    if (here[0] >= 0)
        add(app, here[0] - 2, here[1] - 2, 6, 6, light, 1);
}

static void add_legend(struct app *app)
{
    const struct panel_box legend = app_legend(app);
    const int beside = LEGEND_NUMBER + MARGIN / 2;
    add(app, legend.x - beside, legend.y - ROW - 1, beside + legend.width + MARGIN / 2,
        legend.height + ROW + MARGIN, dark, 0.72f);
    for (int i = 0; i < WINDOW_BANDS; i++) {
        const int top = legend.y + legend.height * (WINDOW_BANDS - 1 - i) / WINDOW_BANDS;
        const int bottom = legend.y + legend.height * (WINDOW_BANDS - i) / WINDOW_BANDS;
        float colour[3];
        app_scale_colour(app, (i + 0.5) / WINDOW_BANDS, colour);
        add(app, legend.x, top, legend.width, bottom - top, colour, 1);
    }
}

bool app_make_boxes(struct app *app)
{
    app->boxes.count = 0;
    if (!ARRAY_RESERVE(&app->boxes, BOXES_MAX))
        return false;
    if (app_help_alone(app))
        return true;
    if (app_has_sliders(app))
        add_sliders(app);
    if (app_has_plot(app))
        add_plot(app);
    if (app_has_legend(app))
        add_legend(app);
    return true;
}
