/* Gas against the laws of an ideal gas: amounts, pressures, energies and thrust. */
#include "common/vec3.h"
#include "gas.h"
#include "sim/gas.h"

/* Six numbers of each sum of some 320 terms are rounded: 1e-13 is generous. */
static void what_fills_a_balloon_is_as_asked(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, GAS("balloons[0].gas.fill=3"));
    const struct gas_look g = look(&b);
    const double volume = sim_measure(&b.sim).volume;
    assert_near(g.volume, volume, 1e-12 * volume);
    assert_near(g.amount, 30 * volume, 1e-12 * 30 * volume);
    assert_near(g.gauge_pressure, 20, 1e-11);
    close_balloon(&b);
}

/* p V stays, or p V^1.4, whatever the skin does: to the rounding of a power. */
static void sealed_gas_keeps_to_its_law(void **state)
{
    (void)state;
    for (int adiabatic = 0; adiabatic < 2; adiabatic++) {
        struct balloon b;
        open_balloon(&b, 2,
                     GAS("balloons[0].gas.fill=3", adiabatic ? "balloons[0].gas.process=adiabatic"
                                                             : "balloons[0].gas.process=isothermal"));
        const struct gas_look first = look(&b);
        const double g = adiabatic ? 1.4 : 1;
        for (int i = 0; i < 20; i++) {
            steps(&b, 10);
            const struct gas_look now = look(&b);
            assert_near((now.gauge_pressure + 10) * pow(now.volume / first.volume, g), 30, 1e-11);
            assert_true(now.amount == first.amount && now.brought == 0);
        }
        assert_true(look(&b).volume > 1.2 * first.volume);
        close_balloon(&b);
    }
}

/* What the pressure does on the skin is what the gas loses: force . dx = -dE, by central differences over
 * 1e-5 of the radius: the third derivative's share is (1e-5)^2, rounding 1e-16/1e-5. */
static void its_push_is_the_derivative_of_its_energy(void **state)
{
    (void)state;
    for (int adiabatic = 0; adiabatic < 2; adiabatic++) {
        struct balloon b;
        open_balloon(
            &b, 2,
            GAS("balloons[0].gas.fill=3", "balloons[0].spring=0", "balloons[0].damping=0",
                adiabatic ? "balloons[0].gas.process=adiabatic" : "balloons[0].gas.process=isothermal"));
        double work = 0, energy[2];
        sim_forces(&b.sim);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int i = 0; i < 3; i++)
                work += b.sim.force[p][i] * sin(p + i);
        for (int side = 0; side < 2; side++) {
            const double h = 1e-5 * 45;
            for (uint32_t p = 0; p < b.sim.point_count; p++)
                for (int i = 0; i < 3; i++)
                    b.sim.position[p][i] += (side ? -2 : 1) * h * sin(p + i);
            energy[side] = effects_energy(&b.sim) / (2 * h);
        }
        assert_near(work, energy[1] - energy[0], 1e-8 * fabs(energy[0]) + 1e-8 * fabs(work));
        close_balloon(&b);
    }
}

/* A rigid vessel (heavy points): N falls as exp(-leak pa t/V) towards what is in balance, with an error of
 * the method's: dt k/2 of symplectic Euler, k t = 1, in 200 steps: .5/200. */
static void a_slow_leak_decays_exponentially(void **state)
{
    (void)state;
    struct balloon b;
    const double volume = 4.0 / 3 * M_PI * pow(45, 3), leak = volume / 10;
    char text[64];
    snprintf(text, sizeof text, "balloons[0].gas.leak=%.17g", leak);
    open_balloon(&b, 3, GAS("balloons[0].gas.fill=3", "balloons[0].point_mass=1e9", text));
    const struct gas_look first = look(&b);
    const double rate = leak * 10 / first.volume;
    steps(&b, 200);
    const double wanted = 20 * exp(-rate * 1);
    assert_near(look(&b).gauge_pressure, wanted, 20 * rate * 0.005);
    assert_near(look(&b).amount, first.amount + look(&b).brought, 1e-13 * first.amount);
    close_balloon(&b);
}

/* 1.5 of a fill a second, from 1 until 1.3 is reached, and no more than that. */
static void a_pump_stops_where_it_should(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, GAS("balloons[0].gas.pump=1.5", "balloons[0].gas.pump_until=1.303"));
    const double full = look(&b).amount;
    steps(&b, 20);
    assert_near(look(&b).amount, 1.15 * full, 1e-12 * full);
    steps(&b, 60);
    assert_near(look(&b).amount, 1.303 * full, 1e-12 * full); /* no whole number of steps */
    close_balloon(&b);
}

