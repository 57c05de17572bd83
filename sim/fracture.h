/*
 * Where and when a skin tears (the scene's block `fracture` in mode "tear"); topology.h is how.
 *
 * All is asked between two steps, with the stresses as they are. Lengths are at rest, in mean radii
 * R; W is the energy that a volume at rest holds over the shear modulus, and T = R/c, c the speed
 * of shear waves at rest.
 *
 * Births. Whole skin tears where the mean of W over a patch of radius 0.15 R passes what an equal stretch of
 * `strength` both ways would hold, times 1 + weakness x noise(place, seed). The mean makes it a property of
 * the skin and not of its mesh. Once it has burst somewhere, it takes 1.5 times as much to burst elsewhere,
 * and not near an earlier place. Birth is a slit across the largest tension. Tips. A crack runs on when its
 * tip's triangles would release its toughness: W_tip r >= toughness R, r = sqrt(their area/pi) (Griffith
 * 1921: an energy per area of crack, so that the mesh's size drops out). It takes the edge with the largest
 * tension across, forwards only, and then rests for as long as a tip of `tip_speed` c takes to go there.
 * Forks. Where the skin ahead holds more than `branching` would, a tip goes two ways, and not again before it
 * has run `spacing` R sqrt(W_branching/W). Strands. What holds pieces together snaps at twice the W of whole
 * skin, the most stretched first, one in a look; not near cuts that are as young as waves need to go there,
 * since what a tip has left behind has yet to relax. Rims. A tip that comes to a rim runs through it, however
 * narrow what is left: were ligaments kept, their width would be the mesh's. Strongest first, and nothing
 * twice in a neighbourhood that has changed in this step.
 */
#ifndef SIM_FRACTURE_H
#define SIM_FRACTURE_H

#include "sim/effect_gas.h"
#include "sim/membrane.h"
#include "sim/topology.h"

enum { TIPS_MAX = 512, BIRTHS_MAX = 128 };

struct crack_tip {
    double heading[3]; /* unit, at rest */
    double ready;      /* s: when it may go on */
    double since;      /* s: when it was cut */
    double run;        /* at rest, since it forked last */
    uint32_t point;
    uint32_t alive;
};

struct fracture {
    /* [triangles] sides at rest in their plane: (a, 0), (b, c); c is 0 where it is next to a line */
    double (*shape)[3];
    double *energy;      /* [triangles] W by the last look */
    double *noise;       /* [triangles] -1 to 1 */
    double (*middle)[3]; /* [triangles] at rest */
    uint32_t *patch;     /* [triangles] */
    double *patch_sum;   /* [patch_count] */
    double *patch_area;  /* [patch_count] */
    uint32_t patch_count;
    uint32_t *list; /* [list_room] for searches */
    uint32_t list_room;
    unsigned char *seen; /* [triangles] */
    uint32_t *stamp;     /* [points] when the point's triangles last changed: within a step only */
    uint32_t stamps;
    double radius;
    double wave_speed;                  /* c of a membrane, or of the springs where spring_factor is 1 */
    double whole_energy, branch_energy; /* W of strength and branching */
    struct gas_rims rims;               /* what the gas is told */
    uint32_t *hole_of;                  /* [sides of triangles] scratch for them */
    unsigned char *lost;                /* [triangles] 1: fell off the gas's piece */
    bool told_fan;                      /* that a crack has come to more than FAN_MAX triangles */
    bool told_whole;                    /* that a prick has cut nothing */

    struct crack_tip *tips; /* [TIPS_MAX] */
    double (*births)[3];    /* [BIRTHS_MAX] places at rest */
    struct fracture_counts {
        uint32_t tips, births;
        uint32_t pieces;                       /* that fell off */
        uint32_t events;                       /* cuts by the rule */
        uint32_t refused_tips, refused_births; /* for want of room in the tables */
        double next_look;
    } now;
};

/* The strain of a triangle: the membrane's own, or else as if the springs were a neo-Hookean membrane, which
 * depends on the stretches alone. */
void fracture_look(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle,
                   struct membrane_state *state);

/* Cuts a slit at a point, half_length (at rest) to both sides of it along `direction`, a vector of the skin
 * as it was at rest; on a rim only inwards. Its ends become tips of cracks. Returns the cuts. */
uint32_t fracture_slit(struct sim *sim, struct sim_balloon *balloon, uint32_t point,
                       const double direction[3], double half_length);

/* What a needle's touch or a click does: a slit of 0.15 R at the balloon's point nearest to a place as the
 * skin is now, across the largest tension there. NULL, or why nothing was cut. */
const char *fracture_prick(struct sim *sim, struct sim_balloon *balloon, const double place[3]);

/* The scene's rip as a slit. Returns the cuts. */
uint32_t fracture_rip(struct sim *sim, struct sim_balloon *balloon);

/* Whether what came from a file can be cracks; what follows from them, once blocks were put back. */
bool fracture_is_sound(const struct sim *sim, const struct sim_balloon *balloon);
void fracture_restored(struct sim *sim, struct sim_balloon *balloon);

/* c, as springs are now; 0: they hold nothing that could tear. */
double fracture_wave_speed(const struct sim_balloon *balloon);

/* The rule, after each step. */
void fracture_step(struct sim *sim, struct sim_balloon *balloon);

/* Its second half: those tips go on that can. */
void fracture_tips(struct sim *sim, struct sim_balloon *balloon);

/* W of an equal stretch both ways; and the stretch of 1 at the least that has such a W. */
double fracture_equal_energy(double stretch);
double fracture_equal_stretch(double energy);

/* Of the patch that was nearest to a birth at the last look: what it held (the mean of W), and what it
 * bears. False: there was no look yet. */
bool fracture_nearest(const struct sim_balloon *balloon, double *held, double *borne);

#endif
