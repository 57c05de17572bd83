/*
 * The ledger: where the energy comes from and where it goes.
 *
 *     if (ledger_open(&sim, err)) ...            after sim_open(), at the state to count from
 *     if (sim_step(&sim, err)) ...
 *     struct sim_measures m = sim_measure(&sim);
 *     struct ledger_balance b = ledger_balance(&sim, &m);
 *
 * What moves energy while the points move (the pressure's work, what the dampers take) has a rate, and is
 * integrated as a scalar by the same method as the points; what moves it at one moment (an edge lets go, the
 * user changes a spring) is counted then, exactly. So
 *     kinetic + elastic + gas + dissipated + fracture = what there was at the start + pressure's + user's work + error
 * where the error is the method's own, and falls with its order. Without ledger_open() none of it is
 * computed; with it no bit of the state is another.
 */
#ifndef SIM_LEDGER_H
#define SIM_LEDGER_H

#include "sim/sim.h"

/* The ledger's scalars, from sim->ledger.first on. */
enum { LEDGER_PRESSURE, LEDGER_DISSIPATED, LEDGER_SCALARS };

/* Opens the accounts at the present state; fine when they are open. Errors: STATUS_NO_MEMORY. */
enum status ledger_open(struct sim *sim, struct error *err);

/* Frees what it has; fine when it was never opened. */
void ledger_close(struct sim *sim);

/* Counts from the present state on, all accounts at 0. */
void ledger_begin(struct sim *sim);

/* Sets the rates of the ledger's scalars at the current state; sim->normal must be of that
 * state. For sim_forces(). */
void ledger_rates(struct sim *sim);

/* sim_forces() that a method asks for only so that the rates of the accounts are those of the current state:
 * what effects go by at the end of the step (struct effect: left) stays as the forces before left it. */
void ledger_forces(struct sim *sim);

/* Energy of the active springs from edge begin to end: k_s (|l| - r)^2 / 2 each. */
double ledger_elastic(const struct sim *sim, uint32_t begin, uint32_t end);

/* For what moves points at once, obstacles and contact: notes what there is, once, just before they do; and
 * books what that has taken, or nothing where none of it came about. While nothing is noted nothing is worked
 * out. */
void ledger_note(struct sim *sim);
void ledger_book(struct sim *sim, bool moved);

/* All in the unit of force x length. */
struct ledger_balance {
    double gas;        /* held by gas, and by what else effects hold; 0 where the pressure is given */
    double dissipated; /* by dampers, obstacles and contact, and what got out with the gas */
    /* That springs and triangles held when they let go. A tear (topology.h) takes nothing from the skin: what
     * a crack releases moves the skin around it, and is taken by the dampers there; what its toughness asks
     * for is sim_measures.crack_energy. */
    double fracture;
    double pressure_work; /* by the pressure on the points, and by what else effects bring */
    double user_work;     /* by changes of springs in the schedule */
    double error;         /* what there is and went, less what there was and came */
};

/* measures are those of the present state. All 0 when no ledger is open. */
struct ledger_balance ledger_balance(struct sim *sim, const struct sim_measures *measures);

#endif
