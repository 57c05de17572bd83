#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/gas.h"
#include "sim/gas_torn.h"
#include "sim/guard.h"
#include "sim/vectors.h"

#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->gas.on;
}

/* What volumes are seen from: the balloon's first point, so that nothing is lost of them however far it has flown. */
static void origin_of(const struct sim *sim, const struct sim_balloon *b, double origin[4])
{
    memcpy(origin, sim->position[b->point_begin], 4 * sizeof *origin);
}

static const unsigned char *held_of(const struct gas *gas)
{
    return gas->memory.let_go ? gas->held : NULL;
}

static void set_weights(struct gas *gas, const struct scene_gravity *gravity)
{
    if (!gravity->on || gravity->air_density == 0)
        return;
    memcpy(gas->down, gravity->acceleration, sizeof gas->down);
    gas->air_weight = gravity->air_density;
    gas->gas_weight = gas->scene->density / gas->scene->ambient; /* times N/V */
}

/* The volume as positions have it, whatever the last forces were. */
static double volume_now(const struct sim *sim, const struct sim_balloon *b)
{
    double origin[4];
    origin_of(sim, b, origin);
    gas_find_holes(sim, b);
    return areas_change(sim, b, origin, held_of(b->gas), sim->velocity).volume +
           gas_fan_volume(&b->gas->holes, origin);
}

static void fill(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    double *scalar = &sim->scalar[gas->scalar];
    gas->rest_volume = gas->volume = volume_now(sim, b);
    gas->filling = gas->scene->ambient * gas->rest_volume;
    scalar[GAS_AMOUNT] = gas->scene->fill * gas->filling;
    scalar[GAS_ENTROPY] = gas->g == 1 ? 1 : pow(gas->scene->fill * gas->scene->ambient, 1 - gas->g);
    gas->pressure = gas->scene->fill * gas->scene->ambient;
    gas->memory.neck_open = gas->scene->neck > 0 && gas->scene->neck_at <= 0;
}

static bool tears_along_cracks(const struct scene_balloon *balloon)
{
    return balloon->fracture.on && balloon->fracture.mode == SCENE_FRACTURE_TEAR;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    struct gas *gas = b->gas = calloc(1, sizeof *gas);
    if (!gas)
        return error_no_memory(err, "the gas");
    gas->scene = &b->scene->gas;
    gas->g = gas->scene->process == SCENE_ADIABATIC ? gas->scene->gamma : 1;
    set_weights(gas, &sim->scene->gravity);
    gas->held = sim_table(sim, b->point_room - b->point_begin, sizeof *gas->held);
    if (!gas->held)
        return error_no_memory(err, "the gas");
    memset(gas->held, 1, b->point_room - b->point_begin);
    sim->bytes += sizeof *gas;
    enum status status = sim_add_scalars(sim, GAS_SCALARS, &gas->scalar, err);
    if (!status && gas->scene->neck > 0)
        status = gas_find_neck(sim, b, err);
    if (!status && !tears_along_cracks(b->scene))
        status = gas_torn_open(sim, b, err);
    if (!status)
        fill(sim, b);
    return status;
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->gas) {
        gas_torn_close(b);
        free(b->gas->neck);
        free(b->gas->held);
    }
    free(b->gas);
    b->gas = NULL;
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *list)
{
    (void)sim;
    list[0] = (struct sim_block){"gas", &b->gas->memory, sizeof b->gas->memory};
    list[1] = (struct sim_block){"held by gas", b->gas->held, b->point_room - b->point_begin};
    return 2;
}

struct gas_drive gas_drive(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct gas *gas = balloon->gas;
    const double amount = gas_amount(sim, gas);
    return (struct gas_drive){.pressure = gas->pressure,
                              .density = gas->scene->density * amount / (gas->volume * gas->scene->ambient),
                              .warmth = gas->pressure * gas->volume / amount,
                              .amount_of_mass = gas->scene->ambient / gas->scene->density,
                              .to_even = amount / (gas->pressure * gas->g * 2 * sim->step)};
}

