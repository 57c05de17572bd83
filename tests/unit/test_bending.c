/* Hinges: forces against their energy, derivatives against forces, what they keep, and what ends them. */
#include "books.h"
#include "common/vec3.h"
#include "differences.h"
#include "hinges.h"
#include "sim/bending.h"
#include "sim/guard.h"
#include "sim/jacobian.h"
#include "sim/let_go.h"

/* Out of shape and in motion, a few triangles and edges gone. */
static void crumple(struct sim *sim, const double factor[3], double size)
{
    deform(sim, factor, size);
    for (uint32_t e = 0; e < sim->edge_count; e += 17)
        sim->edge_active[e] = 0;
}

static double energy_of(struct sim *sim)
{
    return effects_energy(sim);
}

/* h = 1e-6 of edges of .3, of which the crushed ones' heights are some .01: h^4 f'''''/30 is below 1e-16 f;
 * rounding of E, below 100:
 * 100 x 2e-16/h = 2e-8. A triangle that is crushed within 2 h would jump in E''. */
static void forces_are_the_slope_of_the_energy(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++)
        for (int k = 0; k < SHAPES; k++) {
            struct balloon b;
            uint64_t random = 9;
            double size;
            open_balloon(&b, 2, flat ? HINGES("balloons[0].bending.rest=flat") : HINGES());
            crumple(&b.sim, shapes[k].factor, shapes[k].size);
            rows dx = new_rows(&b.sim);
            fill(dx, b.sim.point_count, 1, &random);
            const double work = work_against(&b.sim, dx, &size);
            assert_near(work, energy_difference(&b.sim, 1e-6, dx, energy_of), 1e-8 * size + 3e-8);
            assert_true(size > 1);
            free(dx);
            close_balloon(&b);
        }
}

static void check_products(const char *const *changes, int shape)
{
    struct balloon b;
    uint64_t random = 5;
    open_balloon(&b, 2, changes);
    struct sim *sim = &b.sim;
    crumple(sim, shapes[shape].factor, shapes[shape].size);
    assert_ok(sim_jacobian_open(sim, &(struct error){0}), &(struct error){0});
    sim_linearise(sim);
    double size;
    const double error = product_error(sim, 1e-6, &random, &size);
    assert_near(error, 0, 1e-8 * size);
    sim_jacobian_close(sim);
    close_balloon(&b);
}

/* The same h; rounding is f x 2e-16/h = 2e-10 f, and changes are larger than f. */
static void products_are_the_differences_of_the_forces(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++) {
        check_products(HINGES(), k);
        check_products(HINGES("balloons[0].bending.rest=flat"), k);
        check_products(HINGES("balloons[0].bending.damping=0.3"), k);
    }
}

static void add_moments(const struct sim *sim, rows what, double linear[3], double angular[3])
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            linear[i] += what[p][i];
            angular[i] += sim->position[p][j] * what[p][k] - sim->position[p][k] * what[p][j];
        }
}

/* No force and no torque on the whole, but for the rounding of sums of some 500 terms of
 * the size of the largest. */
static void hinges_push_and_turn_nothing_as_a_whole(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++) {
        struct balloon b;
        double force[3] = {0}, torque[3] = {0};
        open_balloon(&b, 2, HINGES("balloons[0].bending.damping=0.3"));
        crumple(&b.sim, shapes[k].factor, shapes[k].size);
        sim_forces(&b.sim);
        add_moments(&b.sim, b.sim.force, force, torque);
        const double size = largest(b.sim.force, b.sim.point_count);
        assert_true(size > 0.1);
        for (int i = 0; i < 3; i++) {
            assert_near(force[i], 0, 1e-13 * size);
            assert_near(torque[i], 0, 1e-12 * size); /* places are up to 2.5 away */
        }
        close_balloon(&b);
    }
}

/* As meshed, it is at rest at any size: angles are what is kept. Flat, a sphere is not. */
static void a_balloon_as_it_was_meshed_is_not_bent(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HINGES());
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] *= 3;
    sim_forces(&b.sim);
    assert_near(largest(b.sim.force, b.sim.point_count), 0, 1e-14);
    assert_near(effects_energy(&b.sim), 0, 1e-25); /* squares of roundings */
    close_balloon(&b);
}

