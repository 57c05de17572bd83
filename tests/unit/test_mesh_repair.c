/* What is repaired and what is reported. */
#include "common/mesh.h"
#include "solids.h"

static struct mesh_report repaired(struct mesh *mesh)
{
    struct error err = {0};
    struct mesh_report report;
    assert_ok(mesh_repair(mesh, &report, &err), &err);
    assert_non_null(mesh->edge);
    return report;
}

static void assert_edge(const uint32_t edge[2], uint32_t a, uint32_t b)
{
    assert_int_equal(edge[0], a);
    assert_int_equal(edge[1], b);
}

static void assert_repairs(const struct mesh_report *report, const char *wanted)
{
    char text[200];
    assert_string_equal(mesh_report_repairs(report, text, sizeof text), wanted);
}

static void a_sound_mesh_is_left_alone(void **state)
{
    (void)state;
    struct mesh mesh = {0}, before = {0};
    add_cube(&mesh, 0, 0, 0);
    add_cube(&before, 0, 0, 0);
    struct mesh_report report = repaired(&mesh);
    assert_same_mesh(&mesh, &before);
    assert_repairs(&report, "");
    assert_int_equal(report.boundary_edges + report.overfull_edges + report.inconsistent_edges, 0);
    assert_edge(report.first_boundary, MESH_NONE, MESH_NONE);
    assert_edge(report.first_overfull, MESH_NONE, MESH_NONE);
    assert_edge(report.first_inconsistent, MESH_NONE, MESH_NONE);
    assert_int_equal(report.pinched_points, 0);
    assert_int_equal(report.components, 1);
    assert_near(report.volume, 1, 1e-15);
    mesh_clear(&mesh);
    mesh_clear(&before);
}

static void an_open_mesh_has_boundary_edges(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    mesh.triangle_count -= 2; /* the face at x = 1: points 1, 3, 5, 7 */
    struct mesh_report report = repaired(&mesh);
    assert_int_equal(report.boundary_edges, 4);
    assert_edge(report.first_boundary, 1, 3);
    assert_int_equal(report.inconsistent_edges + report.overfull_edges, 0);
    mesh_clear(&mesh);
}

/* A band of five triangles whose last side is joined to the first after half a turn. */
static void a_moebius_strip_cannot_be_consistent(void **state)
{
    (void)state;
    const double position[5][3] = {{0, 0, 0}, {1, 0, 1}, {2, 1, 0}, {1, 2, 1}, {0, 1, -1}};
    const uint32_t triangle[5][3] = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}};
    struct mesh mesh = mesh_of(position, 5, triangle, 5);
    struct mesh_report report = repaired(&mesh);
    assert_int_equal(report.inconsistent_edges, 1);
    assert_edge(report.first_inconsistent, 0, 1);
    assert_int_equal(report.boundary_edges, 5);
    assert_int_equal(report.overfull_edges, 0);
    assert_int_equal(report.components, 1);
    mesh_clear(&mesh);
}

static void a_triangle_that_is_turned_round_is_inconsistent_on_its_three_sides(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    mesh.triangle[0][0] = 2;
    mesh.triangle[0][1] = 0;
    struct mesh_report report = repaired(&mesh);
    assert_int_equal(report.inconsistent_edges, 3);
    assert_int_equal(report.boundary_edges, 0);
    mesh_clear(&mesh);
}

static void two_cubes_that_share_an_edge_have_an_overfull_one(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    add_cube(&mesh, 1, 1, 0);
    struct mesh_report report = repaired(&mesh);
    assert_repairs(&report, "2 repeated points welded");
    assert_int_equal(report.overfull_edges, 1);
    assert_edge(report.first_overfull, 3, 7);
    assert_int_equal(report.boundary_edges + report.inconsistent_edges + report.pinched_points, 0);
    assert_int_equal(report.components, 1);
    assert_near(report.volume, 2, 1e-14);
    mesh_clear(&mesh);
}

static void two_cubes_that_share_a_corner_are_pinched_there(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    add_cube(&mesh, 1, 1, 1);
    struct mesh_report report = repaired(&mesh);
    assert_repairs(&report, "1 repeated point welded");
    assert_int_equal(report.pinched_points, 1);
    assert_int_equal(report.overfull_edges, 0);
    assert_int_equal(report.components, 2);
    mesh_clear(&mesh);
}

