/* Pressure and gas at their limits: past the limit point of rubber under control of the gas and of the
 * pressure, ten times the bursting pressure at once, vacuum, gas whose volume goes to nothing, and forces
 * that grow within a step. */
#include "hard.h"

#include "sim/effect_gas.h"
#include "sim/gas.h"

/* Neo-Hookean unless a test says otherwise; p* = p R0/(mu h0) = 100 p, and time in
 * units of R0 sqrt(rho/mu). */
#define RUBBER(...)                                                                        \
    HARD("balloons[0].radius=1", "balloons[0].membrane.thickness=0.01",                    \
         "balloons[0].membrane.shear_modulus=1", "balloons[0].membrane.density=1",         \
         "balloons[0].membrane.viscosity=0.5", "time.step=0.02", "time.integrator=verlet", \
         "balloons[0].pressure_on=areas", "balloons[0].pressure=0" __VA_OPT__(, ) __VA_ARGS__)

/* By the volume, over that of the icosphere that it is made of. */
static double stretch_of(struct balloon *b)
{
    double rest = 0;
    for (uint32_t t = 0; t < b->mesh.triangle_count; t++) {
        const uint32_t *p = b->mesh.triangle[t];
        double cross[3];
        vec3_cross(b->mesh.position[p[1]], b->mesh.position[p[2]], cross);
        rest += vec3_dot(b->mesh.position[p[0]], cross) / 6;
    }
    return cbrt(sim_measure(&b->sim).volume / rest) / b->sim.balloons[0].radius;
}

/* Pumped up slowly: the pressure rises to 1.239 at a stretch of 1.383 and falls from there on, while the
 * balloon goes on growing evenly. 320 triangles err by 1.55 % in pressure; the pump's 0.08 fills a second
 * leave a trembling and a viscous share, eta dL/dt = 0.04 of mu at the most, which is 3 % of p*. As the
 * pressure falls the gas expands by a part of what is pumped. */
static void pumped_up_it_passes_the_limit_point_smoothly(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(
        &b, 2,
        RUBBER("balloons[0].gas.ambient=0.1", "balloons[0].gas.density=1e-6", "balloons[0].gas.pump=0.08"));
    double volume = sim_measure(&b.sim).volume, most = 0, at = 0, last = 0, fastest = 0;
    const double first = volume;
    while (stretch_of(&b) < 2.2) {
        const double before = b.sim.time;
        steps(&b, 10);
        const double now = sim_measure(&b.sim).volume;
        last = 100 * gas_look(&b.sim, b.sim.balloons).gauge_pressure;
        assert_true(now > volume);
        fastest = fmax(fastest, (now - volume) / (b.sim.time - before));
        volume = now;
        if (last > most) {
            most = last;
            at = stretch_of(&b);
        }
        if (stretch_of(&b) > 1.6) /* (1.2 at 1.38, 1.18 at 1.6, .90 at 2.2) */
            assert_true(last < 0.99 * most);
    }
    print_message("# p* %.3f at %.3f, %.3f at the end; volume grew by %.3f of the pump's at the most\n", most,
                  at, last, fastest / (0.08 * first));
    assert_near(most, 1.239, 0.05);
    assert_near(at, 1.383, 0.06);
    assert_near(last, 2 * (1 / 2.2 - pow(2.2, -7)), 0.05);
    assert_true(fastest < 1.4 * 0.08 * first);
    assert_finite(&b.sim);
    close_balloon(&b);
}

/* News of the limit point while the balloon is given a pressure for some time, or until it is three
 * times as large; NULL: none. */
static const char *jump_under(struct balloon *b, double seconds)
{
    const char *told = NULL;
    b->sim.news_count = 0;
    while (b->sim.time < seconds && stretch_of(b) < 7) {
        steps(b, 1);
        for (size_t i = 0; i < b->sim.news_count; i++)
            if (strstr(b->sim.news[i].text, "limit point")) {
                assert_null(told); /* once */
                told = b->sim.news[i].text;
            }
        b->sim.news_count = 0;
    }
    assert_finite(&b->sim);
    return told;
}

