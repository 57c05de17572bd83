/* Spheres of rubber that breathe: inertia, stiffness, gas and viscosity in motion, against one oscillator. */
#include "common/vec3.h"
#include "unit/balloon.h"

static double mean_radius(const struct sim *sim)
{
    double sum = 0;
    for (uint32_t p = 0; p < sim->point_count; p++)
        sum += vec3_length(sim->position[p]);
    return sum / sim->point_count;
}

struct breath {
    double rate, decay; /* 1/s: of the phase, and of the amplitude */
    double round;       /* 3 V/(A R) of the mesh: below 1 by the square of its edges */
};

/* Let go a ten-thousandth too large, over eight crossings of its size at rest and the peaks between them. */
static struct breath breathe(const char *const *settings)
{
    enum { CROSSINGS = 8 };
    struct balloon b;
    double crossed[CROSSINGS], peak[CROSSINGS] = {0};
    open_balloon(&b, 3, settings);
    const double rest = mean_radius(&b.sim);
    const struct sim_measures m = sim_measure(&b.sim);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] *= 1 + 1e-4;
    double before = mean_radius(&b.sim) - rest;
    for (int count = 0; count < CROSSINGS;) {
        steps(&b, 1);
        const double now = mean_radius(&b.sim) - rest;
        if (now * before < 0)
            crossed[count++] = b.sim.time - b.sim.taken * now / (now - before);
        else if (count > 0)
            peak[count] = fmax(peak[count], fabs(now));
        before = now;
    }
    close_balloon(&b);
    const double half = (crossed[CROSSINGS - 1] - crossed[0]) / (CROSSINGS - 1);
    return (struct breath){M_PI / half, log(peak[1] / peak[CROSSINGS - 1]) / (half * (CROSSINGS - 2)),
                           3 * m.volume / (m.area * rest)};
}

/* A sphere's stress is 6 mu x/R for incompressible rubber, and eta x'/R, so that
 *     rho h x'' = -2 h/R (6 mu x/R + eta x'/R) - 3 gamma p x/R,
 * with p the pressure of gas that is sealed in and as full as it was at rest. What is left of the mesh goes
 * by the square of its edges: 2.5e-4 of the rate; peaks are seen at steps of a two-hundredth of a swing. */
static void check(double viscosity, double pressure, const char *const *settings)
{
    const double mu = 17, rho = 0.02, h = 0.37, radius = 37, decay = viscosity / (rho * radius * radius);
    const struct breath breath = breathe(settings);
    const double stiffness = 12 * mu / (rho * radius * radius) +
                             3 * 1.4 * pressure / (rho * h * radius) * breath.round;
    print_message("# rate %.6f of %.6f, decay %.6f of %.6f\n", breath.rate, sqrt(stiffness - decay * decay),
                  breath.decay, decay);
    assert_near(breath.rate / sqrt(stiffness - decay * decay), 1, 5e-4);
    assert_near(breath.decay, decay, 2e-3 * decay + 1e-4);
}

#define RUBBER(...)                                                                                      \
    SETTINGS("balloons[0].radius=37", "balloons[0].pressure=0", "time.integrator=rk4", "time.step=0.01", \
             "balloons[0].membrane.shear_modulus=17", "balloons[0].membrane.thickness=0.37",             \
             "balloons[0].membrane.density=0.02",                                                        \
             "balloons[0].membrane.compression=1" __VA_OPT__(, ) __VA_ARGS__)

static void rubber_swings_and_is_damped_as_its_moduli_say(void **state)
{
    (void)state;
    check(0, 0, RUBBER("balloons[0].membrane.viscosity=0"));
    check(4, 0, RUBBER("balloons[0].membrane.viscosity=4"));
}

static void sealed_gas_makes_it_swing_faster(void **state)
{
    (void)state;
    check(4, 5,
          RUBBER("balloons[0].membrane.viscosity=4", "balloons[0].gas.ambient=5",
                 "balloons[0].gas.process=adiabatic", "time.step=0.002"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rubber_swings_and_is_damped_as_its_moduli_say),
        cmocka_unit_test(sealed_gas_makes_it_swing_faster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
