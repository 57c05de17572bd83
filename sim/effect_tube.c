/*
 * A tube between the gas of two balloons: what flows is what an opening of its area lets through from the
 * higher pressure to the lower (gas_law.h); what leaves one arrives at the other, to the bit.
 *
 * Near even pressures that law would ask for ever shorter steps: the flow goes by the root of the difference
 * d. There a flow is slow and laminar, and goes by d itself (Poiseuille); here from a hundredth of the larger
 * gauge pressure downwards, or 1e-4 of the pressure. So the pressures approach each other at a finite rate,
 * dN/dd (1/C1 + 1/C2) with C = dN/dp of each balloon, and the guard splits steps that cannot follow it. Where
 * it may not, flow is held back so that it never turns round within a step, and that is told.
 */
#include "sim/effects.h"
#include "sim/gas.h"
#include "sim/guard.h"

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->tube.on;
}

/* From the first to the second. */
struct pair {
    const struct scene_balloon *scene; /* whose tube it is */
    const struct gas_drive *from, *into;
};

/* The difference of pressures below which flow is laminar. */
static double laminar(const struct pair *pair)
{
    return fmax(0.01 * fmax(pair->from->gauge, pair->into->gauge), GAS_LAMINAR * pair->from->pressure);
}

/* Of N, a second. */
static double flow(const struct pair *pair, double difference)
{
    const struct scene_tube *tube = &pair->scene->tube;
    const double turbulent = fmax(difference, laminar(pair));
    const struct gas_jet jet = gas_jet(pair->from->pressure, pair->from->density,
                                       pair->from->pressure - turbulent, pair->scene->gas.gamma,
                                       tube->discharge);
    return jet.flux * tube->area * pair->from->amount_of_mass * (difference / turbulent);
}

/* Both change: half of what would even one of them out alone, of the smaller. Methods that choose their own
 * steps see to that by themselves. */
static double most_in_a_step(const struct sim *sim, const struct pair *pair, double difference)
{
    const double capacity = fmin(pair->from->capacity, pair->into->capacity);
    return sim->integrator->flags & INTEGRATOR_ADAPTIVE ? INFINITY : capacity / (4 * sim->step) * difference;
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    struct sim_balloon *to = &sim->balloons[b->scene->tube.to];
    const struct gas_drive here = gas_drive(sim, b), there = gas_drive(sim, to);
    const bool out = here.pressure > there.pressure;
    const struct pair pair = {b->scene, out ? &here : &there, out ? &there : &here};
    const double difference = pair.from->pressure - pair.into->pressure;
    b->gas->tube_held = false;
    if (!(difference > 0) || !(pair.from->density > 0))
        return;
    const double whole = flow(&pair, difference), most = most_in_a_step(sim, &pair, difference),
                 rate = fmin(whole, most);
    b->gas->tube_held = whole > most;
    gas_stream(sim, b, out ? -rate : rate, pair.from->warmth);
    gas_stream(sim, to, out ? rate : -rate, pair.from->warmth);
}

static void after(struct sim *sim, struct sim_balloon *b)
{
    if (!b->gas->tube_held || b->gas->tube_told)
        return;
    b->gas->tube_told = true;
    sim_tell(
        sim, b, "tube",
        "lets less through than it would: in a step of this length the pressures would change places; shorter "
        "steps follow it, or time.guard = \"substep\"");
}

/* Steps that hold no flow back, with half of them to spare for what changes until the gas is asked again. */
static double follow(const struct sim *sim, const struct sim_balloon *b)
{
    const struct sim_balloon *to = &sim->balloons[b->scene->tube.to];
    const struct gas_drive drive[2] = {gas_drive_in_bound(sim, b), gas_drive_in_bound(sim, to)};
    double longest = INFINITY;
    for (int i = 0; i < 2; i++) {
        const struct pair pair = {b->scene, &drive[i], &drive[1 - i]};
        const double difference = laminar(&pair);
        if (drive[i].density > 0)
            longest = fmin(longest, fmin(drive[0].capacity, drive[1].capacity) / 8 * difference /
                                        flow(&pair, difference));
    }
    return longest;
}

const struct effect effect_tube = {
    .name = "tube",
    .phase = EFFECT_FORCES,
    .wanted = wanted,
    .apply = apply,
    .after = after,
    .follow = follow,
    .follows = "what flows in the tube",
    .follows_why = "which evens pressures out so fast; a smaller tube.area would ask for less",
    .source = "Saint-Venant & Wantzel 1839; Poiseuille 1840"};
