/* What CVODE solves its equations with (cvode.c): a fixed point, or Newton with GMRES on
 * exact Jacobian products. */
#ifndef SIM_CVODE_SOLVER_H
#define SIM_CVODE_SOLVER_H

#include "sim/sim.h"

#include <nvector/nvector_serial.h>

/* In sim->scratch: the start of cvode.c's run, and three that this works with. */
enum { CVODE_DX = 2, CVODE_DV, CVODE_DF, CVODE_VECTORS };

struct cvode_solver;

/* That of a sim whose method is CVODE (cvode.c). */
struct cvode_solver *cvode_solver_of(const struct sim *sim);

/* A vector begins with a row of four for each position; rows for the velocities follow. */
static inline double (*cvode_rows(N_Vector y))[4]
{
    return (double(*)[4])(void *)NV_DATA_S(y);
}

/* The sim's positions and velocities become those of y. */
void cvode_load_points(struct sim *sim, N_Vector y);

/* Gives `memory` (a CVODE with sim as its user data) its solver. False when memory is not enough;
 * close *solver all the same. */
bool cvode_solver_open(struct sim *sim, void *memory, N_Vector y, SUNContext context, bool newton,
                       struct cvode_solver **solver);
void cvode_solver_close(struct sim *sim, struct cvode_solver *solver); /* after CVodeFree(); NULL is fine */

#endif
