/* The method that chooses a method (auto.c). */
#ifndef SIM_AUTO_H
#define SIM_AUTO_H

#include "sim/sim.h"

/* In words, what acts and why: "verlet, 4 substeps: stiffness ratio 12, error 3e-05, 4.6 evaluations a step".
 * False, and text is left as it is: the scene names its method, or nothing else has been chosen since
 * *choices, which is updated. */
bool auto_describe(const struct sim *sim, uint64_t *choices, char *text, size_t size);

#endif
