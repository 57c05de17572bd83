/* The inner loops of the preconditioner (solver.h), compiled once for each set of instructions like those of
 * the forces (kernels.h); all give the same bits. */
#ifndef SIM_SOLVER_KERNELS_H
#define SIM_SOLVER_KERNELS_H

#include "sim/solver.h"

/* Each works on the points from begin to end, as if no edge went from there to others. */
struct solver_kernels {
    /* Sets solver->coupling of the links of these points, at the derivatives as they were taken last. */
    void (*couple)(const struct sim *sim, struct solver *solver, uint32_t begin, uint32_t end);
    /* The blocks of D, in solver->inverse, which are the system's diagonal when it begins, to their
     * inverses, column by column. */
    void (*factor)(const struct sim *sim, struct solver *solver, uint32_t begin, uint32_t end);
    /* y = P x, which may be the same rows. */
    void (*precondition)(const struct solver *solver, uint32_t begin, uint32_t end, double (*x)[4],
                         double (*y)[4]);
};

#endif
