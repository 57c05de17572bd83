/* The ledger: what comes in goes out or is there, and keeping accounts changes nothing. */
#include "books.h"
#include "sim/let_go.h"
#include "sim/live.h"

/* The balance's error after .2 s of swelling, at this step; the greatest energy in play goes to *scale. */
static double error_at(const char *integrator, double step, double *scale)
{
    char name[64], text[64];
    snprintf(name, sizeof name, "time.integrator=%s", integrator);
    snprintf(text, sizeof text, "time.step=%.17g", step);
    struct sim_measures end;
    const struct ledger_balance account = balance_of_run(
        SETTINGS(name, text, "balloons[0].pressure=4", "time.end=0.2"), &end);
    assert_true(account.pressure_work > 0 && account.dissipated > 0);
    *scale = account.pressure_work;
    return account.error;
}

/* The scalars are integrated as the points are, so the balance is as good as they are. Halving the step
 * divides the error by 2^order, up to the next order's share: within a tenth of the order at these
 * steps. Where the error is down at the round-off of a few hundred steps (1e-13 of the work) there is
 * nothing left to be halved. */
static void its_error_falls_with_the_integrators_order(void **state)
{
    (void)state;
    for (size_t i = 0; integrators[i]; i++) {
        if (integrators[i]->flags & INTEGRATOR_ADAPTIVE)
            continue;
        double scale, coarse = error_at(integrators[i]->name, 0.002, &scale),
                      fine = error_at(integrators[i]->name, 0.001, &scale);
        print_message("# %s: %.3g, %.3g of %.3g\n", integrators[i]->name, coarse, fine, scale);
        if (fabs(fine) < 1e-12 * scale)
            continue;
        assert_true(log2(fabs(coarse / fine)) > integrators[i]->order - 0.1);
    }
}

/* Nothing is pressed and nothing moves: not even round-off. */
static void at_rest_all_accounts_stay_at_zero(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=0"));
    open_books(&b);
    steps(&b, 100);
    const struct ledger_balance account = balance(&b);
    assert_memory_equal(&account, &(struct ledger_balance){0}, sizeof account);
    close_balloon(&b);
}

/* An edge lets go at one moment: what its spring held goes over into the account, so the sum stays, up to the
 * round-off of adding up the energies of all edges (1e-16 x their number x their sum). */
static void what_a_breaking_edge_held_is_counted_exactly(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=4"));
    open_books(&b);
    steps(&b, 10);
    const double before = balance(&b).error, elastic = sim_measure(&b.sim).elastic_energy;
    assert_true(elastic > 0);
    for (uint32_t e = 0; e < b.sim.edge_count; e += 2)
        sim_break_edge(&b.sim, e);
    const struct ledger_balance after = balance(&b);
    assert_true(after.fracture > 0.3 * elastic);
    assert_near(after.error, before, 1e-16 * b.sim.edge_count * elastic);
    close_balloon(&b);
}

/* Between two steps, where no step sees it go. */
static void what_a_pricked_triangle_held_is_counted_exactly(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].membrane.thickness=0.45", "balloons[0].pressure_on=areas",
                          "balloons[0].pressure=0.2"));
    open_books(&b);
    steps(&b, 10);
    struct live live = {.sim = &b.sim};
    const struct hand_hit hit = {.triangle = 7};
    const double before = balance(&b).error, elastic = sim_measure(&b.sim).elastic_energy;
    live_prick(&live, &hit);
    const double held = elastic - sim_measure(&b.sim).elastic_energy;
    assert_true(held > 1e-3 * elastic);
    assert_near(balance(&b).fracture, held, 1e-13 * elastic);
    assert_near(balance(&b).error, before, 1e-13 * elastic);
    close_balloon(&b);
}

/* A ratio of 0 leaves no arms, whatever is in the numbers that come after the springs'. */
static void an_edge_without_an_arm_held_nothing_in_it(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=4", "balloons[0].viscosity.ratio=0"));
    open_books(&b);
    steps(&b, 10);
    double held = 0;
    b.sim.scalar[0] = INFINITY;
    for (uint32_t e = 0; e < b.sim.edge_count; e++) {
        held += sim_spring_energy(&b.sim, e);
        sim_break_edge(&b.sim, e);
    }
    assert_near(b.sim.ledger.account.fracture, held, 1e-16 * b.sim.edge_count * held);
    close_balloon(&b);
}

