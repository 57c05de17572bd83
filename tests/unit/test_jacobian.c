/* Exact derivatives of the forces, against differences of the forces themselves. */
#include "balloon.h"
#include "differences.h"
#include "sim/jacobian.h"
#include "sim/vectors.h"

/* A balloon out of round and in motion, its points moved by up to `size`, a few of its
 * edges and triangles gone. */
static void open_shaken(struct balloon *b, unsigned level, double size, const char *const *changes)
{
    uint64_t random = 11;
    open_balloon(b, level, changes);
    fill(b->sim.position, b->sim.point_count, size, &random);
    fill(b->sim.velocity, b->sim.point_count, 5, &random);
    for (uint32_t e = 0; e < b->sim.edge_count; e += 17)
        b->sim.edge_active[e] = 0;
    for (uint32_t t = 0; t < b->sim.triangle_count; t += 13)
        b->sim.triangle_active[t] = 0;
    assert_ok(sim_jacobian_open(&b->sim, &(struct error){0}), &(struct error){0});
    sim_linearise(&b->sim);
}

static void close_shaken(struct balloon *b)
{
    sim_jacobian_close(&b->sim);
    close_balloon(b);
}

/* Products along random directions of size 1 must be the differences. Lengths are about 15 (level 2), so that
 * with h = 1e-3 each derivative brings a factor of about 1/5 at worst: h^4 f'''''/30 is 1e-12 / 30 / 5^5 of
 * f, and rounding 2e-16 f / h = 2e-13 f; forces are some 1000 and the tolerance is 100 times that. */
static void check_shaken(const char *const *changes, bool whole)
{
    struct balloon b;
    uint64_t random = 5;
    open_shaken(&b, 2, 2, changes);
    for (uint32_t t = 0; t < b.sim.triangle_count && whole; t++)
        b.sim.triangle_active[t] = 1;
    struct sim *sim = &b.sim;
    rows dx = new_rows(sim), dv = new_rows(sim), exact = new_rows(sim), near = new_rows(sim);
    for (int repeat = 0; repeat < 5; repeat++) {
        fill(dx, sim->point_count, 1, &random);
        fill(dv, sim->point_count, 1, &random);
        if (repeat == 1)
            memset(dx, 0, sim->point_count * sizeof *dx); /* velocities alone */
        if (repeat == 2)
            memset(dv, 0, sim->point_count * sizeof *dv); /* positions alone */
        difference(sim, 1e-3, dx, dv, near);
        sim_force_product(sim, 1, dx, 1, dv, exact);
        const double size = fmax(largest(sim->force, sim->point_count), 1);
        for (uint32_t p = 0; p < sim->point_count; p++)
            for (int i = 0; i < 3; i++)
                assert_near(exact[p][i], near[p][i], 2e-11 * size);
    }
    free(dx);
    free(dv);
    free(exact);
    free(near);
    close_shaken(&b);
}

static void check_products(const char *const *changes)
{
    check_shaken(changes, false);
}

static void check_whole(const char *const *changes)
{
    check_shaken(changes, true);
}

static void products_of_springs_are_the_differences_of_their_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0"));
}

static void products_of_dampers_are_the_differences_of_their_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=0", "balloons[0].damping=3", "balloons[0].spring=0"));
}

static void products_of_pressure_are_the_differences_of_its_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=100", "balloons[0].damping=0", "balloons[0].spring=0"));
}

static void products_of_viscous_arms_are_the_differences_of_their_forces(void **state)
{
    (void)state;
    check_products(
        SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0", "balloons[0].viscosity.ratio=2"));
}

static void products_of_everything_at_once_are_the_differences(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
}

static void products_of_pressure_on_areas_are_the_differences_of_its_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=1", "balloons[0].pressure_on=areas",
                            "balloons[0].damping=0", "balloons[0].spring=0"));
}

/* Torn as the paper tears, a balloon is not closed, and a volume without its rims is no function of
 * places alone: whole, then. */
static void products_of_gas_are_the_differences_of_its_forces(void **state)
{
    (void)state;
    check_whole(SETTINGS("balloons[0].gas.ambient=10", "balloons[0].gas.fill=2", "balloons[0].spring=0",
                         "balloons[0].gas.process=adiabatic", "gravity.air_density=0.001",
                         "balloons[0].gas.density=0.0005", "balloons[0].damping=0"));
}

