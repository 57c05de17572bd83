/* A patch of a balloon's skin, by its place at rest. What cuts make of its points belongs to it, too. */
#ifndef SIM_PATCH_H
#define SIM_PATCH_H

#include "sim/sim.h"

struct patch {
    uint32_t *point; /* [count] in the order of their numbers; owned, with room for what cuts make of them, */
    uint32_t *of;    /* [count] and which of the first ones each was made from; likewise */
    uint32_t count;  /* now, */
    uint32_t first;  /* and before anything was cut */
    uint32_t *member; /* [points at first] which of the first ones it is, by names; MESH_NONE: none; owned */
    double *mass;     /* [first] before anything was cut; owned */
};

/* The balloon's points whose direction from its centre at rest is within `reach` degrees of `place`, and
 * always the nearest one. Needs positions at rest and masses: call it as the sim is opened. Error:
 * STATUS_NO_MEMORY, of `what`; then, too, patch_clear() frees what there is. */
enum status patch_open(struct sim *sim, const struct sim_balloon *balloon, const double place[3],
                       double reach, const char *what, struct patch *patch, struct error *err);
void patch_clear(struct patch *patch);

/* For the hooks of struct effect of these names: a cut has made a copy of a point; points of the patch's own
 * balloon have got other numbers. */
void patch_copied(struct patch *patch, const struct sim_balloon *balloon, uint32_t copy);
void patch_reorder(struct patch *patch, const struct sim_balloon *balloon);

/* Of a point that was cut, the part of what acts on it that is its `k`th point's: by mass, so that what acts
 * on all alike draws none from the others. 1 where nothing was cut. */
static inline double patch_share(const struct sim *sim, const struct patch *patch, uint32_t k)
{
    return sim->mass[patch->point[k]] / patch->mass[patch->of[k]];
}

#endif
