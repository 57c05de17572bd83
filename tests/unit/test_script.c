/* Scripts: what they do, what is wrong with them, and those that are made from a sculpture. */
#include "folder.h"
#include "trees.h"

/* What a.chips makes. */
static struct octree replay(void)
{
    struct error err = {0};
    struct chips chips = {0};
    struct octree tree = {0};
    assert_ok(chips_load("a.chips", &chips, &err), &err);
    assert_ok(chips_begin(&chips, 5, &tree, &err), &err);
    for (size_t i = 0; i < chips.count; i++)
        assert_ok(sculpt_chip(&tree, &chips.items[i], &err), &err);
    chips_clear(&chips);
    return tree;
}

static void a_script_does_what_it_says(void **state)
{
    (void)state;
    write_text("a.chips", "# a comment\r\n"
                          "\n"
                          "  depth 4   # 16 cells\n"
                          "start empty\n"
                          "fill box 0 0 0 1 0.5 1\t# the floor\n"
                          "material 7\n"
                          "coefficient 7 -0.25\n"
                          "fill box 0 0.5 0 0.5 1 1\n"
                          "chip box 0 0 0 .5 .5 .5");
    struct octree tree = replay();
    assert_int_equal(tree.depth, 4);
    assert_int_equal(octree_at(&tree, 15, 0, 0), 1);
    assert_int_equal(octree_at(&tree, 0, 15, 0), 7);
    assert_int_equal(octree_at(&tree, 15, 15, 0), 0);
    assert_int_equal(octree_at(&tree, 7, 7, 7), 0);
    assert_near((double)tree.coefficient[7], -0.25, 0);
    octree_clear(&tree);
}

static void a_script_without_header_carves_a_full_cube(void **state)
{
    (void)state;
    write_text("a.chips", "chip box 0 0 0 1 1 0.5\n");
    struct octree tree = replay();
    assert_int_equal(tree.depth, 5);
    assert_int_equal(octree_measure(&tree).cells, 32 * 32 * 16);
    octree_clear(&tree);
}

static void a_wrong_line_is_named(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"", "a.chips: the file is empty"},
        {"\n\nchop box 0 0 0 1 1 1\n", "a.chips:3: \"chop\" is unknown; a line begins with chip"},
        {"chip\n", "a.chips:1: the shape is missing; there are box, sphere"},
        {"chip cube 0 0 0 1\n", "a.chips:1: \"cube\" is no shape; there are box, sphere"},
        {"chip sphere 0 0 0\n", "a.chips:1: the line ends early; it is: chip sphere X Y Z R"},
        {"fill sphere 0 0 # 0 1\n", "a.chips:1: the line ends early; it is: fill sphere X Y Z R"},
        {"chip sphere 0 0 0 1 2\n", "a.chips:1: \"2\" is one word too many; the line is: chip sphere"},
        {"chip sphere 0 0 zero 1\n", "a.chips:1: \"zero\" must be a finite number; the line is: chip sphere"},
        {"chip sphere 0 0 0 1\nchip sphere 0 nan 0 1\n", "a.chips:2: \"nan\" must be a finite number"},
        {"chip sphere 0 -inf 0 1\n", "a.chips:1: \"-inf\" must be a finite number"},
        {"chip sphere 0 1e999 0 1\n", "a.chips:1: \"1e999\" must be a finite number"},
        {"chip sphere 0 0 0 -1\n", "a.chips:1: a radius of the sphere is -1; must be at least 1e-09"},
        {"depth 11\n", "a.chips:1: \"11\" must be a whole number from 0 to 10; the line is: depth N"},
        {"depth 2.5\n", "a.chips:1: \"2.5\" must be a whole number from 0 to 10"},
        {"depth\n", "a.chips:1: the line ends early; it is: depth N"},
        {"depth 3\ndepth 3\n", "a.chips:2: depth a second time; line 1 has it already"},
        {"start full\nstart full\n", "a.chips:2: start a second time"},
        {"chip sphere 0 0 0 1\nstart full\n", "a.chips:2: start must come before the first operation"},
        {"start half\n", "a.chips:1: full or empty is missing"},
        {"material 0\n", "a.chips:1: \"0\" must be a whole number from 1 to 255"},
        {"coefficient 256 1\n", "a.chips:1: \"256\" must be a whole number from 1 to 255"},
        {"coefficient 1 1e4\n", "a.chips:1: coefficient 10000; must be within +-1000"},
        {"coefficient 1\n", "a.chips:1: the line ends early; it is: coefficient N B"},
        {"\x7f"
         "ELF\2\1\n",
         "a.chips:1: \"?ELF??\" is unknown"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error err = {0};
        struct chips chips = {.depth = 3};
        write_text("a.chips", cases[i][0]);
        assert_refused(chips_load("a.chips", &chips, &err), STATUS_INPUT, cases[i][1], &err);
        assert_int_equal(chips.depth, 3);
    }
}

static void an_exported_script_makes_an_equal_octree(void **state)
{
    (void)state;
    struct error err = {0};
    for (uint64_t seed = 1; seed < 6; seed++) {
        struct octree tree = random_sculpture(6, 30, seed);
        tree.coefficient[2] = 0.1f;
        assert_ok(chips_save(&tree, "a.chips", &err), &err);
        struct octree back = replay();
        assert_true(octree_equal(&tree, &back));
        octree_clear(&tree);
        octree_clear(&back);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_script_does_what_it_says),
        cmocka_unit_test(a_script_without_header_carves_a_full_cube),
        cmocka_unit_test(a_wrong_line_is_named),
        cmocka_unit_test(an_exported_script_makes_an_equal_octree),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
