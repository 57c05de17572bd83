/* What a scene has beside its balloons, as lines in its pictures: strings and weights, needles, obstacles. */
#ifndef SIM_PROPS_H
#define SIM_PROPS_H

#include "render/overlay.h"
#include "render/render.h"
#include "sim/sim.h"

/* Where the lowest end of a string, or the weight that hangs there, is at first: y; INFINITY without any. */
double props_foot(const struct sim *sim);

/* How many lines that is at the most. */
size_t props_room(const struct sim *sim);

/* Fills `lines` ([props_room()]) with those of the state as it is, as wide as suits the view's height;
 * returns how many there are: needles come at their time. */
size_t props_draw(const struct sim *sim, const struct render_view *view, struct render_line *lines);

#endif
