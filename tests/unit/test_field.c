/* The Gaussian field: its value, its slope, its limits. */
#include "fields.h"

static double value_at(struct probe *probe, double x, double y, double z)
{
    double gradient[3];
    return probe_value(probe, (double[3]){x, y, z}, gradient);
}

/* The integral of the normal distribution from a to b. */
static double share_between(double a, double b, double sigma)
{
    return (erf(b / (sigma * M_SQRT2)) - erf(a / (sigma * M_SQRT2))) / 2;
}

static void an_exact_field_is_the_sum_over_all_cells_of_products_of_erf(void **state)
{
    (void)state;
    struct octree tree = random_cells(2, 0.4, 3);
    tree.coefficient[2] = 0.5f;
    struct field field;
    struct probe probe;
    open_field(&field, &probe, &tree, (struct field_settings){FIELDS_EXACT, 0, 0.6, 6});
    uint64_t seed = 4;
    for (int i = 0; i < 200; i++) {
        double point[3], gradient[3], expected = 0;
        for (int axis = 0; axis < 3; axis++)
            point[axis] = -1 + 6 * random_unit(&seed);
        for (int cell = 0; cell < 64; cell++) {
            int at[3] = {cell & 3, cell >> 2 & 3, cell >> 4};
            unsigned material = octree_at(&tree, at[0], at[1], at[2]);
            double part = material == 0 ? 0 : material == 1 ? 1 : 0.5;
            for (int axis = 0; axis < 3; axis++)
                part *= share_between(at[axis] - point[axis], at[axis] + 1 - point[axis], 0.6);
            expected += part;
        }
        /* The cut-off's bound: 3 erfc(6 / sqrt 2) = 5.9e-9. */
        assert_near(probe_value(&probe, point, gradient), expected, 6e-9);
    }
    probe_clear(&probe);
    octree_clear(&tree);
}

/* One field of sigma s, cut off at 6 s along each axis as field.h says. */
static double one_field(const double at[3], const double point[3], double s)
{
    double e = exp(-18), product = 1;
    for (int axis = 0; axis < 3; axis++) {
        double t = at[axis] - point[axis];
        product *= fabs(t) < 6 * s ? (exp(-t * t / (2 * s * s)) - e) / (1 - e) : 0;
    }
    return product;
}

/* All fields of one cell at n^3 sub-cell centres. */
static double fields_of_cell(const int cell[3], int n, const double point[3], double s)
{
    double sum = 0, weight = 1 / (pow(2 * M_PI, 1.5) * pow(n * s, 3));
    for (int i = 0; i < n * n * n; i++) {
        int part[3] = {i % n, i / n % n, i / (n * n)};
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = cell[axis] + (part[axis] + 0.5) / n;
        sum += weight * one_field(at, point, s);
    }
    return sum;
}

/* All fields on one face of a cell, whose plane is 1 / 4 of the first cube away from the next: with A fields
 * a unit of area the lattice's spacing is 4 / sqrt(A) cells. */
static double fields_of_face(const int cell[3], int axis, bool upper, double area, const double point[3],
                             double s)
{
    double spacing = 4 / sqrt(area), sum = 0, weight = spacing * spacing / (2 * M_PI * s * s);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double p = (ceil(cell[u] / spacing - 0.5) + 0.5) * spacing; p < cell[u] + 1; p += spacing)
        for (double q = (ceil(cell[v] / spacing - 0.5) + 0.5) * spacing; q < cell[v] + 1; q += spacing) {
            double at[3];
            at[axis] = cell[axis] + upper;
            at[u] = p;
            at[v] = q;
            sum += weight * one_field(at, point, s);
        }
    return sum;
}

static void sampled_fields_are_the_sum_over_their_gaussians_one_by_one(void **state)
{
    (void)state;
    struct octree tree = random_cells(2, 0.4, 3);
    tree.coefficient[2] = -0.5f;
    const struct field_settings kinds[] = {
        {8, 0, 0.6, 6}, {1, 0, 0.3, 6}, {0, 700, 0.4, 6}, {27, 90, 0.5, 6}};
    for (int k = 0; k < 4; k++) {
        struct field field;
        struct probe probe;
        uint64_t seed = 4;
        int n = (int)lround(cbrt((double)kinds[k].fields_per_cube));
        open_field(&field, &probe, &tree, kinds[k]);
        for (int i = 0; i < 60; i++) {
            double point[3], gradient[3], expected = 0, s = kinds[k].sigma;
            for (int axis = 0; axis < 3; axis++)
                point[axis] = -1 + 6 * random_unit(&seed);
            for (int number = 0; number < 64; number++) {
                int cell[3] = {number & 3, number >> 2 & 3, number >> 4};
                unsigned material = octree_at(&tree, cell[0], cell[1], cell[2]);
                double sum = n > 0 && material ? fields_of_cell(cell, n, point, s) : 0;
                for (int side = 0; side < 6 && material && kinds[k].fields_per_area > 0; side++) {
                    int beyond[3] = {cell[0], cell[1], cell[2]};
                    beyond[side / 2] += side % 2 ? 1 : -1;
                    if (octree_at(&tree, beyond[0], beyond[1], beyond[2]) == 0)
                        sum += fields_of_face(cell, side / 2, side % 2, kinds[k].fields_per_area, point, s);
                }
                expected += material == 2 ? -0.5 * sum : sum;
            }
            /* Some thousand terms of size 1, rounded. */
            assert_near(probe_value(&probe, point, gradient), expected, 1e-12);
        }
        probe_clear(&probe);
    }
    octree_clear(&tree);
}

