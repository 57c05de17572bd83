/*
 * What no point carries and yet moves as points do, such as a weight on a string: of sim->scalar, three are a
 * body's place, whose rates are the three of its speed. Methods know them apart, since to most of them places
 * and speeds are not alike.
 */
#ifndef SIM_BODIES_H
#define SIM_BODIES_H

#include "sim/sim.h"

struct sim_body {
    uint32_t first;                    /* of its scalars */
    const struct sim_balloon *balloon; /* that it belongs to */
};

/* Where they are from its first on. */
enum { SIM_BODY_PLACE = 0, SIM_BODY_SPEED = 3, SIM_BODY_SCALARS = 6 };

/* As sim_add_scalars(), for a balloon. */
enum status sim_add_body(struct sim *sim, const struct sim_balloon *balloon, uint32_t *first,
                         struct error *err);

/* The body that a scalar is of; NULL: none. */
const struct sim_body *sim_body_of(const struct sim *sim, uint32_t scalar);

/* A body's place goes on over dt by its speed, and by dt/2 of its `rate` (NULL: none); and the scalars' own
 * rates leave it where it is. */
void sim_drift_bodies(struct sim *sim, double dt, const double *rate);
void sim_hold_bodies(const struct sim *sim, double *rate);

/* All scalars go on over dt by their rates, and then bodies by the speeds that they have by now: as velocity
 * first, and then positions. */
void sim_advance_scalars(struct sim *sim, double dt);

#endif