/* Into a rigid vessel (heavy points): dp = dN/V at constant temperature; where heat stays in, what is pressed
 * in brings its enthalpy, and dp = gamma dN/V. The vessel gives way by 1e-7. */
static void what_is_pumped_in_brings_its_heat(void **state)
{
    (void)state;
    for (int adiabatic = 0; adiabatic < 2; adiabatic++) {
        struct balloon b;
        open_balloon(
            &b, 2,
            GAS("balloons[0].gas.pump=0.5", "balloons[0].point_mass=1e9", "time.integrator=rk4",
                adiabatic ? "balloons[0].gas.process=adiabatic" : "balloons[0].gas.process=isothermal"));
        steps(&b, 400);
        assert_near(look(&b).gauge_pressure, (adiabatic ? 1.4 : 1) * 0.5 * 2 * 10, 1e-5);
        close_balloon(&b);
    }
}

/* Drawn out at 1.5 of a fill a second, 2 become 1.85 in a tenth; in a vessel that gives way to nothing it
 * ends at the air's pressure, which the rest nears by a half in each step. */
static void a_pump_that_is_turned_round_draws_gas_out_down_to_the_airs_pressure(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 GAS("balloons[0].gas.fill=2", "balloons[0].gas.pump=-1.5", "balloons[0].point_mass=1e9"));
    const double full = look(&b).amount / 2;
    steps(&b, 20);
    assert_near(look(&b).amount, 1.85 * full, 1e-12 * full);
    assert_near(look(&b).brought, -0.15 * full, 1e-12 * full);
    steps(&b, 300);
    /* A force of some 20 x 150 moves 1e9 in 1.6 s by 4e-6, the volume by 3 x that/45, and 10 of
     * pressure by as much of itself. */
    assert_near(look(&b).gauge_pressure, 0, 3e-6);
    close_balloon(&b);
}

/* As the user turns it, between two steps. */
static void the_schedule_turns_the_pump(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 GAS("schedule[0].at=0.05", "schedule[0].pump=2", "schedule[1].at=0.1",
                     "schedule[1].pump_until=1.05"));
    const double full = look(&b).amount;
    steps(&b, 10);
    assert_near(look(&b).amount, full, 1e-12 * full);
    steps(&b, 10);
    assert_near(look(&b).amount, 1.1 * full, 1e-12 * full);
    steps(&b, 10);
    assert_near(look(&b).amount, 1.1 * full, 1e-12 * full);
    close_balloon(&b);
}

/* The textbook's numbers for air: the flow into nothing is choked, with p sqrt(gamma/(r p)) (2/2.4)^3 of
 * flux; just above the ratio .52828 it no longer is; and gentle flow is Bernoulli's, sqrt(2 r dp), to the
 * share of dp/p in compression (3/4 gamma of it, Shapiro). */
static void openings_let_out_what_shapiro_says(void **state)
{
    (void)state;
    const struct gas_jet none = gas_jet(1e5, 1.2, 0, 1.4, 1), choked = gas_jet(1e5, 1.2, 0.528e5, 1.4, 1),
                         free = gas_jet(1e5, 1.2, 0.529e5, 1.4, 1);
    assert_near(none.flux, sqrt(1.4 * 1e5 * 1.2) * pow(2 / 2.4, 3), 1e-10 * none.flux);
    assert_true(choked.flux == none.flux && free.flux < none.flux);
    assert_near(pow(2 / 2.4, 3.5), 0.52828, 5e-6);
    const struct gas_jet gentle = gas_jet(1.001e5, 1.2, 1e5, 1.4, 0.6);
    assert_near(gentle.flux, 0.6 * sqrt(2 * 1.2 * 100), 0.6 * sqrt(240) * 1e-3);
    assert_near(gentle.thrust, 0.6 * 2 * 100, 120 * 1e-3);
}

/* It empties through a neck of 30 at the bottom, choked at first, and flies off. What it gains in momentum is
 * the sum of the thrusts, to the rounding of the springs' forces, which cancel; and nothing pushes it while
 * it draws in air, as its skin swings back. */
