/* The mesh around cells filled at random: whole, closed, on the surface, and the
 * same however it was found. */
#include "common/random.h"
#include "surface/block.h"
#include "surfaces.h"

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
        cmocka_unit_test(random_sculptures_are_closed_whole_and_independent_of_seeds),
        cmocka_unit_test(ambiguous_cells_stay_closed_on_a_coarse_grid),
        cmocka_unit_test(a_mesh_is_the_same_to_the_byte_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