static void products_of_drag_are_the_differences_of_its_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0", "balloons[0].spring=0",
                            "drag.air_density=0.001", "drag.wind=[300, 100, 50]"));
}

static void products_of_string_and_pins_are_the_differences_of_their_forces(void **state)
{
    (void)state;
    check_products(SETTINGS("balloons[0].pressure=0", "balloons[0].damping=3", "balloons[0].string.reach=30",
                            "balloons[0].string.slack=0.5", "balloons[0].pins.place=[0.0, 1.0, 0.0]",
                            "balloons[0].pins.reach=30"));
}

/* a K dx + b D dx in one go: the product is linear, to the rounding of its sums of some
 * 20 terms of at most 1e3. */
static void factors_scale_the_two_parts_of_a_product(void **state)
{
    (void)state;
    struct balloon b;
    uint64_t random = 5;
    open_shaken(&b, 2, 2, SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
    struct sim *sim = &b.sim;
    rows dx = new_rows(sim), none = new_rows(sim), by_x = new_rows(sim), by_v = new_rows(sim),
         both = new_rows(sim);
    fill(dx, sim->point_count, 1, &random);
    sim_force_product(sim, 1, dx, 0, none, by_x);
    sim_force_product(sim, 0, none, 1, dx, by_v);
    sim_force_product(sim, 0.25, dx, 0.5, dx, both);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_near(both[p][i], 0.25 * by_x[p][i] + 0.5 * by_v[p][i], 1e-11);
    free(dx);
    free(none);
    free(by_x);
    free(by_v);
    free(both);
    close_shaken(&b);
}

/* Column by column: the block of a point says what its own force does when it alone moves. */
static void diagonal_blocks_are_those_of_the_products(void **state)
{
    (void)state;
    struct balloon b;
    open_shaken(&b, 1, 2, SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
    struct sim *sim = &b.sim;
    double(*block)[3][4] = aligned_alloc(32, sim->point_count * sizeof *block);
    rows dx = new_rows(sim), df = new_rows(sim);
    sim_diagonal_blocks(sim, 0.25, 0.5, block);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int j = 0; j < 3; j++) {
            dx[p][j] = 1;
            sim_force_product(sim, 0.25, dx, 0.5, dx, df);
            dx[p][j] = 0;
            for (int i = 0; i < 3; i++)
                assert_near(block[p][i][j], (i == j) * sim->mass[p] - df[p][i], 1e-11);
        }
    free(block);
    free(dx);
    free(df);
    close_shaken(&b);
}

/* A body that moves as one feels no change: K times a translation is 0 to rounding,
 * springs and pressure alike. */
static void moving_as_one_changes_no_force(void **state)
{
    (void)state;
    struct balloon b;
    open_shaken(&b, 2, 2, SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
    struct sim *sim = &b.sim;
    rows dx = new_rows(sim), df = new_rows(sim);
    for (uint32_t p = 0; p < sim->point_count; p++)
        dx[p][1] = 1;
    sim_force_product(sim, 1, dx, 1, dx, df);
    assert_near(largest(df, sim->point_count), 0, 0);
    free(dx);
    free(df);
    close_shaken(&b);
}

/* Coincident points, a triangle without area and a point that has lost its skin have
 * derivatives that are numbers. */
static void what_has_no_length_or_area_has_no_derivative(void **state)
{
    (void)state;
    struct balloon b;
    open_shaken(&b, 1, 0, SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
    struct sim *sim = &b.sim;
    const uint32_t *edge = sim->edge_point[3];
    memcpy(sim->position[edge[0]], sim->position[edge[1]], sizeof *sim->position);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (sim->triangle_point[t][k] == 7)
                sim->triangle_active[t] = 0;
    sim_linearise(sim);
    rows dx = new_rows(sim), df = new_rows(sim);
    fill(dx, sim->point_count, 1, &(uint64_t){1});
    sim_force_product(sim, 1, dx, 1, dx, df);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_true(isfinite(df[p][i]));
    free(dx);
    free(df);
    close_shaken(&b);
}

static void products_are_equal_to_the_bit_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {1, 2, 3, 7};
    struct error err = {0};
    struct balloon b;
    open_shaken(&b, 2, 2, SETTINGS("balloons[0].pressure=50", "balloons[0].damping=3"));
    const size_t bytes = b.sim.point_count * sizeof(double[4]);
    rows dx = new_rows(&b.sim), first = new_rows(&b.sim), df = new_rows(&b.sim);
    double(*block)[3][4] = aligned_alloc(32, 3 * bytes), (*first_block)[3][4] = aligned_alloc(32, 3 * bytes);
    fill(dx, b.sim.point_count, 1, &(uint64_t){1});
    for (size_t i = 0; i < sizeof workers / sizeof workers[0]; i++) {
        struct sim sim;
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers[i], &err), &err);
        assert_ok(sim_jacobian_open(&sim, &err), &err);
        memcpy(sim.position, b.sim.position, bytes);
        memcpy(sim.velocity, b.sim.velocity, bytes);
        sim_linearise(&sim);
        sim_force_product(&sim, 0.5, dx, 1, dx, i ? df : first);
        sim_diagonal_blocks(&sim, 0.5, 1, i ? block : first_block);
        if (i) {
            assert_memory_equal(df, first, bytes);
            assert_memory_equal(block, first_block, 3 * bytes);
        }
        sim_jacobian_close(&sim);
        sim_clear(&sim);
    }
    free(dx);
    free(first);
    free(df);
    free(block);
    free(first_block);
    close_shaken(&b);
}

