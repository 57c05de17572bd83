/* A patch of a balloon's skin, by its place at rest. */
#ifndef SIM_PATCH_H
#define SIM_PATCH_H

#include "sim/sim.h"

/* The balloon's points whose direction from its centre at rest is within `reach` degrees of `place`, and
 * always the nearest one. *points is the caller's. Needs positions at rest: call it as the sim is opened.
 * Error: STATUS_NO_MEMORY. */
enum status patch_find(struct sim *sim, const struct sim_balloon *balloon, const double place[3],
                       double reach, uint32_t **points, uint32_t *count, struct error *err);

#endif
