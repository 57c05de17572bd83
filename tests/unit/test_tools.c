/* Sandpaper and heat against their definitions on a dense grid; mirrors; scripts with steps. */
#include "check.h"
#include "common/random.h"
#include "common/vec3.h"
#include "sculpt/sculpt.h"

enum { SIDE_MAX = 64 };

static unsigned char grid[SIDE_MAX][SIDE_MAX][SIDE_MAX], before[SIDE_MAX][SIDE_MAX][SIDE_MAX]; /* [z][y][x] */

static struct octree new_tree(unsigned depth, unsigned material)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

static void apply(struct octree *tree, const struct chip *chip)
{
    struct error err = {0};
    assert_ok(chip_check(chip, &err), &err);
    assert_ok(sculpt_chip(tree, chip, &err), &err);
}

static bool full(int side, int x, int y, int z)
{
    return x >= 0 && y >= 0 && z >= 0 && x < side && y < side && z < side && before[z][y][x] != 0;
}

static bool stands_out(int side, int x, int y, int z)
{
    int count = 0;
    for (int i = 0; i < 27; i++)
        count += full(side, x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
    return count < 14;
}

static bool is_exposed(int side, int x, int y, int z)
{
    return !full(side, x - 1, y, z) || !full(side, x + 1, y, z) || !full(side, x, y - 1, z) ||
           !full(side, x, y + 1, z) || !full(side, x, y, z - 1) || !full(side, x, y, z + 1);
}

/* In the ball or one of its mirror images. */
static bool in_balls(const struct chip *chip, const double p[3])
{
    for (unsigned axes = 0; axes < 8; axes++) {
        if (axes & ~chip->mirror)
            continue;
        double centre[3];
        for (int k = 0; k < 3; k++)
            centre[k] = axes >> k & 1 ? 1 - chip->value[k] : chip->value[k];
        if (vec3_distance(centre, p) <= chip->value[3])
            return true;
    }
    return false;
}

static void smooth_grid(int side, const struct chip *chip)
{
    memcpy(before, grid, sizeof grid);
    for (int z = 0; z < side; z++)
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++) {
                const double p[3] = {(x + 0.5) / side, (y + 0.5) / side, (z + 0.5) / side};
                if (full(side, x, y, z) && in_balls(chip, p) &&
                    (chip->kind == CHIP_HEAT ? is_exposed(side, x, y, z) : stands_out(side, x, y, z)))
                    grid[z][y][x] = 0;
            }
}

static void read_grid(const struct octree *tree)
{
    const int side = 1 << tree->depth;
    for (int z = 0; z < side; z++)
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++)
                grid[z][y][x] = (unsigned char)octree_at(tree, x, y, z);
}

static void assert_same_cells(const struct octree *tree)
{
    const int side = 1 << tree->depth;
    for (int z = 0; z < side; z++)
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++)
                if (octree_at(tree, x, y, z) != grid[z][y][x])
                    fail_msg("cell %d %d %d is %u, must be %u", x, y, z, octree_at(tree, x, y, z),
                             grid[z][y][x]);
}

/* Single cells at random, so that all neighbourhoods occur, and a few balls. */
static struct octree random_sculpture(unsigned depth, uint64_t *seed)
{
    struct error err = {0};
    const int side = 1 << depth;
    struct octree tree = new_tree(depth, 1);
    for (int i = 0; i < 8; i++) {
        struct chip ball = {.shape = CHIP_SPHERE, .material = (unsigned)(random_bits(seed) % 3)};
        for (int k = 0; k < 3; k++)
            ball.value[k] = random_unit(seed);
        ball.value[3] = 0.05 + 0.3 * random_unit(seed);
        apply(&tree, &ball);
    }
    for (int i = 0; i < side * side; i++) {
        uint64_t bits = random_bits(seed);
        assert_ok(octree_set(&tree, (int)(bits % side), (int)(bits / side % side),
                             (int)(bits >> 32) & (side - 1), (unsigned)(bits >> 60) % 2, &err),
                  &err);
    }
    return tree;
}

