/* From a skin's stretch to what its film does to light. Rubber keeps its volume: thickness is that at rest
 * over the area stretch. */
#include "render/geometry.h"

#include "common/random.h"
#include "common/vec3.h"

#include <string.h>

const float latex_rim = 2.2f;
const float latex_opaque = 4; /* exp(-2 x 4): less than a tenth of 1/255 */

static const double scattering = 2;

/* The optical depth (over K + S, as in the shader) at which the skin lets 1 - opacity of white light's
 * luminance pass (ITU-R BT.709), by halving: what passes falls with depth. */
static double film_of(const struct render_skin *skin)
{
    static const double luminance[3] = {0.2126, 0.7152, 0.0722};
    double low = 0, high = 64;
    if (skin->rest_opacity >= 1)
        return 1e4;
    for (int step = 0; step < 40; step++) {
        double middle = (low + high) / 2, passes = 0;
        for (int i = 0; i < 3; i++) {
            double thick = 0.1 + 0.9 * fmin(fmax((double)skin->colour[i], 0), 1);
            double absorption = scattering * (1 - thick) * (1 - thick) / (2 * thick) + 0.01;
            passes += luminance[i] * exp(-(absorption + scattering) * middle);
        }
        if (passes > 1 - (double)skin->rest_opacity)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* A point's number spread over 64 bits: sums of unequal ones do not vanish by chance. */
static uint64_t spread(uint64_t number)
{
    return random_mix((number + 1) * RANDOM_STEP);
}

/* Adds a triangle to its corners' fans and returns its area. */
static double add_to_fans(const struct mesh *mesh, uint32_t t, struct geometry_fan *fans)
{
    const uint32_t *corner = mesh->triangle[t];
    for (int k = 0; k < 3; k++) {
        const uint32_t next = corner[(k + 1) % 3], last = corner[(k + 2) % 3];
        struct geometry_fan *fan = &fans[corner[k]];
        fan->numbers += spread(next) - spread(last);
        for (int i = 0; i < 3; i++)
            fan->places[i] += (float)(mesh->position[next][i] - mesh->position[last][i]);
    }
    double twice[3];
    vec3_triangle(mesh->position[corner[0]], mesh->position[corner[1]], mesh->position[corner[2]], twice);
    return vec3_length(twice) / 2;
}

/* A skin counts as closed while its rims, as one circle, would be a small part of its surface. */
void latex_measure(struct geometry_latex *latex, const struct render_skin *skin, struct geometry_fan *fans)
{
    const struct mesh *mesh = skin->mesh;
    double area = 0, rim = 0;
    memset(fans, 0, mesh->point_count * sizeof *fans);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (!skin->active || skin->active[t])
            area += add_to_fans(mesh, t, fans);
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        const float *along = fans[p].places;
        if (latex_is_rim(&fans[p]))
            rim += 0.5 * hypot(hypot((double)along[0], (double)along[1]), (double)along[2]);
    }
    const double hole = rim * rim / (4 * M_PI);
    *latex = (struct geometry_latex){
        .film = (float)film_of(skin),
        /* of a Beckmann surface and a Phong lobe that spread alike: Walter et al., "Microfacet models for
         * refraction through rough surfaces" (2007) */
        .roughness = sqrtf(2 / (fminf(fmaxf(skin->rest_shininess, 0), 10000) + 2)),
        .closed = area > 0 && isfinite(hole / area) ? (float)exp(-12 * hole / area) : 0,
    };
}

/* Folded rubber is no thicker than it was; what flew apart is no longer rubber. */
static float limited(float stretch)
{
    return fminf(fmaxf(stretch, 0.4f), 64);
}

float latex_film(const struct geometry_latex *latex, float stretch)
{
    return latex->film / limited(stretch);
}

/* The bumps of the skin flatten. */
float latex_roughness(const struct geometry_latex *latex, float stretch)
{
    return latex->roughness * powf(fmaxf(limited(stretch), 1), -1.5f);
}

bool latex_is_rim(const struct geometry_fan *fan)
{
    return fan->numbers != 0;
}