/* The sum of squares of the angle's gradients at most, over that at rest, from the formulas of bending.h. */
static double steepness(const struct sim *sim, uint32_t hinge)
{
    const struct bending *h = sim->balloons[0].bending;
    const uint32_t *p = h->point[hinge];
    double e[3], square, sum = 0;
    vec3_sub(sim->position[p[1]], sim->position[p[0]], e);
    square = vec3_dot(e, e);
    for (int k = 2; k < 4; k++) {
        double d[3], n[3];
        vec3_sub(sim->position[p[k]], sim->position[p[0]], d);
        vec3_cross(e, d, n);
        const double along = vec3_dot(d, e) / square;
        sum += (1 + 2 * along * along + 2 * (1 - along) * (1 - along)) * square / vec3_dot(n, n);
    }
    return sum * h->rest[3][hinge];
}

/* The passes hand on two numbers in the room of one: each to 2^-20 = 1e-6, and what they are taken from is up
 * to six times what is left. */
static void the_guard_goes_by_the_steepest_hinge(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct balloon b;
        double steepest = 0;
        open_balloon(&b, 2, HINGES());
        deform(&b.sim, shapes[k].factor, shapes[k].size);
        const struct bending_view view = bending_look(&b.sim, b.sim.balloons);
        for (uint32_t e = 0; e < view.count; e++)
            if (bending_holds(&view, e))
                steepest = fmax(steepest, steepness(&b.sim, e));
        sim_forces(&b.sim);
        assert_true(steepest > 0.1);
        assert_near(b.sim.balloons[0].bending->range[0], steepest, 1e-5 * steepest);
        close_balloon(&b);
    }
}

/* The guard's bound, found at rest and watched from then on, keeps crumpled skin from gaining energy, but for
 * the share that symplectic Euler moves to and fro near its limit. */
static void the_guards_bound_holds_for_hinges(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct balloon b;
        open_balloon(&b, 2, HINGES("time.guard=substep", "time.step=0.1", "balloons[0].spring=1"));
        crumple(&b.sim, (double[3]){1, 1, 1}, 0.1 * k);
        memset(b.sim.velocity, 0, b.sim.point_count * sizeof *b.sim.velocity);
        sim_forces(&b.sim); /* so that it is known how steep things are */
        b.sim.hooks[EFFECT_FORCES][0].effect->after(&b.sim, b.sim.balloons);
        struct sim_measures m = sim_measure(&b.sim);
        const double begin = m.elastic_energy + effects_energy(&b.sim);
        steps(&b, 2000);
        m = sim_measure(&b.sim);
        assert_true(m.kinetic_energy + m.elastic_energy + effects_energy(&b.sim) < 1.5 * begin + 1e-20);
        close_balloon(&b);
    }
}

/* The largest eigenvalue of the derivatives, by power iteration, is within the bound's
 * 4/dt^2, and not far below. */
static void the_bound_is_above_the_stiffest_mode(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++) {
        struct balloon b;
        uint64_t random = 5;
        open_balloon(&b, 2, HINGES());
        struct sim *sim = &b.sim;
        crumple(sim, shapes[k].factor, shapes[k].size);
        sim_forces(sim);
        sim->hooks[EFFECT_FORCES][0].effect->after(sim, sim->balloons);
        guard_outdated(sim);
        const double step = guard_stable_step(sim);
        assert_ok(sim_jacobian_open(sim, &(struct error){0}), &(struct error){0});
        sim_linearise(sim);
        rows x = new_rows(sim), y = new_rows(sim);
        fill(x, sim->point_count, 1, &random);
        double stiffest = 0;
        for (int i = 0; i < 300; i++) {
            sim_force_product(sim, 1, x, 0, x, y);
            double square = 0;
            for (uint32_t p = 0; p < sim->point_count; p++)
                for (int j = 0; j < 3; j++)
                    square += y[p][j] * y[p][j];
            stiffest = sqrt(square);
            for (uint32_t p = 0; p < sim->point_count; p++)
                for (int j = 0; j < 3; j++)
                    x[p][j] = y[p][j] / stiffest;
        }
        print_message("# shape %d: the bound is %.2f times the stiffest mode\n", k,
                      4 / (step * step) / stiffest);
        assert_true(stiffest <= 4 / (step * step));
        free(x);
        free(y);
        sim_jacobian_close(sim);
        close_balloon(&b);
    }
}

