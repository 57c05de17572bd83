/*
 * Pressure on areas: what pushes is c + d . x at the place x, and a point gets (c + d . x) A/3, A the sum of
 * the area vectors of its triangles; of a pressure that is alike everywhere that is exactly the derivative of
 * its work p V. The kernels leave twice A, not normalised, in sim->normal of balloons that are pressed so
 * (sim_balloon.by_area).
 *
 *     const double volume = areas_volume(sim, balloon, NULL, origin);       after part 3 of a step
 *     areas_push(sim, balloon, NULL, &(struct areas_pressure){c, {d[0], d[1], d[2]}});
 *
 * `held` is NULL, or [points of the balloon]: 0 for those of pieces that have fallen off, which do not count.
 *
 * All is shared out among the workers, and equal to the bit for any number of them.
 */
#ifndef SIM_AREAS_H
#define SIM_AREAS_H

#include "sim/sim.h"

struct areas_pressure {
    double constant;
    double gradient[4]; /* the fourth 0 */
};

/* The signed volume of the cones from `origin` (x, y, z, 0) to the active triangles: that of the
 * balloon where it is closed. */
double areas_volume(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                    const double origin[4]);

/* The moment of that volume along a vector that is not 0: the integral of along . (x - origin). */
double areas_moment(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                    const double origin[4], const double along[3]);

/* Adds the pressure's forces to sim->force. */
void areas_push(struct sim *sim, const struct sim_balloon *balloon, const unsigned char *held,
                const struct areas_pressure *pressure);

/* That volume, and by how much it changes as points move by dx, from positions alone. The change is
 * exact of a closed surface. And, where `along` is not NULL, its moment, and by how much that changes. */
struct areas_change {
    double volume, change;
    double moment, moment_change;
};
struct areas_change areas_change(const struct sim *sim, const struct sim_balloon *balloon,
                                 const double origin[4], const double along[3], const unsigned char *held,
                                 double (*dx)[4]);

/* df += a times the change of the forces as points move by dx and the pressure changes by
 * `change`; from positions alone. */
void areas_product(struct sim *sim, const struct sim_balloon *balloon, const struct areas_pressure *pressure,
                   const struct areas_pressure *change, const unsigned char *held, double a, double (*dx)[4],
                   double (*df)[4]);

/* Of a triangle as its points are now; 0 where it is not active. */
double areas_size(const struct sim *sim, uint32_t triangle);

/* Adds to rows (guard.h), from positions alone, how stiff a pressure of that size is: dF/dx at a corner of a
 * triangle is p/6 times a side, crossed. */
void areas_bound(const struct sim *sim, const struct sim_balloon *balloon, double pressure,
                 const struct guard_rows *rows);

#endif
