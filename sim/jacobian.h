/*
 * Exact derivatives of the forces, as products with a direction: what implicit methods solve with.
 *
 *     if (sim_jacobian_open(sim, err)) ...                    in an integrator's open
 *     sim_linearise(sim);                                     at the current state, whenever it has moved far enough
 *     sim_force_product(sim, a, dx, b, dv, df);               df = a K dx + b D dv, as often as needed
 *     sim_jacobian_close(sim);                                in its close
 *
 * K is the derivative of sim->force by the positions, D that by the velocities: of springs (with the
 * geometric term: a stretched spring also resists being turned), of dampers (their dependence on position
 * too) and of the paper's pressure along unit normals, which makes K unsymmetric. What is broken or torn when
 * sim_linearise() is called is left out. Effects that have forces add theirs (struct effect, product), at the
 * state as it then is: leave it where it was linearised.
 *
 * Products are equal to the bit for any number of threads.
 */
#ifndef SIM_JACOBIAN_H
#define SIM_JACOBIAN_H

#include "sim/sim.h"

struct sim_jacobian;

/* Makes sim->jacobian, empty: 64 bytes an edge and a point, 32 a triangle. Errors: STATUS_NO_MEMORY;
 * close it all the same. */
enum status sim_jacobian_open(struct sim *sim, struct error *err);
void sim_jacobian_close(struct sim *sim); /* fine when there is none */

/* Takes the derivatives at the current positions and velocities. Needs no forces. */
void sim_linearise(struct sim *sim);

/* df = a K dx + b D dv. dx, dv, df are rows of [point_count] aligned to 32 bytes, the fourth numbers 0; dx
 * and dv are only read and may be the same rows, df is neither. */
void sim_force_product(struct sim *sim, double a, double (*dx)[4], double b, double (*dv)[4],
                       double (*df)[4]);

/* The 3x3 diagonal blocks of M - a K - b D, M the masses, without the shares of effects, but
 * with a membrane's stand-ins (membrane.h): block[p][i][j], the fourth numbers 0.
 * [point_count], aligned to 32 bytes. */
void sim_diagonal_blocks(struct sim *sim, double a, double b, double (*block)[3][4]);

#endif
