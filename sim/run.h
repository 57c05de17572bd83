/* A run from the first state to the last: steps, pictures, the log, the skin that is left, and
 * what is said at the end. */
#ifndef SIM_RUN_H
#define SIM_RUN_H

#include "sim/estimate.h"
#include "sim/options.h"
#include "sim/sim.h"

/* Does what the options ask for with an open sim, and what the estimate (NULL: none) says about it; the
 * summary goes to stdout. Errors: all of the step's and the outputs', and those of
 * interrupt.h after a signal. */
enum status run(const struct options *options, struct sim *sim, struct estimate *estimate, struct error *err);

/* Whether a run could begin, and the scene be drawn: nothing is written, and no folder made. A checkpoint
 * that is to be gone on with is loaded into `sim`. Errors: those of beginning. */
enum status run_check(const struct options *options, struct sim *sim, struct error *err);

#endif
