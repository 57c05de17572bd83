/* The membrane's forces against its energy, its derivatives against its forces, and both
 * against what must not matter. */
#include "books.h"
#include "common/vec3.h"
#include "differences.h"
#include "membranes.h"
#include "sim/guard.h"
#include "sim/jacobian.h"

/* Taut all over; wrinkled along one way; slack; crushed. */
static const double shapes[][3] = {{1.7, 1.5, 1.6}, {2.5, 0.8, 0.7}, {0.8, 0.7, 0.9}, {0.4, 0.3, 0.3}};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

static double elastic(struct sim *sim)
{
    return membrane_elastic(sim, sim->balloons);
}

/* -f . dx against (8 (E(h) - E(-h)) - (E(2h) - E(-2h))) / (12 h), h = 1e-5 of edges of .3. Rounding of E,
 * near 20: 20 x 2e-16/h = 4e-10. Where a triangle is about to wrinkle within 2 h, E'' jumps by about 1, and
 * the difference is wrong by h/2 or so of that triangle's share. */
static void check_forces(const char *const *changes)
{
    for (int k = 0; k < SHAPES; k++) {
        struct balloon b;
        uint64_t random = 9;
        open_balloon(&b, 2, changes);
        struct sim *sim = &b.sim;
        deform(sim, shapes[k], 0.02);
        memset(sim->velocity, 0, sim->point_count * sizeof *sim->velocity);
        rows dx = new_rows(sim);
        fill(dx, sim->point_count, 1, &random);
        double size;
        const double work = work_against(sim, dx, &size);
        assert_near(work, energy_difference(sim, 1e-5, dx, elastic), 1e-8 * size + 1e-9);
        free(dx);
        close_balloon(&b);
    }
}

static void forces_are_the_slope_of_the_energy(void **state)
{
    (void)state;
    check_forces(RUBBER());
    check_forces(RUBBER("balloons[0].membrane.law=mooney-rivlin"));
    check_forces(RUBBER("balloons[0].membrane.law=gent"));
    check_forces(RUBBER("balloons[0].membrane.law=ogden"));
    check_forces(RUBBER("balloons[0].membrane.compression=1"));
}

/* With h = 1e-5 and edges of .3 what is left out is below 1e-15 of f, and rounding is f x 2e-16/h =
 * 2e-11 f; forces are below 100. A triangle whose wrinkling begins within 2 h is not among these: with
 * another seed one might be. */
static void check_products(const char *const *changes, const double shape[3])
{
    struct balloon b;
    uint64_t random = 5;
    open_balloon(&b, 2, changes);
    struct sim *sim = &b.sim;
    deform(sim, shape, 0.02);
    assert_ok(sim_jacobian_open(sim, &(struct error){0}), &(struct error){0});
    sim_linearise(sim);
    double size;
    const double error = product_error(sim, 1e-5, &random, &size);
    assert_near(error, 0, 1e-9 * fmax(largest(sim->force, sim->point_count), 1));
    sim_jacobian_close(sim);
    close_balloon(&b);
}

static void products_are_the_differences_of_the_forces(void **state)
{
    (void)state;
    static const char *const laws[] = {"neo-hookean", "mooney-rivlin", "gent", "ogden"};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < SHAPES; k++) {
            char law[64];
            snprintf(law, sizeof law, "balloons[0].membrane.law=%s", laws[i]);
            check_products(RUBBER(law), shapes[k]);
        }
}

/* At rest a skin is about to wrinkle, with stretches that are equal up to rounding, and what is divided
 * by their difference must not show: however little it was shaken, |dx . K dx| is at most what the
 * guard's springs make of dx. */
