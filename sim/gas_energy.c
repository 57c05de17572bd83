/* What gas is worth (effect_gas.c): volume and pressure from positions alone, how they change with them, and
 * the energy that is in them. */
#include "common/vec3.h"
#include "sim/gas.h"
#include "sim/gas_torn.h"
#include "sim/guard.h"
#include "sim/vectors.h"

#include <string.h>

/* What volumes are seen from: the balloon's first point, so that nothing is lost of them
 * however far it has flown. */
void gas_origin(const struct sim *sim, const struct sim_balloon *b, double origin[4])
{
    memcpy(origin, sim->position[b->point_begin], 4 * sizeof *origin);
}

const unsigned char *gas_held(const struct gas *gas)
{
    return gas->memory.let_go ? gas->held : NULL;
}

/* The volume as positions have it, whatever the last forces were. */
double gas_volume(const struct sim *sim, const struct sim_balloon *b)
{
    double origin[4];
    gas_origin(sim, b, origin);
    gas_find_holes(sim, b);
    return areas_change(sim, b, origin, NULL, gas_held(b->gas), sim->velocity).volume +
           gas_fan_volume(&b->gas->holes, origin);
}

/* Volume and its moment along gravity, from positions alone, of the skin and of the holes that were found
 * last. */
static struct areas_change gas_change(const struct sim *sim, const struct sim_balloon *b, double (*dx)[4])
{
    const struct gas *gas = b->gas;
    const double *down = gas->air_weight > 0 ? gas->down : NULL;
    double origin[4];
    gas_origin(sim, b, origin);
    struct areas_change of = areas_change(sim, b, origin, down, gas_held(gas), dx);
    of.volume += gas_fan_volume(&gas->holes, origin);
    of.change += gas_fan_change(sim, b, dx);
    if (down) /* how the holes' moments change is left out: Newton's method does without */
        of.moment += gas_fan_moment(sim, b, origin, down);
    return of;
}

double gas_moment(struct sim *sim, const struct sim_balloon *b)
{
    const struct gas *gas = b->gas;
    double origin[4];
    if (gas->air_weight == 0)
        return 0;
    gas_origin(sim, b, origin);
    return areas_moment(sim, b, gas_held(gas), origin, gas->down) + gas_fan_moment(sim, b, origin, gas->down);
}

/* How far down the middle of the volume is, times gravity. */
static double depth(const struct sim *sim, const struct sim_balloon *b, double volume, double moment)
{
    return vec3_dot(b->gas->down, sim->position[b->point_begin]) + moment / volume;
}

/* At rest the air has pa in the balloon's centre. */
double gas_outside(const struct sim *sim, const struct sim_balloon *b, double volume, double moment)
{
    const struct gas *gas = b->gas;
    if (gas->air_weight == 0)
        return gas->scene->ambient;
    return gas->scene->ambient +
           gas->air_weight * (depth(sim, b, volume, moment) - vec3_dot(gas->down, b->centre));
}

/* At the point x: p - pm + (r - ra) g . (x - m), with the densities r and ra of gas and air, g gravity, and m
 * the middle of the volume, where the gas's pressure is p, as its mean density is N/V, and the air's pm. */
struct areas_pressure gas_pressures(const struct sim *sim, const struct sim_balloon *b, double pressure,
                                    double volume, double moment)
{
    const struct gas *gas = b->gas;
    const double heavier = gas->gas_weight * gas_amount(sim, gas) / volume - gas->air_weight;
    struct areas_pressure q = {.constant = pressure - gas_outside(sim, b, volume, moment)};
    if (gas->air_weight == 0)
        return q;
    q.constant -= heavier * depth(sim, b, volume, moment);
    for (int i = 0; i < 3; i++)
        q.gradient[i] = heavier * gas->down[i];
    return q;
}

/* F_i = q N_i/6, where q follows the volume: dp/dV = -g p/V, and the gas's density dr/dV = -r/V. Thrust is
 * taken as constant: Newton's method does without. */
void gas_product(struct sim *sim, struct sim_balloon *b, double a, double (*dx)[4], double f, double (*dv)[4],
                 double (*df)[4])
{
    (void)f;
    (void)dv;
    const struct gas *gas = b->gas;
    if (a == 0 || gas->memory.gone)
        return;
    gas_find_holes(sim, b);
    const struct areas_change of = gas_change(sim, b, dx);
    const double volume = of.volume, change = of.change;
    const double p = gas_pressure(gas_amount(sim, gas), volume, sim->scalar[gas->scalar + GAS_ENTROPY],
                                  gas->g);
    const struct areas_pressure pressure = gas_pressures(sim, b, p, volume, of.moment);
    const double density = gas->gas_weight * gas_amount(sim, gas) / volume,
                 thinner = density * change / volume, middle = of.moment / volume;
    struct areas_pressure d = {.constant = -gas->g * p / volume * change +
                                           thinner *
                                               (vec3_dot(gas->down, sim->position[b->point_begin]) + middle) -
                                           density * (of.moment_change - middle * change) / volume};
    for (int i = 0; i < 3; i++)
        d.gradient[i] = -thinner * gas->down[i];
    areas_product(sim, b, &pressure, &d, gas_held(gas), a, dx, df);
}

/* The gauge pressure that the bound counts with: a hundredth of the pressure at the least, so that a balloon
 * that is filled from nothing, and swings about that, does not ask for a new one at every step. */
double gas_gauge_to_bound(double pressure, double outside)
{
    return fmax(fabs(pressure - outside), 1e-2 * pressure);
}

/* The largest pressure on any point, less the air's: where gas or air have weight it
 * depends on the height. */