void gas_stream(struct sim *sim, const struct sim_balloon *balloon, double rate, double warmth)
{
    const struct gas *gas = balloon->gas;
    double *scalar_rate = &sim->scalar_rate[gas->scalar];
    if (gas->memory.gone) { /* into the air */
        scalar_rate[GAS_BROUGHT] -= rate;
        return;
    }
    scalar_rate[GAS_AMOUNT] += rate;
    if (rate > 0 && gas->g != 1)
        scalar_rate[GAS_ENTROPY] += gas->g * sim->scalar[gas->scalar + GAS_ENTROPY] * rate *
                                    (warmth / (gas->pressure * gas->volume) - 1 / gas_amount(sim, gas));
}

/* What the pump brings a second, or, below 0, draws out. Near its goal, and as the pressure nears the air's, it slows down, so that neither is
 * overshot. */
static double pumped(const struct sim *sim, const struct sim_balloon *b, const struct gas_drive *in)
{
    const struct gas *gas = b->gas;
    const double rate = b->now->pump * gas->filling,
                 missing = b->now->pump_until * gas->filling - gas_amount(sim, gas);
    if (gas->memory.neck_open)
        return 0;
    if (rate < 0)
        return -fmin(-rate, in->to_even * fmax(in->pressure - gas->scene->ambient, 0));
    return fmax(0, fmin(rate, missing / sim->step));
}

/* By pump and through the skin. */
static void pump_and_leak(struct sim *sim, const struct sim_balloon *b)
{
    const struct gas *gas = b->gas;
    const struct gas_drive in = gas_drive(sim, b);
    const double gauge = in.pressure - gas->scene->ambient, brought = pumped(sim, b, &in);
    const double leaked = fmin(gas->scene->leak * gas->scene->ambient, in.to_even) * gauge;
    gas_stream(sim, b, brought, 1);
    gas_stream(sim, b, -leaked, 1);
    sim->scalar_rate[gas->scalar + GAS_BROUGHT] += brought - leaked;
}

/* At the point x: p - pa + (r - ra) g . x - r g . x0 + ra g . c, with the densities r and ra of gas and air, g gravity, x0 the first point,
 * where the gas's pressure is p, and c the centre at rest, where the air's is pa. */
static struct areas_pressure pressure_of(const struct sim *sim, const struct sim_balloon *b, double pressure,
                                         double volume)
{
    const struct gas *gas = b->gas;
    const double density = gas->gas_weight * gas_amount(sim, gas) / volume;
    struct areas_pressure q = {.constant = pressure - gas->scene->ambient};
    q.constant += gas->air_weight * vec3_dot(gas->down, b->centre) -
                  density * vec3_dot(gas->down, sim->position[b->point_begin]);
    for (int i = 0; i < 3; i++)
        q.gradient[i] = (density - gas->air_weight) * gas->down[i];
    return q;
}

/* Over that at rest: what the pressure is taken for where there is less. */
static const double least_volume = 1e-9;

static void apply(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    double origin[4], *rate = &sim->scalar_rate[gas->scalar];
    memset(rate, 0, GAS_SCALARS * sizeof *rate);
    if (gas->memory.gone)
        return;
    origin_of(sim, b, origin);
    gas_find_holes(sim, b);
    gas->volume = areas_volume(sim, b, held_of(gas), origin) + gas_fan_volume(&gas->holes, origin);
    gas->volume = fmax(gas->volume, least_volume * gas->rest_volume); /* check() sees to what is below */
    gas->pressure = gas_pressure(gas_amount(sim, gas), gas->volume, sim->scalar[gas->scalar + GAS_ENTROPY],
                                 gas->g);
    const struct areas_pressure pressure = pressure_of(sim, b, gas->pressure, gas->volume);
    areas_push(sim, b, held_of(gas), &pressure);
    pump_and_leak(sim, b);
    gas_let_out(sim, b);
}

/* The gas is gone once the holes are wider than a sixth of a sphere of its volume, 2 R^2: they have then grown by a radius within the time
 * that a collapsing skin takes for that, and what is inside no longer knows of one pressure. */
static bool is_gone(const struct gas *gas)
{
    const double radius = cbrt(3 * fmax(gas->volume, 0) / (4 * M_PI));
    return gas->holes.count > 0 && gas_openings(gas) >= 2 * radius * radius;
}

