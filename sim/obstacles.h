/*
 * What stands in the way of points: a half-space, spheres, boxes. No point ends a step inside one, however
 * fast it is: its whole way over the step is looked at, and where the way enters, the rest of it goes on
 * along the surface, with Coulomb's friction.
 */
#ifndef SIM_OBSTACLES_H
#define SIM_OBSTACLES_H

#include "sim/sim.h"

enum obstacle_kind { OBSTACLE_PLANE, OBSTACLE_SPHERE, OBSTACLE_BOX };

struct obstacle {
    enum obstacle_kind kind;
    double place[3];  /* on the plane, or the middle */
    double normal[3]; /* unit, of a plane */
    double radius;    /* of a sphere */
    double half[3];   /* of a box's size */
    double friction, bounce;
};

struct obstacles {
    struct obstacle *items; /* [count] owned */
    size_t count;
    double margin; /* at which points are left in front of a surface, so that rounding leaves them outside */
    double room;   /* how far any point may move before it can meet something; state */
    struct obstacles_found {
        uint32_t touched; /* points that were turned in the last step */
        double box[2][4]; /* of all their ways in it */
    } * found;            /* [part_count] owned */
};

/* How far the obstacle is at the least from anything in a box, which is its smallest and largest coordinates,
 * less what rounding may make of it; 0 or less: it may meet it. */
double obstacle_gap(const struct obstacle *o, double box[2][4]);

/* Whether the place is inside. */
bool obstacle_holds(const struct obstacle *o, const double x[3]);

/* Where on the way from a, outside, to b it enters: 0 to 1, with the outward normal there;
 * INFINITY where it does not. */
double obstacle_entry(const struct obstacle *o, const double a[3], const double b[3], double normal[3]);

/* Takes the way of one point from `from` to x, and its velocity, around everything. True
 * when it met something. */
bool obstacles_turn(const struct obstacles *obstacles, const double from[3], double x[3], double velocity[3]);

/* All points, after a step from sim->before. True when one met something. */
bool obstacles_settle(struct sim *sim);

#endif
