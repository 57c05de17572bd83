/*
 * A simulation under the hand, without its picture: it follows the clock, is changed, pricked and pulled
 * between any two steps, and goes back to what it was.
 *
 *     struct live live;
 *     if (live_open(&live, &sim, 512 << 20, err)) ...           borrows the sim
 *     if (live_run(&live, seconds_passed, 0.015, err)) ...      again and again; steps for 15 ms at most
 *     live_turn(&live, LIVE_PRESSURE, 12);                      in between
 *     live_close(&live);
 *
 * "The user can change the time interval or the internal air pressure between any time steps" (paper 3.5).
 */
#ifndef SIM_LIVE_H
#define SIM_LIVE_H

#include "sim/live_hand.h"
#include "sim/live_past.h"

/* What can be turned. Where gas makes the pressure its dial turns the pump. */
enum live_dial { LIVE_PRESSURE, LIVE_STEP, LIVE_SPRINGS, LIVE_PACE, LIVE_DIALS };

struct live {
    struct sim *sim;
    struct live_past past; /* frames of view.rate */
    size_t shown; /* the frame that the sim was set back to; past.count - 1 or later: it goes on from there */
    double due;   /* s: when the next frame is kept */

    bool paused;
    bool each_frame; /* live_run() returns at every frame that it keeps, so that none is missed */
    double pace;     /* simulated seconds a second that are wanted */
    double owed;     /* simulated seconds that the clock is ahead */
    double speed;    /* simulated seconds a second, of late: the pace, where steps keep up with the clock */
    double rate;     /* steps a second, of late */
    struct {
        double seconds, simulated, steps;
    } window;                    /* what speed and rate are being counted in */
    double standard[LIVE_DIALS]; /* the dials' values at the start */
    void (*stepped)(void *self); /* called after each step, also one that failed; NULL: nobody is */
    void *self;

    struct hand hand;
};

/* Begins with a sim as it is, whose first frame is kept. `memory` bytes are for the past. It runs at the
 * clock's pace, or, where the scene is filmed in slow motion (view.playback under a quarter of view.rate), at
 * the film's. Error: STATUS_NO_MEMORY; then there is nothing to close. */
enum status live_open(struct live *live, struct sim *sim, size_t memory, struct error *err);
void live_close(struct live *live); /* also of {0} */

/* So many seconds have passed: unless paused, takes the steps that are due by then, for `budget` seconds at
 * most and one at least when one is due. What does not get done in that time is not made up for. Errors:
 * those of sim_step(); then it is paused, and the state is as it was left. */
enum status live_run(struct live *live, double seconds, double budget, struct error *err);

/* One step, also while paused. Errors as above. */
enum status live_step(struct live *live, struct error *err);

/* Whether the first dial is the pump: the first balloon has gas. Below 0 it lets gas out. */
bool live_pumps(const struct live *live);

/* Whether any balloon has springs that a dial could turn: all skins may be membranes. */
bool live_has_springs(const struct live *live);

/* A dial's name, and the unit of its value to be written behind it. */
const char *live_name(const struct live *live, enum live_dial dial);
const char *live_unit(const struct live *live, enum live_dial dial);

/* A dial's value, of the first balloon; sets it, for all, limited to the scene's range. The pace is 1e-6 to
 * 1e6. A pump that is turned by hand goes on past the scene's pump_until. */
double live_value(const struct live *live, enum live_dial dial);
void live_turn(struct live *live, enum live_dial dial, double value);

/* Shows frame i of the past, paused. What came after it stays until the next step, from there, is taken. */
void live_show(struct live *live, size_t i);

/* As it was at the start, and on. */
void live_restart(struct live *live);

/* The mean length of the edges that hold, over their mean rest length; NAN where none does. */
double live_stretch(const struct live *live);

/* Breaks the skin where it is hit. NULL, or a sentence that says why not. */
const char *live_prick(struct live *live, const struct hand_hit *hit);

#endif
