/* The gas in one balloon, as effect_gas.c and gas_holes.c keep it (effect_gas.h says what it is). */
#ifndef SIM_GAS_H
#define SIM_GAS_H

#include "sim/areas.h"
#include "sim/effect_gas.h"
#include "sim/gas_law.h"
#include "sim/patch.h"

/* Its scalars. */
enum { GAS_AMOUNT, GAS_ENTROPY, GAS_BROUGHT, GAS_SCALARS };

/* What closes the skin: for each hole the middle of its rim and its vector area, inwards. */
struct gas_holes {
    uint32_t count;
    double middle[GAS_HOLES_MAX][3], area[GAS_HOLES_MAX][3];
    uint32_t sides[GAS_HOLES_MAX];
};

struct gas {
    const struct scene_gas *scene;
    uint32_t scalar;             /* the first of its own */
    double g;                    /* what p goes by */
    double rest_volume, filling; /* N that fills it at ambient pressure */
    double gas_weight, air_weight;
    double down[3]; /* acceleration of gravity, where the air has weight */
    struct gas_holes holes;
    struct gas_torn *torn; /* where edges let go (gas_torn.h); NULL: the skin tears along cracks */
    struct patch neck;     /* points that feel its thrust; empty where there is none */
    unsigned char *held;   /* [points] of the balloon: 0 where a piece has fallen off; owned */

    /* By the last sim_forces(); the thrust beyond the missing pressure on a unit of a hole's
     * area, and that of the neck. */
    double volume, pressure, rim_thrust, neck_thrust;
    double outside; /* of the air beside the middle of the volume */

    bool flow_held; /* what streams through holes, neck and skin was held back by them (gas_let_out()) */
    bool flow_told; /* and that was told */
    bool tube_held; /* what flows in its tube was held back by them (effect_tube.c) */
    bool tube_told; /* and that was told */

    struct gas_memory {
        double bound_volume, bound_pressure, bound_gauge; /* for which the guard's bound was found */
        /* 1: nothing is left to press; pieces have fallen off; the neck has opened; so has a tear */
        uint64_t gone, let_go, neck_open, torn_open;
        double left_at; /* the air's pressure where gas that is gone went; 0 before */
    } memory;
};

static inline double gas_amount(const struct sim *sim, const struct gas *gas)
{
    return sim->scalar[gas->scalar + GAS_AMOUNT];
}

/* Over that at rest: what the pressure is taken for where there is less. */
#define GAS_LEAST_VOLUME 1e-9

/* Nearer than this to even pressures, of the higher one, flow is laminar: it goes by their difference, not by
 * its root. */
#define GAS_LAMINAR 1e-4

/* What volumes are seen from. */
void gas_origin(const struct sim *sim, const struct sim_balloon *balloon, double origin[4]);

/* For areas.h: NULL while no piece has fallen off. */
const unsigned char *gas_held(const struct gas *gas);

/* The volume as positions have it, whatever the last forces were; finds the holes. */
double gas_volume(const struct sim *sim, const struct sim_balloon *balloon);

/* The volume's moment along gravity, seen from its origin, after part 3 of a step and with the holes that
 * were found last; 0 where air has no weight. */
double gas_moment(struct sim *sim, const struct sim_balloon *balloon);

/* The pressure of the air beside the middle of this volume. */
double gas_outside(const struct sim *sim, const struct sim_balloon *balloon, double volume, double moment);

/* What presses on points where the gas has this pressure, volume and moment. */
struct areas_pressure gas_pressures(const struct sim *sim, const struct sim_balloon *balloon, double pressure,
                                    double volume, double moment);

/* The gauge pressure that the bound counts with. */
double gas_gauge_to_bound(double pressure, double outside);

/* The hooks of struct effect of these names; power by the last sim_forces(). */
void gas_product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                 double (*dv)[4], double (*df)[4]);
void gas_bound(const struct sim *sim, const struct sim_balloon *balloon, const struct guard_rows *rows);
double gas_held_energy(struct sim *sim, struct sim_balloon *balloon);
double gas_energy_before(struct sim *sim, struct sim_balloon *balloon);
void gas_power(struct sim *sim, struct sim_balloon *balloon, double *dissipated, double *work);

/* The holes that these rims bound, where points are now; NULL: none. */
void gas_measure_holes(const struct sim *sim, const struct gas_rims *rims, struct gas_holes *holes);

/* Finds the holes as they are. */
void gas_find_holes(const struct sim *sim, const struct sim_balloon *balloon);

/* The volume of the fans that close them, seen from `origin`. */
double gas_fan_volume(const struct gas_holes *holes, const double origin[3]);

/* The moment of that along `down`: the integral of down . (x - origin), as in areas.h. */
double gas_fan_moment(const struct sim *sim, const struct sim_balloon *balloon, const double origin[3],
                      const double down[3]);

/* The volume's change as the points move by dx; exact also for what the moving rim
 * does to the skin's volume. */
double gas_fan_change(const struct sim *sim, const struct sim_balloon *balloon, double (*dx)[4]);

/* What gets out through holes and neck a second: sets the rates of the scalars for it, and adds the jets'
 * thrust to the forces beyond the pressure that is missing where the holes are. */
void gas_let_out(struct sim *sim, struct sim_balloon *balloon);

/* What that thrust does to the skin's energy a second, by the last sim_forces(). */
double gas_thrust_power(const struct sim *sim, const struct sim_balloon *balloon);

/* Area of all openings. */
double gas_openings(const struct gas *gas);

/* Finds the points at the neck; STATUS_NO_MEMORY. */
enum status gas_find_neck(struct sim *sim, const struct sim_balloon *balloon, struct error *err);

#endif
