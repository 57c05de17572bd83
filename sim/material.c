/* "As the surface of the balloon stretches, it should look shinier and it should get more
 * translucent" (paper 3.3). */
#include "sim/material.h"

#include <math.h>

double sim_triangle_stretch(const struct sim *sim, uint32_t triangle)
{
    double length = 0, rest = 0;
    for (int k = 0; k < 3; k++) {
        length += sim_edge_length(sim, sim->triangle_edge[triangle][k]);
        rest += sim->rest_length[sim->triangle_edge[triangle][k]];
    }
    return rest > 0 ? length / rest : 1;
}

/* Rubber keeps its volume, so at a stretch L the film thins as 1/L^2, and by the law of Beer and Lambert its
 * transmittance 1 - opacity becomes the rest's to the power 1/L^2. The highlight's exponent grows as L^4: the
 * bumps of the skin flatten. */
void sim_material(const struct sim *sim, float *opacity, float *shininess)
{
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const struct scene_balloon *skin = sim_balloon_of(sim, t)->scene;
        const double stretch = fmax(sim_triangle_stretch(sim, t), 1);
        opacity[t] = (float)(1 - pow(1 - skin->opacity, 1 / (stretch * stretch)));
        shininess[t] = (float)fmin(skin->shininess * pow(stretch, 4), 1000);
    }
}
