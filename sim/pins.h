/* What pins hold (effect_pins.c), for others that move points. */
#ifndef SIM_PINS_H
#define SIM_PINS_H

#include "sim/sim.h"

/* Sets held[p] to 1 for each point that is held now; [point_count]. */
void pins_mark(const struct sim *sim, unsigned char *held);

/* Sets the rows of those points to 0: of changes of places or speeds; [point_count]. */
void pins_hold(const struct sim *sim, double (*rows)[4]);

#endif
