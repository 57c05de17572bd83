/* Shapes against their definitions on a dense grid of 64 cells a side. */
#include "common/vec3.h"
#include "trees.h"

enum { DEPTH = 6, SIDE = 1 << DEPTH };

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
    struct octree border = new_tree(DEPTH, 0), hardly = new_tree(DEPTH, 0);
    cells_after(&border, (struct chip){CHIP_SPHERE, 1, {0, 0.5, 0.5, 0.3}, CHIP_CARVE, 0});
    cells_after(&hardly, /* a way whose square is hardly a number */
                (struct chip){CHIP_CAPSULE, 1, {0, 0.5, 0.5, 1.6e-162, 0.5, 0.5, 0.3, 0.3}, CHIP_CARVE, 0});
    assert_true(octree_equal(&border, &hardly));
    octree_clear(&border);
    octree_clear(&hardly);
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
        {{CHIP_SPHERE, 0, {0, 0, 0, 1e-10}, CHIP_CARVE, 0},
         "a radius of the sphere is 1e-10; must be at least 1e-09"},
        {{CHIP_SPHERE, 0, {0, 0, 0, 0}, CHIP_CARVE, 0},
         "a radius of the sphere is 0; must be at least 1e-09"},
        {{CHIP_SPHERE, 0, {0, NAN, 0, 1}, CHIP_CARVE, 0}, "number 2 of the sphere is nan"},
        {{CHIP_SPHERE, 0, {0, 0, 1e300, 1}, CHIP_CARVE, 0},
         "number 3 of the sphere is 1e+300; must be within +-1e+06"},
        {{CHIP_ELLIPSOID, 0, {0, 0, 0, 1, 1, -1}, CHIP_CARVE, 0}, "a radius of the ellipsoid is -1"},
        {{CHIP_BOX, 0, {0, 0, 0, 1, 0, 1}, CHIP_CARVE, 0},
         "the box is flat along y; its corners must differ there, by at least 1e-09"},
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_chips_and_fills_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(thousands_of_small_chips_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(boxes_side_by_side_share_no_cell),
        cmocka_unit_test(chips_outside_the_cube_change_nothing),
        cmocka_unit_test(a_capsule_that_does_not_move_is_its_larger_sphere),
        cmocka_unit_test(what_is_no_shape_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