/* The limit on 320 triangles is 1.239 but for 1.55 %: 3 % less is held for good, 9 % more by nothing. */
static void under_more_pressure_than_its_limit_it_jumps_and_says_so(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, RUBBER("balloons[0].pressure=0.0120"));
    assert_null(jump_under(&b, 20));
    assert_true(stretch_of(&b) < 1.383);
    close_balloon(&b);

    open_balloon(&b, 2, RUBBER("balloons[0].pressure=0.0135"));
    const char *told = jump_under(&b, 100);
    assert_non_null(told);
    assert_non_null(strstr(told, "at 1.38"));
    assert_non_null(strstr(told, "under 0.0135 nothing but its bursting stops it"));
    assert_true(stretch_of(&b) >= 7);
    close_balloon(&b);
}

/* Mooney's and Rivlin's rubber stiffens again. Where it comes to rest is what was told, to half of the last
 * of three digits and .2 % of creeping. */
static void rubber_that_stiffens_again_jumps_to_where_it_says(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 RUBBER("balloons[0].membrane.law=mooney-rivlin", "balloons[0].pressure=0.0140",
                        "balloons[0].membrane.viscosity=1"));
    const char *told = jump_under(&b, 150);
    assert_non_null(told);
    const char *where = strstr(told, "it jumps to ");
    assert_non_null(where);
    const double stretch = strtod(where + strlen("it jumps to "), NULL);
    print_message("# %s; rests at %.3f\n", told, stretch_of(&b));
    assert_near(stretch_of(&b) / stretch, 1, 0.005);
    assert_true(stretch > 4);
    close_balloon(&b);
}

/* Springs hold (L - 1)/L^2 of something: the most at twice their size. */
static void springs_have_their_limit_point_at_twice_their_size(void **state)
{
    (void)state;
    struct balloon b;
    double held = 0;
    open_balloon(&b, 2,
                 HARD("balloons[0].pressure_on=areas", "balloons[0].pressure=0", "balloons[0].damping=4"));
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        held += 20 * b.sim.rest_length[e] * b.sim.rest_length[e];
    held /= 4 * 3 * sim_measure(&b.sim).volume;
    for (int more = 0; more < 2; more++) {
        b.sim.settings[0].pressure = (more ? 1.05 : 0.9) * held;
        guard_outdated(&b.sim);
        const char *told = jump_under(&b, more ? 60 : 20);
        assert_true((told != NULL) == more);
        assert_true(!told || strstr(told, "at 2 times its size") || strstr(told, "at 2.001 times its size"));
    }
    close_balloon(&b);
}

/* Kinetic, elastic and the gas's energy: sealed gas and still air give and take, dampers only take. */
static double all_energy(struct balloon *b)
{
    return energy_of(b) + effects_energy(&b->sim);
}

/* In the paper's skin, which bursts at a force of 10 a point: filled with ten times the pressure that
 * makes 642 such forces on its area. It never has more than the gas had at first; symplectic Euler keeps
 * that to a factor of 2. */
static void gas_of_ten_times_the_bursting_pressure_at_once(void **state)
{
    (void)state;
    struct balloon b;
    char fill[64];
    snprintf(fill, sizeof fill, "balloons[0].gas.fill=%.17g",
             1 + 10 * (642 * 10 / (4 * M_PI * 45 * 45)) / 0.5);
    open_balloon(&b, 3,
                 SETTINGS("time.guard=substep", "balloons[0].pressure=0", "balloons[0].gas.ambient=0.5",
                          "balloons[0].gas.density=1e-5", fill));
    const double begin = all_energy(&b);
    while (b.sim.time < 5) {
        steps(&b, 1);
        assert_true(energy_of(&b) <= 2 * begin);
    }
    assert_finite(&b.sim);
    assert_true(b.sim.broken > b.sim.edge_count / 4);
    assert_near(effects_energy(&b.sim), 0, 0); /* the gas has left */
    close_balloon(&b);
}

/* The same of a membrane that tears along cracks, at ten times the pressure of its limit point. */
static void a_tearing_skin_under_ten_times_its_limit_at_once(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 RUBBER("time.integrator=symplectic-euler", "balloons[0].gas.ambient=0.01",
                        "balloons[0].gas.fill=13.4", "balloons[0].gas.density=1e-4",
                        "balloons[0].fracture.strength=1.5"));
    const double begin = all_energy(&b);
    while (b.sim.time < 8) {
        steps(&b, 1);
        assert_true(energy_of(&b) <= 2 * begin);
    }
    assert_finite(&b.sim);
    assert_true(sim_measure(&b.sim).torn_length > 0);
    close_balloon(&b);
}

