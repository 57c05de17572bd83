/* MagicaVoxel models, read, and written and read back. */
#include "common/random.h"
#include "vox_models.h"

static void a_model_stands_upright_and_is_not_mirrored(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    const int x = info.low[0], y = info.low[1], z = info.high[2]; /* the file's y runs away from the viewer */
    assert_int_equal(info.cells, 5);
    assert_int_equal(octree_at(&tree, x, y, z), 1);
    assert_int_equal(octree_at(&tree, x + 1, y, z), 2);
    assert_int_equal(octree_at(&tree, x, y, z - 1), 3);
    assert_int_equal(octree_at(&tree, x, y + 1, z), 4);
    assert_int_equal(octree_at(&tree, x, y + 2, z), 5);
    octree_clear(&tree);
}

static void the_cube_is_the_smallest_with_a_free_cell_all_around(void **state)
{
    (void)state;
    static const int lengths[][2] = {{1, 2}, {2, 2}, {3, 3}, {6, 3}, {7, 4}, {254, 8}, {255, 9}};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        int length = lengths[i][0];
        const unsigned char ends[][4] = {{0, 0, 0, 1}, {(unsigned char)(length - 1), 0, 0, 1}};
        struct model model = new_model();
        add_size(&model, 256, 1, 1);
        add_voxels(&model, ends, 2);
        struct octree tree = load(&model);
        struct octree_info info = octree_measure(&tree);
        int side = 1 << tree.depth;
        assert_int_equal(tree.depth, lengths[i][1]);
        for (int k = 0; k < 3; k++) {
            int before = info.low[k], behind = side - 1 - info.high[k];
            assert_true(before >= 1 && behind >= 1 && abs(before - behind) <= 1);
        }
        octree_clear(&tree);
    }
}

static void several_models_without_a_scene_are_merged(void **state)
{
    (void)state;
    static const unsigned char one[][4] = {{0, 0, 0, 1}, {1, 0, 0, 1}},
                               other[][4] = {{1, 0, 0, 2}, {3, 0, 0, 2}};
    struct model model = new_model();
    add_size(&model, 2, 1, 1);
    add_voxels(&model, one, 2);
    add_size(&model, 4, 1, 1);
    add_voxels(&model, other, 2);
    add_layer(&model, 0, true); /* in which nothing is */
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.cells, 3);
    assert_int_equal(octree_at(&tree, info.low[0], info.low[1], info.low[2]), 1);
    assert_int_equal(octree_at(&tree, info.low[0] + 1, info.low[1], info.low[2]), 2);
    assert_int_equal(octree_at(&tree, info.low[0] + 3, info.low[1], info.low[2]), 2);
    octree_clear(&tree);
}

/* Where the letter's parts go when the scene turns it by these bits and moves it by (10, 20, 30). */
static struct octree turned(const char *rotation)
{
    static const unsigned char mark[][4] = {{0, 0, 0, 9}};
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    add_size(&model, 1, 1, 1);
    add_voxels(&model, mark, 1);
    add_transform(&model, 0, 1, NULL, NULL, false);
    add_group(&model, 1, (const uint32_t[]){2, 4}, 2);
    add_transform(&model, 2, 3, rotation, "10 20 30", false);
    add_shape(&model, 3, 0);
    add_transform(&model, 4, 5, NULL, "0 0 0", false);
    add_shape(&model, 5, 1);
    return load(&model);
}

/* The material at (x, y, z) of the file, measured from the mark at the scene's origin. */
static unsigned at_scene(const struct octree *tree, int x, int y, int z)
{
    struct octree_info info = octree_measure(tree);
    return octree_at(tree, info.low[0] + x, info.low[1] + z, info.high[2] - y);
}

static void a_scene_moves_models_by_their_middle(void **state)
{
    (void)state;
    struct octree tree = turned(NULL);
    /* a model of 2 x 2 x 3 turns about the corner 1 1 1 of its cells, which goes to 10 20 30 */
    assert_int_equal(at_scene(&tree, 0, 0, 0), 9);
    assert_int_equal(at_scene(&tree, 9, 19, 29), 1);
    assert_int_equal(at_scene(&tree, 10, 19, 29), 2);
    assert_int_equal(at_scene(&tree, 9, 20, 29), 3);
    assert_int_equal(at_scene(&tree, 9, 19, 30), 4);
    assert_int_equal(at_scene(&tree, 9, 19, 31), 5);
    octree_clear(&tree);
}

