/* Implicit methods follow a skin that tears: their derivatives are exact there, their solver knows of every
 * edge, and what bursts by them bursts as by explicit ones. */
#include "burst/ordered.h"
#include "sim/gas.h"
#include "sim/jacobian.h"
#include "sim/solver.h"
#include "unit/differences.h"

static const char *const methods[] = {"time.integrator=backward-euler", "time.integrator=implicit-midpoint",
                                      "time.integrator=bdf2"};
enum { METHODS = sizeof methods / sizeof methods[0] };

/* Of rubber with all that has derivatives of its own, cut anywhere, before and after its new points have come
 * to their places. Its gas has left: the thrust of what streams out is taken as constant. By differences,
 * which are exact to h^4 and rounding/h: 1e-7 of the largest number. */
static void derivatives_are_exact_where_skin_is_torn(void **unused)
{
    (void)unused;
    struct inflated it;
    struct error err = {0};
    uint64_t random = 9;
    inflate(&it, &all_of_rubber);
    assert_ok(sim_jacobian_open(&it.sim, &err), &err);
    give_speeds(&it);
    cut_anywhere(&it, 11, 300);
    it.balloon->gas->memory.gone = 1;
    for (int placed = 0; placed < 2; placed++) {
        double size;
        if (placed)
            put_in_order(&it);
        sim_linearise(&it.sim);
        assert_true(product_error(&it.sim, 1e-4, &random, &size) <= 1e-7 * size);
    }
    sim_jacobian_close(&it.sim);
    deflate(&it);
}

/* The linear system of a step in which a skin's springs are far from at rest. */
static unsigned iterations_of(struct inflated *it)
{
    struct solver solver = {0};
    struct error err = {0};
    struct sim *sim = &it->sim;
    rows x = new_rows(sim);
    assert_ok(sim_jacobian_open(sim, &err), &err);
    assert_ok(solver_open(sim, &solver, &err), &err);
    cut_anywhere(it, 11, 300);
    sim_forces(sim);
    sim_linearise(sim);
    solver_prepare(sim, &solver, 0.04, 0.2);
    assert_true(solver_solve(sim, &solver, sim->force, x, 1e-8));
    const unsigned iterations = (unsigned)solver.iterations;
    solver_close(&solver);
    sim_jacobian_close(sim);
    free(x);
    return iterations;
}

/* It is told of the points that cuts have given to edges: by those of before it would find no solution. */
static void the_solver_knows_of_edges_that_a_cut_has_moved(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    assert_in_range(iterations_of(&it), 1, 30);
    deflate(&it);
}

/* In steps four times as long as an explicit method can take. */
static void what_is_pricked_bursts_as_by_explicit_methods(void **unused)
{
    (void)unused;
    for (int m = 0; m < METHODS; m += 2) {
        struct inflated it;
        inflate(&it, &(struct inflation){.level = 3, .stretch = 2.2, .step = 4, .keys = {methods[m]}});
        prick(&it);
        run_until(&it, 1.5);
        const struct shreds s = count_shreds(&it);
        print_message("# %s: %u pieces, the largest %.3f, the smallest of %u triangles, slender %.1f\n",
                      methods[m], s.count, s.largest, s.fewest, s.slenderness);
        assert_int_equal(it.balloon->fracture->now.pieces + 1, s.count);
        assert_true(s.count >= 4 && s.fewest >= 4 && s.slenderness >= 3);
        deflate(&it);
    }
}

static uint64_t hash_of_burst(const char *method, unsigned workers)
{
    struct inflated it;
    inflate(&it,
            &(struct inflation){.level = 3, .stretch = 2.2, .step = 4, .workers = workers, .keys = {method}});
    prick(&it);
    run_until(&it, 0.5);
    assert_true(it.balloon->topology->now.edges > 10);
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void any_number_of_workers_gives_the_same_burst(void **unused)
{
    (void)unused;
    assert_true(hash_of_burst(methods[2], 1) == hash_of_burst(methods[2], 3));
}

/* Newton's method stops at a millionth of what a step changed, some 1e-2 of the speeds of about 1. */
static void momentum_and_mass_are_kept(void **unused)
{
    (void)unused;
    for (int m = 0; m < METHODS; m++) {
        struct inflated it;
        inflate(&it, &(struct inflation){.level = 3,
                                         .stretch = 2.2,
                                         .springs = true,
                                         .step = 4,
                                         .keys = {"balloons[0].pressure=0", methods[m]}});
        assert_a_burst_keeps_bulk(&it, 1, 1e-5);
        assert_true(it.balloon->topology->now.edges > 10);
        deflate(&it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_are_exact_where_skin_is_torn),
        cmocka_unit_test(the_solver_knows_of_edges_that_a_cut_has_moved),
        cmocka_unit_test(what_is_pricked_bursts_as_by_explicit_methods),
        cmocka_unit_test(any_number_of_workers_gives_the_same_burst),
        cmocka_unit_test(momentum_and_mass_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