/* Air that presses on a balloon with half of its gas gone squeezes it to about half the volume (its skin
 * takes little of the load), where it stays: the gas is all there, the volume never nothing, and of the air's
 * work nothing is left but what the skin holds. */
static void air_crushes_a_half_empty_balloon_no_further_than_its_gas_allows(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 HARD("balloons[0].pressure=0", "balloons[0].gas.ambient=10", "balloons[0].gas.fill=0.5"));
    const double begin = all_energy(&b), amount = gas_look(&b.sim, b.sim.balloons).amount,
                 rest = sim_measure(&b.sim).volume;
    while (b.sim.time < 20) {
        steps(&b, 1);
        assert_true(all_energy(&b) <= 1.01 * begin);
        assert_true(gas_look(&b.sim, b.sim.balloons).volume > 0.2 * rest);
    }
    const struct gas_look g = gas_look(&b.sim, b.sim.balloons);
    assert_true(g.amount == amount);
    assert_near(g.volume / rest, 0.5, 0.1);
    close_balloon(&b);
}

/* Next to nothing inside: the skin is pushed through itself, whatever the step. That ends the run in the step
 * in which no volume is left, with what has happened, and until then nothing has more energy than the air
 * gives, pa V0, to a factor of 2. */
static void gas_whose_volume_goes_to_nothing_ends_the_run_and_says_so(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 2,
                 HARD("balloons[0].pressure=0", "balloons[0].gas.ambient=10", "balloons[0].gas.fill=1e-6"));
    const double given = 10 * sim_measure(&b.sim).volume;
    enum status status = STATUS_OK;
    while (!status && b.sim.time < 20) {
        status = sim_step(&b.sim, &err);
        assert_true(status || energy_of(&b) <= 2 * given);
        assert_finite(&b.sim);
    }
    assert_refused(status, STATUS_DIVERGED, "its skin has collapsed or turned inside out", &err);
    close_balloon(&b);
}

/* A pump that fills it ten thousand times in the first step, gas that weighs more than its skin, a string
 * that is taut by a radius, air as thick as honey and storm in it: forces that no speed of the start tells
 * of. None is mistaken for numbers that run away, none makes them. */
static void what_pushes_out_of_the_blue_is_no_divergence(void **state)
{
    (void)state;
    static const char *const scenes[][4] = {
        {"balloons[0].gas.ambient=10", "balloons[0].gas.pump=4e5", "balloons[0].gas.pump_until=20",
         "balloons[0].gas.density=1e-5"},
        {"balloons[0].gas.ambient=100", "balloons[0].gas.density=0.2", "gravity.acceleration=[0, -1, 0]",
         "gravity.air_density=0.1"},
        {"balloons[0].string.slack=0.2", "balloons[0].string.stiffness=1e5", "balloons[0].spring=1e-3",
         "balloons[0].damping=0"},
        {"balloons[0].pressure=1000", "drag.air_density=10", "drag.wind=[300, 0, 0]", "balloons[0].spring=1"},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        struct balloon b;
        const char *const *s = scenes[i];
        open_balloon(&b, 1, HARD("balloons[0].pressure=0", s[0], s[1], s[2], s[3]));
        while (b.sim.time < 0.1)
            steps(&b, 1);
        assert_finite(&b.sim);
        close_balloon(&b);
    }
}

/* Air of 10 against points of .11, a thousand of pressure on them: the step that is stable at rest is a
 * hundred times too long once they fly, which happens within it. Drag only takes: with the pressure gone
 * there is never more energy than there was. */
static void drag_that_grows_within_a_step_splits_it_further(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 HARD("drag.air_density=10", "balloons[0].pressure=1000", "schedule[0].at=0.1",
                      "schedule[0].pressure=0", "time.step=0.1"));
    steps(&b, 1);
    const uint32_t first = b.sim.substeps;
    while (b.sim.steps_since % b.sim.substeps)
        steps(&b, 1);
    assert_true(b.sim.substeps > first);
    double before = energy_of(&b);
    for (int i = 0; i < 200; i++) {
        steps(&b, 1);
        assert_true(energy_of(&b) <= 1.001 * before);
        before = energy_of(&b);
    }
    close_balloon(&b);
}

/* Cuts, skin that gets longer, air that comes faster: the bound is found anew as the motion goes on, but none
 * of it brings energy. What runs away while it tears is found out where it begins to, at a thousand times the
 * speed that its pressure can give it, and not when its numbers end. */
