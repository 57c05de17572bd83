#include "sim/live.h"
#include "common/scene_fields.h"
#include "sim/effect_gas.h"
#include "sim/guard.h"
#include "sim/let_go.h"

#include <math.h>
#include <string.h>
#include <time.h>

/* A minute of the film, frame by frame; speeds are counted over this long. */
static const double past_seconds = 60, window_seconds = 0.5;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double live_stretch(const struct live *live)
{
    const struct sim *sim = live->sim;
    double length = 0, rest = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++)
        if (sim->edge_active[e]) {
            length += sim_edge_length(sim, e);
            rest += sim->rest_length[e];
        }
    return length / rest;
}

static double frame_seconds(const struct live *live)
{
    return 1 / live->sim->scene->view.rate;
}

/* The state as it is becomes the newest frame. */
static enum status keep_frame(struct live *live, struct error *err)
{
    const struct live_marks marks = {live->sim->time, live_stretch(live),
                                     gas_gauge_pressure(live->sim, live->sim->balloons)};
    enum status status = live_past_add(&live->past, live->sim, marks, err);
    live->shown = live->past.count - 1;
    live->due = (floor(live->sim->time / frame_seconds(live) + 1e-6) + 1) * frame_seconds(live);
    return status;
}

static double film_pace(const struct scene_view *view)
{
    return view->playback < view->rate / 4 ? view->playback / view->rate : 1;
}

enum status live_open(struct live *live, struct sim *sim, size_t memory, struct error *err)
{
    const struct scene_view *view = &sim->scene->view;
    *live = (struct live){.sim = sim, .pace = film_pace(view)};
    live->past.bytes_most = memory;
    live->past.frames_most = (size_t)(past_seconds * view->playback);
    for (int dial = 0; dial < LIVE_DIALS; dial++)
        live->standard[dial] = live_value(live, (enum live_dial)dial);
    enum status status = hand_open(&live->hand, sim, err);
    if (!status)
        status = keep_frame(live, err);
    if (status)
        live_close(live);
    return status;
}

void live_close(struct live *live)
{
    if (!live->sim)
        return;
    hand_close(&live->hand, live->sim);
    live_past_clear(&live->past);
    *live = (struct live){0};
}

/* What was shown of later is given up: from here it happens anew. */
static void go_on_from_here(struct live *live)
{
    if (live->shown + 1 < live->past.count)
        live_past_forget_after(&live->past, live->shown);
    live->due = (floor(live->sim->time / frame_seconds(live) + 1e-6) + 1) * frame_seconds(live);
}

enum status live_step(struct live *live, struct error *err)
{
    struct sim *sim = live->sim;
    go_on_from_here(live);
    const double held = hand_energy(&live->hand, sim);
    enum status status = sim_step(sim, err);
    if (sim->ledger.on)
        sim->ledger.account.user += held - hand_energy(&live->hand, sim);
    live->window.steps++;
    live->window.simulated += sim->taken;
    if (live->stepped)
        live->stepped(live->self);
    if (status)
        live->paused = true;
    else if (sim->time + 1e-9 * frame_seconds(live) >= live->due)
        status = keep_frame(live, err);
    return status;
}

/* Speeds are those of the last full window. */
static void count(struct live *live, double seconds)
{
    live->window.seconds += seconds;
    if (live->window.seconds < window_seconds)
        return;
    live->speed = live->window.simulated / live->window.seconds;
    live->rate = live->window.steps / live->window.seconds;
    memset(&live->window, 0, sizeof live->window);
}

enum status live_run(struct live *live, double seconds, double budget, struct error *err)
{
    const double until = now() + budget;
    enum status status = STATUS_OK;
    if (!live->paused)
        live->owed += seconds * live->pace;
    while (!status && !live->paused && live->owed >= live->sim->step) {
        status = live_step(live, err);
        live->owed -= live->sim->taken;
        if (now() >= until ||
            (live->each_frame && live->sim->time == live->past.items[live->shown].marks.time))
            live->owed = fmin(live->owed, 0);
    }
    count(live, seconds);
    return status;
}

bool live_pumps(const struct live *live)
{
    return live->sim->balloons->gas;
}

bool live_has_springs(const struct live *live)
{
    const struct sim *sim = live->sim;
    for (size_t i = 0; i < sim->balloon_count; i++)
        if (!sim->balloons[i].membrane)
            return true;
    return false;
}

const char *live_name(const struct live *live, enum live_dial dial)
{
    static const char *const names[LIVE_DIALS] = {[LIVE_PRESSURE] = "pressure",
                                                  [LIVE_STEP] = "step",
                                                  [LIVE_SPRINGS] = "springs",
                                                  [LIVE_PACE] = "speed"};
    return dial == LIVE_PRESSURE && live_pumps(live) ? "pump" : names[dial];
}

const char *live_unit(const struct live *live, enum live_dial dial)
{
    static const char *const units[LIVE_DIALS] = {
        [LIVE_PRESSURE] = "", [LIVE_STEP] = " s", [LIVE_SPRINGS] = "", [LIVE_PACE] = " x"};
    return dial == LIVE_PRESSURE && live_pumps(live) ? "/s" : units[dial];
}

double live_value(const struct live *live, enum live_dial dial)
{
    const struct sim_settings *settings = live->sim->settings;
    const double values[LIVE_DIALS] = {[LIVE_PRESSURE] = live_pumps(live) ? settings->pump
                                                                          : settings->pressure,
                                       [LIVE_STEP] = live->sim->whole_step,
                                       [LIVE_SPRINGS] = settings->spring_factor,
                                       [LIVE_PACE] = live->pace};
    return values[dial];
}

void live_turn(struct live *live, enum live_dial dial, double value)
{
    static const char *const keys[LIVE_DIALS][3] = {[LIVE_PRESSURE] = {"", "balloons", "pressure"},
                                                    [LIVE_STEP] = {"", "time", "step"},
                                                    [LIVE_SPRINGS] = {"", "balloons", "spring_factor"}},
                             *const pump[] = {"balloons", "gas", "pump"};
    const bool pumps = dial == LIVE_PRESSURE && live_pumps(live);
    const char *const *key = pumps ? pump : keys[dial];
    if (dial == LIVE_PACE) {
        live->pace = fmin(fmax(value, 1e-6), 1e6);
        return;
    }
    const struct scene_block *block = scene_find_block(key[0], key[1]);
    const struct scene_field *field = scene_find_field(block, key[2]);
    struct scene_schedule change = {.balloon = -1, .change_count = 1};
    change.change[0].field = field;
    change.change[0].value = fmin(fmax(value, field->least), field->most);
    if (pumps) {
        change.change[1].field = scene_find_field(block, "pump_until");
        change.change[1].value = change.change[1].field->most;
        change.change_count = 2;
    }
    go_on_from_here(live);
    sim_change(live->sim, &change);
}

void live_show(struct live *live, size_t i)
{
    hand_let_go(&live->hand, live->sim);
    live_past_restore(&live->past, i, live->sim);
    sim_forces(live->sim); /* for the normals */
    live->shown = i;
    live->paused = true;
    live->owed = 0;
}

void live_restart(struct live *live)
{
    live_show(live, 0);
    live_past_forget_after(&live->past, 0);
    live->paused = false;
}

const char *live_prick(struct live *live, const struct hand_hit *hit)
{
    struct sim *sim = live->sim;
    go_on_from_here(live);
    const char *why_not = sim_prick(sim, hit->triangle, hit->place);
    if (!sim_balloon_of(sim, hit->triangle)->fracture)
        sim_drop_triangle(sim, hit->triangle); /* also while nothing steps */
    return why_not;
}
