/* The simulation as pictures: the program layer's bridge from sim to render. */
#ifndef SIM_FILM_H
#define SIM_FILM_H

#include "render/frames.h"
#include "sim/sim.h"

struct film;

/* Opens the renderer and the outputs: one picture a frame, or with view.stereo "separate" one for each eye,
 * in files of its own. `sim` is borrowed, as the options' texts are. The camera looks at the ball around all
 * points at rest (skins_ball() before the first step), by its centre and radius. */
enum status film_open(struct sim *sim, const double centre[3], double radius,
                      const struct frames_options *options, struct film **film, struct error *err);

/* Whether the scene's pictures could be drawn; asks no renderer. Errors: STATUS_RANGE, as of film_open(). */
enum status film_check(const struct sim *sim, const double centre[3], double radius, struct error *err);

/* From now on the camera stands as many full turns round its target, about the vertical, from
 * where the scene has it. */
void film_turn(struct film *film, double turns);

/* Draws the state as it is and hands the picture on. With the first one the folder loses the frames of an
 * earlier run that it has from there on. */
enum status film_frame(struct film *film, struct error *err);

/* How many those were. NULL is fine. */
size_t film_removed(const struct film *film);

/* Ends the outputs and frees the film, whatever it returns; without `keep` there is no movie and no sheet,
 * and those that were there stay. NULL is fine. */
enum status film_close(struct film *film, bool keep, struct error *err);

#endif