static void what_runs_away_while_it_tears_is_found_out_in_time(void **state)
{
    (void)state;
    static const char *const skins[] = {"balloons[0].pressure_on=points",
                                        "balloons[0].membrane.thickness=0.5", "drag.air_density=1e-9"};
    for (int i = 0; i < 3; i++) {
        struct balloon b;
        struct error err = {0};
        enum status status = STATUS_OK;
        open_balloon(&b, 3,
                     SETTINGS("time.integrator=verlet", "balloons[0].fracture.mode=tear",
                              "balloons[0].fracture.strength=1.2", "balloons[0].pressure=10", skins[i],
                              "time.step=0.1"));
        while (!status && b.sim.steps < 1000)
            status = sim_step(&b.sim, &err);
        assert_refused(status, STATUS_DIVERGED, "time.guard=substep splits it", &err);
        const double kinetic = sim_measure(&b.sim).kinetic_energy, can_be = reachable(&b, 10);
        print_message("# at %g s: %.3g times the energy that there can be\n", b.sim.time, kinetic / can_be);
        assert_true(kinetic < 1e9 * can_be); /* in one step it grows a thousandfold at most */
        close_balloon(&b);
    }
}

/* A step is split in a million parts at the most: one that needs more before it is through, here since a
 * balloon is thrown into dense air, goes no further. */
static void what_no_split_follows_any_more_is_refused_within_a_step_too(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, HARD("drag.air_density=10", "drag.wind=[10, 0, 0]", "balloons[0].pressure=0"));
    b.sim.whole_step = b.sim.step = 0.9e6 * guard_stable_step(&b.sim);
    steps(&b, 1);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        b.sim.velocity[p][0] = -1000;
    steps(&b, 1); /* by the bound that was */
    assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED, "is too large to be split: steps up to", &err);
    close_balloon(&b);
}

/* Dense air that blows hard, a bag of stiff gas, stiff strings and arms, arms that give way at once: each is
 * faster than the step can follow. Whether a method solves equations for them, chooses its steps or has them
 * split, energy stays what there is: steps() fails where it does not. */
static void every_method_follows_effects_stiffer_than_its_step(void **state)
{
    (void)state;
    static const char *const stiff[][2] = {
        {"drag.air_density=1", "drag.wind=[-40, -20, -5]"},
        {"balloons[0].gas.ambient=1e4", "balloons[0].gas.fill=1.01"},
        {"balloons[0].string.stiffness=1e5", "balloons[0].string.damping=1e3"},
        {"balloons[0].viscosity.ratio=1e3", "balloons[0].viscosity.time=1"},
        {"balloons[0].viscosity.ratio=1", "balloons[0].viscosity.time=0.005"},
    };
    for (const struct integrator *const *method = integrators; *method; method++)
        for (size_t i = 0; i < sizeof stiff / sizeof stiff[0]; i++) {
            char name[64];
            struct balloon b;
            snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
            open_balloon(&b, 1, HARD("balloons[0].pressure=0", stiff[i][0], stiff[i][1], name));
            disturb(&b, 0.1);
            steps(&b, 20);
            close_balloon(&b);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pumped_up_it_passes_the_limit_point_smoothly),
        cmocka_unit_test(under_more_pressure_than_its_limit_it_jumps_and_says_so),
        cmocka_unit_test(rubber_that_stiffens_again_jumps_to_where_it_says),
        cmocka_unit_test(springs_have_their_limit_point_at_twice_their_size),
        cmocka_unit_test(gas_of_ten_times_the_bursting_pressure_at_once),
        cmocka_unit_test(a_tearing_skin_under_ten_times_its_limit_at_once),
        cmocka_unit_test(air_crushes_a_half_empty_balloon_no_further_than_its_gas_allows),
        cmocka_unit_test(what_pushes_out_of_the_blue_is_no_divergence),
        cmocka_unit_test(drag_that_grows_within_a_step_splits_it_further),
        cmocka_unit_test(what_runs_away_while_it_tears_is_found_out_in_time),
        cmocka_unit_test(gas_whose_volume_goes_to_nothing_ends_the_run_and_says_so),
        cmocka_unit_test(what_no_split_follows_any_more_is_refused_within_a_step_too),
        cmocka_unit_test(every_method_follows_effects_stiffer_than_its_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
