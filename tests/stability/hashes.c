/* Prints what a bursting balloon comes to by each method, as a hash: equal on every compiler and
 * at every optimisation. */
#include "hard.h"

#include <inttypes.h>

int main(void)
{
    for (const struct integrator *const *method = integrators; *method; method++) {
        if (!strncmp((*method)->name, "cvode", 5)) /* a library of the system, compiled as it was */
            continue;
        char name[64];
        struct balloon b;
        snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
        open_balloon(
            &b, 2,
            SETTINGS("time.guard=substep", "time.step=0.05", "time.end=3", "balloons[0].pressure=250", name));
        steps(&b, 100);
        printf("%016" PRIx64 " %s\n", sim_hash(&b.sim), (*method)->name);
        close_balloon(&b);
    }
    return 0;
}
