/* A run from the first state to the last: steps, pictures, the log, the skin that is left, and what is said at the end. */
#ifndef SIM_RUN_H
#define SIM_RUN_H

#include "sim/options.h"
#include "sim/sim.h"

/* Does what the options ask for with an open sim; the summary goes to stdout. Errors: all of the step's and the outputs'. */
enum status run(const struct options *options, struct sim *sim, struct error *err);

#endif
