/* Gas and air that have weight: where the gas has its pressure, and against which air. */
#include "common/vec3.h"
#include "sim/gas.h"
#include "unit/balloon.h"

/* The middle of the volume, of cones as seen from the first point. */
static void middle_of_volume(const struct sim *sim, double middle[3])
{
    double volume = 0;
    memset(middle, 0, 3 * sizeof *middle);
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const uint32_t *p = sim->triangle_point[t];
        double(*x)[4] = sim->position, u[3][3], cross[3];
        for (int k = 0; k < 3; k++)
            vec3_sub(x[p[k]], x[0], u[k]);
        vec3_cross(u[0], u[1], cross);
        const double cone = vec3_dot(cross, u[2]) / 6;
        volume += cone;
        for (int i = 0; i < 3; i++)
            middle[i] += cone * (u[0][i] + u[1][i] + u[2][i]) / 4;
    }
    for (int i = 0; i < 3; i++)
        middle[i] = sim->position[0][i] + middle[i] / volume;
}

/* What gas of one mean density presses has its mean in the middle of the volume, whichever point is numbered
 * first and wherever down is. So the virial of its forces about that point is 3 V (p - pa), whatever it
 * weighs: here, 0.5 at its top and bottom, and air of no weight to speak of. A triangle's pressure is that of
 * its corners: off by the square of the edges, a hundredth of what the weights do. */
static void gas_has_its_pressure_in_the_middle_of_its_volume(void **state)
{
    (void)state;
    static const char *const downs[] = {"gravity.acceleration=[0, -10, 0]", "gravity.acceleration=[10, 0, 0]",
                                        "gravity.acceleration=[3, 5, -8]"};
    for (int d = 0; d < 3; d++) {
        struct balloon b;
        open_balloon(&b, 2,
                     SETTINGS("balloons[0].gas.ambient=10", "balloons[0].spring=0",
                              "balloons[0].gas.density=0.001", "gravity.air_density=1e-12",
                              "balloons[0].point_mass=1e-9", "balloons[0].position=[50, 7, -20]", downs[d]));
        double middle[3], virial = 0;
        for (uint32_t p = 0; p < b.sim.point_count; p++) /* a pear, well out of its middle */
            for (int i = 0; i < 3; i++)
                b.sim.position[p][i] *= 1 + 0.2 * (b.sim.position[p][0] - 50) / 45;
        middle_of_volume(&b.sim, middle);
        sim_forces(&b.sim);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int i = 0; i < 3; i++)
                virial += b.sim.force[p][i] * (b.sim.position[p][i] - middle[i]);
        const struct gas_look look = gas_look(&b.sim, &b.sim.balloons[0]);
        print_message("# %s: off by %.2g\n", downs[d], virial / (3 * look.volume) - look.gauge_pressure);
        assert_near(virial / (3 * look.volume), look.gauge_pressure, 0.005);
        close_balloon(&b);
    }
}

/* 500 up in air of .01 a length the pressure around it is 5, not 10: that is what its skin bears against,
 * what is logged, and what drives gas out through a leak and a neck. Down below it is even with the air. */
static void gas_that_has_risen_presses_and_leaks_against_the_air_up_there(void **state)
{
    (void)state;
    static const char *const openings[] = {"balloons[0].gas.leak=2", "balloons[0].gas.neck=100"};
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        struct error err = {0};
        open_balloon(&b, 1,
                     SETTINGS("balloons[0].gas.ambient=10", "balloons[0].point_mass=1e9",
                              "balloons[0].gas.density=0.001", "gravity.air_density=0.001",
                              "gravity.acceleration=[0, -10, 0]", openings[i]));
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            b.sim.position[p][1] += 500;
        sim_forces(&b.sim);
        const struct gas_look look = gas_look(&b.sim, &b.sim.balloons[0]);
        const struct gas_jet jet = gas_jet(10, 0.001, 5, 1.4, 0.6);
        assert_near(look.gauge_pressure, 5, 1e-12);
        assert_near(b.sim.scalar_rate[b.sim.balloons[0].gas->scalar] /
                        (i ? -jet.flux * 100 * 10 / 0.001 : -2 * 10 * 5),
                    1, 1e-9);
        assert_ok(sim_step(&b.sim, &err), &err);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gas_has_its_pressure_in_the_middle_of_its_volume),
        cmocka_unit_test(gas_that_has_risen_presses_and_leaks_against_the_air_up_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
