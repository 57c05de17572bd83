/* What there is to see of a string (effect_string.c). */
#ifndef SIM_EFFECT_STRING_H
#define SIM_EFFECT_STRING_H

#include "sim/sim.h"

/* Its two ends as they are: at the skin, and where it is held or its weight hangs. False: the balloon
 * has none. */
bool string_ends(const struct sim *sim, const struct sim_balloon *balloon, double skin[3], double end[3]);

#endif
