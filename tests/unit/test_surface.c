/* The mesh around a sculpture: whole, closed, on the surface, and the same however it was found. */
#include "check.h"
#include "common/random.h"
#include "common/vec3.h"
#include "surface/block.h"
#include "surface/probe.h"
#include "surface/surface.h"

/* What the rounding of a right-angled edge takes away of its cross-section, in s^2, at half the inside's
 * value: the integral over x > 0 of y where F(x) F(y) = 1/2, F the normal distribution's function. By the
 * midpoint rule. */
#define EDGE_LOSS 0.865

static struct octree new_tree(unsigned depth, unsigned material)
{
    struct error err = {0};
    struct octree tree;
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

static void set_box(struct octree *tree, const int low[3], const int high[3], unsigned material)
{
    struct error err = {0};
    for (int x = low[0]; x < high[0]; x++)
        for (int y = low[1]; y < high[1]; y++)
            for (int z = low[2]; z < high[2]; z++)
                assert_ok(octree_set(tree, x, y, z, material, &err), &err);
}

static struct mesh make(const struct octree *tree, const struct surface_options *options)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct surface_stats stats;
    assert_ok(surface_make(tree, options, &mesh, &stats, &err), &err);
    assert_ok(mesh_connect(&mesh, &err), &err);
    assert_true(stats.worst_residual < 1e-9);
    return mesh;
}

/* Marching cubes as they are, one point a crossed edge. */
static struct surface_options plain(void)
{
    struct surface_options options = surface_defaults();
    options.relax = 0;
    return options;
}

static struct surface_shape shape_of(const struct mesh *mesh)
{
    struct error err = {0};
    struct surface_shape shape;
    assert_ok(surface_measure(mesh, &shape, &err), &err);
    return shape;
}

/* Each edge is run along exactly once in each sense. */
static void assert_closed(const struct mesh *mesh)
{
    unsigned char(*runs)[2] = calloc(mesh->edge_count, sizeof *runs);
    assert_int_equal(2 * mesh->edge_count, 3 * mesh->triangle_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            assert_int_equal(runs[edge][mesh->edge[edge][0] == from]++, 0);
        }
    free(runs);
}

/* The triangles of each point form one ring: going from each to its neighbour across the next edge meets
 * them all. */
static void assert_single_rings(const struct mesh *mesh)
{
    uint32_t(*across)[3] = calloc(mesh->triangle_count, sizeof *across);
    uint32_t(*owner)[2] = calloc(mesh->edge_count, sizeof *owner);
    uint32_t *degree = calloc(mesh->point_count, sizeof *degree);
    uint32_t *some = calloc(mesh->point_count, sizeof *some);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            owner[edge][mesh->edge[edge][0] == from] = t;
            degree[from]++;
            some[from] = t;
        }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh->triangle_edge[t][k], from = mesh->triangle[t][k];
            across[t][k] = owner[edge][mesh->edge[edge][0] != from];
        }
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        uint32_t t = some[p], count = 0;
        do {
            int k = mesh->triangle[t][0] == p ? 0 : mesh->triangle[t][1] == p ? 1 : 2;
            t = across[t][k];
            count++;
        } while (t != some[p] && count <= degree[p]);
        assert_int_equal(count, degree[p]);
    }
    free(across);
    free(owner);
    free(degree);
    free(some);
}

static void assert_on_surface(const struct mesh *mesh, const struct octree *tree,
                              const struct surface_options *options)
{
    struct error err = {0};
    struct field field;
    struct probe probe;
    double side = 1 << tree->depth;
    assert_ok(field_init(&field, tree, &options->field, &err), &err);
    assert_ok(probe_init(&probe, &field, &err), &err);
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        double point[3], gradient[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = mesh->position[p][axis] * side;
        assert_near(probe_value(&probe, point, gradient), options->threshold, 1e-9);
        assert_near(vec3_length(mesh->normal[p]), 1, 1e-12);
        assert_near(vec3_dot(mesh->normal[p], gradient), -vec3_length(gradient), 1e-6);
    }
    probe_clear(&probe);
}

static void assert_sound(const struct mesh *mesh, const struct octree *tree,
                         const struct surface_options *options)
{
    assert_closed(mesh);
    assert_single_rings(mesh);
    assert_on_surface(mesh, tree, options);
    assert_true(mesh_volume(mesh) > 0);
    struct surface_shape shape = shape_of(mesh);
    assert_int_equal(shape.euler % 2, 0);
    /* In a file of single precision no two points may fall together. */
    assert_true(shape.shortest_edge > 1e-3 * shape.mean_edge);
}

