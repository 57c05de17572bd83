/* The faces of the cubes as a mesh. */
#include "common/mesh.h"
#include "trees.h"

enum { DEPTH = 6, SIDE = 1 << DEPTH };

static void faces_enclose_the_volume_and_have_the_area_of_the_cells(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = random_sculpture(DEPTH, 30, 9);
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
    struct octree tree = random_sculpture(DEPTH, 30, 10);
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
        cmocka_unit_test(faces_enclose_the_volume_and_have_the_area_of_the_cells),
        cmocka_unit_test(faces_have_no_cracks),
        cmocka_unit_test(a_full_cube_has_twelve_triangles),
        cmocka_unit_test(an_empty_sculpture_has_no_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
