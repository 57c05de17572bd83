/*
 * A tree of boxes over the triangles of all balloons: which of them may meet while the points move from one set of places to another.
 *
 *     if (contact_tree_open(&tree, sim, err)) ...        once: triangles that are near at rest stay near in the tree
 *     contact_tree_fit(&tree, sim, &ways);               boxes around the ways
 *     contact_tree_pairs(&tree, sim, take, context);     every two triangles whose boxes meet
 *     contact_tree_close(&tree);
 *
 * Neighbours in one sheet always have boxes that meet. So a connected patch whose triangles all look to one side of some direction, all the
 * way, is not compared with itself: it is the graph of a function, and does not cross itself (Volino & Magnenat-Thalmann, "Efficient
 * self-collision detection", Computer Graphics Forum 13 (1994) 155). That the normal of a triangle looks to that side all the way is known from
 * three vectors: moving in straight lines it is n0 (1-t)^2 + (n0 + n1 - d) t(1-t) + n1 t^2, d the normal of the differences (Tang, Curtis, Yoon &
 * Manocha, "ICCD", IEEE TVCG 15 (2009) 544).
 */
#ifndef SIM_CONTACT_TREE_H
#define SIM_CONTACT_TREE_H

#include "sim/contact_box.h"
#include "sim/sim.h"

enum { CONTACT_JOBS = 4096 }; /* that a search is divided into at the most */

/* Of each node the left child is the next one. */
struct contact_node {
    struct contact_box box;
    uint32_t right;      /* child; 0: a leaf */
    uint32_t begin, end; /* of tree->order */
    uint32_t next;       /* behind the last node below this one */
    uint32_t sides;      /* a bit for each direction that all its triangles look to */
    uint32_t connected;  /* 1: in one piece when it was made */
};

struct contact_tree {
    struct contact_node *nodes; /* [node_count] owned */
    uint32_t node_count;
    uint32_t *order;           /* [triangle_count] triangles as the leaves list them; owned */
    uint32_t *root;            /* [balloon_count] owned */
    struct contact_box *box;   /* [triangle_count] owned */
    struct contact_box *point; /* [point_count] of each point's way; owned */
    struct contact_job *jobs;  /* [CONTACT_JOBS] two nodes, or one with itself; owned */
    uint32_t job_count;
    uint32_t *fit; /* [fit_count] nodes that are fitted on their own, with all below; owned */
    uint32_t fit_count;
};

struct contact_job {
    uint32_t a, b;
};

/* Where the points go, how far they may stray from that at its end, and how much room is wanted around it. */
struct contact_ways {
    double (*from)[4], (*to)[4]; /* [point_count] */
    double stray, room;
};

/* Errors: STATUS_NO_MEMORY; close it all the same. */
enum status contact_tree_open(struct contact_tree *tree, struct sim *sim, struct error *err);
void contact_tree_close(struct contact_tree *tree);

void contact_tree_fit(struct contact_tree *tree, struct sim *sim, const struct contact_ways *ways);

/* Calls take for each two triangles whose boxes meet, t < u, on any worker and in any order. Triangles that are not active are in none. */
void contact_tree_pairs(struct contact_tree *tree, struct sim *sim,
                        void (*take)(void *context, uint32_t t, uint32_t u), void *context);

#endif
