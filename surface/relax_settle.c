#include "surface/relax_settle.h"

#include "common/vec3.h"

#include <math.h>
#include <string.h>

enum { NEWTON_TURNS = 60, HALVINGS = 30, SCAN_STEPS = 40, BISECTIONS = 80 };

/* Well below the 1e-9 that is promised. */
#define RESIDUAL 1e-10

static double excess_at(struct probe *probe, double threshold, const double place[3], double gradient[3])
{
    double point[3], side = probe->field->side;
    for (int axis = 0; axis < 3; axis++)
        point[axis] = place[axis] * side;
    return probe_value(probe, point, gradient) - threshold;
}

static void go(const double from[3], double distance, const double direction[3], double to[3])
{
    for (int axis = 0; axis < 3; axis++)
        to[axis] = from[axis] + distance * direction[axis];
}

static void set_normal(const double gradient[3], double normal[3])
{
    double length = vec3_length(gradient);
    for (int axis = 0; axis < 3 && length > 0; axis++)
        normal[axis] = -gradient[axis] / length;
}

/* Newton's method along the gradient, each step halved until |f - T| falls. */
static double descend(struct probe *probe, double threshold, double reach, double place[3], double normal[3])
{
    double gradient[3], excess = excess_at(probe, threshold, place, gradient);
    for (int turn = 0; turn < NEWTON_TURNS && fabs(excess) > RESIDUAL; turn++) {
        double length = vec3_length(gradient), there[3], slope[3], next = excess;
        if (!(length > 0))
            break;
        double step = copysign(fmin(fabs(excess) / (length * probe->field->side), reach / 4), excess);
        set_normal(gradient, normal);
        for (int half = 0; half < HALVINGS; half++, step /= 2) {
            go(place, step, normal, there);
            next = excess_at(probe, threshold, there, slope);
            if (fabs(next) < fabs(excess))
                break;
        }
        if (!(fabs(next) < fabs(excess)))
            break;
        memcpy(place, there, sizeof there);
        memcpy(gradient, slope, sizeof slope);
        excess = next;
    }
    set_normal(gradient, normal);
    return excess;
}

/* The nearest change of sign along the normal, either way, within reach; closed in by bisection. */
static double search(struct probe *probe, double threshold, double reach, double excess, double place[3],
                     double normal[3])
{
    double there[3], gradient[3], low = 0, high = 0;
    for (int i = 1; i <= 2 * SCAN_STEPS && high == 0; i++) {
        double step = reach * (i / 2 + i % 2) / SCAN_STEPS * (i % 2 ? 1 : -1);
        go(place, step, normal, there);
        if (signbit(excess_at(probe, threshold, there, gradient)) != signbit(excess))
            high = step;
    }
    if (high == 0)
        return excess;
    double last = excess;
    for (int turn = 0; turn < BISECTIONS && fabs(last) > RESIDUAL; turn++) {
        double middle = (low + high) / 2;
        go(place, middle, normal, there);
        last = excess_at(probe, threshold, there, gradient);
        *(signbit(last) == signbit(excess) ? &low : &high) = middle;
    }
    memcpy(place, there, sizeof there);
    set_normal(gradient, normal);
    return last;
}

double relax_settle(struct probe *probe, double threshold, double reach, double place[3], double normal[3])
{
    double excess = descend(probe, threshold, reach, place, normal);
    if (fabs(excess) > RESIDUAL)
        excess = search(probe, threshold, reach, excess, place, normal);
    return fabs(excess);
}