static struct chip random_tool(uint64_t *seed)
{
    uint64_t bits = random_bits(seed);
    struct chip chip = {.kind = bits & 1 ? CHIP_HEAT : CHIP_SANDPAPER};
    for (int k = 0; k < 3; k++)
        chip.value[k] = 1.4 * random_unit(seed) - 0.2;
    chip.value[3] = 0.01 + 0.4 * random_unit(seed);
    chip.mirror = bits & 2 ? (unsigned)(bits >> 8) % 8 : 0;
    return chip;
}

static void sandpaper_and_heat_do_what_a_dense_grid_does(void **state)
{
    (void)state;
    uint64_t seed = 1;
    static const int repeats[7] = {10, 20, 50, 100, 100, 60, 40};
    for (unsigned depth = 0; depth <= 6; depth++) {
        struct octree tree = random_sculpture(depth, &seed);
        for (int i = 0; i < repeats[depth]; i++) {
            if (i % 10 == 0) {
                octree_clear(&tree);
                tree = random_sculpture(depth, &seed);
                read_grid(&tree);
            }
            const struct chip chip = random_tool(&seed);
            apply(&tree, &chip);
            smooth_grid(1 << depth, &chip);
            assert_same_cells(&tree);
        }
        octree_clear(&tree);
    }
}

static void sandpaper_leaves_a_plane_and_takes_what_stands_on_it(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = new_tree(6, 1);
    const struct chip above = {.shape = CHIP_HALF_SPACE, .value = {0, 0.5, 0, 0, 1, 0}},
                      sand = {.kind = CHIP_SANDPAPER, .value = {0.5, 0.5, 0.5, 0.2}};
    apply(&tree, &above);
    const struct octree_info plane = octree_measure(&tree);
    assert_ok(octree_set(&tree, 32, 32, 32, 1, &err), &err);
    apply(&tree, &sand);
    assert_int_equal(octree_measure(&tree).cells, plane.cells);
    assert_int_equal(octree_measure(&tree).leaves, plane.leaves);
    octree_clear(&tree);
}

static void heat_shrinks_a_cube_by_one_cell_all_around(void **state)
{
    (void)state;
    struct octree tree = new_tree(8, 1);
    const struct chip heat = {.kind = CHIP_HEAT, .value = {0.5, 0.5, 0.5, 1}};
    apply(&tree, &heat);
    assert_int_equal(octree_measure(&tree).cells, 254 * 254 * 254);
    octree_clear(&tree);
}