/* An effect whose force is -3 v: its product is -3 b dv. */
static void drag_product(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                         double (*dv)[4], double (*df)[4])
{
    (void)sim, (void)a, (void)dx;
    for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++)
        for (int i = 0; i < 3; i++)
            df[p][i] -= 3 * b * dv[p][i];
}

static void effects_add_their_share(void **state)
{
    (void)state;
    static const struct effect drag = {.name = "test", .phase = EFFECT_FORCES, .product = drag_product};
    struct balloon b;
    open_shaken(&b, 1, 2, SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0"));
    struct sim *sim = &b.sim;
    sim->hooks[EFFECT_FORCES] = calloc(1, sizeof(struct effect_hook));
    sim->hooks[EFFECT_FORCES][0] = (struct effect_hook){&drag, sim->balloons};
    rows dx = new_rows(sim), dv = new_rows(sim), without = new_rows(sim), with = new_rows(sim);
    fill(dx, sim->point_count, 1, &(uint64_t){1});
    fill(dv, sim->point_count, 1, &(uint64_t){2});
    sim_force_product(sim, 1, dx, 0.5, dv, without);
    sim->hook_count[EFFECT_FORCES] = 1;
    sim_force_product(sim, 1, dx, 0.5, dv, with);
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            assert_near(with[p][i], without[p][i] - 1.5 * dv[p][i], 1e-12);
    free(dx);
    free(dv);
    free(without);
    free(with);
    close_shaken(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_of_springs_are_the_differences_of_their_forces),
        cmocka_unit_test(products_of_dampers_are_the_differences_of_their_forces),
        cmocka_unit_test(products_of_pressure_are_the_differences_of_its_forces),
        cmocka_unit_test(products_of_viscous_arms_are_the_differences_of_their_forces),
        cmocka_unit_test(products_of_everything_at_once_are_the_differences),
        cmocka_unit_test(products_of_pressure_on_areas_are_the_differences_of_its_forces),
        cmocka_unit_test(products_of_gas_are_the_differences_of_its_forces),
        cmocka_unit_test(products_of_drag_are_the_differences_of_its_forces),
        cmocka_unit_test(products_of_string_and_pins_are_the_differences_of_their_forces),
        cmocka_unit_test(factors_scale_the_two_parts_of_a_product),
        cmocka_unit_test(diagonal_blocks_are_those_of_the_products),
        cmocka_unit_test(moving_as_one_changes_no_force),
        cmocka_unit_test(what_has_no_length_or_area_has_no_derivative),
        cmocka_unit_test(products_are_equal_to_the_bit_for_any_number_of_threads),
        cmocka_unit_test(effects_add_their_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
