/*
 * What no point carries and yet moves as points do, such as a weight on a string: of sim->scalar, three are a
 * body's place, whose rates are the three of its speed. Methods know them apart, since to most of them places
 * and speeds are not alike.
 */
#ifndef SIM_BODIES_H
#define SIM_BODIES_H

#include "sim/sim.h"

enum { SIM_BODY_SCALARS = 6 };

/* The first of its scalars. */
struct sim_body {
    uint32_t place, speed;
};

/* As sim_add_scalars(): place, and then speed. */
enum status sim_add_body(struct sim *sim, uint32_t *first, struct error *err);

/* Whether that scalar is a body's. */
bool sim_is_of_body(const struct sim *sim, uint32_t scalar);

/* A body's place goes on over dt by its speed, and by dt/2 of its `rate` (NULL: none); and the scalars' own
 * rates leave it where it is. */
void sim_drift_bodies(struct sim *sim, double dt, const double *rate);
void sim_hold_bodies(const struct sim *sim, double *rate);

#endif
