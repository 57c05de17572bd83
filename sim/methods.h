/* The integrators, a file each or a family a file; integrators.c lists them. */
#ifndef SIM_METHODS_H
#define SIM_METHODS_H

#include "sim/sim.h"

extern const struct integrator integrator_symplectic_euler; /* euler.c */
extern const struct integrator integrator_explicit_euler;
extern const struct integrator integrator_verlet;      /* verlet.c */
extern const struct integrator integrator_rk4;         /* runge_kutta.c */
extern const struct integrator integrator_rk_adaptive; /* rk_adaptive.c */
extern const struct integrator integrator_rkn4;        /* rkn4.c */
extern const struct integrator integrator_cvode_adams; /* cvode.c, or no_cvode.c without the library */
extern const struct integrator integrator_cvode_bdf;
extern const struct integrator integrator_backward_euler; /* implicit_methods.c */
extern const struct integrator integrator_implicit_midpoint;
extern const struct integrator integrator_bdf2;
extern const struct integrator integrator_xpbd; /* xpbd.c */
extern const struct integrator integrator_auto; /* auto.c */

#endif
