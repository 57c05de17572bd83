/* Shapes against their definitions on a dense grid of 64 cells a side; scripts; faces. */
#include "check.h"
#include "common/file.h"
#include "common/random.h"
#include "common/vec3.h"
#include "sculpt/sculpt.h"

#include <unistd.h>

enum { DEPTH = 6, SIDE = 1 << DEPTH };

static char folder[] = "/tmp/balloon-chips-XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(folder) || chdir(folder);
}

static int leave_folder(void **state)
{
    (void)state;
    unlink("a.chips");
    return rmdir(folder);
}

/* Where a point lies along an axis, and how far off it. */
static void on_axis(const double *ends, const double p[3], double *along, double *off, double *length)
{
    double axis[3], from[3], across[3];
    vec3_sub(ends + 3, ends, axis);
    vec3_sub(p, ends, from);
    *length = vec3_length(axis);
    *along = vec3_dot(from, axis) / *length;
    vec3_cross(axis, from, across);
    *off = vec3_length(across) / *length;
}

static bool in_cone(const double *v, double first_radius, double last_radius, const double p[3])
{
    double along, off, length;
    on_axis(v, p, &along, &off, &length);
    return along >= 0 && along <= length &&
           off <= first_radius + (last_radius - first_radius) * along / length;
}

/* Distance to the sphere at a share t of the way. */
static double capsule_at(const double *v, const double p[3], double t)
{
    double centre[3];
    for (int k = 0; k < 3; k++)
        centre[k] = v[k] + t * (v[k + 3] - v[k]);
    return vec3_distance(p, centre) - (v[6] + t * (v[7] - v[6]));
}

/* The union of all spheres on the way, by search: the distance is convex in t. */
static bool in_capsule(const double *v, const double p[3])
{
    double low = 0, high = 1;
    for (int i = 0; i < 45; i++) {
        double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (capsule_at(v, p, a) < capsule_at(v, p, b))
            high = b;
        else
            low = a;
    }
    return capsule_at(v, p, (low + high) / 2) <= 0;
}

static bool in_shape(const struct chip *chip, const double p[3])
{
    const double *v = chip->value;
    double sum = 0;
    switch (chip->shape) {
    case CHIP_BOX:
        for (int k = 0; k < 3; k++)
            if (p[k] < fmin(v[k], v[k + 3]) || p[k] > fmax(v[k], v[k + 3]))
                return false;
        return true;
    case CHIP_SPHERE:
        return vec3_distance(p, v) <= v[3];
    case CHIP_ELLIPSOID:
        for (int k = 0; k < 3; k++)
            sum += pow((p[k] - v[k]) / v[k + 3], 2);
        return sum <= 1;
    case CHIP_HALF_SPACE:
        for (int k = 0; k < 3; k++)
            sum += (p[k] - v[k]) * v[k + 3];
        return sum >= 0;
    case CHIP_CYLINDER:
        return in_cone(v, v[6], v[6], p);
    case CHIP_CONE:
        return in_cone(v, v[6], v[7], p);
    case CHIP_CAPSULE:
    case CHIP_SHAPES:
        break;
    }
    return in_capsule(v, p);
}

static unsigned char grid[SIDE][SIDE][SIDE]; /* [z][y][x] */

static void chip_grid(const struct chip *chip)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                const double centre[3] = {(x + 0.5) / SIDE, (y + 0.5) / SIDE, (z + 0.5) / SIDE};
                if (in_shape(chip, centre))
                    grid[z][y][x] = (unsigned char)chip->material;
            }
}

static void assert_same_cells(const struct octree *tree, const char *after)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                if (octree_at(tree, x, y, z) != grid[z][y][x])
                    fail_msg("after %s cell %d %d %d is %u, must be %u", after, x, y, z,
                             octree_at(tree, x, y, z), grid[z][y][x]);
}

static struct octree new_tree(unsigned depth, unsigned material)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

