/* The mesh around a sculpture of known shape: whole, closed, of the right volume; and what has no surface. */
#include "surfaces.h"

/* What the rounding of a right-angled edge takes away of its cross-section, in s^2, at half the inside's
 * value: the integral over x > 0 of y where F(x) F(y) = 1/2, F the normal distribution's function. By the
 * midpoint rule. */
#define EDGE_LOSS 0.865

static void set_box(struct octree *tree, const int low[3], const int high[3], unsigned material)
{
    struct error err = {0};
    for (int x = low[0]; x < high[0]; x++)
        for (int y = low[1]; y < high[1]; y++)
            for (int z = low[2]; z < high[2]; z++)
                assert_ok(octree_set(tree, x, y, z, material, &err), &err);
}

static void one_gaussian_makes_a_sphere_of_the_radius_in_closed_form(void **state)
{
    (void)state;
    struct octree tree = new_tree(0, 1);
    struct surface_options options = surface_defaults();
    options.field = (struct field_settings){1, 0, 0.3, 8};
    options.threshold = 0.4;
    options.cube_size = 0.05;
    struct mesh mesh = make(&tree, &options);
    /* b exp(-r^2/2s^2) = T, b = 1/((2 pi)^(3/2) s^3); the cut-off at 8 s changes the field by exp(-32) b =
     * 3e-14. */
    double b = 1 / (pow(2 * M_PI, 1.5) * pow(0.3, 3)), radius = 0.3 * sqrt(2 * log(b / 0.4));
    const double centre[3] = {0.5, 0.5, 0.5};
    for (uint32_t p = 0; p < mesh.point_count; p++)
        assert_near(vec3_distance(mesh.position[p], centre), radius, 1e-9);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.components, 1);
    assert_int_equal(shape.euler, 2);
    /* Flat triangles lie inside the sphere by up to h^2/(8 r) or so: .2 % of the radius. */
    assert_near(shape.volume, 4 / 3.0 * M_PI * pow(radius, 3), 0.02);
    assert_sound(&mesh, &tree, &options);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void a_full_cube_closes_beyond_its_own_border(void **state)
{
    (void)state;
    struct octree tree = new_tree(2, 1);
    struct surface_options options = surface_defaults();
    options.field.sigma = 0.2;
    options.cube_size = 0.03;
    struct mesh mesh = make(&tree, &options);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.euler, 2);
    assert_sound(&mesh, &tree, &options);
    /* Each edge of length 1 loses EDGE_LOSS s^2 of cross-section, s = .05; corners differ by some s^3. */
    assert_near(shape.volume, 1 - 12 * EDGE_LOSS * 0.05 * 0.05, 0.003);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void a_cavity_is_a_component_that_is_seen_from_within(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 1);
    set_box(&tree, (int[3]){2, 2, 2}, (int[3]){6, 6, 6}, 0);
    struct surface_options options = surface_defaults();
    struct mesh mesh = make(&tree, &options);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.components, 2);
    assert_int_equal(shape.euler, 4);
    /* 1 less an eighth, both rounded along 12 sides, of 1 and of 1/2, s = .35/8; the triangles' chords take
     * some more from the outer than from the inner. */
    assert_near(shape.volume, 1 - 0.125 - 6 * EDGE_LOSS * pow(0.35 / 8, 2), 0.003);
    assert_sound(&mesh, &tree, &options);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void a_tunnel_makes_a_torus(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 1);
    set_box(&tree, (int[3]){3, 3, 0}, (int[3]){5, 5, 8}, 0);
    struct surface_options options = surface_defaults();
    struct mesh mesh = make(&tree, &options);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.components, 1);
    assert_int_equal(shape.euler, 0);
    assert_sound(&mesh, &tree, &options);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

/* Every sample on some plane of the grid equals the threshold, give or take a rounding. */
static void a_grid_plane_on_the_surface_does_no_harm(void **state)
{
    (void)state;
    struct octree tree = new_tree(2, 1);
    struct surface_options options = surface_defaults();
    /* Planes at (i + 1/2) h: with h = 2/9 of a cell one lies at x = 1 cell; the box begins there. */
    set_box(&tree, (int[3]){0, 0, 0}, (int[3]){1, 4, 4}, 0);
    options.cube_size = 2.0 / 9 / 4;
    options.field.sigma = 0.1;
    struct mesh mesh = make(&tree, &options);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.euler, 2);
    assert_sound(&mesh, &tree, &options);
    assert_true(shape.shortest_edge > 0.1 * shape.mean_edge);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void materials_weigh_by_their_coefficient(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 0);
    set_box(&tree, (int[3]){1, 1, 1}, (int[3]){4, 4, 4}, 1);
    set_box(&tree, (int[3]){5, 5, 5}, (int[3]){8, 8, 8}, 2);
    tree.coefficient[2] = 0.4f;
    struct surface_options options = surface_defaults();
    struct mesh mesh = make(&tree, &options);
    assert_int_equal(shape_of(&mesh).components, 1);
    mesh_clear(&mesh);
    tree.coefficient[2] = 3;
    mesh = make(&tree, &options);
    assert_int_equal(shape_of(&mesh).components, 2);
    assert_sound(&mesh, &tree, &options);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void area_fields_alone_make_a_shell_with_two_skins(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 1);
    struct surface_options options = surface_defaults();
    options.field = (struct field_settings){0, 1000, 0.5, 6};
    struct mesh mesh = make(&tree, &options);
    struct surface_shape shape = shape_of(&mesh);
    assert_int_equal(shape.components, 2);
    assert_int_equal(shape.euler, 4);
    assert_sound(&mesh, &tree, &options);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

