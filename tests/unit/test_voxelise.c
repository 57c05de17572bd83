/* Meshes become the cells that they enclose. */
#include "check.h"
#include "common/random.h"
#include "sculpt/voxelise.h"
#include "sculpt/voxelise_parts.h"
#include "tests/support/shapes.h"

enum { DEPTH = 6, SIDE = 1 << DEPTH };

static const double radius = SIDE / 2 - 1; /* of a ball that fills the cube but for a free cell, in cells */

static uint64_t ball_seed = 3;

/* An icosphere without this part of its triangles, picked at random. */
static struct mesh ball(unsigned level, double missing)
{
    struct mesh mesh = {0};
    uint64_t seed = ball_seed;
    uint32_t count = 0;
    shape_icosphere(level, &mesh);
    for (uint32_t t = 0; t < mesh.triangle_count; t++)
        if (random_unit(&seed) >= missing)
            memmove(mesh.triangle[count++], mesh.triangle[t], sizeof *mesh.triangle);
    mesh.triangle_count = count;
    return mesh;
}

static enum status make(struct mesh *mesh, struct octree *tree, struct voxelise_report *report,
                        struct error *err)
{
    enum status status = mesh_repair(mesh, &report->mesh, err);
    return status ? status : voxelise(mesh, DEPTH, tree, report, err);
}

static void assert_solid(const struct octree *tree)
{
    struct error err = {0};
    struct octree copy = {0};
    uint64_t hollow;
    assert_ok(octree_copy(&copy, tree, &err), &err);
    assert_ok(octree_fill_hollows(&copy, 0, &hollow, &err), &err);
    assert_int_equal(hollow, 0);
    octree_clear(&copy);
}

/* Whatever lies further than half a cell's diagonal within the mesh's inscribed ball is full, and
 * what lies as far out of its circumscribed one is empty. The inscribed ball of an icosphere of level
 * 4 is 0.2 % smaller: the triangle's circumradius, at most 0.6 of the edge 1.05 / 2^4, takes 0.6^2
 * 0.066^2 / 2 = 0.0008 off. */
static void assert_ball(const struct octree *tree, double slack)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                double from_middle = sqrt(pow(x + 0.5 - SIDE / 2, 2) + pow(y + 0.5 - SIDE / 2, 2) +
                                          pow(z + 0.5 - SIDE / 2, 2));
                if (from_middle < radius * 0.998 - slack)
                    assert_int_equal(octree_at(tree, x, y, z), 1);
                if (from_middle > radius + slack)
                    assert_int_equal(octree_at(tree, x, y, z), 0);
            }
}

static void a_ball_is_a_ball_to_the_cell(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = ball(4, 0);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_ball(&tree, 1e-3);
    assert_int_equal(report.inside, octree_measure(&tree).cells);
    assert_int_equal(report.undecided, 0);
    /* Cells are wrong by no more than half of those that the surface crosses: (0.998 r)^3 .. r^3, and a
     * lattice's counting error, which for a ball of radius 31 is under half a shell of one cell, 3 / (2 r) */
    const double volume = 4 / 3.0 * M_PI * pow(radius, 3);
    assert_near((double)report.inside / volume, 1, 3 / (2 * radius));
    octree_clear(&tree);
    mesh_clear(&mesh);
}

static void a_ball_with_holes_is_solid_nonetheless(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct error err = {0};
        struct octree tree = {0};
        struct voxelise_report report;
        struct mesh mesh = ball(4, i == 2 ? 0.1 : 0.02);
        ball_seed++;
        assert_ok(make(&mesh, &tree, &report, &err), &err);
        assert_true(report.mesh.boundary_edges > 0);
        assert_solid(&tree);
        /* around a hole as wide as a few triangles (an edge is 2 cells long) the
         * solid angle bulges or dents */
        assert_ball(&tree, i == 2 ? 5 : 3);
        octree_clear(&tree);
        mesh_clear(&mesh);
    }
}