static void products_are_no_larger_than_the_bound_near_rest(void **state)
{
    (void)state;
    for (double size = 1e-16; size < 1e-2; size *= 10) {
        struct balloon b;
        uint64_t random = 5;
        open_balloon(&b, 2, RUBBER());
        struct sim *sim = &b.sim;
        const struct membrane *m = sim->balloons->membrane;
        fill(sim->position, sim->point_count, size, &random);
        assert_ok(sim_jacobian_open(sim, &(struct error){0}), &(struct error){0});
        rows dx = new_rows(sim), df = new_rows(sim);
        fill(dx, sim->point_count, 1, &random);
        sim_force_product(sim, 1, dx, 0, dx, df);
        const double range[2] = {2.5, 0.8};
        double work = 0, most = 0, d[3];
        for (uint32_t p = 0; p < sim->point_count; p++)
            work += vec3_dot(dx[p], df[p]);
        for (uint32_t e = 0; e < sim->edge_count; e++) {
            vec3_sub(dx[sim->edge_point[e][0]], dx[sim->edge_point[e][1]], d);
            most += membrane_stiffness(&m->law, range) * m->edge_weight[e] * vec3_dot(d, d);
        }
        assert_true(fabs(work) <= most);
        free(dx);
        free(df);
        sim_jacobian_close(sim);
        close_balloon(&b);
    }
}

static void products_of_the_damping_are_the_differences_of_its_forces(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++)
        check_products(RUBBER("balloons[0].membrane.viscosity=0.3"), shapes[k]);
}

/* To the bit: forces, products, energies, after a few steps through wrinkled and crushed states. */
static void results_are_equal_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {1, 2, 3, 7};
    static const char *const laws[] = {"neo-hookean", "gent", "ogden"};
    struct error err = {0};
    for (int i = 0; i < 3; i++) {
        char law[64];
        snprintf(law, sizeof law, "balloons[0].membrane.law=%s", laws[i]);
        struct balloon b;
        open_balloon(&b, 3, RUBBER(law, "balloons[0].membrane.viscosity=0.1", "time.step=0.01"));
        uint64_t first = 0;
        double energy = 0;
        for (size_t w = 0; w < sizeof workers / sizeof workers[0]; w++) {
            struct sim sim;
            assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers[w], &err), &err);
            deform(&sim, shapes[1], 0.02);
            for (int s = 0; s < 10; s++)
                assert_ok(sim_step(&sim, &err), &err);
            if (w == 0) {
                first = sim_hash(&sim);
                energy = membrane_elastic(&sim, sim.balloons);
            }
            assert_true(sim_hash(&sim) == first);
            assert_true(membrane_elastic(&sim, sim.balloons) == energy);
            sim_clear(&sim);
        }
        close_balloon(&b);
    }
}

/* Turning and moving the balloon as a whole stretches nothing: its energy stays 0 to the
 * rounding of lengths, squared. */
static void a_membrane_that_only_turns_holds_nothing(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, RUBBER());
    struct sim *sim = &b.sim;
    assert_near(membrane_elastic(sim, sim->balloons), 0, 1e-14);
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double x = sim->position[p][0], y = sim->position[p][1];
        sim->position[p][0] = 0.6 * x - 0.8 * y;
        sim->position[p][1] = 0.8 * x + 0.6 * y;
        sim->position[p][2] += 5;
    }
    assert_near(membrane_elastic(sim, sim->balloons), 0, 1e-13);
    sim_forces(sim);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_near(sim->force[p][i], 0, 1e-13);
    close_balloon(&b);
}

/* The sum of all thirds is the skin's mass: density x thickness x area at rest. */
static void masses_are_those_of_the_skin(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, RUBBER("balloons[0].membrane.density=3", "balloons[0].membrane.thickness=0.02"));
    double mass = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        mass += b.sim.mass[p];
    const double area = sim_measure(&b.sim).area;
    assert_near(mass, 3 * 0.02 * area, 1e-13);
    double rest = 0;
    for (uint32_t t = 0; t < b.sim.triangle_count; t++)
        rest += membrane_rest_area(b.sim.balloons, t);
    assert_near(rest, area, 1e-12);
    close_balloon(&b);
}

/* The bound is what the guard says: one percent below it a shaken membrane stays bounded for 2000 steps. */
static void the_guards_bound_holds_for_a_membrane(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(
        &b, 2,
        RUBBER("time.guard=substep", "time.step=10", "time.end=1e9", "time.integrator=symplectic-euler"));
    uint64_t random = 1;
    fill(b.sim.position, b.sim.point_count, 0.01, &random);
    guard_outdated(&b.sim);
    const double begin = membrane_elastic(&b.sim, b.sim.balloons);
    for (int i = 0; i < 2000; i++)
        assert_ok(sim_step(&b.sim, &err), &err);
    const struct sim_measures m = sim_measure(&b.sim);
    assert_true(m.kinetic_energy + m.elastic_energy < 3 * begin);
    close_balloon(&b);
}