static void a_scene_turns_models(void **state)
{
    (void)state;
    /* rows (0 -1 0), (1 0 0), (0 0 1): a quarter turn about z, x to y and y to -x: columns 1 and 0 (1 | 0 <<
     * 2), the first row's sign minus (1 << 4): 17. About the corner 1 1 1 the first cell, which spans -1 .. 0
     * along each axis, then spans 0 .. 1 along x. */
    struct octree tree = turned("17");
    assert_int_equal(at_scene(&tree, 10, 19, 29), 1);
    assert_int_equal(at_scene(&tree, 10, 20, 29), 2);
    assert_int_equal(at_scene(&tree, 9, 19, 29), 3);
    assert_int_equal(at_scene(&tree, 10, 19, 31), 5);
    octree_clear(&tree);
    /* rows (0 1 0), (0 0 -1), (-1 0 0): the format's own example: 1 | 2 << 2 | 1 << 5 | 1 << 6 = 105 */
    tree = turned("105");
    assert_int_equal(at_scene(&tree, 9, 20, 30), 1);
    assert_int_equal(at_scene(&tree, 9, 20, 29), 2);
    assert_int_equal(at_scene(&tree, 10, 20, 30), 3);
    assert_int_equal(at_scene(&tree, 9, 18, 30), 5);
    octree_clear(&tree);
}

static void nested_moves_add_up_and_hidden_parts_are_left_out(void **state)
{
    (void)state;
    static const unsigned char one[][4] = {{0, 0, 0, 1}};
    struct model model = new_model();
    add_size(&model, 1, 1, 1);
    add_voxels(&model, one, 1);
    /* chunks of the scene in no order: they are found by number */
    add_shape(&model, 7, 0);
    add_shape(&model, 5, 0);
    add_shape(&model, 3, 0);
    add_transform(&model, 6, 7, NULL, "100 0 0", true);
    add_transform(&model, 4, 5, NULL, "2 1 0", false);
    add_transform(&model, 2, 3, NULL, NULL, false);
    add_group(&model, 1, (const uint32_t[]){2, 8, 6}, 3);
    add_group(&model, 9, (const uint32_t[]){4}, 1);
    add_transform(&model, 8, 9, "17", "5 0 0", false); /* 2 1 becomes -1 2 */
    add_transform(&model, 0, 1, NULL, NULL, false);
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.cells, 2);
    /* the cell spans 0 .. 1; turned about the origin it spans -1 .. 0 along x: 5 - 1 - 1, and 2 along y */
    assert_int_equal(info.high[0] - info.low[0], 3);
    assert_int_equal(info.high[2] - info.low[2], 2);
    octree_clear(&tree);
}

/* A part, a group of parts, and what no layer is known of. Layers have numbers of their own. */
static void what_is_in_a_hidden_layer_is_left_out(void **state)
{
    (void)state;
    for (uint32_t hidden = 0; hidden < 4; hidden++) {
        static const uint64_t cells[] = {1 + 2 + 4 + 8, 2 + 4 + 8, 1 + 8, 8}; /* of the parts that are left */
        struct model model = new_model();
        for (uint32_t part = 0; part < 4; part++) {
            static const unsigned char row[][4] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}, {3, 0, 0, 1},
                                                   {4, 0, 0, 1}, {5, 0, 0, 1}, {6, 0, 0, 1}, {7, 0, 0, 1}};
            add_size(&model, 8, 1, 1);
            add_voxels(&model, row, 1u << part);
            add_shape(&model, 10 + part, part);
        }
        add_transform(&model, 0, 1, NULL, NULL, false);
        add_group(&model, 1, (const uint32_t[]){2, 3, 4}, 3);
        add_transform_of_layer(&model, 1, 2, 10, NULL, NULL, false);
        add_transform_of_layer(&model, 2, 3, 7, NULL, "0 5 0", false);
        add_transform_of_layer(&model, 77, 4, 13, NULL, "0 9 0", false);
        add_group(&model, 7, (const uint32_t[]){5, 6}, 2);
        add_transform(&model, 5, 11, NULL, NULL, false);
        add_transform(&model, 6, 12, NULL, "0 1 0", false);
        add_layer(&model, 2, hidden & 2);
        add_layer(&model, 1, hidden & 1);
        add_layer(&model, 0, false);
        struct octree tree = load(&model);
        assert_int_equal(octree_measure(&tree).cells, cells[hidden]);
        octree_clear(&tree);
    }
}

