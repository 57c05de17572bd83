/* --explain: which effects a scene calls for, without running it. */
#ifndef SIM_EXPLAIN_H
#define SIM_EXPLAIN_H

#include "sim/sim.h"

#include <stdio.h>

/* A line an effect: on or off, its name, why, what it needs, and what it is expected to add to a step of
 * springs and pressure; tab-separated. */
void explain_effects(const struct scene *scene, FILE *stream);

/* What an effect is expected to add to a step of springs and pressure, by counted work, over that: 0.1 is a
 * tenth; 0 where the scene does not call for it. Below 0 where it takes the place of something dearer. */
double explain_share(const struct effect *effect, const struct scene *scene);

/* A line a balloon: on or off, "burst", and whether its pressure or gas can burst it by itself, with what
 * would do: an estimate (explain_burst.c). Its points are moved about: the sim is of no use afterwards. */
void explain_bursts(struct sim *sim, FILE *stream);

#endif
