/* How two features come too near each other on their ways over a step. */
#ifndef SIM_CONTACT_APPROACH_H
#define SIM_CONTACT_APPROACH_H

#include "sim/contact.h"

/* Ways that a pair may go, and how near. */
struct contact_approach {
    const uint32_t *p; /* its four points */
    double from[4][3], to[4][3];
    double distance; /* at the start */
    struct ccd_touch touch;
};

/* contact_look.c: whether a pair comes nearer, at any time of the step, than half of what it
 * must keep; how, into *a. */
bool contact_approaches(const struct sim *sim, const struct contact_pair *pair, struct contact_approach *a);

#endif