/* How many edges of the whole grid the surface crosses: each is a point of the mesh. */
static size_t crossings(const struct octree *tree, const struct surface_options *options)
{
    struct error err = {0};
    struct field field;
    struct grid grid;
    struct block block;
    size_t count = 0;
    assert_ok(field_init(&field, tree, &options->field, &err), &err);
    assert_ok(grid_init(&grid, &field, options->cube_size * (1 << tree->depth), &err), &err);
    assert_true(block_init(&block, &grid));
    for (int x = grid.brick_low[0]; x <= grid.brick_high[0]; x++)
        for (int y = grid.brick_low[1]; y <= grid.brick_high[1]; y++)
            for (int z = grid.brick_low[2]; z <= grid.brick_high[2]; z++) {
                assert_true(block_move(&block, (int[3]){x, y, z}) && block_sample(&block));
                for (int i = 0; i < 512; i++) {
                    const double *v = block.values + (i >> 6) * 81 + (i >> 3 & 7) * 9 + (i & 7);
                    bool inside = *v >= options->threshold;
                    count += inside != (v[1] >= options->threshold);
                    count += inside != (v[9] >= options->threshold);
                    count += inside != (v[81] >= options->threshold);
                }
            }
    block_clear(&block);
    grid_clear(&grid);
    return count;
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

static void assert_same(const struct mesh *a, const struct mesh *b)
{
    assert_int_equal(a->point_count, b->point_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_memory_equal(a->position, b->position, a->point_count * sizeof *a->position);
    assert_memory_equal(a->normal, b->normal, a->point_count * sizeof *a->normal);
    assert_memory_equal(a->triangle, b->triangle, a->triangle_count * sizeof *a->triangle);
}

static struct octree random_tree(unsigned depth, uint64_t *seed)
{
    struct error err = {0};
    struct octree tree = new_tree(depth, 0);
    int side = 1 << depth;
    double share = random_unit(seed);
    for (int x = 0; x < side; x++)
        for (int y = 0; y < side; y++)
            for (int z = 0; z < side; z++)
                if (random_unit(seed) < share * share)
                    assert_ok(octree_set(&tree, x, y, z, 1, &err), &err);
    assert_ok(octree_set(&tree, (int)(random_unit(seed) * side), 0, side - 1, 1, &err), &err);
    return tree;
}

/* Cells filled at random touch along edges and at corners, and leave cavities, tunnels and thin walls. */
static void check_random_tree(unsigned depth, uint64_t *seed, bool by_points, bool fine)
{
    struct octree tree = random_tree(depth, seed);
    struct surface_options options = plain();
    options.cube_size = (fine ? 0.05 : 0.3 + 0.5 * random_unit(seed)) / (1 << depth);
    options.field.sigma = 0.2 + 0.2 * random_unit(seed);
    options.threshold = 0.1 + 0.4 * random_unit(seed);
    if (options.field.sigma > 0.35) /* a lone cell's field is .45 at .4 */
        options.threshold = 0.3;
    if (by_points) /* one field a cell needs a wide Gaussian to be more than peaks */
        options.field = (struct field_settings){8, 200, 0.35, 6};
    struct mesh mesh = make(&tree, &options);
    assert_sound(&mesh, &tree, &options);
    size_t expected = crossings(&tree, &options);
    /* A few loops have one more in their middle. */
    assert_true(mesh.point_count >= expected && mesh.point_count <= expected + expected / 100 + 2);
    options.seeds = SURFACE_RANDOM;
    options.seed = random_bits(seed);
    struct mesh again = make(&tree, &options);
    assert_same(&mesh, &again);
    mesh_clear(&mesh);
    mesh_clear(&again);
    octree_clear(&tree);
}

static void random_sculptures_are_closed_whole_and_independent_of_seeds(void **state)
{
    (void)state;
    uint64_t seed = 2024;
    for (int i = 0; i < 120; i++)
        check_random_tree(1 + (unsigned)i % 3, &seed, i % 10 == 9, false);
    for (int i = 0; i < 12; i++)
        check_random_tree(1, &seed, i % 3 == 2, true);
    for (int i = 0; i < 2; i++)
        check_random_tree(4, &seed, false, false);
}

/* On a grid that is coarse against the cells the surface passes in every way; those of three cells and more
 * a face need a middle. */
static void ambiguous_cells_stay_closed_on_a_coarse_grid(void **state)
{
    (void)state;
    uint64_t seed = 77;
    for (int i = 0; i < 25; i++) {
        struct octree tree = random_tree(3, &seed);
        struct surface_options options = surface_defaults();
        options.cube_size = (0.7 + random_unit(&seed)) / 8;
        options.threshold = 0.3;
        struct mesh mesh = {0};
        struct surface_stats stats;
        struct error err = {0};
        /* One cell alone may fall through such a grid. */
        if (surface_make(&tree, &options, &mesh, &stats, &err) == STATUS_OK) {
            assert_ok(mesh_connect(&mesh, &err), &err);
            assert_closed(&mesh);
            assert_single_rings(&mesh);
            assert_on_surface(&mesh, &tree, &options);
        }
        mesh_clear(&mesh);
        octree_clear(&tree);
    }
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

static void a_mesh_is_the_same_to_the_byte_for_any_number_of_threads(void **state)
{
    (void)state;
    uint64_t seed = 99;
    for (int i = 0; i < 4; i++) {
        struct octree tree = random_tree(3, &seed);
        struct surface_options options = surface_defaults();
        options.cube_size = 0.03 + 0.02 * random_unit(&seed);
        options.threshold = 0.3;
        options.threads = 1;
        struct mesh alone = make(&tree, &options);
        for (options.threads = 2; options.threads < 8; options.threads += 2) {
            struct mesh shared = make(&tree, &options);
            assert_same(&alone, &shared);
            mesh_clear(&shared);
        }
        mesh_clear(&alone);
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
        cmocka_unit_test(random_sculptures_are_closed_whole_and_independent_of_seeds),
        cmocka_unit_test(ambiguous_cells_stay_closed_on_a_coarse_grid),
        cmocka_unit_test(a_mesh_is_the_same_to_the_byte_for_any_number_of_threads),
        cmocka_unit_test(a_grid_plane_on_the_surface_does_no_harm),
        cmocka_unit_test(materials_weigh_by_their_coefficient),
        cmocka_unit_test(area_fields_alone_make_a_shell_with_two_skins),
        cmocka_unit_test(a_number_of_triangles_is_met_within_5_percent),
        cmocka_unit_test(what_has_no_surface_is_refused_with_the_reason),
        cmocka_unit_test(the_cube_size_that_a_refusal_names_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
