/* A balloon that implicit methods move in long steps. */
#ifndef TESTS_UNIT_IMPLICIT_H
#define TESTS_UNIT_IMPLICIT_H

#include "balloon.h"

static const char *const implicit_names[] = {"backward-euler", "implicit-midpoint", "bdf2", "xpbd"};
enum { IMPLICIT_COUNT = sizeof implicit_names / sizeof implicit_names[0] };

/* A balloon under a pressure that it bears, by this method in steps of `step`. Nothing breaks. */
static inline void open_with(struct balloon *b, const char *name, double step, const char *const *changes)
{
    char integrator[64], step_text[64];
    const char *all[24] = {integrator, step_text, "time.guard=off", "balloons[0].threshold=100"};
    size_t count = 4;
    snprintf(integrator, sizeof integrator, "time.integrator=%s", name);
    snprintf(step_text, sizeof step_text, "time.step=%.17g", step);
    for (; *changes; changes++)
        all[count++] = *changes;
    open_balloon(b, 2, all);
}

#endif
