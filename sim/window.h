/* The live window of balloon-sim: the program layer's bridge between a simulation under
 * the hand and its picture. */
#ifndef SIM_WINDOW_H
#define SIM_WINDOW_H

#include "sim/estimate.h"
#include "sim/sim.h"

enum { WINDOW_PAST_BYTES = 512 << 20 }; /* a minute of some 10,000 triangles */

struct sim_window_options {
    const char *log; /* gets a row a frame that is shown; NULL: none */
    size_t memory;   /* bytes for the past that it can go back to */
};

/* Opens a window on a sim that has not stepped, inflates at once, and returns when it has been closed.
 * `estimate` (NULL: none) is asked about each frame until the user changes anything. Errors: STATUS_RESOURCE
 * without a display; those of the log; those of interrupt.h after a signal. A step that
 * diverges is told of in the window. */
enum status sim_window(const struct sim_window_options *options, struct sim *sim, struct estimate *estimate,
                       struct error *err);

#endif
