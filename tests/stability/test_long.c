/* Hard cases that take long: what small errors add up to. */
#include "hard.h"

/* A symplectic method keeps an energy near the true one for ever: after 10^6 undamped steps it is where it
 * was, but for what oscillates within (dt w)^2/4 < 3 % at a quarter of the bound. */
static void undamped_energy_does_not_drift_in_1e6_steps(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0, HARD("balloons[0].pressure=0", "balloons[0].damping=0", "time.step=0.005"));
    disturb(&b, 1);
    double first = 0, last = 0;
    for (int i = 0; i < 1000; i++) {
        steps(&b, 1);
        first += energy_of(&b) / 1000;
    }
    steps(&b, 998000);
    for (int i = 0; i < 1000; i++) {
        steps(&b, 1);
        last += energy_of(&b) / 1000;
    }
    assert_near(last / first, 1, 0.01);
    close_balloon(&b);
}

/* Forty random scenes over four decades of each dial, all at the same step: none makes energy. */
static void forty_random_scenes_stay_within_what_pressure_can_do(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 40; i++) {
        const char *keys[] = {"point_mass", "spring", "damping", "pressure", "radius"};
        const double middle[] = {0.11, 20, 1, 10, 45};
        char change[5][64];
        for (int k = 0; k < 5; k++)
            snprintf(change[k], sizeof change[k], "balloons[0].%s=%.9g", keys[k],
                     middle[k] * pow(10, 4 * random_unit(&random) - 2));
        struct balloon b;
        open_balloon(&b, 2,
                     SETTINGS("time.guard=substep", change[0], change[1], change[2], change[3], change[4]));
        while (b.sim.time < 2) {
            steps(&b, 1);
            assert_true(energy_of(&b) <= 2 * reachable(&b, b.sim.settings[0].pressure));
        }
        assert_finite(&b.sim);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_energy_does_not_drift_in_1e6_steps),
        cmocka_unit_test(forty_random_scenes_stay_within_what_pressure_can_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
