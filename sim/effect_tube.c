/* A tube between the gas of two balloons: what flows is what an opening of its area lets through from the higher pressure to the lower
 * (gas_law.h); what leaves one arrives at the other, to the bit. */
#include "sim/effect_gas.h"
#include "sim/effects.h"
#include "sim/gas_law.h"

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->tube.on;
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    const struct scene_tube *tube = &b->scene->tube;
    struct sim_balloon *to = &sim->balloons[tube->to];
    struct gas_drive here = gas_drive(sim, b), there = gas_drive(sim, to);
    const double sign = here.pressure > there.pressure ? 1 : -1;
    const struct gas_drive *from = sign > 0 ? &here : &there, *into = sign > 0 ? &there : &here;
    if (!(from->pressure > into->pressure) || !(from->density > 0))
        return;
    const struct gas_jet jet = gas_jet(from->pressure, from->density, into->pressure, b->scene->gas.gamma,
                                       tube->discharge);
    /* both change: half of what would even one of them out alone, of the smaller */
    const double most = fmin(here.to_even, there.to_even) / 2 * (from->pressure - into->pressure);
    const double rate = fmin(jet.flux * tube->area * from->amount_of_mass, most);
    gas_stream(sim, b, -sign * rate, from->warmth);
    gas_stream(sim, to, sign * rate, from->warmth);
}

const struct effect effect_tube = {.name = "tube",
                                   .phase = EFFECT_FORCES,
                                   .wanted = wanted,
                                   .apply = apply,
                                   .source = "Saint-Venant & Wantzel 1839"};
