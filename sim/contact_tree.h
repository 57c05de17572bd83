/*
 * A tree of boxes over the triangles of all balloons: which of them may meet while the points move from one
 * set of places to another.
 *
 *     if (contact_tree_open(&tree, sim, err)) ...        once: triangles that are near at rest stay near in the tree
 *     contact_tree_fit(&tree, sim, &ways);               boxes around the ways
 *     contact_tree_share(&tree, sim);                    which leaf stands for a point or an edge
 *     contact_tree_pairs(&tree, sim, take, context);     every two leaves whose boxes meet
 *     contact_tree_close(&tree);
 *
 * Neighbours in one sheet always have boxes that meet. So a connected patch whose triangles all look to one
 * side of some direction, all the way, is not compared with itself: it is the graph of a function, and does
 * not cross itself (Volino & Magnenat-Thalmann, "Efficient self-collision detection", Computer Graphics Forum
 * 13 (1994) 155). That the normal of a triangle looks to that side all the way is known from three vectors:
 * moving in straight lines it is n0 (1-t)^2 + (n0 + n1 - d) t(1-t) + n1 t^2, d the normal of the differences
 * (Tang, Curtis, Yoon & Manocha, "ICCD", IEEE TVCG 15 (2009) 544).
 */
#ifndef SIM_CONTACT_TREE_H
#define SIM_CONTACT_TREE_H

#include "sim/contact_box.h"
#include "sim/contact_kernels.h"
#include "sim/sim.h"

enum { CONTACT_JOBS = 4096 }; /* that a search is divided into at the most */

/* What a leaf stands for, so that nothing is looked at twice: points and edges of its
 * triangles, each in one leaf. */
struct contact_leaf {
    uint32_t point_begin, point_end; /* of tree->leaf_point */
    uint32_t edge_begin, edge_end;   /* of tree->leaf_edge */
};

/* Of each node the left child is the next one. */
struct contact_node {
    struct contact_box box;
    uint32_t right;      /* child; 0: a leaf */
    uint32_t begin, end; /* of tree->order */
    uint32_t next;       /* behind the last node below this one */
    uint32_t parent;     /* itself: a root */
    uint32_t sides;      /* a bit for each direction that all its triangles look to */
    uint32_t connected;  /* 1: in one piece when it was made */
    uint32_t number;     /* of a leaf */
};

/* Triangles in a leaf at the most, and sides that they have. Of fewer more leaves meet, of more they have
 * more boxes that do not. */
enum { CONTACT_LEAF = 10, CONTACT_BESIDE = 3 * CONTACT_LEAF };

struct contact_tree {
    struct contact_node *nodes; /* [node_count] owned */
    uint32_t node_count, leaf_count;
    uint32_t *order; /* [triangle_count] triangles as the leaves list them; owned */
    uint32_t *leaf;  /* [triangle_count] the node that lists it; owned */
    /* [leaves] nodes of leaves across their triangles' sides, the others itself; owned. */
    uint32_t (*beside)[CONTACT_BESIDE];
    uint32_t *root;                          /* [balloon_count] owned */
    struct contact_leaf *leaves;             /* [leaf_count] owned */
    uint32_t *leaf_point, *leaf_edge;        /* [point_count], [edge_count] owned */
    unsigned char *point_taken, *edge_taken; /* [point_count], [edge_count] for finding that; owned */
    uint32_t *side; /* [triangle_count] to which sides each looks (contact_kernels.h); owned */
    const struct contact_kernels *kernels;
    struct contact_box *point; /* [point_count] of each point's way; owned */
    struct contact_job *jobs;  /* [CONTACT_JOBS] two nodes, or one with itself; owned */
    uint32_t job_count;
    uint32_t *fit; /* [fit_count] nodes that are fitted on their own, with all below; owned */
    uint32_t fit_count;
};

/* The boxes of a leaf: of its triangles, in the tree's order, and of the points and
 * edges that it stands for. */
struct contact_cell {
    uint32_t leaf;
    struct contact_group triangles, points, edges;
    struct contact_box triangle[CONTACT_LEAF], point[CONTACT_BESIDE], edge[CONTACT_BESIDE];
};

struct contact_job {
    uint32_t a, b;
};

/* Errors: STATUS_NO_MEMORY; close it all the same. */
enum status contact_tree_open(struct contact_tree *tree, struct sim *sim, struct error *err);
void contact_tree_close(struct contact_tree *tree);

void contact_tree_fit(struct contact_tree *tree, struct sim *sim, const struct contact_ways *ways);

/* The cell of a leaf, for the ways that the tree was fitted to. */
void contact_tree_cell(const struct contact_tree *tree, const struct sim *sim, uint32_t leaf,
                       struct contact_cell *cell);

/* Finds anew what the leaves stand for, of the triangles that are active; before the first
 * contact_tree_fit(), and when sim->broken has changed. */
void contact_tree_share(struct contact_tree *tree, const struct sim *sim);

/* Calls take for each two leaves, and each with itself, whose boxes meet and that are not of one patch, on
 * any worker and in any order. */
void contact_tree_pairs(struct contact_tree *tree, struct sim *sim,
                        void (*take)(void *context, unsigned worker, uint32_t a, uint32_t b), void *context);

/* For ways that have changed of a few points, with the triangles around these: boxes only grow until
 * contact_tree_fit() comes again. False where that is better, since there are too many patches that no longer
 * look to one side. Then the pairs that come to them with those patches, some of which are known; and for
 * each point, which can be done by several workers at once, the leaves whose boxes meet a box. */
bool contact_tree_refit(struct contact_tree *tree, struct sim *sim, const struct contact_ways *ways,
                        const uint32_t *points, uint32_t point_count, const uint32_t *triangles,
                        uint32_t triangle_count);
void contact_tree_pairs_opened(struct contact_tree *tree, struct sim *sim,
                               void (*take)(void *context, unsigned worker, uint32_t a, uint32_t b),
                               void *context);
void contact_tree_near(const struct contact_tree *tree, const struct contact_box *box,
                       void (*take)(void *context, uint32_t leaf), void *context);

#endif
