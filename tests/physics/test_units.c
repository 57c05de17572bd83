/* The units of the paper's figure 1 in series and in parallel: creep, relaxation and slip
 * against their closed forms.
 *
 * An icosahedron that swells is one spring: all edges have the length c R, and with a pull T in each the five
 * at a point hold 5 T c/2 against the pressure's force P. Points are light, so that nothing swings. */
#include "sim/let_go.h"
#include "unit/books.h"
#include "unit/differences.h"

#define UNIT(...)                                                                                   \
    SETTINGS("balloons[0].radius=10", "balloons[0].point_mass=0.001", "balloons[0].spring=20",      \
             "balloons[0].threshold=1e300", "time.guard=substep", "time.step=0.01", "time.end=1e6", \
             "time.integrator=symplectic-euler" __VA_OPT__(, ) __VA_ARGS__)

static double chord(void) /* c */
{
    return 1 / sin(2 * M_PI / 5);
}

/* Under P, the edges' pull. */
static double pull_of(double pressure)
{
    return pressure / (2.5 * chord());
}

static double mean_elongation(const struct sim *sim, double rest)
{
    double sum = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++)
        sum += sim_edge_length(sim, e) / sim->edge_count;
    return sum - rest;
}

static void run_to(struct balloon *b, double time)
{
    while (b->sim.time < time - 1e-9)
        steps(b, 1);
}

/* Spring and dashpot side by side (Kelvin and Voigt): e = T/k (1 - exp(-k t/d)). The error is of the first
 * order in the substeps and in the masses that are not quite 0: m/d = 2e-4 s of 0.25. */
static void a_damped_spring_creeps_as_kelvin_and_voigt_say(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0, UNIT("balloons[0].damping=5", "balloons[0].pressure=100"));
    const double final = pull_of(100) / 20, rest = b.sim.rest_length[0];
    for (double time = 0.1; time < 1.5; time += 0.1) {
        run_to(&b, time);
        assert_near(mean_elongation(&b.sim, rest) / final, 1 - exp(-20 * b.sim.time / 5), 0.005);
    }
    close_balloon(&b);
}

/* A Maxwell arm beside the spring, c = 1: at once e = T/(2 k); then it creeps to T/k with the time T (1 + c):
 * e = T/k (1 - exp(-t/2)/2). */
static void a_viscous_spring_creeps_as_its_units_say(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0,
                 UNIT("balloons[0].damping=0.1", "balloons[0].pressure=100", "balloons[0].viscosity.ratio=1",
                      "balloons[0].viscosity.time=1"));
    const double final = pull_of(100) / 20, rest = b.sim.rest_length[0];
    for (double time = 0.2; time < 6; time += 0.4) {
        run_to(&b, time);
        assert_near(mean_elongation(&b.sim, rest) / final, 1 - exp(-b.sim.time / 2) / 2, 0.006);
    }
    close_balloon(&b);
}

/* A method that moves springs by itself asks for the arms alone. Heavy points go by the forces at the
 * start, of which arms are three quarters; it takes ten times shorter steps, in which arms relax by h/(2 T)
 * = 1 % less than in Euler's. */