/* A shape of each kind and its image, by hand. */
static void the_image_of_a_chip_is_the_chip_mirrored_by_hand(void **state)
{
    (void)state;
    static const struct {
        enum chip_shape shape;
        double value[CHIP_VALUES_MAX], image[CHIP_VALUES_MAX]; /* about x = 1/2 and z = 1/2 */
    } cases[] = {
        {CHIP_BOX, {0, 0.25, 0.5, 0.25, 0.5, 1}, {1, 0.25, 0.5, 0.75, 0.5, 0}},
        {CHIP_SPHERE, {0.25, 0.25, 0.125, 0.25}, {0.75, 0.25, 0.875, 0.25}},
        {CHIP_ELLIPSOID, {0.25, 0.25, 0.125, 0.25, 0.125, 0.5}, {0.75, 0.25, 0.875, 0.25, 0.125, 0.5}},
        {CHIP_HALF_SPACE, {0.25, 0.5, 0.25, 1, -2, 3}, {0.75, 0.5, 0.75, -1, -2, -3}},
        {CHIP_CYLINDER, {0, 0.25, 0.5, 0.25, 0.5, 1, 0.125}, {1, 0.25, 0.5, 0.75, 0.5, 0, 0.125}},
        {CHIP_CONE, {0, 0.25, 0.5, 0.25, 0.5, 1, 0.125, 0}, {1, 0.25, 0.5, 0.75, 0.5, 0, 0.125, 0}},
        {CHIP_CAPSULE, {0, 0.25, 0.5, 0.25, 0.5, 1, 0.125, 0.25}, {1, 0.25, 0.5, 0.75, 0.5, 0, 0.125, 0.25}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct chip chip = {.shape = cases[i].shape, .material = 2, .mirror = CHIP_MIRROR_X | CHIP_MIRROR_Z};
        memcpy(chip.value, cases[i].value, sizeof chip.value);
        struct chip image = chip_image(&chip, CHIP_MIRROR_X | CHIP_MIRROR_Z);
        assert_int_equal(image.mirror, 0);
        for (int v = 0; v < CHIP_VALUES_MAX; v++)
            assert_near(image.value[v], cases[i].image[v], 0);
    }
}

static void a_mirrored_chip_is_the_chip_and_all_its_images(void **state)
{
    (void)state;
    for (unsigned mirror = 0; mirror < 8; mirror++) {
        struct octree once = new_tree(6, 1), each = new_tree(6, 1);
        const struct chip chip = {
            .shape = CHIP_CAPSULE, .value = {0.1, 0.2, 0.3, 0.4, 0.45, 0.2, 0.1, 0.02}, .mirror = mirror};
        apply(&once, &chip);
        for (unsigned axes = 0; axes < 8; axes++) {
            const struct chip image = chip_image(&chip, axes);
            if (!(axes & ~mirror))
                apply(&each, &image);
        }
        assert_true(octree_equal(&once, &each));
        for (int k = 0; k < 3; k++) {
            /* the cells are symmetrical about each plane */
            const int at[3] = {15, 18, 17};
            int other[3] = {15, 18, 17};
            other[k] = 63 - at[k];
            if (mirror >> k & 1)
                assert_int_equal(octree_at(&once, at[0], at[1], at[2]),
                                 octree_at(&once, other[0], other[1], other[2]));
        }
        octree_clear(&once);
        octree_clear(&each);
    }
}

/* Its borders run through the middles of cells, of which the lower are a box's own. */
static void the_image_of_a_box_holds_the_images_of_its_cells(void **state)
{
    (void)state;
    struct octree tree = new_tree(2, 1);
    const struct chip chip = {.value = {0.125, 0.125, 0.125, 0.375, 0.375, 0.375}, .mirror = 7};
    apply(&tree, &chip);
    for (int i = 0; i < 64; i++) {
        const int at[3] = {i & 3, i >> 2 & 3, i >> 4};
        const bool corner = at[0] % 3 == 0 && at[1] % 3 == 0 && at[2] % 3 == 0;
        assert_int_equal(octree_at(&tree, at[0], at[1], at[2]), !corner);
    }
    octree_clear(&tree);
}

static struct chips parse(const char *text)
{
    struct error err = {0};
    struct chips chips = {0};
    assert_ok(chips_parse("text", text, strlen(text), &chips, &err), &err);
    return chips;
}

static struct octree run(const char *text)
{
    struct error err = {0};
    struct octree tree = {0};
    struct chips chips = parse(text);
    assert_ok(chips_begin(&chips, 5, &tree, &err), &err);
    assert_ok(chips_run(&tree, &chips, &err), &err);
    chips_clear(&chips);
    return tree;
}

#define A "chip sphere 0.2 0.2 0.2 0.15\n"
#define B "fill box 0.1 0.1 0.1 0.2 0.3 0.2\n"
#define C "heat 0.5 0.5 0.5 0.5\n"
#define D "sandpaper 0.2 0.2 0.2 0.3\n"

/* Each script ends as the other does. */
static void undo_and_redo_in_a_script_take_back_steps(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {A B "undo\n", A},
        {A B "undo\nundo\nundo\n", "start full\n"},
        {A B "undo\nundo\nredo\n", A},
        {A B "undo\nundo\nredo\nredo\nredo\n" C, A B C},
        {A B "undo\n" C "redo\n", A C},
        {"undo\nredo\n" A, A},
        {A B "step\n" C D "step\nundo\n", A B},
        {A B "step\n" C D "undo\nundo\nredo\n", A B},
        {A "step\n" B "step\n" C "undo\n" D, A B D},
        {A "step\nstep\nstep\n" B "step\nstep\nundo\n", A},
        {A "step\n" B "undo\nstep\nredo\n", A B},
        {"mirror xz\n" A "mirror none\n" B "undo\n", "mirror xz\n" A},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct octree tree = run(cases[i][0]), expected = run(cases[i][1]);
        assert_true(octree_equal(&tree, &expected));
        octree_clear(&tree);
        octree_clear(&expected);
    }
}

