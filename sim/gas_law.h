/*
 * Laws of an ideal gas, in the units of effect_gas.h: p pressure, V volume, N amount (p V at the temperature
 * of the air), s entropy, g the exponent that p follows (1 at constant temperature), gamma the gas's own.
 */
#ifndef SIM_GAS_LAW_H
#define SIM_GAS_LAW_H

#include <math.h>

/* p = s (N/V)^g */
static inline double gas_pressure(double amount, double volume, double entropy, double g)
{
    return g == 1 ? entropy * amount / volume : entropy * pow(amount / volume, g);
}

/* What gas between p and V could still do to the air at `ambient` (its exergy): U + pa V - T0 S less
 * the same of as much air,
 *     p V/(g - 1) + pa V - N (g/(g - 1) + ln s/(g - 1) + ln pa),
 * and in the limit g = 1, N ln(p/pa) - N + pa V. Its derivative by V is pa - p. */
static inline double gas_energy(double amount, double volume, double entropy, double g, double ambient)
{
    const double p = gas_pressure(amount, volume, entropy, g);
    if (g == 1)
        return amount * (log(p / ambient) - 1) + ambient * volume;
    return p * volume / (g - 1) + ambient * volume -
           amount * (g / (g - 1) + log(entropy) / (g - 1) + log(ambient));
}

/* By how much that energy changes a second at the rates dN of amount and ds of
 * entropy, at the same volume. */
static inline double gas_energy_rate(double amount, double volume, double entropy, double g, double ambient,
                                     double rate, double entropy_rate)
{
    const double p = gas_pressure(amount, volume, entropy, g);
    if (g == 1)
        return rate * log(p / ambient);
    const double warmth = p * volume / amount; /* the temperature over that of the air */
    return rate * ((warmth - 1) * g - log(entropy) - (g - 1) * log(ambient)) / (g - 1) +
           entropy_rate * amount * (warmth - 1) / (entropy * (g - 1));
}

struct gas_jet {
    /* Mass through a unit of the opening's area, a second; always outwards, from the higher pressure. */
    double flux;
    double thrust; /* force on that unit */
};

/* Gas at pressure p and density r streams through an opening into `outside` < p, without friction or heat:
 * with q = outside/p, not below that at which it runs at the speed of sound (choked), q* = (2/(gamma +
 * 1))^(gamma/(gamma - 1)),
 *     v = sqrt(2 gamma/(gamma - 1) p/r (1 - q^((gamma - 1)/gamma))),   flux = C r q^(1/gamma) v,
 * and its reaction is flux v + C (p q - outside) (Saint-Venant & Wantzel 1839; Shapiro I, chapter 4). C is
 * the discharge coefficient, taken for the contraction of the jet. */
static inline struct gas_jet gas_jet(double p, double density, double outside, double gamma, double discharge)
{
    const double choked = pow(2 / (gamma + 1), gamma / (gamma - 1)), ratio = fmax(outside / p, choked);
    const double speed = sqrt(2 * gamma / (gamma - 1) * p / density *
                              fmax(0, 1 - pow(ratio, (gamma - 1) / gamma)));
    const double flux = discharge * density * pow(ratio, 1 / gamma) * speed;
    return (struct gas_jet){flux, flux * speed + discharge * fmax(0, p * ratio - outside)};
}

#endif
