/* What the live window says. */
#include "sim/measure.h"
#include "sim/window_app.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 1280, MARGIN = 8, LETTER_WIDTH = 6, LETTER_HEIGHT = 7 };

static const char app_help[] = "left       prick, drag: pull     middle, alt+left  turn\n"
                               "right      pan (shift+middle)    wheel      zoom\n"
                               "\n"
                               "space  pause, go on              .  one step\n"
                               "up down  pressure, pump          [ ]  time step\n"
                               "- +  spring constants            < >  speed of time\n"
                               "left right  a frame back, on     page up, down  a second\n"
                               "r  from the start\n"
                               "\n"
                               "home f  see all   1 3 7  front, right, top; ctrl: opposite\n"
                               "v  stereo         w  wires       c  colours by stretch\n"
                               "s  latex or the paper's look     o  order of layers\n"
                               "tab  sliders and plot\n"
                               "m  record a movie, end it        p  save a picture\n"
                               "ctrl+q  quit                     F1 ?  this help";

/* Measures are taken this often, and may take a twentieth of the time. */
static const double measure_seconds = 0.1, measure_share = 0.05;

static const float white[3] = {1, 1, 1}, warm[3] = {1, 0.8f, 0.3f}, cool[3] = {0.55f, 0.85f, 1};

static void measure(struct app *app)
{
    const double now = app_seconds();
    if (app->stale &&
        now - app->measured >= fmax(app->live.paused ? 0 : measure_seconds, app->measuring / measure_share)) {
        app->measures = sim_measure(app->live.sim);
        app->measured = now;
        app->measuring = app_seconds() - now;
    }
}

static void describe_effects(const struct app *app, char *text, size_t size)
{
    const struct sim *sim = app->live.sim;
    size_t used = 0;
    const char *last = NULL;
    text[0] = '\0';
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++) {
            const char *name = sim->hooks[phase][i].effect->name;
            if (last == name || used + strlen(name) + 2 >= size)
                continue;
            used += (size_t)snprintf(text + used, size - used, "%s%s", last ? " " : "", name);
            last = name;
        }
    if (!last)
        snprintf(text, size, "none");
}

static void describe_error(const struct app *app, char *text, size_t size)
{
    if (!app->estimate)
        snprintf(text, size, "not estimated");
    else if (app->touched)
        snprintf(text, size, "not known of a run that was touched");
    else if (isnan(app->error))
        snprintf(text, size, "not known after a break");
    else
        snprintf(text, size, "%.2g radii", app->error);
}

/* Laws of rubber are sums of terms of the size of the modulus, which end in 0 at rest but for their last
 * bits: over all triangles those are some of what all skin holds at a strain of 1. */
double app_find_rounding(const struct sim *sim)
{
    const double last_bits = 1e-14;
    double held = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        double area = 0;
        for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
            area += sim_rest_area(sim, t);
        held += sim_stiffness(sim, b) * area;
    }
    return last_bits * held;
}

static double unless_rounding(const struct app *app, double energy)
{
    return fabs(energy) > app->rounding ? energy : 0;
}

static void describe_state(const struct app *app, char *text, size_t size)
{
    const struct sim_measures *m = &app->measures;
    char active[200], error[60];
    describe_effects(app, active, sizeof active);
    describe_error(app, error, sizeof error);
    char going[80] = "paused";
    if (!app->live.paused)
        snprintf(going, sizeof going, "%.2g x  %.0f steps/s  %.0f frames/s", app->live.speed, app->live.rate,
                 app->frames_rate);
    snprintf(text, size,
             "%.3f s  %s\nenergy %.4g moving + %.4g in the skin   error %s\n"
             "%u triangles in %u piece%s   effects: %s   F1 help",
             app->live.sim->time, going, unless_rounding(app, m->kinetic_energy),
             unless_rounding(app, m->elastic_energy), error, m->triangles_active, m->pieces,
             m->pieces == 1 ? "" : "s", active);
}

