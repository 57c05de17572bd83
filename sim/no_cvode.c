/* In the place of cvode.c where SUNDIALS is not installed: the names exist, and say what they need. */
#include "sim/methods.h"

#include <math.h>

static enum status open(struct sim *sim, struct error *err)
{
    return error_set(
        err, STATUS_RESOURCE,
        "time.integrator = \"%s\": this program was built without SUNDIALS CVODE; install the package "
        "libsundials-dev and build again, or use \"%s\"",
        sim->integrator->name, sim->integrator == &integrator_cvode_bdf ? "bdf2" : "rk-adaptive");
}

static enum status advance(struct sim *sim, double longest, struct error *err)
{
    (void)longest;
    return open(sim, err);
}

#define MISSING(method, of_order)                                                                       \
    {                                                                                                   \
        .name = method, .order = of_order, .flags = INTEGRATOR_ADAPTIVE, .oscillation_limit = INFINITY, \
        .decay_limit = INFINITY, .open = open, .advance = advance,                                      \
        .source = "SUNDIALS CVODE (not installed: libsundials-dev)"                                     \
    }
const struct integrator integrator_cvode_adams = MISSING("cvode-adams", 12);
const struct integrator integrator_cvode_bdf = MISSING("cvode-bdf", 5);
