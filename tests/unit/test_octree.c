/* The octree against a dense grid of cells: changes, copies, comparisons. */
#include "grids.h"

static void a_new_cube_is_one_leaf(void **state)
{
    (void)state;
    struct octree tree = new_tree(DEPTH, 1);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.leaves, 1);
    assert_int_equal(info.nodes, 1);
    assert_int_equal(info.cells, CELLS);
    assert_int_equal(info.exposed_faces, 6 * SIDE * SIDE);
    assert_int_equal(info.smallest_side, SIDE);
    assert_int_equal(octree_at(&tree, SIDE - 1, 0, 0), 1);
    assert_int_equal(octree_at(&tree, SIDE, 0, 0), 0);
    assert_int_equal(octree_at(&tree, 0, -1, 0), 0);
    octree_clear(&tree);
}

static void depths_and_materials_out_of_range_are_refused(void **state)
{
    (void)state;
    struct octree tree = {0};
    struct error err = {0};
    assert_refused(octree_init(&tree, 11, 1, &err), STATUS_RANGE, "depth 11: must be from 0 to 10", &err);
    assert_refused(octree_init(&tree, 3, 256, &err), STATUS_RANGE, "material 256", &err);
}

static void random_boxes_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    uint64_t seed = 1;
    struct grid grid = {0};
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 0);
    for (int i = 0; i < 2000; i++) {
        struct cells cells = random_cells(&seed);
        unsigned material = (unsigned)(random_bits(&seed) % 3);
        assert_ok(octree_apply(&tree, cells_cover, &cells, material, &err), &err);
        set_grid(&grid, &cells, material);
        if (i % 20 == 0) {
            assert_same_cells(&tree, &grid);
            assert_sound(&tree);
        }
    }
    octree_clear(&tree);
}

static void random_single_cells_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    uint64_t seed = 2;
    struct error err = {0};
    struct grid grid = {0};
    struct octree tree = new_tree(DEPTH, 0);
    for (int i = 0; i < 40000; i++) {
        uint64_t bits = random_bits(&seed);
        int x = (int)(bits % 8), y = (int)(bits / 8 % 8), z = (int)(bits / 64 % 8);
        unsigned material = (unsigned)(bits / 512 % 2);
        assert_ok(octree_set(&tree, x, y, z, material, &err), &err);
        grid.cell[z][y][x] = (unsigned char)material;
        if (i % 1000 == 0) {
            assert_same_cells(&tree, &grid);
            assert_sound(&tree);
        }
    }
    octree_clear(&tree);
}

static void a_sculpture_carved_away_leaves_every_block_free(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree tree = random_tree(3, 50, &grid);
    const struct cells all = {{0, 0, 0}, {SIDE, SIDE, SIDE}, false};
    assert_true(tree.block_count > 1);
    assert_ok(octree_apply(&tree, cells_cover, &all, 0, &err), &err);
    assert_int_equal(tree.root, 0);
    assert_int_equal(tree.free_count, tree.block_count);
    assert_sound(&tree);
    octree_clear(&tree);
}

static void the_order_of_work_does_not_show(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree carved = random_tree(4, 50, &grid), built = new_tree(DEPTH, 0);
    for (int x = SIDE - 1; x >= 0; x--)
        for (int y = 0; y < SIDE; y++)
            for (int z = 0; z < SIDE; z++)
                assert_ok(octree_set(&built, x, y, z, grid.cell[z][y][x], &err), &err);
    assert_true(octree_equal(&carved, &built));
    assert_ok(octree_set(&built, 5, 6, 7, 9, &err), &err);
    assert_false(octree_equal(&carved, &built));
    octree_clear(&carved);
    octree_clear(&built);
}

static void a_copy_goes_its_own_way(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree tree = random_tree(5, 30, &grid), copy = new_tree(DEPTH, 2);
    assert_ok(octree_copy(&copy, &tree, &err), &err);
    assert_true(octree_equal(&tree, &copy));
    assert_ok(octree_set(&copy, 1, 1, 1, 9, &err), &err);
    assert_same_cells(&tree, &grid);
    assert_sound(&copy);
    octree_clear(&tree);
    octree_clear(&copy);
}

static void coefficients_count_only_where_the_material_is_in_use(void **state)
{
    (void)state;
    struct octree a = new_tree(DEPTH, 1), b = new_tree(DEPTH, 1);
    b.coefficient[2] = 5;
    assert_true(octree_equal(&a, &b));
    b.coefficient[1] = 5;
    assert_false(octree_equal(&a, &b));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_cube_is_one_leaf),
        cmocka_unit_test(depths_and_materials_out_of_range_are_refused),
        cmocka_unit_test(random_boxes_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(random_single_cells_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(a_sculpture_carved_away_leaves_every_block_free),
        cmocka_unit_test(the_order_of_work_does_not_show),
        cmocka_unit_test(a_copy_goes_its_own_way),
        cmocka_unit_test(coefficients_count_only_where_the_material_is_in_use),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