/* Joins two meshes of the same kind, the second moved along x. */
static struct mesh two_balls(double shift, bool second_inside_out)
{
    struct error err = {0};
    struct mesh one = ball(3, 0), both = {0};
    assert_ok(mesh_init(&both, 2 * (size_t)one.point_count, 2 * (size_t)one.triangle_count, false, &err),
              &err);
    for (uint32_t p = 0; p < both.point_count; p++)
        for (int k = 0; k < 3; k++) {
            bool second = p >= one.point_count;
            double at = one.position[p % one.point_count][k];
            both.position[p][k] = second ? at * 0.75 + (k == 0 ? shift : 0) : at;
        }
    for (uint32_t t = 0; t < both.triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            bool second = t >= one.triangle_count;
            uint32_t corner = one.triangle[t % one.triangle_count][second && second_inside_out ? 2 - k : k];
            both.triangle[t][k] = corner + (second ? one.point_count : 0);
        }
    mesh_clear(&one);
    return both;
}

/* Beside each other: a ball that is inside out hides nothing of what encloses it. */
static void a_part_that_is_inside_out_is_a_part(void **state)
{
    (void)state;
    uint64_t inside[2];
    for (int inside_out = 0; inside_out < 2; inside_out++) {
        struct error err = {0};
        struct octree tree = {0};
        struct voxelise_report report;
        struct mesh mesh = two_balls(2, inside_out);
        assert_ok(make(&mesh, &tree, &report, &err), &err);
        assert_int_equal(report.doubtful, 0);
        inside[inside_out] = report.inside;
        octree_clear(&tree);
        mesh_clear(&mesh);
    }
    assert_int_equal(inside[0], inside[1]);
}

