/* Checkpoints: a run that is resumed is equal to the bit to one that never stopped;
 * another scene's are refused. */
#include "checkpoints.h"
#include "sim/ledger.h"
#include "sim/log.h"

enum { STEPS = 30, AHEAD = 5 };

/* A run that bursts on the way: saved and resumed after each of its steps, it goes on as it did, every
 * sixth time to the end. */
static void check_resuming(const char *const *changes, unsigned workers)
{
    struct error err = {0};
    struct balloon b;
    uint64_t hash[STEPS + 1];
    open_balloon(&b, 1, changes);
    for (int i = 0; i <= STEPS; i++) {
        char name[32];
        snprintf(name, sizeof name, "%d.ck", i);
        hash[i] = sim_hash(&b.sim);
        assert_ok(save(&b.sim, name, &err), &err);
        if (i < STEPS)
            steps(&b, 1);
    }
    assert_true(b.sim.broken > 0);
    for (int i = 0; i <= STEPS; i++) {
        char name[32];
        struct sim sim;
        snprintf(name, sizeof name, "%d.ck", i);
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers, &err), &err);
        assert_ok(load(&sim, name, &err), &err);
        const int last = i % 6 == 0 || i + AHEAD > STEPS ? STEPS : i + AHEAD;
        for (int at = i; at <= last; at++) {
            if (sim_hash(&sim) != hash[at])
                fail_msg("%s: resumed after step %d, it is another run at step %d", b.sim.integrator->name, i,
                         at);
            if (at < last)
                assert_ok(sim_step(&sim, &err), &err);
        }
        sim_clear(&sim);
        unlink(name);
    }
    close_balloon(&b);
}

static void a_resumed_run_is_equal_to_the_bit_to_one_that_never_stopped(void **state)
{
    (void)state;
    for (size_t i = 0; integrators[i]; i++) {
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", integrators[i]->name);
        check_resuming(SETTINGS(name, "balloons[0].pressure=40", "balloons[0].threshold=1.1",
                                "schedule[0].at=0.2", "schedule[0].pressure=50", "schedule[1].at=0.3",
                                "schedule[1].step=0.02", "balloons[0].rip.at=0.35"),
                       (unsigned)i % 3 + 1);
    }
}

static void a_checkpoint_carries_what_the_program_knows_of_the_run(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    struct checkpoint_run run = {0};
    assert_ok(checkpoint_load("a.ck", &b.sim, &run, &err), &err);
    assert_near(run.first_break, -1, 0);
    assert_near(run.seconds, 2.5, 0);
    assert_int_equal(run.shown, 7);
    assert_int_equal(run.row_bytes, 4);
    assert_string_equal(run.rows, "row\n");
    free(run.rows);
    unlink("a.ck");
    close_balloon(&b);
}

/* The accounts go along where they are kept, begin where they were not, and are left behind
 * where nobody wants them. */
static void the_ledger_goes_along(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b, with, without;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    open_balloon(&with, 1, SETTINGS("balloons[0].pressure=10"));
    open_balloon(&without, 1, SETTINGS("balloons[0].pressure=10"));
    assert_ok(ledger_open(&b.sim, &err), &err);
    assert_ok(ledger_open(&with.sim, &err), &err);
    steps(&b, 5);
    assert_ok(save(&b.sim, "with.ck", &err), &err);
    assert_ok(load(&without.sim, "with.ck", &err), &err);
    assert_ok(save(&without.sim, "without.ck", &err), &err);
    assert_ok(load(&with.sim, "with.ck", &err), &err);
    steps(&b, 5);
    steps(&with, 5);
    steps(&without, 5);
    assert_true(sim_hash(&with.sim) == sim_hash(&without.sim));
    struct sim_measures m = sim_measure(&b.sim);
    const struct ledger_balance wanted = ledger_balance(&b.sim, &m), got = ledger_balance(&with.sim, &m);
    assert_memory_equal(&got, &wanted, sizeof got);

    assert_ok(load(&with.sim, "without.ck", &err), &err);
    m = sim_measure(&with.sim);
    assert_near(ledger_balance(&with.sim, &m).pressure_work, 0, 0);
    assert_near(ledger_balance(&with.sim, &m).error, 0, 1e-12 * m.kinetic_energy);
    unlink("with.ck");
    unlink("without.ck");
    close_balloon(&b);
    close_balloon(&with);
    close_balloon(&without);
}

static void another_scene_is_refused_with_the_key_that_differs(void **state)
{
    (void)state;
    static const struct {
        const char *change, *message;
    } cases[] = {
        {"balloons[0].pressure=12", "a.ck: is of another scene: balloons[0].pressure is 12, and was 10"},
        {"time.integrator=explicit-euler", "time.integrator is explicit-euler, and was symplectic-euler"},
        {"balloons[0].rip.at=1", "balloons[0].rip.at is 1, and was not there"},
        {"balloons[0].radius=44", "balloons[0].radius is 44, and was 45"},
        {"schedule[0].pressure=1", "schedule[0].at is 0, and was not there"},
    };
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct balloon other;
        open_balloon(&other, 1, SETTINGS(cases[i].change));
        assert_refused(load(&other.sim, "a.ck", &err), STATUS_INPUT, cases[i].message, &err);
        close_balloon(&other);
    }
    struct balloon finer;
    open_balloon(&finer, 2, SETTINGS("balloons[0].pressure=10"));
    assert_refused(load(&finer.sim, "a.ck", &err), STATUS_INPUT, "other points, edges or triangles", &err);
    close_balloon(&finer);
    b.mesh.position[3][1] += 1e-9; /* as many points, and one of them elsewhere */
    sim_clear(&b.sim);
    assert_ok(sim_open(&b.sim, &b.scene, &b.mesh, 1, &err), &err);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "other points, edges or triangles", &err);
    unlink("a.ck");
    close_balloon(&b);
}

/* As another version would have written it. */
static void a_log_of_other_columns_is_not_gone_on_with(void **state)
{
    (void)state;
    struct error err = {0};
    struct sim_log *log = NULL;
    const struct sim_log_options options = {.rows = "time\tvolume\n", .row_bytes = 12};
    assert_refused(sim_log_open("log.tsv", &options, &log, &err), STATUS_INPUT, "has other columns", &err);
    assert_null(log);
    assert_int_equal(access("log.tsv", F_OK), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resumed_run_is_equal_to_the_bit_to_one_that_never_stopped),
        cmocka_unit_test(a_checkpoint_carries_what_the_program_knows_of_the_run),
        cmocka_unit_test(the_ledger_goes_along),
        cmocka_unit_test(another_scene_is_refused_with_the_key_that_differs),
        cmocka_unit_test(a_log_of_other_columns_is_not_gone_on_with),
    };
    return cmocka_run_group_tests(tests, enter_memory, leave_folder);
}