/* Positions from -0.25 to 1.25, radii from 0.01 to 0.31: some reach out of the cube, some lie outside. */
static struct chip random_chip(enum chip_shape shape, uint64_t *seed)
{
    struct chip chip = {.shape = shape, .material = (unsigned)(random_bits(seed) % 3)};
    for (int i = 0; i < CHIP_VALUES_MAX; i++)
        chip.value[i] = 1.5 * random_unit(seed) - 0.25;
    int first_radius = shape == CHIP_SPHERE || shape == CHIP_ELLIPSOID ? 3 : 6;
    for (int i = first_radius; i < CHIP_VALUES_MAX; i++)
        chip.value[i] = 0.01 + 0.3 * random_unit(seed);
    for (int i = 3; i < 6 && shape == CHIP_HALF_SPACE; i++)
        chip.value[i] -= 0.5;
    if (shape == CHIP_CONE && random_bits(seed) % 4 == 0)
        chip.value[6 + random_bits(seed) % 2] = 0;
    return chip;
}

/* Every shape in turn, on what the ones before left. A grid takes 10 to 60 ms a chip of search and square
 * roots, so that each shape has as many as fit into about half a second. */
static void random_chips_and_fills_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    static const int repeats[CHIP_SHAPES] = {40, 40, 40, 40, 25, 25, 4};
    uint64_t seed = 1;
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 1);
    memset(grid, 1, sizeof grid);
    for (int shape = 0; shape < CHIP_SHAPES; shape++)
        for (int i = 0; i < repeats[shape]; i++) {
            struct chip chip = random_chip((enum chip_shape)shape, &seed);
            assert_ok(chip_check(&chip, &err), &err);
            assert_ok(sculpt_chip(&tree, &chip, &err), &err);
            chip_grid(&chip);
            assert_same_cells(&tree, chip_shape_names[shape].name);
        }
    octree_clear(&tree);
}

/* Thousands of small ones: only the cells near them are looked at, so that there is time for as many. */
static void thousands_of_small_chips_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    uint64_t seed = 2;
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 1);
    memset(grid, 1, sizeof grid);
    for (int i = 0; i < 5000; i++) {
        struct chip chip = {.shape = CHIP_SPHERE, .material = (unsigned)(random_bits(&seed) % 2)};
        for (int k = 0; k < 3; k++)
            chip.value[k] = random_unit(&seed);
        chip.value[3] = 0.02 + 0.06 * random_unit(&seed);
        assert_ok(sculpt_chip(&tree, &chip, &err), &err);
        int low[3], high[3];
        for (int k = 0; k < 3; k++) {
            low[k] = (int)fmax(0, floor((chip.value[k] - chip.value[3]) * SIDE));
            high[k] = (int)fmin(SIDE - 1, floor((chip.value[k] + chip.value[3]) * SIDE));
        }
        for (int z = low[2]; z <= high[2]; z++)
            for (int y = low[1]; y <= high[1]; y++)
                for (int x = low[0]; x <= high[0]; x++) {
                    const double centre[3] = {(x + 0.5) / SIDE, (y + 0.5) / SIDE, (z + 0.5) / SIDE};
                    if (in_shape(&chip, centre))
                        grid[z][y][x] = (unsigned char)chip.material;
                    assert_int_equal(octree_at(&tree, x, y, z), grid[z][y][x]);
                }
    }
    assert_same_cells(&tree, "all spheres");
    octree_clear(&tree);
}

static uint64_t cells_after(struct octree *tree, struct chip chip)
{
    struct error err = {0};
    assert_ok(chip_check(&chip, &err), &err);
    assert_ok(sculpt_chip(tree, &chip, &err), &err);
    return octree_measure(tree).cells;
}

static void boxes_side_by_side_share_no_cell(void **state)
{
    (void)state;
    /* the border runs through the centres of the cells 31: they belong to the second box alone */
    const double border = 31.5 / SIDE;
    struct octree tree = new_tree(DEPTH, 0);
    struct chip left = {CHIP_BOX, 1, {0, 0, 0, border, 1, 1}, CHIP_CARVE, 0},
                right = {CHIP_BOX, 2, {border, 1, 1, 1, 0, 0}, CHIP_CARVE, 0};
    assert_int_equal(cells_after(&tree, left), 31 * SIDE * SIDE);
    assert_int_equal(cells_after(&tree, right), SIDE * SIDE * SIDE);
    assert_int_equal(octree_at(&tree, 30, 0, 0), 1);
    assert_int_equal(octree_at(&tree, 31, 0, 0), 2);
    octree_clear(&tree);
}

