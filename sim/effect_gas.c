#include "common/scene_checks.h"
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/gas.h"
#include "sim/gas_torn.h"
#include "sim/guard.h"
#include "sim/reorder.h"
#include "sim/vectors.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->gas.on;
}

/* What falls with less than 1e-100 changes no bit of any pressure, and squares of it would be 0. */
static void set_weights(struct gas *gas, const struct scene_gravity *gravity)
{
    if (!gravity->on || gravity->air_density == 0 || vec3_length(gravity->acceleration) < 1e-100)
        return;
    memcpy(gas->down, gravity->acceleration, sizeof gas->down);
    gas->air_weight = gravity->air_density;
    gas->gas_weight = gas->scene->density / gas->scene->ambient; /* times N/V */
}

static void fill(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    double *scalar = &sim->scalar[gas->scalar];
    gas->rest_volume = gas->volume = gas_volume(sim, b);
    gas->filling = gas->scene->ambient * gas->rest_volume;
    scalar[GAS_AMOUNT] = gas->scene->fill * gas->filling;
    scalar[GAS_ENTROPY] = gas->g == 1 ? 1 : pow(gas->scene->fill * gas->scene->ambient, 1 - gas->g);
    gas->pressure = gas->scene->fill * gas->scene->ambient;
    gas->outside = gas->scene->ambient;
    gas->memory.neck_open = gas->scene->neck > 0 && gas->scene->neck_at <= 0;
}

