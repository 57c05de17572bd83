/* The inner loops of membranes (membrane.h), compiled once for each set of instructions like those of the
 * springs (kernels.h); all give the same bits. */
#ifndef SIM_MEMBRANE_KERNELS_H
#define SIM_MEMBRANE_KERNELS_H

#include "sim/jacobian_kernels.h"
#include "sim/membrane.h"

/* W(a, D) over mu and its derivatives. */
struct membrane_response {
    double energy, a, d, aa, ad, dd;
};

struct membrane_kernels {
    /* Add the membrane's forces to those of the part's points: of triangles of lower
     * parts; of a chunk's own. */
    void (*coming_forces)(struct sim *sim, const struct sim_part *part);
    void (*forces)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    /* Adds a K dx + b D dv to the part's rows of product->out. */
    void (*product)(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product);
    /* Sum of what the active triangles from begin to end hold; each over its mu V in each[0 ..]
     * where that is not NULL. */
    double (*energy)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin, uint32_t end,
                     double *each);
    /* And of what their damping takes. */
    double (*dissipation)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin,
                          uint32_t end);
    /* Of one state. */
    struct membrane_response (*respond)(const struct membrane_law *law, double a, double d, double gap);
};

/* The table for this machine. */
const struct membrane_kernels *membrane_kernels_find(void);

#endif
