/* The effects, one file each; effects.c lists them. */
#ifndef SIM_EFFECTS_H
#define SIM_EFFECTS_H

#include "sim/sim.h"

extern const struct effect effect_spring_by_height;
extern const struct effect effect_rip;
extern const struct effect effect_fracture;
extern const struct effect effect_membrane;
extern const struct effect effect_bending;
extern const struct effect effect_viscosity;
extern const struct effect effect_plasticity;
extern const struct effect effect_areas;
extern const struct effect effect_gas;
extern const struct effect effect_tube;
extern const struct effect effect_gravity;
extern const struct effect effect_drag;
extern const struct effect effect_string;
extern const struct effect effect_pins;
extern const struct effect effect_needles;
extern const struct effect effect_ground; /* effect_obstacles.c */
extern const struct effect effect_obstacles;
extern const struct effect effect_contact;

#endif