/* A skin around nothing but rounding holds no gas, and what that does to the skin cannot be told. */
static enum status check_room(const struct sim *sim, const struct sim_balloon *b, struct error *err)
{
    if (b->gas->rest_volume > 1e-12 * b->radius * b->radius * b->radius)
        return STATUS_OK;
    return scene_contradiction(
        sim->scene, (size_t)(b - sim->balloons), "gas", b->scene->gas.line, err,
        "the mesh has a volume of %.2g, no room for gas; take one that does not lie flat",
        b->gas->rest_volume);
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
    return status ? status : check_room(sim, b, err);
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    if (b->gas) {
        gas_torn_close(b);
        patch_clear(&b->gas->neck);
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

static size_t left(struct sim *sim, struct sim_balloon *b, struct sim_block *list)
{
    (void)sim;
    struct gas *gas = b->gas;
    list[0] = (struct sim_block){"holes", &gas->holes, sizeof gas->holes};
    list[1] = (struct sim_block){"volume", &gas->volume, sizeof gas->volume};
    list[2] = (struct sim_block){"pressure", &gas->pressure, sizeof gas->pressure};
    list[3] = (struct sim_block){"outside", &gas->outside, sizeof gas->outside};
    list[4] = (struct sim_block){"tube held", &gas->tube_held, sizeof gas->tube_held};
    list[5] = (struct sim_block){"flow held", &gas->flow_held, sizeof gas->flow_held};
    return 6;
}

static void reorder(struct sim *sim, struct sim_balloon *b, const struct reorder *how)
{
    (void)sim;
    if (how->balloon != b)
        return;
    reorder_rows(how, b->gas->held, sizeof *b->gas->held);
    if (b->gas->scene->neck > 0)
        patch_reorder(&b->gas->neck, b);
}

/* The part of what is missing that may come a second, so that a step ends at its goal at the most. A method
 * that chooses its steps sees to that by itself: the longest that it may take says nothing. */
static double most_a_second(const struct sim *sim)
{
    return sim->integrator->flags & INTEGRATOR_ADAPTIVE ? DBL_MAX : 1 / sim->step;
}

/* Of gas that is gone: the air's. */
static struct gas_drive drive_at(const struct sim *sim, const struct gas *gas, double pressure, double volume,
                                 double gauge)
{
    const double amount = gas_amount(sim, gas), capacity = amount / (pressure * gas->g);
    const bool gone = gas->memory.gone;
    return (struct gas_drive){.pressure = gone ? gas->memory.left_at : pressure,
                              .gauge = gone ? 0 : gauge,
                              .density = gas->scene->density *
                                         (gone ? 1 : amount / (volume * gas->scene->ambient)),
                              .warmth = gone ? 1 : pressure * volume / amount,
                              .amount_of_mass = gas->scene->ambient / gas->scene->density,
                              .capacity = gone ? INFINITY : capacity,
                              .to_even = capacity / 2 * most_a_second(sim)};
}

struct gas_drive gas_drive(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct gas *gas = balloon->gas;
    return drive_at(sim, gas, gas->pressure, gas->volume, fabs(gas->pressure - gas->outside));
}

struct gas_drive gas_drive_in_bound(const struct sim *sim, const struct sim_balloon *balloon)
{
    const struct gas_memory *memory = &balloon->gas->memory;
    return drive_at(sim, balloon->gas, memory->bound_pressure, memory->bound_volume, memory->bound_gauge);
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

bool gas_flows(const struct sim_balloon *balloon)
{
    const struct gas *gas = balloon->gas;
    return gas && !gas->memory.gone &&
           (balloon->now->pump != 0 || gas->scene->leak > 0 || balloon->scene->tube.on ||
            gas->memory.neck_open || gas->memory.torn_open);
}

/* What the pump brings a second, or, below 0, draws out. Over the last thousandth, of its goal or of what
 * fills the balloon, it slows down in proportion to what is missing; and over the last step, so that neither
 * the goal nor the air's pressure is overshot. */
static double pumped(const struct sim *sim, const struct sim_balloon *b, const struct gas_drive *in)
{
    const struct gas *gas = b->gas;
    const double rate = b->now->pump * gas->filling, goal = b->now->pump_until * gas->filling,
                 missing = goal - gas_amount(sim, gas), gauge = fmax(in->pressure - gas->outside, 0);
    if (gas->memory.neck_open || rate == 0)
        return 0;
    if (rate < 0)
        return rate * fmin(1, gauge * fmin(in->capacity / (1e-3 * gas->filling), in->to_even / -rate));
    return fmax(0, fmin(rate, fmin(missing * most_a_second(sim), rate * (missing / (1e-3 * goal)))));
}

/* By pump and through the skin. */
static void pump_and_leak(struct sim *sim, const struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    const struct gas_drive in = gas_drive(sim, b);
    const double gauge = in.pressure - gas->outside, brought = pumped(sim, b, &in);
    const double leak = gas->scene->leak * gas->scene->ambient, leaked = fmin(leak, in.to_even) * gauge;
    gas->flow_held = leak > in.to_even && fabs(gauge) > GAS_LAMINAR * in.pressure;
    gas_stream(sim, b, brought, 1);
    gas_stream(sim, b, -leaked, 1);
    sim->scalar_rate[gas->scalar + GAS_BROUGHT] += brought - leaked;
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    double origin[4], *rate = &sim->scalar_rate[gas->scalar];
    memset(rate, 0, GAS_SCALARS * sizeof *rate);
    if (gas->memory.gone)
        return;
    gas_origin(sim, b, origin);
    gas_find_holes(sim, b);
    gas->volume = areas_volume(sim, b, gas_held(gas), origin) + gas_fan_volume(&gas->holes, origin);
    gas->volume = fmax(gas->volume, GAS_LEAST_VOLUME * gas->rest_volume); /* check() sees to what is below */
    gas->pressure = gas_pressure(gas_amount(sim, gas), gas->volume, sim->scalar[gas->scalar + GAS_ENTROPY],
                                 gas->g);
    const double moment = gas_moment(sim, b);
    const struct areas_pressure pressure = gas_pressures(sim, b, gas->pressure, gas->volume, moment);
    gas->outside = gas_outside(sim, b, gas->volume, moment);
    areas_push(sim, b, gas_held(gas), &pressure);
    pump_and_leak(sim, b);
    gas_let_out(sim, b);
}

/* The gas is gone once the holes are wider than a sixth of a sphere of its volume, 2 R^2: they have then
 * grown by a radius within the time that a collapsing skin takes for that, and what is inside no longer
 * knows of one pressure. */
static bool is_too_wide(const struct gas *gas, double openings)
{
    const double radius = cbrt(3 * fmax(gas->volume, 0) / (4 * M_PI));
    return openings >= 2 * radius * radius;
}

static bool is_gone(const struct gas *gas)
{
    return gas->holes.count > 0 && is_too_wide(gas, gas_openings(gas));
}

static void let_all_go(struct sim *sim, struct sim_balloon *b)
{
    double *scalar = &sim->scalar[b->gas->scalar];
    scalar[GAS_BROUGHT] -= scalar[GAS_AMOUNT];
    scalar[GAS_AMOUNT] = 0;
    b->gas->memory.gone = 1;
    b->gas->memory.left_at = b->gas->pressure = b->gas->outside;
    sim->changed = true;
    guard_bound_outdated(sim);
    sim_tell(sim, b, "gas", "has left through the holes, and sleeps");
}

static bool is_collapsed(const struct gas *gas)
{
    return !(gas->volume > 1e-6 * gas->rest_volume);
}

/* Triangles of the paper's skin went at once, with no time for anything to be pressed together: what is
 * outside of the skin that is left is the gas's no longer, at the pressure and entropy that there are. Where
 * the skin is in shreds the areas of their rims cancel out: it goes by those of the triangles. */
static void lose_outside(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    double *scalar = &sim->scalar[gas->scalar];
    const double before = gas_torn_volume_before(sim, b);
    gas_torn_let_go(sim, b);
    gas->volume = before;
    if (is_collapsed(gas))
        return; /* for check() */
    gas->volume = gas_volume(sim, b);
    if (is_collapsed(gas) || is_too_wide(gas, gas_torn_missing(sim, b))) {
        let_all_go(sim, b);
    } else if (gas->volume < before) {
        const double lost = scalar[GAS_AMOUNT] * (1 - gas->volume / before);
        scalar[GAS_AMOUNT] -= lost;
        scalar[GAS_BROUGHT] -= lost;
        sim->changed = true;
    }
}

static bool is_bound_outdated(const struct gas *gas)
{
    const struct gas_memory *memory = &gas->memory;
    const double volume = gas->volume / memory->bound_volume,
                 pressure = gas->pressure / memory->bound_pressure,
                 gauge = gas_gauge_to_bound(gas->pressure, gas->outside) / memory->bound_gauge;
    return !(volume > 0.8 && volume < 1.25 && pressure > 0.8 && pressure < 1.25 && gauge < 1.5 &&
             gauge > 0.5);
}

static void tell_held(struct sim *sim, struct sim_balloon *b)
{
    b->gas->flow_told = true;
    sim_tell(sim, b, "gas",
             "less flows than would: a step of this length would even the pressures out more than half-way; "
             "shorter steps follow it");
}

static void after(struct sim *sim, struct sim_balloon *b)
{
    struct gas *gas = b->gas;
    struct gas_memory *memory = &gas->memory;
    if (gas->flow_held && !gas->flow_told)
        tell_held(sim, b);
    if (gas->torn && !memory->gone && !is_collapsed(gas) && gas_torn_is_behind(sim, b))
        lose_outside(sim, b);
    if (!memory->neck_open && gas->scene->neck > 0 && sim->time >= gas->scene->neck_at) {
        memory->neck_open = 1;
        sim->changed = true;
        sim_tell(sim, b, "gas", "streams out of the neck");
    }
    if (!memory->gone && !memory->torn_open && gas->holes.count > 0) {
        memory->torn_open = 1;
        sim_tell(sim, b, "gas", "streams out of a tear");
    }
    if (!memory->gone && is_gone(gas))
        let_all_go(sim, b);
    if (!memory->gone && is_bound_outdated(gas))
        guard_bound_outdated(sim);
}

/* The neck opens. */
static double due(const struct sim_balloon *b)
{
    return b->gas->scene->neck > 0 ? b->gas->scene->neck_at : 0;
}

static enum status check(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    const struct gas *gas = b->gas;
    if (gas->memory.gone)
        return STATUS_OK;
    if (!(gas_amount(sim, gas) > 0))
        return error_set(
            err, STATUS_DIVERGED,
            "%s: diverged at time %g (step %llu): more gas than there is left balloons[%zu] within a "
            "step; take a shorter step, another integrator, or a narrower tube",
            sim->scene->path, sim->time, (unsigned long long)sim->steps, (size_t)(b - sim->balloons));
    if (!is_collapsed(gas))
        return STATUS_OK;
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): balloons[%zu] holds gas in a volume of less than a "
        "millionth of that at rest: its skin has collapsed or turned inside out; take a shorter "
        "step, or another integrator",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, (size_t)(b - sim->balloons));
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

static void copied(struct sim *sim, struct sim_balloon *b, uint32_t point, uint32_t copy, double share)
{
    (void)sim;
    (void)share;
    b->gas->held[copy - b->point_begin] = b->gas->held[point - b->point_begin];
    if (b->gas->scene->neck > 0)
        patch_copied(&b->gas->neck, b, copy);
}

const struct effect effect_gas = {.name = "gas",
                                  .phase = EFFECT_FORCES,
                                  .wanted = wanted,
                                  .open = open,
                                  .close = close,
                                  .apply = apply,
                                  .after = after,
                                  .due = due,
                                  .left = left,
                                  .blocks = blocks,
                                  .copied = copied,
                                  .reorder = reorder,
                                  .product = gas_product,
                                  .bound = gas_bound,
                                  .check = check,
                                  .energy = gas_held_energy,
                                  .energy_before = gas_energy_before,
                                  .power = gas_power,
                                  .source = "ideal gas; Saint-Venant & Wantzel 1839"};
