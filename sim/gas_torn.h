/*
 * Where the paper's skin is open (3.5, part 3: triangles vanish), for the gas inside: the sides of active
 * triangles that no other active triangle shares are rims; those that hang together by points are one hole.
 * Triangles that hang together by points are one piece, and the gas stays in the one with the most triangles.
 *
 * Skins that tear along cracks know their rims themselves (fracture.h).
 */
#ifndef SIM_GAS_TORN_H
#define SIM_GAS_TORN_H

#include "sim/effect_gas.h"

struct gas_torn {
    struct gas_rims rims;
    uint64_t of; /* fingerprint of what they were found for; 0: of nothing yet */
    /* [points of the balloon] points that hang together: one of them, in the end the same for all; owned. */
    uint32_t *group;
    uint32_t *number;      /* [points of the balloon] of the hole, or how many triangles a piece has; owned */
    unsigned char *sides;  /* [edges of the balloon] how many active triangles an edge has; owned */
    unsigned char *active; /* [triangles of the balloon] as they were when the rims were found; owned */
};

/* For a balloon whose gas is open: makes balloon->gas->torn and balloon->rims. STATUS_NO_MEMORY. */
enum status gas_torn_open(struct sim *sim, struct sim_balloon *balloon, struct error *err);
void gas_torn_close(struct sim_balloon *balloon);

/* Brings the rims up to date with the triangles that are active, whoever put them in that state. */
void gas_torn_follow(const struct sim *sim, const struct sim_balloon *balloon);

/* Whether triangles went since the rims were brought up to date. */
bool gas_torn_is_behind(const struct sim *sim, const struct sim_balloon *balloon);

/* The volume, where points are now, of the skin that the rims were found for. */
double gas_torn_volume_before(const struct sim *sim, const struct sim_balloon *balloon);

/* Area of the triangles that went, where their points are now. */
double gas_torn_missing(const struct sim *sim, const struct sim_balloon *balloon);

/* At the end of a step in which triangles went: the gas lets go of the smaller pieces. */
void gas_torn_let_go(struct sim *sim, struct sim_balloon *balloon);

#endif