static void let_all_go(struct sim *sim, struct sim_balloon *b)
{
    double *scalar = &sim->scalar[b->gas->scalar];
    scalar[GAS_BROUGHT] -= scalar[GAS_AMOUNT];
    scalar[GAS_AMOUNT] = 0;
    b->gas->memory.gone = 1;
    b->gas->pressure = b->gas->scene->ambient;
    sim->changed = true;
    guard_outdated(sim);
    sim_tell(sim, b, "gas", "has left through the holes, and sleeps");
}

/* The gauge pressure that the bound counts with: a thousandth of the pressure at the least, so that a balloon that is filled from
 * nothing does not ask for a new one at every step. */
static double gauge_to_bound(const struct gas *gas, double pressure)
{
    return fmax(fabs(pressure - gas->scene->ambient), 1e-3 * pressure);
}

static bool is_bound_outdated(const struct gas *gas)
{
    const struct gas_memory *memory = &gas->memory;
    const double volume = gas->volume / memory->bound_volume,
                 pressure = gas->pressure / memory->bound_pressure,
                 gauge = gauge_to_bound(gas, gas->pressure) / memory->bound_gauge;
    return !(volume > 0.8 && volume < 1.25 && pressure > 0.8 && pressure < 1.25 && gauge < 1.5 &&
             gauge > 0.5);
}

static void after(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    struct gas_memory *memory = &gas->memory;
    if (gas->torn && !memory->gone)
        gas_torn_let_go(sim, b);
    if (!memory->neck_open && gas->scene->neck > 0 && sim->time >= gas->scene->neck_at) {
        memory->neck_open = 1;
        sim->changed = true;
        sim_tell(sim, b, "gas", "streams out of the neck");
    }
    if (!memory->gone && is_gone(gas))
        let_all_go(sim, b);
    if (!memory->gone && is_bound_outdated(gas))
        guard_outdated(sim);
}

static enum status check(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    const struct gas *gas = b->gas;
    if (gas->memory.gone || gas->volume > 1e-6 * gas->rest_volume)
        return STATUS_OK;
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): balloons[%zu] holds gas in a volume of less than a "
        "millionth of that at rest: its skin has collapsed or turned inside out; take a shorter "
        "step, or another integrator",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, (size_t)(b - sim->balloons));
}

/* F_i = q N_i/6, where q follows the volume: dp/dV = -g p/V, and the gas's density dr/dV = -r/V. Thrust is taken as constant: Newton's method
 * does without. */
static void product(struct sim *sim, struct sim_balloon *b, double a, double (*dx)[4], double f,
                    double (*dv)[4], double (*df)[4])
{
    (void)f;
    (void)dv;
    const struct gas *gas = b->gas;
    double origin[4];
    if (a == 0 || gas->memory.gone)
        return;
    origin_of(sim, b, origin);
    gas_find_holes(sim, b);
    const struct areas_change of = areas_change(sim, b, origin, held_of(gas), dx);
    const double volume = of.volume + gas_fan_volume(&gas->holes, origin),
                 change = of.change + gas_fan_change(sim, b, dx);
    const double p = gas_pressure(gas_amount(sim, gas), volume, sim->scalar[gas->scalar + GAS_ENTROPY],
                                  gas->g);
    const struct areas_pressure pressure = pressure_of(sim, b, p, volume);
    const double density = gas->gas_weight * gas_amount(sim, gas) / volume,
                 thinner = density * change / volume;
    struct areas_pressure d = {.constant = -gas->g * p / volume * change +
                                           thinner * vec3_dot(gas->down, sim->position[b->point_begin]) -
                                           density * vec3_dot(gas->down, dx[b->point_begin])};
    for (int i = 0; i < 3; i++)
        d.gradient[i] = -thinner * gas->down[i];
    areas_product(sim, b, &pressure, &d, held_of(gas), a, dx, df);
}

/* The largest pressure on any point, less the air's: where gas or air have weight it depends on the height. */
static double largest_gauge(const struct sim *sim, const struct sim_balloon *b,
                            const struct areas_pressure *pressure)
{
    double most = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        most = fmax(most, fabs(pressure->constant + vec3_dot(pressure->gradient, sim->position[p])));
    return most;
}

