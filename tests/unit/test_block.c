/* Blocks of the field's samples, lines along their edges and the table of the normal distribution: what they
 * say is what a probe does. */
#include "fields.h"
#include "surface/block.h"

static void sample(struct block *block, int x, int y, int z)
{
    assert_true(block_move(block, (int[3]){x, y, z}));
    assert_true(block_sample(block));
}

/* Of fields of every kind over one sculpture, with a grid of such cubes. */
static void check_all_kinds(uint64_t seed, double cube,
                            void (*check)(struct probe *probe, const struct grid *grid))
{
    struct error err = {0};
    struct octree tree = random_cells(3, 0.5, seed);
    tree.coefficient[2] = -0.3f;
    const struct field_settings kinds[] = {exact, {8, 0, 0.7, 5}, {1, 400, 0.5, 6}, {FIELDS_EXACT, 90, 2, 4}};
    for (int k = 0; k < 4; k++) {
        struct field field;
        struct probe probe;
        struct grid grid;
        open_field(&field, &probe, &tree, kinds[k]);
        assert_ok(grid_init(&grid, &field, cube, &err), &err);
        check(&probe, &grid);
        grid_clear(&grid);
        probe_clear(&probe);
    }
    octree_clear(&tree);
}

static void check_corners(struct probe *probe, const struct grid *grid)
{
    struct block block, other;
    assert_true(block_init(&block, grid) && block_init(&other, grid));
    /* The windows of block and other begin and end at different places. */
    sample(&block, 0, 1, 1);
    sample(&other, 2, 3, 3);
    sample(&other, 1, 1, 1);
    for (int i = 0; i < BLOCK_VALUES; i++) {
        int at[3] = {i % 9, 8 + i / 9 % 9, 8 + i / 81};
        double point[3], gradient[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = grid_coordinate(grid, at[axis]);
        assert_true(block.values[i] == probe_value(probe, point, gradient));
        assert_true(block.values[i] == block_value(&block, point, gradient));
        if (at[0] == 8)
            assert_true(block.values[i] == other.values[i - 8]);
    }
    block_clear(&block);
    block_clear(&other);
}

static void a_corner_has_the_same_bits_in_every_block_and_from_a_probe(void **state)
{
    (void)state;
    check_all_kinds(21, 0.43, check_corners);
}

static void check_edges(struct probe *probe, const struct grid *grid)
{
    struct block block;
    uint64_t seed = 6;
    assert_true(block_init(&block, grid));
    sample(&block, 1, 0, 1);
    for (int i = 0; i < 300; i++) {
        int axis = i % 3, at[3];
        double point[3], expected[3], gradient[3], slope, ends[2];
        for (int k2 = 0; k2 < 3; k2++) {
            at[k2] = (int)(8 * random_unit(&seed));
            point[k2] = grid_coordinate(grid, block.corner[k2] + at[k2]);
        }
        struct line line = block_line(&block, axis, at);
        line_slopes(&line, at, ends);
        probe_value(probe, point, expected);
        assert_near(ends[0], expected[axis], 1e-12);
        point[axis] += random_unit(&seed) * grid->cube;
        double value = line_value(&line, point[axis], &slope);
        line_gradient(&line, slope, gradient);
        /* The same sums in another order: a few hundred terms of size 1/s at most. */
        assert_near(value, probe_value(probe, point, expected), 1e-13);
        for (int k2 = 0; k2 < 3; k2++)
            assert_near(gradient[k2], expected[k2], 1e-12);
    }
    block_clear(&block);
}

static void along_the_edges_of_the_grid_the_field_is_that_of_a_probe(void **state)
{
    (void)state;
    check_all_kinds(22, 0.37, check_edges);
}

static void the_tabulated_distribution_is_that_of_erf(void **state)
{
    (void)state;
    struct distribution distribution;
    for (double cutoff = 2; cutoff <= 8; cutoff += 0.5) {
        double mass = erf(cutoff / M_SQRT2);
        distribution_fill(&distribution, cutoff);
        for (int i = -5000; i <= 5000; i++) {
            double u = i * cutoff / 5000, slope;
            double value = distribution_value(&distribution, u, &slope);
            /* The bounds derived in distribution.h and two roundings of a half. */
            assert_near(value, erf(u / M_SQRT2) / 2 / mass, 7.1e-16 + 1.2e-16);
            assert_near(slope, exp(-u * u / 2) / (sqrt(2 * M_PI) * mass), 1.8e-13);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_has_the_same_bits_in_every_block_and_from_a_probe),
        cmocka_unit_test(along_the_edges_of_the_grid_the_field_is_that_of_a_probe),
        cmocka_unit_test(the_tabulated_distribution_is_that_of_erf),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
