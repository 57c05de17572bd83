/*
 * Skin that resists being bent: each edge between two triangles is a hinge (the scene's block `bending`).
 *
 * With the angle t between the two normals, positive where the skin bulges outwards, and t0 at rest,
 *     E = w (1 - cos(t - t0)),    w = k |e|^2/(A1 + A2)     e, A1 and A2 the edge and the two areas at rest
 * which is w (t - t0)^2/2 of a small fold (Grinspun et al., Discrete shells, SCA 2003) and (w/2)(2 sin((t -
 * t0)/2))^2 of any, so that it needs no arcs, and a hinge that folds right through itself goes on without a
 * jump. Of a mesh of equilateral triangles that is bent with the principal curvatures c1 and c2, the sum over
 * the hinges is k/2 (c1^2 + c2^2 - 2/3 c1 c2) x area (Seung and Nelson, Phys. Rev. A 38, 1988: Poisson's
 * ratio -1/3): k is the stiffness of a plate.
 *
 * With e = x1 - x0, d2 = x2 - x0, d3 = x3 - x0 (x2 and x3 across from the edge), n1 = e x d2 and n2 = d3 x e,
 *     cos t = n1.n2/|n1||n2|,   sin t = -|e| n1.d3/|n1||n2|,
 *     f2 = T |e|/|n1|^2 n1,   f3 = T |e|/|n2|^2 n2,   f1 = -(a2 f2 + a3 f3),   ai = di.e/|e|^2,   f0 = -(f1 + f2 + f3)
 * under the hinge's torque T = w sin(t - t0) + w damping dt/dt: no force and no torque on the whole.
 *
 * Crushed triangles. The lever of a triangle shrinks with it, and the forces grow. So E is multiplied by r (2
 * - r) for each of the two whose area is below a quarter of that of the smaller at rest: r = |n|^2/(that
 * quarter of twice its area)^2.
 *
 * A hinge is there as long as its edge and both its triangles are; a cut along the edge ends it.
 */
#ifndef SIM_BENDING_H
#define SIM_BENDING_H

#include "sim/sim.h"

#include <string.h>

struct bending_kernels;

/* Where a hinge's x2 and x3 are: corners of its triangles, whose numbers are less the balloon's
 * triangle_begin. x0 and x1 are its edge's points; the first triangle has them in this order. */
struct bending_corners {
    uint32_t triangle[2];
    unsigned char corner[2];
};

/* The hinges that reach into a part and are not its own: their numbers, in order,
 * those before its own first. */
struct bending_reach {
    uint32_t *hinge; /* [count] owned */
    uint32_t before, count;
};

/* What the passes over triangles and hinges leave for each other (bending_passes.h). Owned. */
struct bending_passes {
    double (*normal)[4];             /* [triangles] */
    double *cotangent[3], *swing[3]; /* [triangles] each; swing NULL where nothing is damped */
    double *least;                   /* [triangles] below that |n|^2 a hinge takes it for crushed */
    /* [part_count] some triangle is; a line of the cache would be shared, but is hardly ever written. */
    bool *crushed;
    unsigned char *hinge_crushed; /* [hinges] 1: the second pass has left it to the third; where any is */
};

/* What a balloon's hinges are; balloon->bending, NULL where none are asked for. Numbers of hinges are those
 * of their edges less edge_begin. */
struct bending {
    uint32_t count;  /* edges when the simulation was opened */
    double *rest[4]; /* [count] each: w cos t0, w sin t0, r/|n|^2, 1/slope at rest; 0: no hinge. Owned. */
    struct bending_corners *corners; /* [count] owned */
    uint32_t (*point)[4];            /* [count] x0 to x3, as long as nothing is cut. Owned. */
    struct bending_reach *reach;     /* [part_count] owned */
    double *range;  /* [part_count] largest slope over that at rest, by the last forces. Owned. */
    double bounded; /* what the guard takes that for */
    double damping; /* s */
    bool done;      /* the third pass, with the second: some are crushed */
    struct bending_passes passes;
    const struct bending_kernels *kernels;
};

/* What says which hinges are there and where, of one balloon: so that loops need not look it up again and
 * again. Tables of triangles begin with the balloon's first. */
struct bending_view {
    const unsigned char *edge_active, *triangle_active;
    const uint32_t (*edge_point)[2], (*triangle_point)[3], (*triangle_edge)[3];
    const double *shrink; /* rest[2] */
    const struct bending_corners *corners;
    const uint32_t (*point)[4];
    uint32_t first, count; /* edges of the balloon */
    bool cut;              /* it has been, somewhere: each cut brings an edge */
};

static inline struct bending_view bending_look(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct bending *b = balloon->bending;
    return (struct bending_view){sim->edge_active,
                                 sim->triangle_active + balloon->triangle_begin,
                                 (const uint32_t(*)[2])sim->edge_point,
                                 (const uint32_t(*)[3])sim->triangle_point + balloon->triangle_begin,
                                 (const uint32_t(*)[3])sim->triangle_edge + balloon->triangle_begin,
                                 b->rest[2],
                                 b->corners,
                                 (const uint32_t(*)[4])b->point,
                                 balloon->edge_begin,
                                 b->count,
                                 balloon->edge_end - balloon->edge_begin > b->count};
}

/* Whether a hinge is there; `edge` is a number in sim's tables. */
static inline bool bending_holds(const struct bending_view *v, uint32_t edge)
{
    const uint32_t hinge = edge - v->first;
    if (hinge >= v->count || v->shrink[hinge] == 0 || !v->edge_active[edge])
        return false;
    const struct bending_corners *c = &v->corners[hinge];
    if (!v->triangle_active[c->triangle[0]] || !v->triangle_active[c->triangle[1]])
        return false;
    return !v->cut || (v->triangle_edge[c->triangle[0]][(c->corner[0] + 1u) % 3] == edge &&
                       v->triangle_edge[c->triangle[1]][(c->corner[1] + 1u) % 3] == edge);
}

/* Its points x0 to x3. */
static inline void bending_points(const struct bending_view *v, uint32_t edge, uint32_t point[4])
{
    memcpy(point, v->point[edge - v->first], sizeof v->point[0]);
    if (!v->cut)
        return;
    const struct bending_corners *c = &v->corners[edge - v->first];
    for (int k = 0; k < 2; k++) {
        point[k] = v->edge_point[edge][k];
        point[k + 2] = v->triangle_point[c->triangle[k]][c->corner[k]];
    }
}

#endif
