/* The inner loops of hinges (bending.h), compiled once for each set of instructions like those of the springs
 * (kernels.h); all give the same bits. */
#ifndef SIM_BENDING_KERNELS_H
#define SIM_BENDING_KERNELS_H

#include "sim/bending.h"
#include "sim/jacobian_kernels.h"

/* What the hinges together hold, and what their damping takes a second. */
struct bending_sums {
    double energy, power;
};

struct bending_kernels {
    /* The forces, in three passes over all parts (bending_passes.h): of the part's triangles, chunk by chunk;
     * of its hinges, `crushed` where the first found any part's to be so; and what is added to the forces on
     * its points. The first is true where it has added the triangles' normals to their points' too, as the
     * step asks for (kernels.h). */
    bool (*triangles)(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk);
    void (*hinges)(struct sim *sim, const struct sim_part *part, bool crushed);
    void (*forces)(struct sim *sim, const struct sim_part *part, bool crushed);
    /* Adds a K dx + b D dv to the part's rows of product->out. */
    void (*product)(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product);
    /* Of the edges from begin to end. */
    struct bending_sums (*sums)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t begin,
                                uint32_t end);
};

#endif