/* Arms are as stiff as their springs. */
static void a_scheduled_change_of_springs_is_the_users_work(void **state)
{
    (void)state;
    static const char *const arms[] = {"balloons[0].viscosity.ratio=0", "balloons[0].viscosity.ratio=2"};
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_balloon(&b, 2,
                     SETTINGS("balloons[0].pressure=4", arms[i], "schedule[0].at=0.25",
                              "schedule[0].spring_factor=3"));
        open_books(&b);
        steps(&b, 10);
        const struct ledger_balance before = balance(&b);
        const double held = sim_measure(&b.sim).elastic_energy + before.gas;
        assert_true(i == 0 ? before.gas == 0 : before.gas > 0.1 * held);
        sim_change(&b.sim, &b.scene.schedule[0]);
        const struct ledger_balance after = balance(&b);
        assert_near(after.user_work, 2 * held, 1e-16 * b.sim.edge_count * held);
        assert_near(after.error, before.error, 1e-16 * b.sim.edge_count * 3 * held);
        close_balloon(&b);
    }
}

/* From the start to the dust, with first order's error of the paper's step: the sum
 * holds to a few per cent. */
static void it_balances_through_a_burst(void **state)
{
    (void)state;
    double error[2];
    static const char *const step[] = {"time.step=0.002", "time.step=0.001"};
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_balloon(&b, 3, SETTINGS(step[i], "balloons[0].pressure=10", "balloons[0].threshold=1.3"));
        open_books(&b);
        while (b.sim.time < 1)
            steps(&b, 1);
        const struct ledger_balance account = balance(&b);
        assert_true(b.sim.broken > 100 && account.fracture > 0);
        error[i] = fabs(account.error) / account.pressure_work;
        close_balloon(&b);
    }
    assert_true(error[0] < 0.02 && error[1] < 0.6 * error[0]);
}

/* Where a method looks back inside a step, what broke at its end is whole again, also in the accounts: the
 * error stays that of the tolerance (1e-5 a step), far below what the springs that let go had held. */
static void a_look_inside_a_step_finds_the_accounts_as_they_were(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("time.integrator=rk-adaptive", "balloons[0].pressure=30",
                          "balloons[0].threshold=1.2", "time.end=1"));
    open_books(&b);
    double held = 0;
    while (!sim_at_end(&b.sim)) {
        const double before = b.sim.time, fracture = b.sim.ledger.account.fracture;
        steps(&b, 1);
        const struct ledger_balance now = balance(&b);
        held = fmax(held, now.fracture - fracture);
        sim_look(&b.sim, (before + b.sim.time) / 2);
        const struct ledger_balance then = balance(&b);
        assert_near(then.fracture, fracture, 0);
        assert_near(then.error, now.error, 1e-3 * now.pressure_work);
        sim_look_end(&b.sim);
        const struct ledger_balance again = balance(&b);
        assert_memory_equal(&again, &now, sizeof now);
        if (held > 0.1 * now.pressure_work)
            break;
    }
    assert_true(held > 0);
    close_balloon(&b);
}

/* A row of a log between two steps: the accounts there are as good as at the steps' ends, by 1e-6 of the work
 * at a tolerance of 1e-8. */
static void accounts_inside_a_step_balance_as_well_as_at_its_end(void **state)
{
    (void)state;
    static const char *const methods[] = {"rk-adaptive", "cvode-adams", "cvode-bdf"};
    for (int i = 0; i < 3; i++) {
        struct balloon b;
        char integrator[64];
        snprintf(integrator, sizeof integrator, "time.integrator=%s", methods[i]);
        open_balloon(&b, 2,
                     SETTINGS(integrator, "time.tolerance=1e-8", "time.step=0.05", "time.end=0.3",
                              "balloons[0].pressure=4"));
        open_books(&b);
        double inside = 0, work = 0;
        while (!sim_at_end(&b.sim)) {
            const double before = b.sim.time;
            steps(&b, 1);
            sim_look(&b.sim, before + 0.3 * (b.sim.time - before));
            inside = fmax(inside, fabs(balance(&b).error));
            sim_look_end(&b.sim);
            work = fmax(work, balance(&b).pressure_work);
        }
        print_message("# %s: %.3g of %.3g\n", methods[i], inside, work);
        assert_true(inside < 1e-6 * work);
        close_balloon(&b);
    }
}