/* The stiffness of areas, and g p/V times a point's area vector times those of all others; both for half as much again. From the state
 * alone: what the last forces left may be that of another one. */
static void bound(const struct sim *sim, const struct sim_balloon *b, const struct guard_rows *rows)
{
    struct gas *gas = b->gas;
    struct gas_memory *memory = &gas->memory;
    double all = 0;
    if (memory->gone)
        return;
    memory->bound_volume = fmax(volume_now(sim, b), least_volume * gas->rest_volume);
    memory->bound_pressure = gas_pressure(gas_amount(sim, gas), memory->bound_volume,
                                          sim->scalar[gas->scalar + GAS_ENTROPY], gas->g);
    memory->bound_gauge = gauge_to_bound(gas, memory->bound_pressure);
    const struct areas_pressure pressure = pressure_of(sim, b, memory->bound_pressure, memory->bound_volume);
    areas_bound(sim, b, 1.5 * fmax(memory->bound_gauge, largest_gauge(sim, b, &pressure)), rows);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        all += areas_size(sim, t);
    const double stiffness = 1.5 * (gas->g * memory->bound_pressure / memory->bound_volume * all +
                                    vec3_length(pressure.gradient));
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            rows->stiffness[sim->triangle_point[t][k]] += stiffness * areas_size(sim, t) / 3;
}

/* Whoever asks leaves the holes as the last forces found them: what goes by them must not depend on the ledger. */
static double energy(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    if (gas->memory.gone)
        return 0;
    const struct gas_holes holes = gas->holes;
    double volume = volume_now(sim, b);
    if (!(volume >
          least_volume * gas->rest_volume)) /* all went in one step: it is what the last forces found */
        volume = gas->volume;
    gas->holes = holes;
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
    const unsigned char *held = held_of(b->gas);
    double power = 0;
    for (uint32_t p = begin; p < end; p++)
        if (p - b->point_begin < b->point_end - b->point_begin && (!held || held[p - b->point_begin]))
            power += (m->constant + vec3_dot(m->gradient, sim->position[p])) / 6 *
                     vec3_dot(sim->normal[p], sim->velocity[p]);
    return power;
}

/* What pumps bring and what the air lifts is work; what streams out is lost, but for its thrust's work, and so is what a
 * hole's edge does not catch of the pressure. */
static void power(struct sim *sim, struct sim_balloon *b, double *dissipated, double *work)
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
        const struct areas_pressure q = pressure_of(sim, b, gas->pressure, gas->volume);
        struct moving m = {b, q.constant - gauge, {q.gradient[0], q.gradient[1], q.gradient[2]}};
        *work += vector_sum(sim, pushing_power, &m);
    }
}

void gas_let_go(struct sim *sim, struct sim_balloon *balloon, const uint32_t *points, uint32_t count)
{
    struct gas *gas = balloon->gas;
    if (!gas)
        return;
    for (uint32_t i = 0; i < count; i++)
        gas->held[points[i] - balloon->point_begin] = 0;
    gas->memory.let_go = 1;
    sim->changed = true;
}

struct gas_look gas_look(struct sim *sim, const struct sim_balloon *balloon)
{
    struct gas *gas = balloon->gas;
    if (!gas)
        return (struct gas_look){0};
    const double *scalar = &sim->scalar[gas->scalar];
    struct gas_look look = {
        .volume = volume_now(sim, balloon), .amount = scalar[GAS_AMOUNT], .brought = scalar[GAS_BROUGHT]};
    look.hole_area = gas_openings(gas);
    if (!gas->memory.gone)
        look.gauge_pressure = gas_pressure(scalar[GAS_AMOUNT], look.volume, scalar[GAS_ENTROPY], gas->g) -
                              gas->scene->ambient;
    return look;
}

const struct effect effect_gas = {.name = "gas",
                                  .phase = EFFECT_FORCES,
                                  .wanted = wanted,
                                  .open = open,
                                  .close = close,
                                  .apply = apply,
                                  .after = after,
                                  .blocks = blocks,
                                  .product = product,
                                  .bound = bound,
                                  .check = check,
                                  .energy = energy,
                                  .power = power,
                                  .source = "ideal gas; Saint-Venant & Wantzel 1839"};
