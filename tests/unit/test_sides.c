/* Proofs that a ball is on one side of the threshold: they hold, and are found where the field is small. */
#include "fields.h"
#include "surface/sides.h"
#include "surface/surface.h"

static double value_at(struct probe *probe, const double point[3])
{
    double gradient[3];
    return probe_value(probe, point, gradient);
}

/* Random balls of random fields, with places in each of them. Returns how many were told of, of `balls`. */
static int told_of(const struct octree *tree, struct field_settings settings, double threshold, int balls)
{
    struct field field;
    struct probe probe;
    uint64_t seed = 7;
    int told = 0;
    open_field(&field, &probe, tree, settings);
    const struct sides sides = sides_of(&field, threshold);
    for (int i = 0; i < balls; i++) {
        const double radius = 0.02 * settings.sigma * pow(100, random_unit(&seed));
        double middle[3];
        for (int axis = 0; axis < 3; axis++)
            middle[axis] = -2 * settings.sigma + (field.side + 4 * settings.sigma) * random_unit(&seed);
        const double value = value_at(&probe, middle);
        if (!sides_tell(&sides, value, radius))
            continue;
        told++;
        for (int k = 0; k < 20; k++) {
            double place[3], square = 0;
            for (int axis = 0; axis < 3; axis++) {
                place[axis] = 2 * random_unit(&seed) - 1;
                square += place[axis] * place[axis];
            }
            for (int axis = 0; axis < 3; axis++)
                place[axis] = middle[axis] + place[axis] * radius / sqrt(square);
            assert_int_equal(value_at(&probe, place) > threshold, value > threshold);
        }
    }
    probe_clear(&probe);
    return told;
}

static void what_is_told_of_a_ball_holds_in_all_of_it(void **state)
{
    (void)state;
    struct octree trees[] = {random_cells(2, 0.4, 3), random_cells(3, 0.02, 5), full_cube(1)};
    trees[0].coefficient[2] = 0.25f;
    trees[1].coefficient[2] = -0.5f;
    const struct field_settings settings[] = {
        {FIELDS_EXACT, 0, 0.5, 6}, {FIELDS_EXACT, 0, 2, 3}, {8, 0, 0.6, 6}, {FIELDS_EXACT, 50, 0.5, 6}};
    for (size_t s = 0; s < 4; s++) {
        int told = 0;
        for (size_t t = 0; t < 3; t++)
            for (double threshold = 1e-4; threshold < 1; threshold *= 6)
                told += told_of(&trees[t], settings[s], threshold, 400);
        assert_true(told > (s < 2 ? 2000 : 0)); /* of exact fields most */
    }
    for (size_t t = 0; t < 3; t++)
        octree_clear(&trees[t]);
}

/* Where a half space ends the bound is met: q rises by 1/s a cell, so that balls which just reach the
 * surface are those that are not told of. */
static void a_plane_is_told_of_from_all_balls_that_do_not_reach_it(void **state)
{
    (void)state;
    struct octree tree = full_cube(6);
    struct field field;
    struct probe probe;
    open_field(&field, &probe, &tree, (struct field_settings){FIELDS_EXACT, 0, 1, 8});
    const struct sides sides = sides_of(&field, 0.5);
    for (double away = -3; away < 3.1; away += 0.25) {
        const double value = value_at(&probe, (double[3]){away, 32, 32}), radius = fabs(away);
        assert_false(sides_tell(&sides, value, radius + 1e-6));
        if (away != 0)
            assert_true(sides_tell(&sides, value, 0.999 * radius));
    }
    probe_clear(&probe);
    octree_clear(&tree);
}

/* The ball around one cell is about a third of a sigma: what lies further away is not sampled. All within
 * reach was before, 1.4e8 places. */
static void a_wide_sigma_around_little_is_not_sampled_everywhere(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree;
    struct mesh mesh = {0};
    struct surface_stats stats;
    struct surface_options options = surface_defaults();
    assert_ok(octree_init(&tree, 4, 0, &err), &err);
    assert_ok(octree_set(&tree, 8, 8, 8, 1, &err), &err);
    options.field.sigma = 10;
    options.threshold = 6e-5;
    options.cube_size = 0.25 / 16;
    options.relax = 0;
    assert_ok(surface_make(&tree, &options, &mesh, &stats, &err), &err);
    assert_true(stats.samples < 1000000);
    assert_in_range(mesh.triangle_count, 3000, 12000);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_told_of_a_ball_holds_in_all_of_it),
        cmocka_unit_test(a_plane_is_told_of_from_all_balls_that_do_not_reach_it),
        cmocka_unit_test(a_wide_sigma_around_little_is_not_sampled_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
