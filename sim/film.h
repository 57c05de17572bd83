/* The simulation as pictures: the program layer's bridge from sim to render. */
#ifndef SIM_FILM_H
#define SIM_FILM_H

#include "render/frames.h"
#include "sim/sim.h"

struct film;

/* Opens the renderer and the outputs. `sim` is borrowed, as the options' texts are. The camera looks at the ball around all points
 * at rest (skins_ball() before the first step), by its centre and radius. */
enum status film_open(struct sim *sim, const double centre[3], double radius,
                      const struct frames_options *options, struct film **film, struct error *err);

/* Draws the state as it is and hands the picture on. */
enum status film_frame(struct film *film, struct error *err);

/* Ends the outputs and frees the film, whatever it returns. NULL is fine. */
enum status film_close(struct film *film, struct error *err);

#endif