static void a_block_of_no_stiffness_changes_no_bit(void **state)
{
    (void)state;
    struct balloon with, without;
    open_balloon(&with, 2, SETTINGS("balloons[0].bending.stiffness=0"));
    open_balloon(&without, 2, SETTINGS());
    assert_int_equal(with.sim.bytes, without.sim.bytes);
    steps(&with, 60);
    steps(&without, 60);
    assert_true(sim_hash(&with.sim) == sim_hash(&without.sim));
    close_balloon(&with);
    close_balloon(&without);
}

/* Forces and products after cuts are the slopes of what is left, and cut hinges are gone. */
static void a_cut_ends_its_hinge(void **state)
{
    (void)state;
    struct balloon b;
    uint64_t random = 8;
    double size;
    open_balloon(&b, 2, HINGES("balloons[0].fracture.mode=tear", "balloons[0].fracture.strength=50"));
    struct sim *sim = &b.sim;
    open_books(&b);
    fill(sim->position, sim->balloons->point_end, 0.05, &random);
    const double before = effects_energy(sim);
    cut_some(sim, 30);
    const double after = effects_energy(sim);
    const struct bending_view view = bending_look(sim, sim->balloons);
    uint32_t hinges = 0;
    for (uint32_t e = 0; e < sim->balloons->bending->count; e++)
        hinges += bending_holds(&view, e);
    assert_int_equal(hinges, 480 - sim->broken);
    assert_true(after < before);
    assert_near(sim->ledger.account.fracture, before - after, 1e-12 * before);
    rows dx = new_rows(sim);
    fill(dx, sim->balloons->point_end, 1, &random);
    const double work = work_against(sim, dx, &size);
    assert_near(work, energy_difference(sim, 1e-6, dx, energy_of), 1e-8 * size + 3e-8);
    free(dx);
    close_balloon(&b);
}

/* Kinetic, elastic, bending and dissipated energy and what broke add up: symplectic Euler's
 * error falls with the step. */
static void the_ledger_balances(void **state)
{
    (void)state;
    double error[2];
    for (int k = 0; k < 2; k++) {
        struct balloon b;
        open_balloon(&b, 2,
                     HINGES("balloons[0].spring=2", "balloons[0].bending.damping=0.05",
                            k ? "time.step=0.0025" : "time.step=0.005"));
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            b.sim.position[p][0] *= 0.7;
        open_books(&b);
        steps(&b, k ? 200 : 100);
        sim_break_edge(&b.sim, 30);
        sim_break_edge(&b.sim, 77);
        steps(&b, k ? 200 : 100);
        const struct ledger_balance account = balance(&b);
        assert_true(account.dissipated > 0.01);
        assert_true(account.fracture > 0);
        error[k] = fabs(account.error);
        assert_true(error[k] < 0.02 * b.sim.ledger.account.begin);
        close_balloon(&b);
    }
    assert_true(error[1] < 0.6 * error[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_the_slope_of_the_energy),
        cmocka_unit_test(products_are_the_differences_of_the_forces),
        cmocka_unit_test(hinges_push_and_turn_nothing_as_a_whole),
        cmocka_unit_test(a_balloon_as_it_was_meshed_is_not_bent),
        cmocka_unit_test(the_guard_goes_by_the_steepest_hinge),
        cmocka_unit_test(the_bound_is_above_the_stiffest_mode),
        cmocka_unit_test(the_guards_bound_holds_for_hinges),
        cmocka_unit_test(a_block_of_no_stiffness_changes_no_bit),
        cmocka_unit_test(a_cut_ends_its_hinge),
        cmocka_unit_test(the_ledger_balances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
