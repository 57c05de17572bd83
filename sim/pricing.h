/*
 * What all that measures prices goes by: how long it may take, who ends it, and its clock.
 *
 *     if (pricing_ask(options, done, err)) ...      between steps, and between pictures
 *     const double began = pricing_now();
 *     if (pricing_step(options, &sim, err)) ...
 */
#ifndef SIM_PRICING_H
#define SIM_PRICING_H

#include "sim/sim.h"

struct pricing_options {
    double seconds; /* about how much time all may take */
    /* Asked between steps, with the share that is done; false ends it all with
     * STATUS_INTERRUPTED. NULL: nobody asks. */
    bool (*go_on)(void *context, double done);
    void *context;
    bool (*goes_on)(const struct sim *sim); /* likewise within what may be long in a step: sim->goes_on */
};

/* STATUS_INTERRUPTED where go_on says so. */
enum status pricing_ask(const struct pricing_options *options, double done, struct error *err);

/* One step. Errors: those of sim_step(). */
enum status pricing_step(const struct pricing_options *options, struct sim *sim, struct error *err);

/* Seconds that this thread has had of a processor. */
double pricing_now(void);

#endif
