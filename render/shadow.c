/*
 * The soft shadow. A wide light above sees a skin as a cloud of small screens; its shadow is taken to be
 * the Gaussian of the same mean, covariance and amount, widened by the height above the floor.
 */
#include "render/geometry.h"

#include "common/vec3.h"

#include <string.h>

static const double spread = 0.25; /* standard deviation gained for each unit of height: the light's size */
static const double reach = 3;     /* standard deviations that are drawn */
static const double darkest = 0.8; /* share of the light from above that a skin can take at most */
static const double light_share = .5; /* of what thin skin lets through, still in its colour */

struct screens {
    double area;       /* sum of area x opacity */
    double mean[3];    /* x, height above the floor, z */
    double xx, xz, zz; /* covariance on the floor */
    double colour[3];
};

/* Adds triangle t with weight area x opacity; squares are taken from `origin`, near the skin. */
static void add_screen(struct screens *sum, const struct render_skin *skin, uint32_t t,
                       const double origin[3])
{
    const struct mesh *mesh = skin->mesh;
    const uint32_t *corner = mesh->triangle[t];
    const double *a = mesh->position[corner[0]], *b = mesh->position[corner[1]],
                 *c = mesh->position[corner[2]];
    double twice[3], at[3];
    vec3_triangle(a, b, c, twice);
    double weight = vec3_length(twice) / 2 * (skin->opacity ? fmin(fmax(skin->opacity[t], 0), 1) : 1);
    for (int i = 0; i < 3; i++) {
        at[i] = (a[i] + b[i] + c[i]) / 3 - origin[i];
        sum->mean[i] += weight * at[i];
        sum->colour[i] += weight * fmin(fmax((double)skin->colour[i], 0), 1);
    }
    sum->area += weight;
    sum->xx += weight * at[0] * at[0];
    sum->xz += weight * at[0] * at[2];
    sum->zz += weight * at[2] * at[2];
}

/* False where there is nothing to cast a shadow. */
static bool sum_screens(struct screens *sum, const double origin[3], const struct render_skin *skin)
{
    *sum = (struct screens){0};
    for (uint32_t t = 0; t < skin->mesh->triangle_count; t++)
        if (!skin->active || skin->active[t])
            add_screen(sum, skin, t, origin);
    if (!(sum->area > 0) || !isfinite(sum->area))
        return false;
    for (int i = 0; i < 3; i++) {
        sum->mean[i] /= sum->area;
        sum->colour[i] /= sum->area;
    }
    sum->xx = sum->xx / sum->area - sum->mean[0] * sum->mean[0];
    sum->xz = sum->xz / sum->area - sum->mean[0] * sum->mean[2];
    sum->zz = sum->zz / sum->area - sum->mean[2] * sum->mean[2];
    return isfinite(sum->xx) && isfinite(sum->xz) && isfinite(sum->zz);
}

/* Cholesky's factor of the covariance takes the unit square's corners to the floor. */
static void place_corners(struct geometry_shadow *shadow, const struct camera_space *space,
                          const double middle[3], const struct screens *sum)
{
    double down = sqrt(sum->xx), slant = sum->xz / down, rest = sqrt(fmax(sum->zz - slant * slant, 0));
    for (int k = 0; k < 4; k++) {
        double u = k & 1 ? reach : -reach, v = k & 2 ? reach : -reach, at[3];
        const double corner[3] = {middle[0] + down * u, middle[1], middle[2] + slant * u + rest * v};
        camera_to_space(space, corner, at);
        for (int i = 0; i < 3; i++)
            shadow->corner[k][i] = (float)at[i];
    }
}

bool geometry_cast_shadow(struct geometry_shadow *shadow, const struct camera_space *space, double height,
                          const struct render_skin *skin)
{
    struct screens sum;
    /* the target: the origin of squares must be near the skin, or their differences drown in round-off */
    double origin[3];
    for (int i = 0; i < 3; i++)
        origin[i] = space->origin[i] - space->axis[2][i] / space->scale;
    if (!isfinite(height) || !(space->origin[1] > height) || !sum_screens(&sum, origin, skin))
        return false;
    double above = fmax(sum.mean[1] + origin[1] - height, 0);
    double wider = spread * spread * above * above + 1e-12 / (space->scale * space->scale);
    sum.xx += wider;
    sum.zz += wider;
    const double middle[3] = {sum.mean[0] + origin[0], height, sum.mean[2] + origin[2]};
    place_corners(shadow, space, middle, &sum);
    /* a convex body's mean shadow is a quarter of its surface (Cauchy) */
    double depth = sum.area / 4 / (2 * M_PI * sqrt(fmax(sum.xx * sum.zz - sum.xz * sum.xz, 1e-300)));
    double taken = darkest * (1 - exp(-depth));
    for (int i = 0; i < 3; i++)
        shadow->colour[i] = (float)(1 - taken * (1 - light_share * sum.colour[i]));
    return true;
}