static void a_bow_tie_is_pinched_in_its_middle(void **state)
{
    (void)state;
    const double position[5][3] = {{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
    const uint32_t triangle[2][3] = {{0, 2, 1}, {0, 3, 4}};
    struct mesh mesh = mesh_of(position, 5, triangle, 2);
    struct mesh_report report = repaired(&mesh);
    assert_int_equal(report.pinched_points, 1);
    assert_int_equal(report.boundary_edges, 6);
    assert_int_equal(report.components, 2);
    mesh_clear(&mesh);
}

static void an_inside_out_mesh_has_a_negative_volume(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 5, 5, 5);
    for (uint32_t t = 0; t < mesh.triangle_count; t++) {
        uint32_t kept = mesh.triangle[t][0];
        mesh.triangle[t][0] = mesh.triangle[t][1];
        mesh.triangle[t][1] = kept;
    }
    struct mesh_report report = repaired(&mesh);
    assert_near(report.volume, -1, 1e-14);
    assert_int_equal(report.inconsistent_edges, 0);
    mesh_clear(&mesh);
}

static void repeated_flat_and_unused_ones_are_dropped(void **state)
{
    (void)state;
    const double position[][3] = {
        {9, 9, 9},                                     /* 0: unused */
        {0, 0, 0},    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, /* 1 to 4: a tetrahedron */
        {0.5, 0, 0},                                   /* 5: in the middle of 1 2 */
        {1, 0, -0.0},                                  /* 6: where 2 is */
    };
    const uint32_t triangle[][3] = {
        {1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}, /* the tetrahedron */
        {3, 6, 1},                                  /* the first one again */
        {4, 2, 1},                                  /* the second one, the other way round */
        {1, 5, 2},                                  /* no area */
        {2, 6, 3},                                  /* a side of length 0 */
        {4, 4, 1},                                  /* a corner twice */
    };
    struct mesh mesh = mesh_of(position, 7, triangle, 9);
    struct mesh_report report = repaired(&mesh);
    assert_repairs(&report,
                   "1 repeated point welded, 3 flat triangles dropped, 2 repeated triangles dropped, "
                   "2 unused points dropped");
    const uint32_t kept[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    struct mesh wanted = mesh_of(&position[1], 4, kept, 4);
    assert_same_mesh(&mesh, &wanted);
    assert_int_equal(mesh.edge_count, 6);
    assert_int_equal(report.boundary_edges, 0);
    assert_near(report.volume, 1.0 / 6, 1e-16);
    mesh_clear(&mesh);
    mesh_clear(&wanted);
}

static void normals_follow_their_points(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    assert_int_equal(mesh_init(&mesh, 6, 1, true, NULL), STATUS_OK);
    for (uint32_t p = 0; p < 6; p++) {
        uint32_t place = p == 3 ? 1 : p; /* 3 is where 1 is */
        for (int i = 0; i < 3; i++) {
            mesh.position[p][i] = place == i + 1u || place == 5 ? 1 : 0;
            mesh.normal[p][i] = p;
        }
    }
    for (uint32_t k = 0; k < 3; k++)
        mesh.triangle[0][k] = 2 + (k + 1) % 3 + (k == 1); /* 3, 5, 2 */
    struct mesh_report report = repaired(&mesh);
    assert_int_equal(report.welded_points, 2); /* 4 is where 0 is */
    assert_int_equal(mesh.point_count, 3);
    assert_near(mesh.normal[0][0], 1, 0);
    assert_near(mesh.normal[1][1], 2, 0);
    assert_near(mesh.normal[2][2], 5, 0);
    mesh_clear(&mesh);
}

static void assert_not_repaired(struct mesh *mesh, const char *message)
{
    struct error err = {0};
    struct mesh_report report;
    assert_refused(mesh_repair(mesh, &report, &err), STATUS_INPUT, message, &err);
}

static void what_cannot_be_repaired_is_named(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    assert_not_repaired(&mesh, "the mesh has no triangles");
    add_cube(&mesh, 0, 0, 0);
    mesh.position[6][1] = NAN;
    assert_not_repaired(&mesh, "y of point 6 is nan");
    mesh.position[6][1] = -INFINITY;
    assert_not_repaired(&mesh, "y of point 6 is -inf");
    mesh.position[6][1] = 1e300;
    assert_not_repaired(&mesh, "y of point 6 is 1e+300; must be a number of at most 1e+90");
    mesh.position[6][1] = 1;
    mesh.triangle[11][2] = 4000000000u;
    assert_not_repaired(&mesh, "corner 2 of triangle 11 is point 4000000000; there are 8 points");
    mesh.triangle[11][2] = 5;
    for (int p = 0; p < 8; p++)
        mesh.position[p][2] = mesh.position[p][1] = 0;
    assert_not_repaired(&mesh, "flat");
    mesh_clear(&mesh);
}

static void the_largest_coordinates_give_a_finite_volume(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    for (int p = 0; p < 8; p++) {
        for (int i = 0; i < 3; i++)
            mesh.position[p][i] = (2 * mesh.position[p][i] - 1) * MESH_COORDINATE_MAX;
    }
    struct mesh_report report = repaired(&mesh);
    assert_near(report.volume / 8e270, 1, 1e-14);
    mesh_clear(&mesh);
}

static void a_report_is_cut_to_the_room_there_is(void **state)
{
    (void)state;
    struct mesh_report report = {.welded_points = 12, .unused_points = 34};
    char text[16];
    assert_string_equal(mesh_report_repairs(&report, text, sizeof text), "12 repeated poi");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_mesh_is_left_alone),
        cmocka_unit_test(an_open_mesh_has_boundary_edges),
        cmocka_unit_test(a_moebius_strip_cannot_be_consistent),
        cmocka_unit_test(a_triangle_that_is_turned_round_is_inconsistent_on_its_three_sides),
        cmocka_unit_test(two_cubes_that_share_an_edge_have_an_overfull_one),
        cmocka_unit_test(two_cubes_that_share_a_corner_are_pinched_there),
        cmocka_unit_test(a_bow_tie_is_pinched_in_its_middle),
        cmocka_unit_test(an_inside_out_mesh_has_a_negative_volume),
        cmocka_unit_test(repeated_flat_and_unused_ones_are_dropped),
        cmocka_unit_test(normals_follow_their_points),
        cmocka_unit_test(what_cannot_be_repaired_is_named),
        cmocka_unit_test(the_largest_coordinates_give_a_finite_volume),
        cmocka_unit_test(a_report_is_cut_to_the_room_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
