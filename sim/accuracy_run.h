/* Runs of one scene by different methods, up to the same moments, for accuracy.h. */
#ifndef SIM_ACCURACY_RUN_H
#define SIM_ACCURACY_RUN_H

#include "sim/accuracy.h"

/* What all runs have in common; borrowed. */
struct accuracy_subject {
    const struct scene *scene;
    const struct mesh *meshes;
    const struct pricing_options *options;
    double done;                 /* share of the whole so far, for options->go_on() */
    double part;                 /* by how much the run at hand brings that on when it is over */
    double time[ACCURACY_TIMES]; /* s */
};

/* In which they differ. */
struct accuracy_dials {
    const struct integrator *method;
    double step, tolerance, end;
    int guard;       /* enum scene_guard */
    uint64_t member; /* of an ensemble, which moves the points a little; 0: no, it does not */
};

struct accuracy_run {
    struct scene scene; /* what it points to is the subject's */
    struct sim sim;
    double seconds, limit;          /* in sim_step(), so far; at most */
    double reached;                 /* s: how far it came */
    uint64_t evaluations, products; /* likewise */
};

/* A run's states at the subject's times. */
struct accuracy_states {
    double (*position[ACCURACY_TIMES])[4]; /* [point_count] owned */
    double volume[ACCURACY_TIMES], pressure[ACCURACY_TIMES], energy[ACCURACY_TIMES];
};

/* Why the method cannot move the scene's balloons, which a run would be refused for; NULL: it can. */
const char *accuracy_unsuited(const struct scene *scene, const struct integrator *method);

/* Those of the first run, which finds how far there is time to go: the scene's, by auto. */
struct accuracy_dials accuracy_first_dials(const struct scene *scene);

/* Errors: those of sim_open(). It must be closed in any case. */
enum status accuracy_open(struct accuracy_run *run, const struct accuracy_subject *subject,
                          const struct accuracy_dials *dials, struct error *err);
void accuracy_close(struct accuracy_run *run); /* what it counted stays */

/* One step. Errors: those of sim_step(); STATUS_RESOURCE past run->limit, STATUS_INTERRUPTED. */
enum status accuracy_step(struct accuracy_run *run, const struct accuracy_subject *subject,
                          struct error *err);

/* Steps until the time, or past it where the method can look into its steps. Errors: those of
 * accuracy_step(); STATUS_RESOURCE also where it comes on so slowly that its end is far beyond the limit. */
enum status accuracy_advance(struct accuracy_run *run, const struct accuracy_subject *subject, double time,
                             struct error *err);

enum status accuracy_states_open(struct accuracy_states *states, const struct sim *sim, struct error *err);
void accuracy_states_close(struct accuracy_states *states);

/* The largest over the times of the RMS distance of the points, each in its balloon's radius. */
double accuracy_distance(const struct sim *sim, const struct accuracy_states *a,
                         const struct accuracy_states *b);

/* Opens, goes through all the subject's times and keeps how long it took. Errors: those of accuracy_step();
 * STATUS_INPUT when something breaks before the last of them. On failure *run is closed, else the caller does
 * that. */
enum status accuracy_go(struct accuracy_run *run, const struct accuracy_subject *subject,
                        const struct accuracy_dials *dials, double limit, struct accuracy_states *states,
                        struct error *err);

#endif
