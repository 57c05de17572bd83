#include "surface/sides.h"

#include <math.h>

/* The normal distribution function. */
static double normal(double quantile)
{
    return erfc(-quantile / M_SQRT2) / 2;
}

/* Its inverse, by halving; infinite for shares that are none. */
static double quantile_of(double share)
{
    double low = -40, high = 40;
    if (!(share > 0) || !(share < 1))
        return share > 0.5 ? INFINITY : -INFINITY;
    for (int i = 0; i < 100; i++) {
        const double middle = (low + high) / 2;
        *(normal(middle) < share ? &low : &high) = middle;
    }
    return low;
}

struct sides sides_of(const struct field *field, double threshold)
{
    const struct field_lattice *volume = &field->lattice[TRACK_VOLUME];
    struct sides sides = {.threshold = threshold, .steepness = 1.000001 * field->steepness};
    double high = 0;
    for (int k = 0; k < OCTREE_MATERIALS; k++) {
        sides.low = fmin(sides.low, field->coefficient[k]);
        high = fmax(high, field->coefficient[k]);
    }
    sides.range = high - sides.low;
    if (!volume->used || volume->spacing != 0 || field->lattice[TRACK_AREA].used || !(sides.range > 0))
        return sides;
    sides.per_sigma = 1.000001 / field->sigma;
    sides.error = 3 * erfc(field->cutoff / M_SQRT2) + 1e-12;
    const double share = (threshold - sides.low) / sides.range;
    sides.below = quantile_of(share - sides.error);
    sides.above = quantile_of(share + sides.error);
    return sides;
}

bool sides_may_tell(const struct sides *sides, double radius)
{
    return sides->steepness * radius < sides->threshold ||
           (sides->per_sigma > 0 && normal(sides->below - radius * sides->per_sigma) > sides->error);
}

bool sides_tell(const struct sides *sides, double value, double radius)
{
    if (fabs(value - sides->threshold) > sides->steepness * radius)
        return true;
    if (sides->per_sigma == 0)
        return false;
    const double share = (value - sides->low) / sides->range, far = radius * sides->per_sigma;
    return value < sides->threshold ? share + sides->error < normal(sides->below - far)
                                    : share - sides->error > normal(sides->above + far);
}
