/*
 * How a balloon's triangles hang together, and how they come apart: the skin is cut along edges. Points are
 * doubled where a cut goes through them; no triangle is lost, nor any mass, area at rest or momentum.
 *
 *     balloon->topology                                    made by topology_open() where a scene tears (fracture)
 *     if (topology_can_cut(sim, balloon)) ...              room is left
 *     topology_cut(sim, balloon, triangle, side);          cut the edge from corner `side` to the next
 *
 * A cut of an edge inside the skin makes a slit, at an end that lies on a rim it splits the point: of
 * the triangles around it those on the neighbour's side get a new point, which takes its share of the
 * mass, by area at rest of a membrane or else by number, and has the same place and speed. No point is
 * ever left with two fans of triangles. The neighbour gets an edge of its own; each of the two springs
 * keeps half the stiffness.
 *
 * How it fits parts and chunks (parts.c). Points and edges have room behind point_end and edge_end, which
 * move up. What is new is worked on by a part of its own, the balloon's last; edges and triangles keep their
 * slots, and those that have got a new point join that part's lists of what comes in. New edges come into the
 * parts of their old points, ahead of all others. So what acts on a point is added up in an order that does
 * not depend on the parts, and a cut touches memory around it alone. When it has rested from tearing the
 * new points come to their places among the old ones (reorder.h).
 *
 * Numbers of triangles and sides are those of sim's tables.
 */
#ifndef SIM_TOPOLOGY_H
#define SIM_TOPOLOGY_H

#include "sim/sim.h"

/* About as many triangles as a chunk has (parts.h), but alike for any number of workers. */
enum { TOPOLOGY_STRETCH = 4096 };

/* Triangles around a point, at the most, where a cut goes through it. */
enum { FAN_MAX = 64 };

/* A balloon's connections. Arrays are owned; [triangles], [points] and [edges] are of the balloon's
 * triangles, points with room and edges with room, from its first on. */
struct topology {
    uint32_t (*neighbour)[3]; /* [triangles] across side k, from corner k to the next; MESH_NONE: a rim */
    double *rest_area;        /* [triangles] */
    double (*rest)[3];        /* [points] places at rest */
    uint32_t *triangle_at;    /* [points] one of the triangles around it */
    uint32_t *name;   /* [points] its own number as it was made, less the balloon's first (reorder.h) */
    uint32_t *named;  /* [points] the other way round */
    uint32_t *family; /* [points] by name: that of the old point that it was made from in the end */
    uint32_t *place, *spare_numbers; /* [points] for putting points in order, */
    void *spare;                     /* and rows of 32 bytes */
    unsigned char *late_edge;        /* [edges] 1: in the last part's list */
    unsigned char *late_triangle;
    uint32_t *slow_from;   /* [triangles / TOPOLOGY_STRETCH + 1] the first late one of each stretch */
    uint32_t slow;         /* triangles from there on in theirs, which are not worked out four at a time */
    struct sim_part *tail; /* the balloon's last part: what is new */
    uint32_t old_points, old_edges;
    uint32_t rim_room;
    uint32_t (*rim)[2]; /* [rim_room] triangle and side of each side of a rim, as they were cut */
    double area;        /* of the whole skin at rest */

    /* What the future depends on; no padding. */
    struct topology_counts {
        uint32_t points, edges;              /* that are new */
        uint32_t late_edges, late_triangles; /* in the last part's lists */
        uint32_t rims;                       /* sides in rim */
        uint32_t refused;                    /* cuts for which there was no room */
        uint32_t settled;                    /* of the new points those that have come to their places */
        uint32_t orders;                     /* how often some have */
        uint64_t awake;                      /* REORDER_SLEEPS or another */
        uint64_t slowed; /* triangles that took longer since new points last came there, a step each */
        double last_cut; /* s */
        double torn;     /* length at rest of all that was cut */
    } now;
};

/* Room for new points and edges of a balloon with so many points, whose cracks may be so many radii long. */
uint32_t topology_room(const struct scene_fracture *fracture, uint32_t points);

/* Makes and frees what belongs to one balloon. Errors: STATUS_NO_MEMORY. */
enum status topology_open(struct sim *sim, struct sim_balloon *balloon, struct error *err);
void topology_close(struct sim_balloon *balloon);

/* Blocks of state; and what follows from them, after they were put back. */
size_t topology_blocks(struct sim *sim, struct sim_balloon *balloon, struct sim_block *blocks);
void topology_restored(struct sim *sim, struct sim_balloon *balloon);
/* A triangle has got a new point; none has any more, and no edge either. */
void topology_slow(struct sim *sim, struct sim_balloon *balloon, uint32_t triangle);
void topology_nothing_slow(const struct sim_balloon *balloon);
/* Whether blocks that may be anything are those of a skin, before topology_restored(). */
bool topology_is_sound(const struct sim *sim, const struct sim_balloon *balloon);

/* One triangle after another around a point. */
struct fan {
    uint32_t triangle;
    int corner; /* of the triangle, that is the point */
};

/* The first of the triangles around a point counted against the clock, seen from outside: the one whose side
 * before it is a rim; any, and true, where there is no rim. */
bool topology_first(const struct sim *sim, const struct sim_balloon *balloon, uint32_t point,
                    struct fan *fan);
/* The next against the clock; false at a rim, and then *fan stays. */
bool topology_next(const struct sim *sim, const struct sim_balloon *balloon, struct fan *fan);

/* Whether there is room for another cut; counts one as refused if not. */
bool topology_can_cut(struct sim *sim, struct sim_balloon *balloon);

/* Cuts the edge across `side` of a triangle, which must not be a rim, and whose ends have no more than
 * FAN_MAX triangles where they lie on one. Does not allocate; takes the time of the two ends' triangles. */
void topology_cut(struct sim *sim, struct sim_balloon *balloon, uint32_t triangle, int side);

#endif