static void viscous_springs_pull_alike_under_any_method(void **state)
{
    (void)state;
    const char *const methods[] = {"time.integrator=symplectic-euler", "time.integrator=xpbd"};
    struct balloon b[2];
    for (int k = 0; k < 2; k++) {
        open_balloon(&b[k], 1,
                     UNIT("balloons[0].damping=0", "balloons[0].pressure=0", "balloons[0].viscosity.ratio=3",
                          "balloons[0].viscosity.time=0.5", "balloons[0].point_mass=1e6", methods[k]));
        for (uint32_t p = 0; p < b[k].sim.point_count; p++)
            b[k].sim.position[p][0] *= 1.2;
        sim_break_edge(&b[k].sim, 7);
        steps(&b[k], 10);
    }
    const double fastest = largest(b[0].sim.velocity, b[0].sim.point_count);
    assert_true(fastest > 1e-7);
    for (uint32_t p = 0; p < b[0].sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_near(b[1].sim.velocity[p][i], b[0].sim.velocity[p][i], 0.02 * fastest);
    for (uint32_t i = 0; i < b[0].sim.scalar_count; i++)
        assert_near(b[1].sim.scalar[i], b[0].sim.scalar[i], 0.02 * b[0].sim.rest_length[0] / 5);
    close_balloon(&b[0]);
    close_balloon(&b[1]);
}

/* Held at a length its pull relaxes: f = k e (1 + c exp(-t/T)). */
static void a_viscous_spring_that_is_held_relaxes(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0,
                 UNIT("balloons[0].damping=0", "balloons[0].pressure=0", "balloons[0].viscosity.ratio=3",
                      "balloons[0].viscosity.time=0.5", "balloons[0].point_mass=1e9"));
    struct sim *sim = &b.sim;
    const double rest = sim->rest_length[0], e = 0.2 * rest;
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            sim->position[p][i] *= 1.2;
    for (double time = 0; time < 2; time += 0.25) {
        run_to(&b, time);
        sim_forces(sim);
        const double force = sqrt(sim->force[0][0] * sim->force[0][0] + sim->force[0][1] * sim->force[0][1] +
                                  sim->force[0][2] * sim->force[0][2]);
        /* Euler's exp(-t/T) with h/T = .02 is off by t h/(2 T^2) of itself: 1 % at T. */
        assert_near(force / (2.5 * chord()) / (20 * e), 1 + 3 * exp(-sim->time / 0.5), 3 * 0.01);
    }
    close_balloon(&b);
}

/* Past the yield y = 20 with H = 10: it slips until T = y + H s, and what has slipped stays
 * when the pressure is gone. */
static void a_spring_that_slips_keeps_its_length(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0,
                 UNIT("balloons[0].damping=1", "balloons[0].pressure=100", "balloons[0].plasticity.yield=20",
                      "balloons[0].plasticity.hardening=10"));
    const double rest = b.sim.rest_length[0], pull = pull_of(100), slip = (pull - 20) / 10;
    run_to(&b, 5);
    assert_near(mean_elongation(&b.sim, rest), pull / 20 + slip, 1e-3);
    b.sim.balloons[0].now->pressure = 0;
    run_to(&b, 10);
    assert_near(mean_elongation(&b.sim, rest), slip, 1e-3);
    close_balloon(&b);
}

/* Below the yield nothing slips, and no bit is another than without the block. */
static void a_spring_that_is_not_pulled_hard_does_not_slip(void **state)
{
    (void)state;
    struct balloon b, plain;
    open_balloon(&b, 1, UNIT("balloons[0].plasticity.yield=1e6"));
    open_balloon(&plain, 1, UNIT());
    steps(&b, 50);
    steps(&plain, 50);
    assert_memory_equal(b.sim.position, plain.sim.position, b.sim.point_count * sizeof *b.sim.position);
    close_balloon(&b);
    close_balloon(&plain);
}

/* Steps that need not look at every spring leave none that pulls with more than it can hold, as what was
 * slack comes under a pull; and one that slips stops where it holds again. 1e-9: to round-off. */
static void every_spring_slips_in_the_step_in_which_it_must(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 UNIT("balloons[0].damping=1", "balloons[0].pressure=100", "balloons[0].plasticity.yield=30",
                      "balloons[0].plasticity.hardening=5", "time.step=0.002"));
    const struct sim *sim = &b.sim;
    uint32_t slack = 0, slipped = 0;
    double *before = calloc(sim->edge_count, sizeof *before);
    for (int i = 0; i < 400; i++) {
        memcpy(before, sim->balloons[0].slip, sim->edge_count * sizeof *before);
        steps(&b, 1);
        for (uint32_t e = 0; e < sim->edge_count; e++) {
            const double pull = sim->current_spring_const[e] *
                                (sim_edge_length(sim, e) - sim->rest_length[e]),
                         held = 30 + 5 * sim->balloons[0].slip[e];
            assert_true(fabs(pull) <= held * (1 + 1e-9));
            if (sim->balloons[0].slip[e] > before[e])
                assert_near(fabs(pull), held, 1e-9 * held);
            slipped += sim->balloons[0].slip[e] > 0;
            slack += fabs(pull) < 0.9 * held;
        }
    }
    assert_true(slack > 0 && slipped > 0);
    free(before);
    close_balloon(&b);
}

