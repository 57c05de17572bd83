/*
 * Whatever the sculpture, the mesh is whole: test_octrees [HOW_MANY] random octrees, and every way
 * to fill 2 x 2 x 2 cells, which makes every pattern of inside and outside corners at a cell of the
 * grid and at its faces.
 */
#include "check.h"
#include "common/mesh_measure.h"
#include "common/random.h"
#include "common/vec3.h"
#include "surface/census.h"

static int how_many = 200;

static void fill(struct octree *tree, const int low[3], const int high[3], unsigned material)
{
    struct error err = {0};
    for (int z = low[2]; z < high[2]; z++)
        for (int y = low[1]; y < high[1]; y++)
            for (int x = low[0]; x < high[0]; x++)
                assert_ok(octree_set(tree, x, y, z, material, &err), &err);
}

static int below(uint64_t *seed, int limit)
{
    return (int)(random_unit(seed) * limit);
}

/* Cells at random, from nearly none to nearly all, in a window of at most four cells a side
 * somewhere in the tree. */
static void add_dust(struct octree *tree, uint64_t *seed)
{
    int side = 1 << tree->depth, window = side < 4 ? side : 2 + below(seed, 3);
    int at[3] = {below(seed, side - window + 1), below(seed, side - window + 1),
                 below(seed, side - window + 1)};
    double density = 0.02 + 0.96 * random_unit(seed);
    for (int i = 0; i < window * window * window; i++) {
        int cell[3] = {at[0] + i % window, at[1] + i / window % window, at[2] + i / window / window};
        fill(tree, cell, (int[3]){cell[0] + 1, cell[1] + 1, cell[2] + 1}, random_unit(seed) < density);
    }
}

/* A box of three to five cells a side with what makes trouble: a tunnel, a cavity, walls of one cell, cubes
 * that touch along an edge or at a corner. */
static void add_shape(struct octree *tree, uint64_t *seed)
{
    int size = 3 + below(seed, 3), side = 1 << tree->depth, what = below(seed, 5), axis = below(seed, 3);
    int at[3], end[3], in[3], out[3];
    for (int k = 0; k < 3; k++) {
        at[k] = below(seed, side - size + 1);
        end[k] = at[k] + size;
        in[k] = at[k] + 1;
        out[k] = end[k] - 1;
    }
    if (what == 2)
        end[axis] = at[axis] + 1;
    if (what >= 3)
        memcpy(end, in, sizeof end);
    fill(tree, at, end, 1);
    if (what == 0) { /* a tunnel, or a shell where it is one cell wide */
        in[axis] = at[axis];
        out[axis] = end[axis];
    }
    if (what <= 1)
        fill(tree, in, out, 0);
    if (what >= 3) { /* diagonal neighbours */
        int low[3] = {in[0], in[1], in[2]};
        if (what == 3)
            low[axis] = at[axis];
        fill(tree, low, (int[3]){low[0] + 1, low[1] + 1, low[2] + 1}, 1);
    }
}

static struct octree random_tree(uint64_t *seed)
{
    struct error err = {0};
    struct octree tree;
    unsigned depth = 1 + (unsigned)below(seed, 6);
    assert_ok(octree_init(&tree, depth, 0, &err), &err);
    if (depth < 3 || random_unit(seed) < 0.5)
        add_dust(&tree, seed);
    else
        add_shape(&tree, seed);
    return tree;
}

/* Two triangles an edge, one each way round; one fan a point. */
static void assert_whole(const struct mesh *mesh)
{
    struct error err = {0};
    struct mesh_report report = {0};
    assert_ok(mesh_measure(mesh, &report, &err), &err);
    assert_int_equal(report.boundary_edges, 0);
    assert_int_equal(report.overfull_edges, 0);
    assert_int_equal(report.inconsistent_edges, 0);
    assert_int_equal(report.pinched_points, 0);
}

/* Where a part reaches furthest along x the field falls outwards on an outer shell, and inwards, towards -x,
 * on a cavity. Its volume, which is the triangles' winding, has the sign that goes with it. */
static void assert_wound_as_the_field_says(const struct mesh *mesh, const struct surface_census *census)
{
    uint32_t(*edge)[2] = mesh->edge, *part = calloc(mesh->point_count, sizeof *part);
    for (uint32_t p = 0; p < mesh->point_count; p++)
        part[p] = p;
    for (bool news = true; news;) {
        news = false;
        for (uint32_t e = 0; e < mesh->edge_count; e++) {
            uint32_t least = part[edge[e][0]] < part[edge[e][1]] ? part[edge[e][0]] : part[edge[e][1]];
            news = news || part[edge[e][0]] != least || part[edge[e][1]] != least;
            part[edge[e][0]] = part[edge[e][1]] = least;
        }
    }
    size_t number = 0;
    for (uint32_t first = 0; first < mesh->point_count; first++) {
        if (part[first] != first)
            continue;
        uint32_t furthest = first;
        for (uint32_t p = first; p < mesh->point_count; p++)
            if (part[p] == first && mesh->position[p][0] > mesh->position[furthest][0])
                furthest = p;
        assert_true((census->parts[number].volume > 0) == (mesh->normal[furthest][0] > 0));
        number++;
    }
    assert_int_equal(number, census->part_count);
    free(part);
}