static void an_open_neck_makes_it_fly(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 GAS("balloons[0].gas.fill=2.5", "balloons[0].gas.neck=30", "balloons[0].gas.neck_at=0.1",
                     "balloons[0].gas.density=0.001"));
    const double before = look(&b).amount;
    steps(&b, 20);
    assert_true(look(&b).amount == before && b.sim.news_count == 1);
    double momentum = 0, thrust = 0;
    for (int i = 0; i < 100; i++) {
        const double gauge = look(&b).gauge_pressure;
        double force = 0;
        steps(&b, 1);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            force += b.sim.force[p][1];
        assert_true(gauge > 0 ? force > 0 : fabs(force) < 1e-9);
        thrust += 0.005 * force;
    }
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        momentum += b.sim.mass[p] * b.sim.velocity[p][1];
    assert_near(momentum, thrust, 1e-9 * thrust);
    assert_true(look(&b).amount < before);
    assert_near(look(&b).amount, before + look(&b).brought, 1e-13 * before);
    close_balloon(&b);
}

/* Choked all the time, at constant temperature, out of a rigid vessel into nearly nothing, the amount falls
 * exponentially: flux is in proportion to the pressure. dN/dt = -C A sqrt(gamma pa/r) (2/(gamma + 1))^((gamma
 * + 1)/(2 (gamma - 1))) N/V. The method's error is k dt/2 of it. */
static void a_choked_neck_empties_exponentially(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3,
                 GAS("balloons[0].gas.fill=100", "balloons[0].gas.neck=5000", "balloons[0].gas.density=0.01",
                     "balloons[0].point_mass=1e9"));
    const struct gas_look first = look(&b);
    const double rate = 0.6 * 5000 * sqrt(1.4 * 10 / 0.01) * pow(2 / 2.4, 3) / first.volume;
    steps(&b, 400);
    const double wanted = exp(-rate * 2);
    assert_true(wanted < 0.9);
    assert_near(look(&b).amount / first.amount, wanted, rate * rate * 0.005 + 1e-6);
    close_balloon(&b);
}

/* Two equal balloons, one of them fuller: what flows over is never lost, they end alike, and the fuller one
 * never the emptier: pressures within a thousandth after 2 s (they even out with sqrt(2 dp/r), in about V
 * dp/(C A sqrt(..) p), a twentieth of a second). */
static void a_tube_evens_two_balloons_out(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    struct mesh meshes[2];
    struct sim sim;
    const char *const settings[] = {
        "balloons[1].mesh=\"sphere\"", "balloons[1].position=[200, 0, 0]", "time.step=0.005",
        "balloons[0].gas.ambient=10",  "balloons[0].gas.fill=1.6",         "balloons[0].gas.density=0.001",
        "balloons[1].gas.ambient=10",  "balloons[1].gas.fill=1.1",         "balloons[1].gas.density=0.001",
        "balloons[0].tube.to=1",       "balloons[0].tube.area=5000",       "balloons[0].threshold=100",
        "balloons[1].threshold=100"};
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        assert_ok(scene_set(&scene, settings[i], &err), &err);
    assert_ok(scene_check(&scene, &err), &err);
    shape_icosphere(2, &meshes[0]);
    shape_icosphere(2, &meshes[1]);
    assert_ok(sim_open(&sim, &scene, meshes, 1, &err), &err);
    const double before = gas_look(&sim, &sim.balloons[0]).amount + gas_look(&sim, &sim.balloons[1]).amount;
    for (int i = 0; i < 1000; i++) {
        assert_ok(sim_step(&sim, &err), &err);
        assert_near(gas_look(&sim, &sim.balloons[0]).amount + gas_look(&sim, &sim.balloons[1]).amount, before,
                    1e-13 * before);
    }
    const struct gas_look a = gas_look(&sim, &sim.balloons[0]), b = gas_look(&sim, &sim.balloons[1]);
    assert_near(a.gauge_pressure, b.gauge_pressure, 1e-3 * 10);
    assert_near(a.amount, b.amount, 1e-2 * a.amount);
    sim_clear(&sim);
    mesh_clear(&meshes[0]);
    mesh_clear(&meshes[1]);
    scene_clear(&scene);
}

/* The balance of energies, with everything that gas can do; its error falls with the method's order (RK4: 16
 * at half the step; 10 leaves room for the next order). */
