/*
 * A row of sim->position, velocity, force ... as one vector of GCC's and clang's: arithmetic on it reads as
 * on paper and runs as wide as the machine allows. The fourth number is 0 and stays so.
 *
 *     row *velocity = (row *)sim->velocity;
 *     velocity[p] += force[p] * (dt / mass[p]);
 */
#ifndef SIM_ROWS_H
#define SIM_ROWS_H

typedef double row __attribute__((vector_size(4 * sizeof(double)), may_alias));

#endif
