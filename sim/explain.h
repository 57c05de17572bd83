/* --explain: which effects a scene calls for, without running it. */
#ifndef SIM_EXPLAIN_H
#define SIM_EXPLAIN_H

#include "sim/effect.h"

#include <stdio.h>

/* A line an effect: on or off, its name, why, what it needs, and what it is expected to add to a step of springs and pressure; tab-separated. Then
 * what the scene can and cannot come to. */
void explain_effects(const struct scene *scene, FILE *stream);

/* What an effect is expected to add to a step of springs and pressure, by counted work, over that: 0.1 is a tenth; 0 where the scene does not call
 * for it. Below 0 where it takes the place of something dearer. */
double explain_share(const struct effect *effect, const struct scene *scene);

#endif