struct page {
    struct render_text *texts;
    char (*storage)[TEXT_SIZE];
    size_t count;
};

static struct render_text *add(struct page *page, int x, int y, int scale, const float colour[3], bool boxed)
{
    struct render_text *text = &page->texts[page->count];
    *text = (struct render_text){page->storage[page->count],        x,    y, scale,
                                 {colour[0], colour[1], colour[2]}, boxed};
    page->count++;
    return text;
}

/* The next text's storage. */
static char *room(struct page *page)
{
    return page->storage[page->count];
}

static void add_sliders(const struct app *app, struct page *page)
{
    for (int i = 0; i < LIVE_DIALS; i++) {
        const struct panel_box track = app_slider(app, (enum live_dial)i);
        const enum live_dial dial = (enum live_dial)i;
        snprintf(room(page), TEXT_SIZE, "%-8s %.4g%s", live_name(&app->live, dial),
                 live_value(&app->live, dial), live_unit(&app->live, dial));
        add(page, MARGIN, track.y + track.height / 2 - LETTER_HEIGHT / 2, 1, white, false);
    }
    const struct panel_box time = app_time_slider(app);
    snprintf(room(page), TEXT_SIZE, "%.3f s", app->live.sim->time);
    add(page, MARGIN, time.y + time.height / 2 - LETTER_HEIGHT / 2, 1, white, false);
}

static void add_plot(const struct app *app, struct page *page)
{
    const struct panel_box plot = app_plot(app);
    double stretch[2], pressure[2];
    snprintf(room(page), TEXT_SIZE, "pressure against stretch");
    add(page, plot.x + 4, plot.y + 4, 1, white, false);
    if (!app_plot_ranges(app, stretch, pressure))
        return;
    snprintf(room(page), TEXT_SIZE, "%.3g", pressure[1] > app_no_pressure ? pressure[1] : 0);
    add(page, plot.x + 4, plot.y + 4 + 2 * LETTER_HEIGHT, 1, warm, false);
    snprintf(room(page), TEXT_SIZE, "%.3g", stretch[0]);
    add(page, plot.x + 4, plot.y + plot.height - 4 - LETTER_HEIGHT, 1, warm, false);
    snprintf(room(page), TEXT_SIZE, "%.3g", stretch[1]);
    const int width = (int)strlen(room(page)) * LETTER_WIDTH;
    add(page, plot.x + plot.width - 4 - width, plot.y + plot.height - 4 - LETTER_HEIGHT, 1, warm, false);
}

static void add_legend(const struct app *app, struct page *page)
{
    const struct panel_box legend = app_legend(app);
    snprintf(room(page), TEXT_SIZE, "stretch");
    add(page, legend.x + legend.width - 7 * LETTER_WIDTH, legend.y - LETTER_HEIGHT - 6, 1, white, false);
    for (int i = 0; i <= 2; i++) {
        snprintf(room(page), TEXT_SIZE, "%.2f", 1 + (app_stretch_most(app) - 1) * i / 2);
        const int width = (int)strlen(room(page)) * LETTER_WIDTH;
        add(page, legend.x - 4 - width, legend.y + legend.height * (2 - i) / 2 - LETTER_HEIGHT / 2, 1, white,
            false);
    }
}

/* The list of keys below what else there is at the upper border. */
static struct render_text help_at(int y)
{
    return (struct render_text){app_help, 3 * MARGIN, y, 1, {white[0], white[1], white[2]}, true};
}

/* The upper border of what stands at the lower one. */
static int free_bottom(const struct app *app)
{
    if (!app_has_sliders(app))
        return app_eye(app).height;
    const int sliders = app_slider(app, 0).y - MARGIN;
    return app_has_plot(app) && app_plot(app).y < sliders ? app_plot(app).y : sliders;
}

bool app_help_alone(const struct app *app)
{
    enum { ABOVE = 11 * MARGIN }; /* what is written */
    const struct render_text help = help_at(ABOVE);
    int width, height;
    render_text_size(&help, &width, &height);
    return app->hints.help && (help.y + height > free_bottom(app) || help.x + width > app_text_width(app));
}

