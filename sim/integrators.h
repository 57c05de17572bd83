/* The methods that a scene can name (integrators.c). */
#ifndef SIM_INTEGRATORS_H
#define SIM_INTEGRATORS_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>

struct sim;
struct sim_block;

/* A method that moves the points over one step of dt (integrators.c). It starts from sim->position, velocity
 * and scalar and leaves the new ones there; it asks sim_forces() as often as its order needs, at trial states
 * if need be; nothing breaks meanwhile. */
struct integrator {
    const char *name;
    int order;       /* of the error in position at a fixed time */
    unsigned flags;  /* enum integrator_flags */
    int evaluations; /* of sim_forces() a step; 0: it depends */
    int vectors;     /* of sim->scratch that it needs */
    /* The largest stable step: dt times the angular frequency of an undamped oscillator, and dt times the
     * rate of a pure decay. INFINITY where any step is stable. */
    double oscillation_limit, decay_limit;
    /* Where any step is stable with springs and dampers only: both of these, of what
     * effects add. 0: the same. */
    double outer_limit;
    enum status (*open)(struct sim *sim,
                        struct error *err); /* makes sim->method, all zero before; NULL: nothing to make */
    void (*close)(struct sim *sim);         /* NULL: nothing to free */
    /* Before each step, `first` where it is the first of one of the scene's: which method acts,
     * and in how many substeps at the least. False: sim->goes_on said no, and nothing is chosen.
     * NULL: this one, in one. */
    bool (*choose)(struct sim *sim, bool first);
    enum status (*advance)(struct sim *sim, double dt, struct error *err);
    /* What it remembers from step to step, as blocks; returns how many. NULL: nothing. */
    size_t (*blocks)(struct sim *sim, struct sim_block *blocks);
    /* Whether those blocks, filled with anything, can be gone on with: asked where a state comes out of
     * a file. NULL: any can. */
    bool (*is_sound)(const struct sim *sim);
    /* Sets position, velocity and scalar to what they were `back` seconds ago, 0 to sim->taken:
     * inside the step that was taken last, by an interpolation as good as the method. NULL: states
     * between steps cannot be had. */
    void (*look)(struct sim *sim, double back);
    const char *source;
};
enum integrator_flags {
    INTEGRATOR_IMPLICIT = 1,   /* solves equations at each step */
    INTEGRATOR_SYMPLECTIC = 2, /* keeps the energy of an undamped system bounded at fixed steps */
    INTEGRATOR_ADAPTIVE = 4,   /* chooses its own steps within dt from time.tolerance */
    INTEGRATOR_ONE_SWEEP =
        8, /* its sweep (sweep.h) moves the points all the way of a step, at their new speeds */
    INTEGRATOR_SPRINGS_ONLY = 16, /* neither membranes nor bending skins: scenes that say so are refused */
};
extern const struct integrator *const integrators[]; /* NULL-terminated */
const struct integrator *integrator_find(const char *name);

#endif