/* What the arms hold and take is in the ledger: Euler's error, with a step of T/100. */
static void viscosity_is_in_the_ledger(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 UNIT("balloons[0].damping=0.1", "balloons[0].point_mass=0.1",
                      "balloons[0].viscosity.ratio=1", "balloons[0].pressure=0", "time.step=0.002",
                      "balloons[0].viscosity.time=0.2"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        b.sim.position[p][0] *= 1.2;
    open_books(&b);
    steps(&b, 500);
    const struct ledger_balance account = balance(&b);
    assert_true(account.dissipated > 1);
    assert_near(account.error, 0, 0.02 * account.dissipated);
    close_balloon(&b);
}

/* A spring that slips lets its arm go by the same way, and what both held is booked: what is left is the
 * method's error, 5e-9 with steps of T/100. */
static void what_an_arm_loses_to_slip_is_in_the_ledger(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 UNIT("balloons[0].damping=0.1", "balloons[0].point_mass=0.1",
                      "balloons[0].viscosity.ratio=3", "balloons[0].viscosity.time=0.2", "time.step=0.002",
                      "balloons[0].plasticity.yield=5", "balloons[0].pressure=0", "time.integrator=rk4"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] *= 1.2;
    open_books(&b);
    steps(&b, 50);
    const struct ledger_balance account = balance(&b);
    assert_true(b.sim.balloons[0].slip[0] > 0 && account.dissipated > 1);
    assert_near(account.error, 0, 1e-6 * account.dissipated);
    close_balloon(&b);
}

/* All edges of a held, stretched balloon let go, one after the other: what was in springs and
 * arms is booked, to the rounding of its sum. A unit that slips holds nothing itself: what it
 * took was booked as it slipped. */
static void what_breaks_takes_its_units_energy_along(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 UNIT("balloons[0].viscosity.ratio=3", "balloons[0].plasticity.yield=5",
                      "balloons[0].pressure=0", "balloons[0].damping=0"));
    struct sim *sim = &b.sim;
    for (uint32_t p = 0; p < sim->point_count; p++)
        sim->position[p][0] *= 1.2;
    open_books(&b);
    steps(&b, 3);
    struct sim_measures m = sim_measure(sim);
    const struct ledger_balance before = ledger_balance(sim, &m);
    assert_true(before.gas > 0.01 * m.elastic_energy && m.elastic_energy > 0 && before.dissipated > 0);
    for (uint32_t e = 0; e < sim->edge_count; e++)
        sim_break_edge(sim, e);
    const double held = m.elastic_energy + before.gas;
    m = sim_measure(sim);
    const struct ledger_balance after = ledger_balance(sim, &m);
    assert_near(after.fracture, held, 1e-12 * held);
    assert_near(after.error, before.error, 1e-12 * held);
    assert_near(m.elastic_energy + after.gas, 0, 0);
    close_balloon(&b);
}

static void viscous_springs_are_equal_for_any_number_of_threads(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 2, UNIT("balloons[0].viscosity.ratio=1", "balloons[0].plasticity.yield=2"));
    uint64_t first = 0;
    for (unsigned workers = 1; workers < 6; workers += 2) {
        struct sim sim;
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers, &err), &err);
        for (int i = 0; i < 30; i++)
            assert_ok(sim_step(&sim, &err), &err);
        if (workers == 1)
            first = sim_hash(&sim);
        assert_true(sim_hash(&sim) == first);
        sim_clear(&sim);
    }
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damped_spring_creeps_as_kelvin_and_voigt_say),
        cmocka_unit_test(a_viscous_spring_creeps_as_its_units_say),
        cmocka_unit_test(viscous_springs_pull_alike_under_any_method),
        cmocka_unit_test(a_viscous_spring_that_is_held_relaxes),
        cmocka_unit_test(a_spring_that_slips_keeps_its_length),
        cmocka_unit_test(a_spring_that_is_not_pulled_hard_does_not_slip),
        cmocka_unit_test(every_spring_slips_in_the_step_in_which_it_must),
        cmocka_unit_test(viscosity_is_in_the_ledger),
        cmocka_unit_test(what_an_arm_loses_to_slip_is_in_the_ledger),
        cmocka_unit_test(what_breaks_takes_its_units_energy_along),
        cmocka_unit_test(viscous_springs_are_equal_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
