/* How far off a threshold is: the largest value of a field. */
#include "check.h"
#include "common/random.h"
#include "surface/largest.h"
#include "surface/probe.h"

#include <math.h>

/* Scattered cells, more of them towards a corner. */
static struct octree scatter(unsigned depth, uint64_t seed)
{
    struct error err = {0};
    struct octree tree;
    assert_ok(octree_init(&tree, depth, 0, &err), &err);
    for (int i = 0; i < 400; i++) {
        int cell[3];
        for (int axis = 0; axis < 3; axis++)
            cell[axis] = (int)(pow(random_unit(&seed), 2) * (1 << depth));
        assert_ok(octree_set(&tree, cell[0], cell[1], cell[2], 1, &err), &err);
    }
    return tree;
}

/* By trying the middle of every cell. */
static double largest_of_all(const struct field *field)
{
    struct error err = {0};
    struct probe probe;
    double most = 0;
    assert_ok(probe_init(&probe, field, &err), &err);
    probe_expect(&probe, 1);
    for (int x = 0; x < field->side; x++)
        for (int y = 0; y < field->side; y++)
            for (int z = 0; z < field->side; z++)
                most = fmax(most, probe_value(&probe, (double[]){x + 0.5, y + 0.5, z + 0.5}, (double[3]){0}));
    probe_clear(&probe);
    return most;
}

/* The search climbs to the top, so it finds no less than the middles have, whether it looks at each leaf or,
 * with a wide sigma, at few of them. */
static void few_places_find_as_much_as_all(void **state)
{
    (void)state;
    static const double sigma[] = {0.5, 2, 6, 30};
    for (size_t i = 0; i < sizeof sigma / sizeof *sigma; i++)
        for (uint64_t seed = 1; seed <= 3; seed++) {
            struct error err = {0};
            struct octree tree = scatter(5, seed);
            struct field field;
            double value, point[3];
            const struct field_settings settings = {FIELDS_EXACT, 0, sigma[i], 4};
            assert_ok(field_init(&field, &tree, &settings, &err), &err);
            assert_ok(field_largest(&field, HUGE_VAL, &value, point, &err), &err);
            assert_true(value >= largest_of_all(&field) * (1 - 1e-9));
            octree_clear(&tree);
        }
}

/* Whether a threshold is reached is known at the first place that does. */
static void enough_is_soon_found(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = scatter(5, 1);
    struct field field;
    double largest, value, point[3];
    const struct field_settings settings = {FIELDS_EXACT, 0, 2, 4};
    assert_ok(field_init(&field, &tree, &settings, &err), &err);
    assert_ok(field_largest(&field, HUGE_VAL, &largest, point, &err), &err);
    assert_ok(field_largest(&field, largest / 2, &value, point, &err), &err);
    assert_true(value >= largest / 2 && value < largest);
    assert_ok(field_largest(&field, 2 * largest, &value, point, &err), &err);
    assert_true(value == largest);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_places_find_as_much_as_all),
        cmocka_unit_test(enough_is_soon_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
