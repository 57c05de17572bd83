/*
 * Two features of a skin that move in straight lines over a step: a point and a triangle, or two edges. Do
 * they come nearer than a gap, and when? Four points each: the point and the triangle's corners, or the ends
 * of one edge and of the other.
 *
 *     struct ccd_touch touch;
 *     if (ccd_distance(CCD_EDGES, from, &touch) > gap &&
 *         ccd_meet(CCD_EDGES, from, to, gap, &touch)) ...        at touch.time hardly further apart than the gap
 *
 * Conservative advancement: features whose distance is d, and that move by no more than l against each other
 * over the step, do not touch before d/l of it has gone. Steps of that length end in front of the touch,
 * whatever the geometry: no polynomial is solved, and features that are parallel or degenerate are no special
 * case (Li, Kaufman & Jiang, "Codimensional incremental potential contact", ACM TOG 40 (2021), section 4.2).
 */
#ifndef SIM_CCD_H
#define SIM_CCD_H

#include <stdbool.h>

enum ccd_kind { CCD_POINT_TRIANGLE, CCD_EDGES };

/* sum over i of weight[i] x[i] is the way from the nearest place of the second feature to that of the first;
 * normal its direction, distance its length. */
struct ccd_touch {
    double time; /* 0 to 1 over the step */
    double weight[4], normal[3], distance;
};

/* The distance of the two features, with the weights and the normal at it (0 where the distance is 0). */
double ccd_distance(enum ccd_kind kind, double x[4][3], struct ccd_touch *touch);

/* Whether they come as near as `gap`, which must be below their distance at `from`, on straight ways from
 * `from` to `to`. *touch is at first what ccd_distance() says of `from`. */
bool ccd_meet(enum ccd_kind kind, double from[4][3], double to[4][3], double gap, struct ccd_touch *touch);

/* How far one feature can come towards the other on those ways, at most. */
double ccd_approach(enum ccd_kind kind, double from[4][3], double to[4][3]);

/* How far apart they are, at other places x, along the normal of `touch`: no more than their distance there.
 * On straight ways it is never below what lies in between its values at the two ends. */
double ccd_apart(enum ccd_kind kind, const struct ccd_touch *touch, double x[4][3]);

#endif
