#include "surface/distribution.h"

#define SQRT_2PI 2.5066282746310005024

void distribution_fill(struct distribution *distribution, double cutoff)
{
    double mass = erf(cutoff / M_SQRT2);
    for (int node = 0; node < DISTRIBUTION_NODES; node++) {
        double u = (node + 0.5) / DISTRIBUTION_NODES_PER_SIGMA, *term = distribution->term[node];
        double density = exp(-u * u / 2) / (SQRT_2PI * mass), before = 0, hermite = 1, factorial = 1;
        term[0] = erf(u / M_SQRT2) / (2 * mass);
        for (int k = 0; k + 1 < DISTRIBUTION_TERMS; k++) {
            factorial *= k + 1;
            term[k + 1] = (k % 2 ? -1 : 1) * hermite * density / factorial;
            double next = u * hermite - k * before;
            before = hermite;
            hermite = next;
        }
    }
}