/* False where nothing of the sculpture reaches the threshold, or no corner of a large cube falls inside. */
static bool make(const struct octree *tree, const struct surface_options *options, struct mesh *mesh,
                 struct surface_shape *shape)
{
    struct error err = {0};
    struct surface_stats stats;
    *mesh = (struct mesh){0};
    enum status status = surface_make(tree, options, mesh, &stats, &err);
    if (status == STATUS_INPUT || status == STATUS_RANGE)
        return false;
    assert_ok(status, &err);
    assert_ok(mesh_connect(mesh, &err), &err);
    assert_ok(surface_measure(mesh, shape, &err), &err);
    assert_true(stats.worst_residual < 1e-9);
    return true;
}

static double third_of_a_cell(const struct octree *tree)
{
    return 1.0 / 3 / (1 << tree->depth);
}

static size_t compared, different;

static long euler_at(const struct octree *tree, const struct surface_options *options, double share,
                     unsigned relax)
{
    struct surface_options finer = *options;
    struct surface_shape shape;
    struct mesh mesh;
    finer.relax = relax;
    finer.cube_size *= share;
    assert_true(make(tree, &finer, &mesh, &shape));
    mesh_clear(&mesh);
    return shape.euler;
}

/* Whether the field has the same shape on a grid four times finer. With sigma 0.35 the field's saddles lie,
 * in the middle of an edge of one cell with two cells diagonally at it, at 2/4 erf(0.5 / (0.35 sqrt 2)) =
 * 0.42, on longer edges at up to 0.5, with three cells at 0.64 to 0.75, at a corner with two cells diagonally
 * at it at 0.25. At a threshold within a few hundredths of one of these the gap or bridge is narrower than a
 * cube of a third of a cell, and its shape depends on where the grid lies. The thresholds here keep away from
 * them; the odd saddle that still comes near one (two in ten thousand octrees) shows itself in that the
 * shapes agree at thresholds to both sides. */
static void compare_with_finer(const struct octree *tree, const struct surface_options *options, long euler)
{
    compared++;
    if (euler_at(tree, options, 0.25, 0) == euler)
        return;
    different++;
    for (int side = -1; side <= 1; side += 2) {
        struct surface_options beside = *options;
        beside.threshold += 0.03 * side;
        assert_int_equal(euler_at(tree, &beside, 1, 10), euler_at(tree, &beside, 0.25, 0));
    }
}

static void check_tree(const struct octree *tree, const struct surface_options *options)
{
    struct error err = {0};
    struct mesh mesh, plain;
    struct surface_shape shape, plain_shape;
    struct surface_census census;
    struct surface_options without = *options;
    without.relax = 0;
    if (!make(tree, &without, &plain, &plain_shape))
        return;
    assert_true(make(tree, options, &mesh, &shape));
    assert_whole(&plain);
    assert_whole(&mesh);
    assert_int_equal(shape.euler, plain_shape.euler);
    assert_int_equal(shape.components, plain_shape.components);
    assert_ok(surface_count(&mesh, &shape, &census, &err), &err);
    assert_wound_as_the_field_says(&mesh, &census);
    surface_census_clear(&census);
    if (options->cube_size <= third_of_a_cell(tree) && plain.triangle_count < 4000)
        compare_with_finer(tree, options, shape.euler);
    mesh_clear(&mesh);
    mesh_clear(&plain);
}

static const double thresholds[] = {0.31, 0.36, 0.47, 0.59, 0.69};
enum { THRESHOLDS = sizeof thresholds / sizeof *thresholds };

static void random_octrees_make_whole_meshes(void **state)
{
    (void)state;
    uint64_t seed = 20240607;
    compared = different = 0;
    for (int i = 0; i < how_many; i++) {
        struct octree tree = random_tree(&seed);
        struct surface_options options = surface_defaults();
        options.threads = 1;
        options.threshold = thresholds[i % THRESHOLDS];
        options.cube_size = third_of_a_cell(&tree);
        check_tree(&tree, &options);
        octree_clear(&tree);
    }
    print_message("# %zu of %zu have another Euler characteristic on a grid four times finer\n", different,
                  compared);
    assert_true(1000 * different <= compared);
}

static void every_filling_of_eight_cells_makes_a_whole_mesh(void **state)
{
    (void)state;
    struct error err = {0};
    for (int pattern = 1; pattern < 256; pattern++) {
        struct octree tree;
        struct surface_options options = surface_defaults();
        assert_ok(octree_init(&tree, 1, 0, &err), &err);
        for (int cell = 0; cell < 8; cell++)
            if (pattern >> cell & 1)
                assert_ok(octree_set(&tree, cell & 1, cell >> 1 & 1, cell >> 2, 1, &err), &err);
        options.threads = 1;
        /* Also cubes as large as the cells, whose corners are the cells' centres: the patterns themselves. */
        for (int i = 0; i < 4; i++) {
            options.cube_size = i < 2 ? third_of_a_cell(&tree) : 0.5;
            options.threshold = thresholds[1 + i % 2];
            check_tree(&tree, &options);
        }
        octree_clear(&tree);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1)
        how_many = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_octrees_make_whole_meshes),
        cmocka_unit_test(every_filling_of_eight_cells_makes_a_whole_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
