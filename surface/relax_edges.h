/* Changes of edges during a relaxation: for relax.c. All run through the triangles in their order. False when
 * memory ran out. */
#ifndef SURFACE_RELAX_EDGES_H
#define SURFACE_RELAX_EDGES_H

#include "surface/remesh.h"

/* Mean length of all edges. */
double edges_mean(const struct remesh *r);

/* Collapses edges shorter than `least`, where no edge becomes longer than `most`, but no more than `count`;
 * splits those longer than `most`. */
void edges_collapse(struct remesh *r, double least, double most, uint32_t count);
bool edges_split(struct remesh *r, double most, uint32_t count);

/* Flips edges where that brings their points nearer to six neighbours each, or opens a narrow angle. */
void edges_flip(struct remesh *r, double most);

/* The length below (or above) which there are about `count` edges. */
double edges_quantile(const struct remesh *r, double mean, uint32_t count, bool below);

/* Merges a point into the neighbour that leaves the triangles around facing outwards best. False where none
 * may be. */
bool edges_merge(struct remesh *r, uint32_t point);

/* At each triangle with an angle below angle_deg: the collapse, flip or split nearby that leaves the best
 * smallest angle, where it is better than before. Returns how many such triangles there were; *good is false
 * when memory ran out. */
size_t edges_cure(struct remesh *r, double mean, double angle_deg, bool *good);

#endif