/* Kinetic, elastic and dissipated energy add up: symplectic Euler's error is of first order in the
 * step, and falls with it. */
static void the_ledger_balances(void **state)
{
    (void)state;
    double error[2];
    for (int k = 0; k < 2; k++) {
        struct error err = {0};
        struct balloon b;
        open_balloon(
            &b, 2, RUBBER("balloons[0].membrane.viscosity=0.05", k ? "time.step=0.0025" : "time.step=0.005"));
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            b.sim.position[p][0] *= 1.3;
        guard_outdated(&b.sim);
        open_books(&b);
        for (int i = 0; i < (k ? 400 : 200); i++)
            assert_ok(sim_step(&b.sim, &err), &err);
        const struct ledger_balance account = balance(&b);
        assert_true(account.dissipated > 0.01);
        error[k] = fabs(account.error);
        assert_true(error[k] < 0.02 * account.dissipated);
        close_balloon(&b);
    }
    assert_true(error[1] < 0.6 * error[0]);
}

static void scenes_that_contradict_themselves_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *set, *message;
    } bad[] = {
        {"balloons[0].membrane.law=gent", "membrane: give thickness"},
        {"balloons[0].membrane.ogden=((-1,2))", "sum of m alpha"},
        {"balloons[0].membrane.ogden=((1,0))", "alpha of row 1 is 0"},
        {"balloons[0].spring_by_height.profile=((0,1),(1,2))", "no springs for spring_by_height"},
        {"time.integrator=xpbd", "moves springs only"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct error err = {0};
        struct scene scene = {0};
        assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
        if (i > 0)
            assert_ok(scene_set(&scene, "balloons[0].membrane.thickness=0.4", &err), &err);
        assert_ok(scene_set(&scene, bad[i].set, &err), &err);
        assert_refused(scene_check(&scene, &err), STATUS_INPUT, bad[i].message, &err);
        scene_clear(&scene);
    }
}

/* A corner that is so near the middle of the opposite side that rounding says how far the triangle is
 * stretched: its energy was any number, or none. One that is 1e-6 of its length wide is still itself. */
static void triangles_too_thin_for_the_precision_are_refused(void **state)
{
    (void)state;
    for (int thin = 0; thin < 2; thin++) {
        struct balloon b;
        struct error err = {0};
        open_balloon(&b, 1, SETTINGS("balloons[0].membrane.thickness=0.4"));
        sim_clear(&b.sim);
        const uint32_t *corner = b.mesh.triangle[0];
        for (int i = 0; i < 3; i++) {
            const double middle = (b.mesh.position[corner[1]][i] + b.mesh.position[corner[2]][i]) / 2;
            b.mesh.position[corner[0]][i] = middle +
                                            (thin ? 1e-9 : 1e-6) * (b.mesh.position[corner[0]][i] - middle);
        }
        const enum status status = sim_open(&b.sim, &b.scene, &b.mesh, 1, &err);
        if (thin)
            assert_refused(status, STATUS_INPUT, "balloons[0].membrane: a triangle near", &err);
        else
            assert_ok(status, &err);
        close_balloon(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_the_slope_of_the_energy),
        cmocka_unit_test(products_are_the_differences_of_the_forces),
        cmocka_unit_test(products_are_no_larger_than_the_bound_near_rest),
        cmocka_unit_test(products_of_the_damping_are_the_differences_of_its_forces),
        cmocka_unit_test(results_are_equal_for_any_number_of_threads),
        cmocka_unit_test(a_membrane_that_only_turns_holds_nothing),
        cmocka_unit_test(masses_are_those_of_the_skin),
        cmocka_unit_test(the_guards_bound_holds_for_a_membrane),
        cmocka_unit_test(the_ledger_balances),
        cmocka_unit_test(triangles_too_thin_for_the_precision_are_refused),
        cmocka_unit_test(scenes_that_contradict_themselves_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
