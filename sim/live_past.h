/*
 * What a simulation was: its states frame by frame, as far back as a number of frames and an
 * amount of memory reach.
 *
 *     struct live_past past = {.frames_most = 1500, .bytes_most = 512 << 20};
 *     if (live_past_add(&past, &sim, marks, err)) ...      a frame is there
 *     live_past_restore(&past, i, &sim);                   0 <= i < past.count
 *     live_past_forget_after(&past, i);                    before the sim goes on from there
 *     live_past_clear(&past);
 *
 * A state is sim_blocks(), so that what follows a restored one is equal to the bit to what followed the first
 * time. Blocks that did not change since the frame before are held once. When memory runs out every second
 * frame is let go, and the first and the newest are always kept.
 */
#ifndef SIM_LIVE_PAST_H
#define SIM_LIVE_PAST_H

#include "sim/sim.h"

struct live_chunk;

/* What plots want to know about a frame without restoring it. */
struct live_marks {
    double time, stretch, pressure;
};

struct live_frame {
    struct live_marks marks;
    struct live_chunk **chunk; /* [chunk_count] one a block */
    size_t chunk_count;
};

struct live_past {
    size_t frames_most, bytes_most; /* limits: at least 2 frames are held */
    struct live_frame *items;       /* [count] oldest first */
    size_t count, capacity;
    size_t bytes; /* of all chunks */
};

/* Keeps the state as it is. Error: STATUS_NO_MEMORY; then the past is as it was. */
enum status live_past_add(struct live_past *past, struct sim *sim, struct live_marks marks,
                          struct error *err);

/* Makes *sim what it was in frame i. */
void live_past_restore(const struct live_past *past, size_t i, struct sim *sim);

/* Frame i is the newest from here on. */
void live_past_forget_after(struct live_past *past, size_t i);

/* The frame nearest in time; the past is not empty. */
size_t live_past_nearest(const struct live_past *past, double time);

void live_past_clear(struct live_past *past); /* the limits stay */

#endif