static void the_accounts_are_equal_to_the_bit_for_any_number_of_threads(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon one;
    open_balloon(&one, 3, SETTINGS("balloons[0].pressure=10", "balloons[0].threshold=1.2"));
    open_books(&one);
    steps(&one, 40);
    const struct ledger_balance wanted = balance(&one);
    for (unsigned workers = 2; workers < 8; workers += 5) {
        struct sim sim;
        assert_ok(sim_open(&sim, &one.scene, &one.mesh, workers, &err), &err);
        assert_ok(ledger_open(&sim, &err), &err);
        for (int i = 0; i < 40; i++)
            assert_ok(sim_step(&sim, &err), &err);
        const struct sim_measures m = sim_measure(&sim);
        const struct ledger_balance got = ledger_balance(&sim, &m);
        assert_memory_equal(&got, &wanted, sizeof got);
        sim_clear(&sim);
    }
    close_balloon(&one);
}

/* The state after 60 steps, in which something breaks or not. */
static uint64_t hash_of(const char *const *settings, bool books, bool bursts)
{
    struct balloon b;
    open_balloon(&b, 2, settings);
    if (books)
        open_books(&b);
    steps(&b, 60);
    assert_true(b.sim.broken > 0 || !bursts);
    const uint64_t hash = sim_hash(&b.sim);
    close_balloon(&b);
    return hash;
}

/* With every method, across a burst; and where the guard goes by how far rubber, gas and hinges have come. */
static void keeping_accounts_changes_no_bit_of_the_state(void **state)
{
    (void)state;
    for (size_t i = 0; integrators[i]; i++) {
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", integrators[i]->name);
        const char *const *const scenes[] = {
            SETTINGS(name, "balloons[0].pressure=30", "balloons[0].threshold=1.2", "time.step=0.01"),
            SETTINGS(name, "balloons[0].pressure=0", "balloons[0].gas.ambient=6", "balloons[0].gas.pump=9"),
            SETTINGS(name, "balloons[0].membrane.thickness=0.45", "balloons[0].pressure_on=areas",
                     "balloons[0].pressure=0.3"),
            SETTINGS(name, "balloons[0].bending.stiffness=1", "balloons[0].pressure=-10")};
        const size_t count = strcmp(integrators[i]->name, "xpbd") ? 4 : 2; /* which moves springs only */
        for (size_t k = 0; k < count; k++)
            if (hash_of(scenes[k], true, k == 0) != hash_of(scenes[k], false, k == 0))
                fail_msg("%s, %zu: another state when accounts are kept", integrators[i]->name, k);
    }
}

/* Springs so stiff that it tries implicit methods, which work out forces for the accounts alone. */
static void what_auto_counts_has_none_of_the_accounts_work(void **state)
{
    (void)state;
    const char *const *const stiff = SETTINGS("time.integrator=auto", "balloons[0].spring=1e6",
                                              "balloons[0].threshold=100", "balloons[0].pressure=0.1");
    assert_true(hash_of(stiff, true, false) == hash_of(stiff, false, false));
}

static void nothing_is_counted_unless_it_is_asked_for(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    steps(&b, 10);
    assert_int_equal(b.sim.scalar_count, 0);
    const struct ledger_balance account = balance(&b);
    assert_memory_equal(&account, &(struct ledger_balance){0}, sizeof account);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_error_falls_with_the_integrators_order),
        cmocka_unit_test(at_rest_all_accounts_stay_at_zero),
        cmocka_unit_test(what_a_breaking_edge_held_is_counted_exactly),
        cmocka_unit_test(what_a_pricked_triangle_held_is_counted_exactly),
        cmocka_unit_test(an_edge_without_an_arm_held_nothing_in_it),
        cmocka_unit_test(a_scheduled_change_of_springs_is_the_users_work),
        cmocka_unit_test(it_balances_through_a_burst),
        cmocka_unit_test(a_look_inside_a_step_finds_the_accounts_as_they_were),
        cmocka_unit_test(accounts_inside_a_step_balance_as_well_as_at_its_end),
        cmocka_unit_test(the_accounts_are_equal_to_the_bit_for_any_number_of_threads),
        cmocka_unit_test(keeping_accounts_changes_no_bit_of_the_state),
        cmocka_unit_test(what_auto_counts_has_none_of_the_accounts_work),
        cmocka_unit_test(nothing_is_counted_unless_it_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
