/* The last step of a relaxation: for relax.c. */
#ifndef SURFACE_RELAX_SETTLE_H
#define SURFACE_RELAX_SETTLE_H

#include "surface/probe.h"

/* Brings a point near the surface f = T onto it, and its normal to what the field says there.
 * place is in units of the first cube, as is reach: how far to look where Newton's method finds
 * no way. Returns |f - T|. */
double relax_settle(struct probe *probe, double threshold, double reach, double place[3], double normal[3]);

#endif
