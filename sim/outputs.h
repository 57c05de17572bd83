/* What becomes of a run's states: pictures, meshes, and rows in the log. */
#ifndef SIM_OUTPUTS_H
#define SIM_OUTPUTS_H

#include "sim/checkpoint.h"
#include "sim/estimate.h"
#include "sim/film.h"
#include "sim/log.h"
#include "sim/mesh_series.h"
#include "sim/motion_cache.h"
#include "sim/options.h"

struct outputs {
    struct film *film;
    struct sim_log *log;
    struct mesh_series *series;
    struct motion_cache *cache;
    struct estimate *estimate; /* asked about each frame; borrowed; NULL: nobody asks */
    double centre[3], radius;  /* of the ball around all points at rest */
    double next;               /* number of the next frame, in frames of view.rate */
    double missed;             /* frames that were due within a step, and are not there */
    size_t removed;            /* meshes of an earlier run, by outputs_close() */
    const char *plot, *title;  /* file of the log's plot (NULL: none), and what stands above it; borrowed */
    uint64_t shown;            /* frames so far */
    bool turntable;            /* the camera goes round, ... */
    long turntable_frames;     /* ... and not before the end, if this is above 0 */
};

/* Remembers where everything is at rest: before a state is loaded. */
void outputs_find_rest(struct outputs *outputs, const struct sim *sim);

/* Whether the scene could be drawn, and the film and the meshes that the options ask for be written; leaves
 * nothing behind. Errors: those of film_open() and file_check_folder(). */
enum status outputs_check(const struct options *options, struct sim *sim, struct error *err);

/* Opens what the options ask for; *outputs has its estimate and where it rests, else it is empty. `past` is
 * the part of the run before it was resumed: frames and rows go on from there; NULL: there is none. */
enum status outputs_open(struct outputs *outputs, const struct options *options, struct sim *sim,
                         const struct checkpoint_run *past, struct error *err);

/* Whether anything is drawn or written of a state. */
bool outputs_are_there(const struct outputs *outputs);

/* All frames that are due by now. */
enum status outputs_show(struct outputs *outputs, struct sim *sim, struct error *err);

/* After the last step: draws what is only drawn of the last state. */
enum status outputs_finish(struct outputs *outputs, struct error *err);

/* Ends all, after a run that ended with `status`: one that diverged or was interrupted keeps what it
 * has shown so far; any other failure leaves the old log, movie and sheet. Returns that status, or
 * the first failure here. */
enum status outputs_close(struct outputs *outputs, enum status status, struct error *err);

#endif