static void chips_outside_the_cube_change_nothing(void **state)
{
    (void)state;
    struct octree tree = new_tree(DEPTH, 1);
    struct chip chips[] = {{CHIP_SPHERE, 0, {3, 0.5, 0.5, 1}, CHIP_CARVE, 0},
                           {CHIP_BOX, 0, {1, 0, 0, 2, 1, 1}, CHIP_CARVE, 0},
                           {CHIP_HALF_SPACE, 0, {0.5, 1.1, 0.5, 0, 1e6, 0}, CHIP_CARVE, 0},
                           {CHIP_CAPSULE, 0, {-1e6, 1e6, 0, 1e6, 1e6, 0, 1, 1}, CHIP_CARVE, 0}};
    for (size_t i = 0; i < sizeof chips / sizeof *chips; i++)
        assert_int_equal(cells_after(&tree, chips[i]), SIDE * SIDE * SIDE);
    assert_int_equal(octree_leaf_count(&tree), 1);
    octree_clear(&tree);
}

static void a_capsule_that_does_not_move_is_its_larger_sphere(void **state)
{
    (void)state;
    struct octree sphere = new_tree(DEPTH, 0), still = new_tree(DEPTH, 0), swallowed = new_tree(DEPTH, 0);
    cells_after(&sphere, (struct chip){CHIP_SPHERE, 1, {0.5, 0.5, 0.5, 0.3}, CHIP_CARVE, 0});
    cells_after(&still,
                (struct chip){CHIP_CAPSULE, 1, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.1, 0.3}, CHIP_CARVE, 0});
    cells_after(&swallowed,
                (struct chip){CHIP_CAPSULE, 1, {0.5, 0.5, 0.5, 0.55, 0.5, 0.5, 0.3, 0.1}, CHIP_CARVE, 0});
    assert_true(octree_equal(&sphere, &still));
    assert_true(octree_equal(&sphere, &swallowed));
    octree_clear(&sphere);
    octree_clear(&still);
    octree_clear(&swallowed);
}

static void what_is_no_shape_is_refused(void **state)
{
    (void)state;
    struct {
        struct chip chip;
        const char *part;
    } cases[] = {
        {{CHIP_SPHERE, 0, {0, 0, 0, 0}, CHIP_CARVE, 0}, "a radius of the sphere is 0; must be above 0"},
        {{CHIP_SPHERE, 0, {0, NAN, 0, 1}, CHIP_CARVE, 0}, "number 2 of the sphere is nan"},
        {{CHIP_SPHERE, 0, {0, 0, 1e300, 1}, CHIP_CARVE, 0},
         "number 3 of the sphere is 1e+300; must be within +-1e+06"},
        {{CHIP_ELLIPSOID, 0, {0, 0, 0, 1, 1, -1}, CHIP_CARVE, 0}, "a radius of the ellipsoid is -1"},
        {{CHIP_BOX, 0, {0, 0, 0, 1, 0, 1}, CHIP_CARVE, 0}, "the box is flat along y"},
        {{CHIP_HALF_SPACE, 0, {0, 0, 0, 0, 0, 0}, CHIP_CARVE, 0}, "normal has no length"},
        {{CHIP_CYLINDER, 0, {1, 1, 1, 1, 1, 1, 1}, CHIP_CARVE, 0}, "the axis of the cylinder has no length"},
        {{CHIP_CYLINDER, 0, {0, 0, 0, 1, 1, 1, INFINITY}, CHIP_CARVE, 0}, "number 7 of the cylinder is inf"},
        {{CHIP_CONE, 0, {0, 0, 0, 1, 1, 1, 0, 0}, CHIP_CARVE, 0}, "both radii of the cone are 0"},
        {{CHIP_CONE, 0, {0, 0, 0, 1, 1, 1, 1, -1}, CHIP_CARVE, 0}, "a radius of the cone is -1"},
        {{CHIP_CAPSULE, 0, {0, 0, 0, 1, 1, 1, 1, 0}, CHIP_CARVE, 0}, "a radius of the capsule is 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error err = {0};
        assert_refused(chip_check(&cases[i].chip, &err), STATUS_RANGE, cases[i].part, &err);
    }
}

static void write_script(const char *text)
{
    FILE *stream = fopen("a.chips", "wb");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

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
    write_script("# a comment\r\n"
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
    write_script("chip box 0 0 0 1 1 0.5\n");
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
        {"chip sphere 0 0 0 -1\n", "a.chips:1: a radius of the sphere is -1; must be above 0"},
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
        write_script(cases[i][0]);
        assert_refused(chips_load("a.chips", &chips, &err), STATUS_INPUT, cases[i][1], &err);
        assert_int_equal(chips.depth, 3);
    }
}

static struct octree random_sculpture(uint64_t seed)
{
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 1);
    for (int i = 0; i < 30; i++) {
        struct chip chip = random_chip((enum chip_shape)(i % CHIP_SHAPES), &seed);
        chip.material = (unsigned)(i % 4);
        assert_ok(sculpt_chip(&tree, &chip, &err), &err);
    }
    return tree;
}

