/*
 * The normal distribution, cut off at R and normalised again, without a call of erf() or exp(): Taylor
 * polynomials about tabulated nodes.
 *
 * P(u) = erf(u / sqrt 2) / (2 m), m = erf(R / sqrt 2): the distribution function less a half. Its
 * derivatives are P^(k+1)(u) = (-1)^k He_k(u) exp(-u^2/2) / (sqrt(2 pi) m), He_k the Hermite polynomials,
 * He_(k+1) = u He_k - k He_(k-1) (Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.28 and
 * 22.7.14). Nodes lie 1/16 apart, so u is within 1/32 of one, and the 8 terms kept leave out at most |P^(8)|
 * / 8! / 32^8. By Cramer's bound (22.14.17) |He_7(u)| exp(-u^2/4) <= 1.09 sqrt(7!) = 78, so |P^(8)| <= 31 /
 * m and the error is below 7.3e-16 for R >= 2, as small as the rounding of the sum. The slope's is below 8 x
 * 32 times that: 1.9e-13.
 */
#ifndef SURFACE_DISTRIBUTION_H
#define SURFACE_DISTRIBUTION_H

#include <math.h>

enum {
    DISTRIBUTION_TERMS = 8,
    DISTRIBUTION_NODES_PER_SIGMA = 16,
    DISTRIBUTION_NODES = 8 * DISTRIBUTION_NODES_PER_SIGMA + 1 /* for R up to 8, and for u rounded up to it */
};

/* term[n][k]: P^(k) / k! at the node (n + 1/2) / 16. */
struct distribution {
    double term[DISTRIBUTION_NODES][DISTRIBUTION_TERMS];
};

/* cutoff: R, 2 .. 8. */
void distribution_fill(struct distribution *distribution, double cutoff);

/* P(u) for |u| <= R, and *slope = P'(u). */
static inline double distribution_value(const struct distribution *distribution, double u, double *slope)
{
    double place = fabs(u) * DISTRIBUTION_NODES_PER_SIGMA;
    int node = (int)place;
    double d = (place - node - 0.5) / DISTRIBUTION_NODES_PER_SIGMA;
    const double *a = distribution->term[node];
    double d2 = d * d, d4 = d2 * d2;
    *slope = (a[1] + 2 * a[2] * d) + (3 * a[3] + 4 * a[4] * d) * d2 +
             ((5 * a[5] + 6 * a[6] * d) + 7 * a[7] * d2) * d4;
    double value = ((a[0] + a[1] * d) + (a[2] + a[3] * d) * d2) +
                   ((a[4] + a[5] * d) + (a[6] + a[7] * d) * d2) * d4;
    return copysign(value, u);
}

#endif