static double largest_gauge(const struct sim *sim, const struct sim_balloon *b,
                            const struct areas_pressure *pressure)
{
    double most = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        most = fmax(most, fabs(pressure->constant + vec3_dot(pressure->gradient, sim->position[p])));
    return most;
}

/* The stiffness of areas, and g p/V times a point's area vector times those of all others; both for half as
 * much again. From the state alone: what the last forces left may be that of another one. */
void gas_bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    struct gas *gas = b->gas;
    struct gas_memory *memory = &gas->memory;
    double all = 0;
    if (memory->gone)
        return;
    gas_find_holes(sim, b);
    const struct areas_change of = gas_change(sim, b, sim->velocity);
    memory->bound_volume = fmax(of.volume, GAS_LEAST_VOLUME * gas->rest_volume);
    memory->bound_pressure = gas_pressure(gas_amount(sim, gas), memory->bound_volume,
                                          sim->scalar[gas->scalar + GAS_ENTROPY], gas->g);
    memory->bound_gauge = gas_gauge_to_bound(memory->bound_pressure,
                                             gas_outside(sim, b, memory->bound_volume, of.moment));
    const struct areas_pressure pressure = gas_pressures(sim, b, memory->bound_pressure, memory->bound_volume,
                                                         of.moment);
    areas_bound(sim, b, 1.5 * fmax(memory->bound_gauge, largest_gauge(sim, b, &pressure)), rows);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        all += areas_size(sim, t);
    const double stiffness = 1.5 * (gas->g * memory->bound_pressure / memory->bound_volume * all +
                                    vec3_length(pressure.gradient));
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            rows->stiffness[sim->triangle_point[t][k]] += stiffness * areas_size(sim, t) / 3;
}

/* Whoever asks leaves the holes as the last forces found them: what goes by them must
 * not depend on the ledger. */
double gas_held_energy(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    if (gas->memory.gone)
        return 0;
    const struct gas_holes holes = gas->holes;
    double volume = gas_volume(sim, b);
    if (!(volume >
          GAS_LEAST_VOLUME * gas->rest_volume)) /* all went in one step: it is what the last forces found */
        volume = gas->volume;
    gas->holes = holes;
    return gas_energy(gas_amount(sim, gas), volume, sim->scalar[gas->scalar + GAS_ENTROPY], gas->g,
                      gas->scene->ambient);
}

/* What went took its share along (effect_gas.c): it is counted from what there was, not from what is left
 * pressed together. Whoever asks leaves the rims as they are, too. */
double gas_energy_before(struct sim *sim, struct sim_balloon *b)
{
    const struct gas *gas = b->gas;
    if (gas->memory.gone || !gas->torn || !gas_torn_is_behind(sim, b))
        return gas_held_energy(sim, b);
    const double before = gas_torn_volume_before(sim, b);
    const double volume = before > GAS_LEAST_VOLUME * gas->rest_volume ? before : gas->volume;
    return gas_energy(gas_amount(sim, gas), volume, sim->scalar[gas->scalar + GAS_ENTROPY], gas->g,
                      gas->scene->ambient);
}

struct moving {
    const struct sim_balloon *balloon;
    double constant, gradient[3];
};

static double pushing_power(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct moving *m = context;
    const struct sim_balloon *b = m->balloon;
    const unsigned char *held = gas_held(b->gas);
    double power = 0;
    for (uint32_t p = begin; p < end; p++)
        if (p - b->point_begin < b->point_end - b->point_begin && (!held || held[p - b->point_begin]))
            power += (m->constant + vec3_dot(m->gradient, sim->position[p])) / 6 *
                     vec3_dot(sim->normal[p], sim->velocity[p]);
    return power;
}

/* What pumps bring and what the air lifts is work; what streams out is lost, but for its thrust's work, and
 * so is what a hole's edge does not catch of the pressure. */
void gas_power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
{
    const struct gas *gas = b->gas;
    if (gas->memory.gone)
        return;
    const double *scalar = &sim->scalar[gas->scalar], *rate = &sim->scalar_rate[gas->scalar];
    const double streams = gas_energy_rate(scalar[GAS_AMOUNT], gas->volume, scalar[GAS_ENTROPY], gas->g,
                                           gas->scene->ambient, rate[GAS_AMOUNT], rate[GAS_ENTROPY]);
    const double gauge = gas->pressure - gas->scene->ambient;
    *(streams > 0 ? work : dissipated) += fabs(streams);
    *dissipated += gauge * gas_fan_change(sim, b, sim->velocity) - gas_thrust_power(sim, b);
    if (gas->air_weight > 0) {
        const struct areas_pressure q = gas_pressures(sim, b, gas->pressure, gas->volume, gas_moment(sim, b));
        struct moving m = {b, q.constant - gauge, {q.gradient[0], q.gradient[1], q.gradient[2]}};
        *work += vector_sum(sim, pushing_power, &m);
    }
}

struct gas_look gas_look(struct sim *sim, const struct sim_balloon *balloon)
{
    struct gas *gas = balloon->gas;
    if (!gas)
        return (struct gas_look){0};
    const double *scalar = &sim->scalar[gas->scalar];
    gas_find_holes(sim, balloon);
    const struct areas_change of = gas_change(sim, balloon, sim->velocity);
    struct gas_look look = {
        .volume = of.volume, .amount = scalar[GAS_AMOUNT], .brought = scalar[GAS_BROUGHT]};
    look.hole_area = gas_openings(gas);
    if (!gas->memory.gone)
        look.gauge_pressure = gas_pressure(scalar[GAS_AMOUNT], look.volume, scalar[GAS_ENTROPY], gas->g) -
                              gas_outside(sim, balloon, look.volume, of.moment);
    return look;
}