/* A text in the page's storage, broken to the picture's width, and below it the next. Whether it has room. */
static bool add_wrapped(const struct app *app, struct page *page, const float colour[3], int *below)
{
    int width, height;
    hints_wrap(room(page), (app_text_width(app) - 3 * MARGIN) / LETTER_WIDTH);
    render_text_size(add(page, MARGIN, *below, 1, colour, true), &width, &height);
    *below += height + MARGIN;
    return *below <= free_bottom(app);
}

/* What the run has told, as much of the latest as there is room for. False: there is none. */
static bool add_news(const struct app *app, struct page *page, int below)
{
    for (size_t first = 0; first < app->news.count; first++) {
        char *text = room(page);
        size_t used = 0;
        for (size_t i = first; i < app->news.count && used < TEXT_SIZE; i++)
            used += (size_t)snprintf(text + used, TEXT_SIZE - used, "%s%s", i > first ? "\n" : "",
                                     app->news.items[i].line);
        int next = below;
        if (add_wrapped(app, page, cool, &next) && used < TEXT_SIZE)
            return true;
        page->count--;
    }
    return app->news.count == 0;
}

/* What is told of the state. */
enum telling { TELL_ALL, TELL_TIME, TELL_NOTHING };

/* What is, and what has just been done or went wrong. False: there is no room. */
static bool add_state(const struct app *app, struct page *page, enum telling telling, int *below)
{
    bool fits = true;
    if (telling == TELL_ALL)
        describe_state(app, room(page), TEXT_SIZE);
    else
        snprintf(room(page), TEXT_SIZE, "%.3f s%s  F1 help", app->live.sim->time,
                 app->live.paused ? "  paused" : "");
    if (telling != TELL_NOTHING || !app->hints.message[0])
        fits = add_wrapped(app, page, white, below) &&
               (telling != TELL_ALL || *below <= app_eye(app).height / 2); /* the balloon is to be seen */
    if (app->hints.message[0]) {
        snprintf(room(page), TEXT_SIZE, "%s", app->hints.message);
        fits = add_wrapped(app, page, warm, below) && fits;
    }
    return fits;
}

/* The lines at the upper border. Where there is no room for news otherwise, and in the smallest pictures,
 * less is told of the state. Returns where they end. */
static int add_lines(const struct app *app, struct page *page)
{
    int below = MARGIN;
    bool fits = false;
    for (int with_news = !app->hints.help; with_news >= 0 && !fits; with_news--)
        for (int telling = TELL_ALL; telling <= TELL_NOTHING && !fits; telling++) {
            page->count = 0;
            below = MARGIN;
            fits = add_state(app, page, (enum telling)telling, &below) &&
                   (!with_news || add_news(app, page, below));
        }
    return below;
}

size_t app_texts(struct app *app, struct render_text texts[WINDOW_TEXTS_MAX])
{
    static char storage[WINDOW_TEXTS_MAX][TEXT_SIZE];
    struct page page = {texts, storage, 0};
    app->hints.pages = 1;
    if (app_help_alone(app)) {
        const struct panel_box eye = app_eye(app);
        texts[0] = help_at(MARGIN);
        texts[0].x = MARGIN;
        texts[0].text = storage[0];
        hints_page(&app->hints, app_help, eye.width - 2 * MARGIN, eye.height - 2 * MARGIN, storage[0],
                   TEXT_SIZE);
        return 1;
    }
    measure(app);
    const int below = add_lines(app, &page);
    if (app_has_sliders(app))
        add_sliders(app, &page);
    if (app_has_plot(app))
        add_plot(app, &page);
    if (app_has_legend(app))
        add_legend(app, &page);
    if (app->hints.help)
        texts[page.count++] = help_at(below > 9 * MARGIN ? below : 9 * MARGIN);
    return page.count;
}