/* What is written reads back to the same numbers, bit by bit. */
static void written_operations_read_back_the_same(void **state)
{
    (void)state;
    uint64_t seed = 5;
    struct error err = {0};
    struct chips chips = {0};
    char *text = NULL;
    size_t size = 0;
    enum { COUNT = 1000 };
    static struct chip written[COUNT];
    FILE *stream = open_memstream(&text, &size);
    struct chip_state written_state = {1, 0};
    for (int i = 0; i < COUNT; i++) {
        struct chip *chip = &written[i];
        *chip = (struct chip){.kind = (enum chip_kind)(random_bits(&seed) % CHIP_KINDS)};
        if (chip->kind == CHIP_CARVE) {
            chip->shape = (enum chip_shape)(random_bits(&seed) % CHIP_SHAPES);
            chip->material = (unsigned)(random_bits(&seed) % 3);
        }
        const struct chip_shape_name *name = chip->kind == CHIP_CARVE ? &chip_shape_names[chip->shape]
                                                                      : &chip_kind_names[chip->kind];
        for (int v = 0; v < name->count; v++)
            chip->value[v] = random_unit(&seed) + 1e-6;
        chip->mirror = chip->kind < CHIP_STEP ? (unsigned)(random_bits(&seed) % 8) : 0;
        chip_write(stream, chip, &written_state);
    }
    fclose(stream);
    assert_ok(chips_parse("text", text, size, &chips, &err), &err);
    assert_int_equal(chips.count, COUNT);
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(chips.items[i].kind, written[i].kind);
        assert_int_equal(chips.items[i].shape, written[i].shape);
        assert_int_equal(chips.items[i].material, written[i].material);
        assert_int_equal(chips.items[i].mirror, written[i].mirror);
        assert_memory_equal(chips.items[i].value, written[i].value, sizeof written[i].value);
    }
    chips_clear(&chips);
    free(text);
}

static void wrong_lines_of_the_tools_are_named(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"mirror\n", "text:1: the line ends early; it is: mirror none, or some of the letters x, y and z"},
        {"mirror w\n", "text:1: \"w\" is no mirror; there are none, x, y, z, xy"},
        {"mirror xx\n", "text:1: \"xx\" is no mirror"},
        {"mirror x y\n", "text:1: \"y\" is one word too many; the line is: mirror none"},
        {"sandpaper 0 0 0\n", "text:1: the line ends early; it is: sandpaper X Y Z R"},
        {"heat 0 0 0 0\n", "text:1: a radius of the heat is 0; must be at least 1e-09"},
        {"heat 0 0 nan 1\n", "text:1: \"nan\" must be a finite number; the line is: heat X Y Z R"},
        {"heat 0 0 2e6 1\n", "text:1: number 3 of the heat is 2e+06; must be within +-1e+06"},
        {"step 1\n", "text:1: \"1\" is one word too many; the line is: step"},
        {"undo\nundo twice\n", "text:2: \"twice\" is one word too many; the line is: undo"},
        {"step\ndepth 3\n", "text:2: depth must come before the first operation"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error err = {0};
        struct chips chips = {0};
        assert_refused(chips_parse("text", cases[i][0], strlen(cases[i][0]), &chips, &err), STATUS_INPUT,
                       cases[i][1], &err);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sandpaper_and_heat_do_what_a_dense_grid_does),
        cmocka_unit_test(sandpaper_leaves_a_plane_and_takes_what_stands_on_it),
        cmocka_unit_test(heat_shrinks_a_cube_by_one_cell_all_around),
        cmocka_unit_test(the_image_of_a_chip_is_the_chip_mirrored_by_hand),
        cmocka_unit_test(the_image_of_a_box_holds_the_images_of_its_cells),
        cmocka_unit_test(a_mirrored_chip_is_the_chip_and_all_its_images),
        cmocka_unit_test(undo_and_redo_in_a_script_take_back_steps),
        cmocka_unit_test(written_operations_read_back_the_same),
        cmocka_unit_test(wrong_lines_of_the_tools_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
