/* --explain: which effects a scene calls for, without running it. */
#ifndef SIM_EXPLAIN_H
#define SIM_EXPLAIN_H

#include "common/scene.h"

#include <stdio.h>

/* A line an effect: on or off, its name, why, what it needs, and what it is expected to add to a step of springs and pressure; tab-separated. Then
 * what the scene can and cannot come to. */
void explain_effects(const struct scene *scene, FILE *stream);

#endif