static double balance_error(const char *step, const char *more, const char *again, double *scale)
{
    struct sim_measures end;
    const struct ledger_balance account = balance_of_run(
        GAS("balloons[0].gas.fill=3", "time.integrator=rk4", step, "balloons[0].gas.leak=300",
            "balloons[0].gas.process=adiabatic", "balloons[0].gas.pump=0.4", more, again),
        &end);
    *scale = account.gas;
    return account.error;
}

static void the_balance_of_energies_holds(void **state)
{
    (void)state;
    for (int open = 0; open < 2; open++) {
        double scale;
        const char *more = open ? "balloons[0].gas.neck=100" : "balloons[0].gas.neck=0";
        const char *again = "balloons[0].gas.density=0.0001";
        const double coarse = balance_error("time.step=0.004", more, again, &scale),
                     fine = balance_error("time.step=0.002", more, again, &scale);
        print_message("# balance %.3g, %.3g of %.3g\n", coarse, fine, scale);
        assert_true(fabs(fine) < fabs(coarse) / 10 || fabs(fine) < 1e-12 * scale);
    }
}

/* 1, 2 and 5 threads: the same bits. */
static void any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    uint64_t hash[3];
    const unsigned workers[3] = {1, 2, 5};
    for (int i = 0; i < 3; i++) {
        struct balloon b;
        struct error err = {0};
        open_balloon(
            &b, 4,
            GAS("balloons[0].gas.fill=2.5", "balloons[0].gas.neck=30", "balloons[0].gas.density=0.001"));
        sim_clear(&b.sim);
        assert_ok(sim_open(&b.sim, &b.scene, &b.mesh, workers[i], &err), &err);
        steps(&b, 40);
        hash[i] = sim_hash(&b.sim);
        close_balloon(&b);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
}

/* A skin that is pushed through itself has no volume that gas could fill: the run ends, and says why. */
static void a_volume_below_nothing_is_refused(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 2, GAS("balloons[0].gas.fill=1"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] = -b.sim.position[p][i];
    assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED, "inside out", &err);
    close_balloon(&b);
}

/* All forces together are the jet's: C A (g pe M^2 + pe - pa), with Mach's number M of the stream and its
 * pressure pe at the neck, pa below the speed of sound. Those on a closed skin add up to 0, to rounding of
 * some 1e4. */
static void the_neck_pushes_back_as_the_jet_streams(void **state)
{
    (void)state;
    static const double fills[] = {1.01, 1.5, 3};
    for (size_t i = 0; i < sizeof fills / sizeof fills[0]; i++) {
        struct balloon b;
        char fill[40];
        snprintf(fill, sizeof fill, "balloons[0].gas.fill=%g", fills[i]);
        open_balloon(&b, 2, GAS(fill, "balloons[0].gas.neck=30", "balloons[0].gas.density=0.001"));
        const double g = 1.4, p = 10 * fills[i], critical = p * pow(2 / (g + 1), g / (g - 1)),
                     at_neck = fmax(10, critical),
                     mach_squared = 2 / (g - 1) * (pow(p / at_neck, (g - 1) / g) - 1);
        double force[3] = {0};
        sim_forces(&b.sim);
        for (uint32_t k = 0; k < b.sim.point_count; k++)
            for (int c = 0; c < 3; c++)
                force[c] += b.sim.force[k][c];
        const double push = 0.6 * 30 * (g * at_neck * mach_squared + at_neck - 10);
        assert_near(vec3_length(force), push, 1e-9 * push);
        assert_true(force[1] > 0.99 * push);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fills_a_balloon_is_as_asked),
        cmocka_unit_test(sealed_gas_keeps_to_its_law),
        cmocka_unit_test(its_push_is_the_derivative_of_its_energy),
        cmocka_unit_test(a_slow_leak_decays_exponentially),
        cmocka_unit_test(a_pump_stops_where_it_should),
        cmocka_unit_test(what_is_pumped_in_brings_its_heat),
        cmocka_unit_test(a_pump_that_is_turned_round_draws_gas_out_down_to_the_airs_pressure),
        cmocka_unit_test(the_schedule_turns_the_pump),
        cmocka_unit_test(openings_let_out_what_shapiro_says),
        cmocka_unit_test(an_open_neck_makes_it_fly),
        cmocka_unit_test(the_neck_pushes_back_as_the_jet_streams),
        cmocka_unit_test(a_choked_neck_empties_exponentially),
        cmocka_unit_test(a_tube_evens_two_balloons_out),
        cmocka_unit_test(the_balance_of_energies_holds),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(a_volume_below_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
