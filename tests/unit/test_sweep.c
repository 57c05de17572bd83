/* A step that goes through memory once (sweep.h) comes to what one would in separate loops. */
#include "balloon.h"
#include "common/vec3.h"
#include "sim/ledger.h"
#include "sim/let_go.h"
#include "sim/sweep.h"

#include <math.h>

static void open_with(struct balloon *b, unsigned level, unsigned workers, const char *const *changes)
{
    struct error err = {0};
    open_balloon(b, level, changes);
    sim_clear(&b->sim);
    assert_ok(mesh_order(&b->mesh, &err), &err);
    assert_ok(sim_open(&b->sim, &b->scene, &b->mesh, workers, &err), &err);
}

/* Where accounts are kept, forces are complete only when all are: points move in a loop of their own. */
static void points_that_move_at_once_end_where_they_would_in_a_loop_of_their_own(void **state)
{
    (void)state;
    static const char *const names[] = {"time.integrator=symplectic-euler", "time.integrator=explicit-euler",
                                        "time.integrator=verlet"};
    for (unsigned workers = 1; workers <= 5; workers += 2)
        for (int n = 0; n < 3; n++) {
            struct error err = {0};
            struct balloon once, apart;
            open_with(&once, 4, workers, SETTINGS(names[n], "balloons[0].threshold=1.3"));
            open_with(&apart, 4, 1, SETTINGS(names[n], "balloons[0].threshold=1.3"));
            assert_ok(ledger_open(&apart.sim, &err), &err);
            steps(&once, 60);
            steps(&apart, 60);
            assert_true(once.sim.broken > 0);
            assert_true(sim_hash(&once.sim) == sim_hash(&apart.sim));
            close_balloon(&once);
            close_balloon(&apart);
        }
}

static uint32_t count_overlong(const struct sim *sim)
{
    uint32_t count = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++)
        count += sim->edge_active[e] && sim_edge_length(sim, e) > sim_threshold(sim, sim->balloons, e);
    return count;
}

/* What the sweep saw must never let an edge pass that is too long, and while a balloon is at rest it
 * must not ask for a look. */
static void no_edge_is_overlong_where_the_sweep_says_so(void **state)
{
    (void)state;
    static const char *const thresholds[] = {"balloons[0].threshold_of=mean",
                                             "balloons[0].threshold_of=edge"};
    for (int k = 0; k < 2; k++) {
        struct balloon b;
        open_with(&b, 4, 3, SETTINGS(thresholds[k], "balloons[0].threshold=1.3"));
        int sure = 0;
        for (int i = 0; i < 100; i++) {
            const uint32_t broken = b.sim.broken;
            steps(&b, 1);
            assert_int_equal(count_overlong(&b.sim), 0); /* they have let go */
            sure += sweep_saw_none_overlong(&b.sim);
            if (sweep_saw_none_overlong(&b.sim))
                assert_int_equal(b.sim.broken, broken);
            assert_true(i > 3 || sweep_saw_none_overlong(&b.sim));
        }
        assert_in_range(sure, 4, 99);
        assert_true(b.sim.broken > 0);
        close_balloon(&b);
    }
}

static void edges_that_have_let_go_ask_for_no_look(void **state)
{
    (void)state;
    struct balloon b;
    open_with(&b, 2, 1, SETTINGS("balloons[0].pressure=0"));
    const uint32_t lost = 40;
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        if (b.sim.edge_point[e][0] == lost || b.sim.edge_point[e][1] == lost)
            sim_break_edge(&b.sim, e);
    for (int i = 0; i < 3; i++)
        b.sim.position[lost][i] *= 3; /* further than an edge may reach */
    steps(&b, 1);
    assert_true(sweep_saw_none_overlong(&b.sim));
    close_balloon(&b);
}

static void the_sweep_sees_the_kinetic_energy(void **state)
{
    (void)state;
    struct balloon b;
    open_with(&b, 3, 2, SETTINGS());
    steps(&b, 10);
    /* two orders of a sum of 642 numbers, none negative: 642 eps off at most */
    const double energy = sim_measure(&b.sim).kinetic_energy;
    assert_near(sweep_saw_energy(&b.sim), energy, 642 * 2.3e-16 * energy);
    b.sim.velocity[7][1] = NAN;
    struct error err = {0};
    assert_int_equal(sim_step(&b.sim, &err), STATUS_DIVERGED);
    assert_false(sweep_saw_energy(&b.sim) < INFINITY);
    close_balloon(&b);
}

static uint32_t part_of(const struct sim *sim, uint32_t point)
{
    uint32_t i = 0;
    while (point >= sim->parts[i].point_end)
        i++;
    return i;
}

static bool is_inner(const struct sim *sim, uint32_t point)
{
    const struct sim_part *part = &sim->parts[part_of(sim, point)];
    return point >= part->inner_begin && point < part->inner_end;
}

static void no_other_part_has_an_edge_or_a_triangle_at_an_inner_point(void **state)
{
    (void)state;
    struct balloon b;
    open_with(&b, 4, 4, SETTINGS());
    const struct sim *sim = &b.sim;
    uint32_t inner = 0;
    for (uint32_t p = 0; p < sim->point_count; p++)
        inner += is_inner(sim, p);
    assert_in_range(inner, sim->point_count / 2, sim->point_count - 1);
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        const uint32_t *p = sim->edge_point[e];
        if (is_inner(sim, p[0]) || is_inner(sim, p[1]))
            assert_int_equal(part_of(sim, p[0]), part_of(sim, p[1]));
    }
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (is_inner(sim, sim->triangle_point[t][k]))
                assert_int_equal(part_of(sim, sim->triangle_point[t][k]),
                                 part_of(sim, sim->triangle_point[t][(k + 1) % 3]));
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_that_move_at_once_end_where_they_would_in_a_loop_of_their_own),
        cmocka_unit_test(no_edge_is_overlong_where_the_sweep_says_so),
        cmocka_unit_test(edges_that_have_let_go_ask_for_no_look),
        cmocka_unit_test(the_sweep_sees_the_kinetic_energy),
        cmocka_unit_test(no_other_part_has_an_edge_or_a_triangle_at_an_inner_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