static void balls_that_overlap_are_one(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = two_balls(1, false);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_solid(&tree);
    assert_int_equal(report.doubtful, 0);
    /* from -1 to 1.75: the overlap, from 0.25 to 1, has its middle at 0.625 */
    int x = 1 + (int)((0.625 + 1) / 2.75 * (SIDE - 2));
    assert_int_equal(octree_at(&tree, x, SIDE / 2, SIDE / 2), 1);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

static void a_shell_is_hollow(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = two_balls(0, true);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_int_equal(octree_at(&tree, SIDE / 2, SIDE / 2, SIDE / 2), 0);
    assert_int_equal(octree_at(&tree, 4, SIDE / 2, SIDE / 2), 1);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

static void turn_over(uint32_t triangle[3])
{
    const uint32_t first = triangle[0];
    triangle[0] = triangle[2];
    triangle[2] = first;
}

static void a_mesh_turned_inside_out_is_turned_back(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = ball(4, 0);
    for (uint32_t t = 0; t < mesh.triangle_count; t++)
        turn_over(mesh.triangle[t]);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_ball(&tree, 1e-3);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

static void turn_some_over(struct mesh *mesh)
{
    uint64_t seed = 8;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (random_bits(&seed) & 1)
            turn_over(mesh->triangle[t]);
}

static void triangles_turned_at_random_are_counted_without_sense(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = ball(4, 0);
    turn_some_over(&mesh);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_ball(&tree, 1e-3);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

/* Half of the rays and more decide then: cells are wrong only where several see a hole, which is near one. */
static void triangles_turned_at_random_may_have_holes_between_them(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = ball(4, 0.002);
    turn_some_over(&mesh);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_true(report.mesh.boundary_edges > 0 && report.doubtful > 0);
    assert_ball(&tree, 3);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

/* A cube whose corners lie on the lattice of cells: every face passes between centres, every diagonal
 * of a face through some. */
static void a_cube_fills_all_but_the_free_cells(void **state)
{
    (void)state;
    static const uint32_t face[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    struct error err = {0};
    struct octree tree = {0};
    struct voxelise_report report;
    struct mesh mesh = {0};
    assert_ok(mesh_init(&mesh, 8, 12, false, &err), &err);
    for (int p = 0; p < 8; p++)
        for (int k = 0; k < 3; k++)
            mesh.position[p][k] = (p >> k & 1) - 7e3;
    memcpy(mesh.triangle, face, sizeof face);
    assert_ok(make(&mesh, &tree, &report, &err), &err);
    assert_int_equal(report.inside, (SIDE - 2) * (SIDE - 2) * (SIDE - 2));
    assert_int_equal(report.doubtful, 0);
    octree_clear(&tree);
    mesh_clear(&mesh);
}

static void what_encloses_nothing_or_is_too_open_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {.root = 7};
    struct voxelise_report report;
    struct mesh sheet = ball(0, 0), sieve = ball(4, 0.35);
    sheet.triangle_count = 1;
    assert_refused(make(&sheet, &tree, &report, &err), STATUS_INPUT, "encloses none of the cells", &err);
    assert_refused(make(&sieve, &tree, &report, &err), STATUS_INPUT, "too open to tell", &err);
    assert_refused(voxelise(&sieve, 1, &tree, &report, &err), STATUS_RANGE, "depth 1: a mesh needs one",
                   &err);
    assert_refused(voxelise(&sieve, 11, &tree, &report, &err), STATUS_RANGE, "depth 11", &err);
    assert_int_equal(tree.root, 7);
    mesh_clear(&sheet);
    mesh_clear(&sieve);
}

/* Half of the 2^20 lines along an axis cross each triangle: 300 of them 300 x 2^19
 * times, and 2^27 is the most. */
static void a_mesh_of_too_many_layers_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct crossings crossings;
    struct mesh mesh = {0};
    const int side = 1 << OCTREE_DEPTH_MAX;
    assert_ok(mesh_init(&mesh, 3, 300, false, &err), &err);
    for (int p = 0; p < 3; p++)
        for (int k = 0; k < 3; k++)
            mesh.position[p][k] = k == p ? side : 0;
    for (int t = 0; t < 300; t++)
        for (int k = 0; k < 3; k++)
            mesh.triangle[t][k] = (uint32_t)k;
    assert_refused(crossings_find(&mesh, 0, side, &crossings, &err), STATUS_RANGE, "lie over each other",
                   &err);
    mesh_clear(&mesh);
}

static void far_triangles_taken_as_one_change_little(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = ball(4, 0.3);
    struct winding *winding = NULL;
    uint64_t seed = 5;
    assert_ok(winding_new(&mesh, &winding, &err), &err);
    for (int i = 0; i < 300; i++) {
        double point[3], exact = 0;
        for (int k = 0; k < 3; k++)
            point[k] = 3 * random_unit(&seed) - 1.5;
        for (uint32_t t = 0; t < mesh.triangle_count; t++)
            exact += winding_of_triangle(&mesh, t, point);
        assert_near(winding_at(winding, point), exact, 0.02);
    }
    winding_free(winding);
    mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_is_a_ball_to_the_cell),
        cmocka_unit_test(a_ball_with_holes_is_solid_nonetheless),
        cmocka_unit_test(a_part_that_is_inside_out_is_a_part),
        cmocka_unit_test(balls_that_overlap_are_one),
        cmocka_unit_test(a_shell_is_hollow),
        cmocka_unit_test(a_mesh_turned_inside_out_is_turned_back),
        cmocka_unit_test(triangles_turned_at_random_are_counted_without_sense),
        cmocka_unit_test(triangles_turned_at_random_may_have_holes_between_them),
        cmocka_unit_test(a_cube_fills_all_but_the_free_cells),
        cmocka_unit_test(what_encloses_nothing_or_is_too_open_is_refused),
        cmocka_unit_test(a_mesh_of_too_many_layers_is_refused),
        cmocka_unit_test(far_triangles_taken_as_one_change_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