static void a_number_of_triangles_is_met_within_5_percent(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 1);
    set_box(&tree, (int[3]){0, 0, 4}, (int[3]){5, 8, 8}, 0);
    const uint32_t wanted[] = {300, 3000, 20000};
    for (int i = 0; i < 3; i++) {
        struct surface_options options = surface_defaults();
        options.triangles = wanted[i];
        struct mesh mesh = make(&tree, &options);
        assert_near(mesh.triangle_count, wanted[i], 0.05 * wanted[i]);
        mesh_clear(&mesh);
    }
    octree_clear(&tree);
}

struct told {
    double last;
    unsigned times;
    bool fell;
};

static void hear(void *context, double done)
{
    struct told *told = context;
    told->fell = told->fell || done < told->last;
    told->last = done;
    told->times++;
}

/* To who waits, meshing and smoothing are one work. */
static void progress_rises_through_meshing_and_smoothing(void **state)
{
    (void)state;
    for (unsigned relax = 0; relax <= 10; relax += 10) {
        struct octree tree = new_tree(2, 1);
        struct told told = {0};
        struct surface_options options = surface_defaults();
        options.cube_size = 0.05;
        options.relax = relax;
        options.threads = 1;
        options.progress = hear;
        options.progress_context = &told;
        struct mesh mesh = make(&tree, &options);
        assert_false(told.fell);
        assert_true(told.times > relax + 2);
        assert_true(told.last > 0.8 && told.last <= 1);
        mesh_clear(&mesh);
        octree_clear(&tree);
    }
}

static void refuse(const struct octree *tree, const struct surface_options *options, enum status status,
                   const char *part)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct surface_stats stats;
    assert_refused(surface_make(tree, options, &mesh, &stats, &err), status, part, &err);
    assert_null(mesh.position);
}

static void what_has_no_surface_is_refused_with_the_reason(void **state)
{
    (void)state;
    struct octree empty = new_tree(3, 0), cube = new_tree(1, 1);
    struct surface_options options = surface_defaults();
    refuse(&empty, &options, STATUS_INPUT, "the sculpture is empty");
    options.threshold = 1.5;
    /* erf(1 / (0.35 sqrt 2))^3 */
    refuse(&cube, &options, STATUS_INPUT, "the largest value of the field found is 0.9872");
    options.triangles = 500;
    refuse(&cube, &options, STATUS_INPUT, "the largest value of the field found is 0.9872");
    options = surface_defaults();
    options.cube_size = 1e-6;
    refuse(&cube, &options, STATUS_RANGE, "too small");
    options.cube_size = 1e-4;
    options.field.sigma = 0.1;
    refuse(&cube, &options, STATUS_RANGE, "triangles in");
    options.cube_size = -1;
    refuse(&cube, &options, STATUS_RANGE, "cube size of -1");
    options = surface_defaults();
    options.threshold = (double)NAN;
    refuse(&cube, &options, STATUS_RANGE, "threshold of nan");
    octree_clear(&empty);
    octree_clear(&cube);
}

static void the_cube_size_that_a_refusal_names_works(void **state)
{
    (void)state;
    struct octree tree = new_tree(3, 0);
    set_box(&tree, (int[3]){2, 2, 2}, (int[3]){3, 3, 3}, 1);
    struct surface_options options = plain();
    struct error err = {0};
    struct mesh mesh = {0};
    struct surface_stats stats;
    options.cube_size = 4;
    assert_refused(surface_make(&tree, &options, &mesh, &stats, &err), STATUS_RANGE, "of 4 is too large",
                   &err);
    options.cube_size = atof(strrchr(err.text, ';') + 1);
    mesh = make(&tree, &options);
    assert_true(mesh.triangle_count >= 8);
    mesh_clear(&mesh);
    octree_clear(&tree);
}

/* One narrow field a cell: balls so far apart, or cut off so near, that points between them were left where
 * the field is flat. */
static void points_that_find_no_way_to_the_surface_go(void **state)
{
    (void)state;
    static const struct {
        unsigned depth;
        double cutoff, cube_size;
    } cases[] = {{1, 2, 0.55}, {2, 2, 0.275}, {2, 6, 0.075}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct octree tree = new_tree(cases[i].depth, 1);
        struct surface_options options = surface_defaults();
        options.field = (struct field_settings){1, 0, 0.2, cases[i].cutoff};
        options.cube_size = cases[i].cube_size;
        struct mesh mesh = make(&tree, &options);
        assert_closed(&mesh);
        assert_single_rings(&mesh);
        mesh_clear(&mesh);
        octree_clear(&tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_gaussian_makes_a_sphere_of_the_radius_in_closed_form),
        cmocka_unit_test(a_full_cube_closes_beyond_its_own_border),
        cmocka_unit_test(a_cavity_is_a_component_that_is_seen_from_within),
        cmocka_unit_test(a_tunnel_makes_a_torus),
        cmocka_unit_test(a_grid_plane_on_the_surface_does_no_harm),
        cmocka_unit_test(materials_weigh_by_their_coefficient),
        cmocka_unit_test(area_fields_alone_make_a_shell_with_two_skins),
        cmocka_unit_test(a_number_of_triangles_is_met_within_5_percent),
        cmocka_unit_test(progress_rises_through_meshing_and_smoothing),
        cmocka_unit_test(what_has_no_surface_is_refused_with_the_reason),
        cmocka_unit_test(the_cube_size_that_a_refusal_names_works),
        cmocka_unit_test(points_that_find_no_way_to_the_surface_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
