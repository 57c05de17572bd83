/* The methods that move the points: a line each. */
#include "sim/methods.h"

#include <string.h>

const struct integrator *const integrators[] = {
    &integrator_symplectic_euler,
    &integrator_explicit_euler,
    &integrator_verlet,
    &integrator_rk4,
    &integrator_rkn4,
    &integrator_rk_adaptive,
    &integrator_backward_euler,
    &integrator_implicit_midpoint,
    &integrator_bdf2,
    &integrator_xpbd,
    &integrator_cvode_adams,
    &integrator_cvode_bdf,
    &integrator_auto,
    NULL,
};

const struct integrator *integrator_find(const char *name)
{
    for (size_t i = 0; integrators[i]; i++)
        if (!strcmp(integrators[i]->name, name))
            return integrators[i];
    return NULL;
}