static void a_field_is_1_deep_inside_and_0_far_outside(void **state)
{
    (void)state;
    struct octree tree = full_cube(4);
    const long kinds[] = {FIELDS_EXACT, 1, 8, 64};
    for (int k = 0; k < 4; k++) {
        struct field field;
        struct probe probe;
        open_field(&field, &probe, &tree, (struct field_settings){kinds[k], 0, 0.8, 6});
        /* At one field a cell the lattice's sum ripples by 2 exp(-2 (pi s)^2) = 6.5e-6 an axis. */
        assert_near(value_at(&probe, 8, 8, 8), 1, 3 * 6.6e-6);
        assert_true(value_at(&probe, -4.81, 8, 8) == 0);
        probe_clear(&probe);
    }
    octree_clear(&tree);
}

static void a_lone_cell_at_the_default_sigma_passes_the_default_threshold(void **state)
{
    (void)state;
    struct octree tree = full_cube(0);
    struct field field;
    struct probe probe;
    open_field(&field, &probe, &tree, exact);
    double centre = value_at(&probe, 0.5, 0.5, 0.5);
    assert_near(centre, pow(erf(0.5 / (0.35 * M_SQRT2)), 3), 6e-9);
    assert_true(centre > 0.55);
    probe_clear(&probe);
    octree_clear(&tree);
}

static void the_gradient_is_that_of_central_differences_and_below_the_steepness(void **state)
{
    (void)state;
    struct octree tree = random_cells(3, 0.3, 11);
    tree.coefficient[2] = -0.7f;
    const struct field_settings kinds[] = {{FIELDS_EXACT, 0, 0.35, 6},
                                           {1, 0, 0.5, 6},
                                           {27, 0, 0.3, 5},
                                           {0, 700, 0.6, 6},
                                           {FIELDS_EXACT, 300, 1, 4}};
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        struct field field;
        struct probe probe;
        uint64_t seed = 5;
        open_field(&field, &probe, &tree, kinds[k]);
        for (int i = 0; i < 300; i++) {
            double point[3], gradient[3], unused[3];
            for (int axis = 0; axis < 3; axis++)
                point[axis] = -0.5 + 9 * random_unit(&seed);
            probe_value(&probe, point, gradient);
            for (int axis = 0; axis < 3; axis++) {
                double there[3] = {point[0], point[1], point[2]}, h = 1e-5;
                there[axis] += h;
                double after = probe_value(&probe, there, unused);
                there[axis] -= 2 * h;
                double before = probe_value(&probe, there, unused);
                /* The truncation is h^2/6 of the third derivative, below 1e-8 here; the kink where
                 * Gaussians end, exp(-R^2/2)/s times a few, is 3e-4 for R = 4 at sums over hundreds of
                 * fields. */
                assert_near(gradient[axis], (after - before) / (2 * h), kinds[k].cutoff > 4 ? 2e-4 : 3e-3);
            }
            assert_true(sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] +
                             gradient[2] * gradient[2]) <= field.steepness);
        }
        probe_clear(&probe);
    }
    octree_clear(&tree);
}

/* The largest distance between N fields a cube and the exact field, on a lone cube at s = .5. */
static double distance_to_exact(long fields)
{
    struct octree tree = full_cube(0);
    struct field limit, sampled;
    struct probe a, b;
    double worst = 0;
    open_field(&limit, &a, &tree, (struct field_settings){FIELDS_EXACT, 0, 0.5, 8});
    open_field(&sampled, &b, &tree, (struct field_settings){fields, 0, 0.5, 8});
    for (int i = 0; i < 21 * 21 * 21; i++) {
        double x = (i % 21) / 20.0, y = (i / 21 % 21) / 20.0, z = (i / 441) / 20.0;
        worst = fmax(worst, fabs(value_at(&a, x, y, z) - value_at(&b, x, y, z)));
    }
    probe_clear(&a);
    probe_clear(&b);
    octree_clear(&tree);
    return worst;
}

