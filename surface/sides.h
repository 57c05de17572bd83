/*
 * Proofs that a ball is on one side of the threshold, from the field's value in its middle.
 *
 *     struct sides sides = sides_of(&field, threshold);
 *     if (sides_may_tell(&sides, radius) && sides_tell(&sides, value, radius)) ...
 *
 * Over a radius d the field changes by at most its steepness times d. Of exact fields more is known: a
 * function between 0 and 1, convolved with a Gaussian of deviation s, has |grad F| <= phi(q) / s, where q
 * with Phi(q) = F is the normal distribution's quantile (Bakry and Ledoux, "Levy-Gromov's isoperimetric
 * inequality for an infinite dimensional diffusion generator", Inventiones Mathematicae 123, 1996), as a half
 * space has it. So q changes by at most d / s: where the field is small, as it all is where sigma is wide for
 * a sculpture, it is hardly steep.
 */
#ifndef SURFACE_SIDES_H
#define SURFACE_SIDES_H

#include "surface/field.h"

struct sides {
    double threshold, steepness;
    double per_sigma;    /* 1/s, per cell; 0 where the field is not exact, and the rest is not used */
    double low, range;   /* what is convolved lies between low and low + range */
    double error;        /* of the field, by cutting Gaussians off and by rounding, over the range */
    double below, above; /* quantiles of the threshold, less and more by the error */
};

/* All are of the field, which is only looked at; radii are in cells. */
struct sides sides_of(const struct field *field, double threshold);

/* Whether some value would tell; from outside, since of the inside more is known by other means. */
bool sides_may_tell(const struct sides *sides, double radius);

/* Whether all points no further than the radius from one with this value are on its side. */
bool sides_tell(const struct sides *sides, double value, double radius);

#endif