/* The same cells with the same materials, wherever in the cube. */
static void assert_same_sculpture(const struct octree *a, const struct octree *b)
{
    struct octree_info one = octree_measure(a), other = octree_measure(b);
    assert_int_equal(one.cells, other.cells);
    for (int k = 0; k < 3; k++)
        assert_int_equal(one.high[k] - one.low[k], other.high[k] - other.low[k]);
    for (int z = 0; z <= one.high[2] - one.low[2]; z++)
        for (int y = 0; y <= one.high[1] - one.low[1]; y++)
            for (int x = 0; x <= one.high[0] - one.low[0]; x++)
                assert_int_equal(octree_at(a, one.low[0] + x, one.low[1] + y, one.low[2] + z),
                                 octree_at(b, other.low[0] + x, other.low[1] + y, other.low[2] + z));
}

static void assert_round_trip(const struct octree *tree)
{
    struct error err = {0};
    struct octree back = {0};
    assert_ok(vox_save(tree, "a.vox", &err), &err);
    assert_ok(vox_load("a.vox", &back, &err), &err);
    assert_same_sculpture(tree, &back);
    octree_clear(&back);
}

static void a_saved_sculpture_comes_back(void **state)
{
    (void)state;
    uint64_t seed = 3;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 5, 0, &err), &err);
    for (int i = 0; i < 2000; i++) {
        uint64_t bits = random_bits(&seed);
        assert_ok(octree_set(&tree, (int)(bits % 32), (int)(bits >> 8 & 31), (int)(bits >> 16 & 15),
                             (unsigned)(bits >> 24 & 0xff), &err),
                  &err);
    }
    assert_round_trip(&tree);
    octree_clear(&tree);
}

static void a_long_sculpture_is_saved_as_several_models(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 9, 0, &err), &err);
    struct chip rod = {CHIP_CAPSULE, 3, {0.05, 0.1, 0.9, 0.9, 0.95, 0.2, 0.004, 0.01}, CHIP_CARVE, 0};
    assert_ok(sculpt_chip(&tree, &rod, &err), &err);
    assert_round_trip(&tree);
    octree_clear(&tree);
}

static void an_empty_sculpture_is_not_saved(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 3, 0, &err), &err);
    unlink("a.vox");
    assert_refused(vox_save(&tree, "a.vox", &err), STATUS_RANGE, "a.vox: the sculpture is empty", &err);
    assert_int_equal(access("a.vox", F_OK), -1);
    assert_ok(octree_init(&tree, 10, 1, &err), &err);
    assert_refused(vox_save(&tree, "a.vox", &err), STATUS_RANGE,
                   "1073741824 cells; a .vox file holds at most", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_stands_upright_and_is_not_mirrored),
        cmocka_unit_test(the_cube_is_the_smallest_with_a_free_cell_all_around),
        cmocka_unit_test(several_models_without_a_scene_are_merged),
        cmocka_unit_test(a_scene_moves_models_by_their_middle),
        cmocka_unit_test(a_scene_turns_models),
        cmocka_unit_test(nested_moves_add_up_and_hidden_parts_are_left_out),
        cmocka_unit_test(what_is_in_a_hidden_layer_is_left_out),
        cmocka_unit_test(a_saved_sculpture_comes_back),
        cmocka_unit_test(a_long_sculpture_is_saved_as_several_models),
        cmocka_unit_test(an_empty_sculpture_is_not_saved),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