static void an_exported_script_makes_an_equal_octree(void **state)
{
    (void)state;
    struct error err = {0};
    for (uint64_t seed = 1; seed < 6; seed++) {
        struct octree tree = random_sculpture(seed);
        tree.coefficient[2] = 0.1f;
        assert_ok(chips_save(&tree, "a.chips", &err), &err);
        struct octree back = replay();
        assert_true(octree_equal(&tree, &back));
        octree_clear(&tree);
        octree_clear(&back);
    }
}

static void faces_enclose_the_volume_and_have_the_area_of_the_cells(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = random_sculpture(9);
    struct mesh mesh = {0};
    assert_ok(sculpt_faces(&tree, &mesh, &err), &err);
    struct octree_info info = octree_measure(&tree);
    /* sums of some 10^4 terms of at most 1, each exact to 2^-53 */
    assert_near(mesh_volume(&mesh), (double)info.cells / (SIDE * SIDE * SIDE), 1e-11);
    assert_near(mesh_area(&mesh), (double)info.exposed_faces / (SIDE * SIDE), 1e-11);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

/* Every edge is used as often one way as the other: no cracks, whatever the sizes of the leaves. */
static void faces_have_no_cracks(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = random_sculpture(10);
    struct mesh mesh = {0};
    assert_ok(sculpt_faces(&tree, &mesh, &err), &err);
    assert_ok(mesh_connect(&mesh, &err), &err);
    int *balance = calloc(mesh.edge_count, sizeof *balance);
    for (uint32_t t = 0; t < mesh.triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh.triangle_edge[t][k];
            balance[edge] += mesh.triangle[t][k] == mesh.edge[edge][0] ? 1 : -1;
        }
    for (uint32_t edge = 0; edge < mesh.edge_count; edge++)
        assert_int_equal(balance[edge], 0);
    free(balance);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void a_full_cube_has_twelve_triangles(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 1);
    struct mesh mesh = {0};
    assert_ok(sculpt_faces(&tree, &mesh, &err), &err);
    assert_int_equal(mesh.point_count, 8);
    assert_int_equal(mesh.triangle_count, 12);
    assert_near(mesh_volume(&mesh), 1, 0);
    mesh_clear(&mesh);
}

static void an_empty_sculpture_has_no_faces(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 0);
    struct mesh mesh = {0};
    assert_refused(sculpt_faces(&tree, &mesh, &err), STATUS_RANGE, "the sculpture is empty", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_chips_and_fills_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(thousands_of_small_chips_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(boxes_side_by_side_share_no_cell),
        cmocka_unit_test(chips_outside_the_cube_change_nothing),
        cmocka_unit_test(a_capsule_that_does_not_move_is_its_larger_sphere),
        cmocka_unit_test(what_is_no_shape_is_refused),
        cmocka_unit_test(a_script_does_what_it_says),
        cmocka_unit_test(a_script_without_header_carves_a_full_cube),
        cmocka_unit_test(a_wrong_line_is_named),
        cmocka_unit_test(an_exported_script_makes_an_equal_octree),
        cmocka_unit_test(faces_enclose_the_volume_and_have_the_area_of_the_cells),
        cmocka_unit_test(faces_have_no_cracks),
        cmocka_unit_test(a_full_cube_has_twelve_triangles),
        cmocka_unit_test(an_empty_sculpture_has_no_faces),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
