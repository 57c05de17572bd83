#include "sim/kernels.h"
#include "sim/bending_kernels.h"
#include "sim/instructions.h"

extern const struct sim_kernels kernels_plain, kernels_avx2;

const struct sim_kernels *kernels_find(void)
{
    return FOR_THIS_MACHINE(kernels);
}

void kernels_press(const struct sim_kernels *k, struct sim *sim, const struct sim_part *part,
                   const struct sim_chunk *chunk)
{
    const struct sim_balloon *b = part->balloon;
    const bool has_normals = b->bending && b->bending->kernels->triangles(sim, part, chunk);
    if (b->by_area && !has_normals)
        k->triangle_areas(sim, part, chunk);
    else if (!has_normals)
        k->triangle_normals(sim, part, chunk);
    if (!b->by_area)
        k->pressure_forces(sim, part, chunk);
}