/* The midpoint rule is of second order: each doubling along an axis divides its error by 4, once it is
 * small. */
static void more_fields_a_cube_converge_to_the_exact_field_at_second_order(void **state)
{
    (void)state;
    double one = distance_to_exact(1), eight = distance_to_exact(8);
    double sixty_four = distance_to_exact(64), five_hundred = distance_to_exact(512);
    assert_near(one / eight, 6, 1.5);
    assert_near(eight / sixty_four, 4, 0.3);
    assert_near(sixty_four / five_hundred, 4, 0.1);
    assert_true(five_hundred < 0.0018);
}

static void a_leaf_and_its_eight_children_have_the_same_field(void **state)
{
    (void)state;
    struct octree whole = full_cube(3), split = full_cube(3);
    octree_node children[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    struct octree in_parts = split;
    in_parts.root = OCTREE_SPLIT;
    in_parts.blocks = children;
    in_parts.block_count = in_parts.block_capacity = 1;
    const struct field_settings kinds[] = {exact, {8, 0, 0.7, 5}, {0, 900, 0.7, 6}};
    for (int k = 0; k < 3; k++) {
        struct field fields[2];
        struct probe probes[2];
        open_field(&fields[0], &probes[0], &whole, kinds[k]);
        open_field(&fields[1], &probes[1], &in_parts, kinds[k]);
        uint64_t seed = 8;
        for (int i = 0; i < 300; i++) {
            double x = -1 + 10 * random_unit(&seed), y = -1 + 10 * random_unit(&seed),
                   z = 10 * random_unit(&seed);
            assert_near(value_at(&probes[0], x, y, z), value_at(&probes[1], x, y, z), 1e-14);
        }
        probe_clear(&probes[0]);
        probe_clear(&probes[1]);
    }
    octree_clear(&whole);
    octree_clear(&split);
}

static void area_fields_add_up_to_1_on_a_large_flat_face(void **state)
{
    (void)state;
    struct octree tree = full_cube(4);
    struct field field;
    struct probe probe;
    /* 40 fields along the first cube's side: 2.5 a cell, s = .7 cells is 1.75 spacings, a ripple of 1e-26. */
    open_field(&field, &probe, &tree, (struct field_settings){0, 1600, 0.7, 6});
    /* The Gaussian's cut-off takes sqrt(2/pi) R exp(-R^2/2) of either axis: 7.3e-8. */
    assert_near(value_at(&probe, 8, 8, 16), 1, 2e-7);
    assert_near(value_at(&probe, 0, 7.7, 8.2), 1, 2e-7);
    assert_near(value_at(&probe, 8, 16 + 0.7, 8), exp(-0.5), 2e-7);
    assert_true(value_at(&probe, 8, 8, 8) == 0);
    probe_clear(&probe);
    octree_clear(&tree);
}

static void settings_out_of_range_are_refused_by_name(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = full_cube(0);
    struct field field;
    const struct {
        struct field_settings settings;
        const char *part;
    } cases[] = {
        {{7, 0, 0.35, 6}, "7 fields per cube"},  {{-8, 0, 0.35, 6}, "-8 fields per cube"},
        {{4913, 0, 0.35, 6}, "4913 fields"},     {{FIELDS_EXACT, -1, 0.35, 6}, "fields per area"},
        {{FIELDS_EXACT, 0, 0, 6}, "sigma of 0"}, {{FIELDS_EXACT, 0, (double)NAN, 6}, "sigma"},
        {{FIELDS_EXACT, 0, 1e300, 6}, "sigma"},  {{FIELDS_EXACT, 0, 0.35, 9}, "cut-off of 9"},
        {{0, 0, 0.35, 6}, "there is no field"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        assert_refused(field_init(&field, &tree, &cases[i].settings, &err), STATUS_RANGE, cases[i].part,
                       &err);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_exact_field_is_the_sum_over_all_cells_of_products_of_erf),
        cmocka_unit_test(sampled_fields_are_the_sum_over_their_gaussians_one_by_one),
        cmocka_unit_test(a_field_is_1_deep_inside_and_0_far_outside),
        cmocka_unit_test(a_lone_cell_at_the_default_sigma_passes_the_default_threshold),
        cmocka_unit_test(the_gradient_is_that_of_central_differences_and_below_the_steepness),
        cmocka_unit_test(more_fields_a_cube_converge_to_the_exact_field_at_second_order),
        cmocka_unit_test(a_leaf_and_its_eight_children_have_the_same_field),
        cmocka_unit_test(area_fields_add_up_to_1_on_a_large_flat_face),
        cmocka_unit_test(settings_out_of_range_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
