/* Single collapses, flips and splits, and what a relaxation makes of a mesh: closed,
 * whole, of the same shape. */
#include "check.h"
#include "common/mesh.h"
#include "folder.h"
#include "surface/remesh.h"
#include "surface/surface.h"

/* An octahedron, wound outward: each point has four neighbours. */
static struct mesh octahedron(void)
{
    static const uint32_t triangles[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    struct mesh mesh = {0};
    struct error err = {0};
    assert_ok(mesh_init(&mesh, 6, 8, true, &err), &err);
    for (int p = 0; p < 6; p++)
        for (int axis = 0; axis < 3; axis++)
            mesh.position[p][axis] = mesh.normal[p][axis] = axis == p / 2 ? 1 - 2 * (p % 2) : 0;
    memcpy(mesh.triangle, triangles, sizeof triangles);
    return mesh;
}

static struct remesh opened(struct mesh mesh)
{
    struct remesh r;
    struct error err = {0};
    assert_ok(remesh_open(&r, &mesh, &err), &err);
    assert_null(mesh.position);
    return r;
}

/* Closes it and sees that every edge is run along once in each sense and how many points
 * and triangles there are. */
static void assert_result(struct remesh *r, uint32_t points, uint32_t triangles, long euler)
{
    struct mesh mesh = {0};
    struct error err = {0};
    struct surface_shape shape;
    assert_ok(remesh_close(r, &mesh, &err), &err);
    remesh_clear(r);
    assert_int_equal(mesh.point_count, points);
    assert_int_equal(mesh.triangle_count, triangles);
    assert_ok(mesh_connect(&mesh, &err), &err);
    assert_int_equal(2 * mesh.edge_count, 3 * mesh.triangle_count);
    assert_ok(surface_measure(&mesh, &shape, &err), &err);
    assert_int_equal(shape.euler, euler);
    assert_int_equal(shape.components, 1);
    assert_true(shape.volume > 0);
    struct remesh again = opened(mesh); /* which an open mesh would refuse */
    remesh_clear(&again);
}

/* Across and back again is the same side, the other way round; each point's degree is
 * the length of its ring. */
static void assert_linked(const struct remesh *r)
{
    uint32_t ring[RING_MAX];
    for (uint32_t side = 0; side < 3 * r->triangle_count; side++) {
        if (r->triangle[side / 3][0] == MESH_NONE)
            continue;
        uint32_t other = side_across(r, side);
        assert_int_equal(side_across(r, other), side);
        assert_int_equal(side_point(r, other), side_point(r, side_next(side)));
        assert_int_equal(side_point(r, side_next(other)), side_point(r, side));
    }
    for (uint32_t p = 0; p < r->point_count; p++)
        if (r->corner[p] != MESH_NONE) {
            assert_int_equal(side_point(r, r->corner[p]), p);
            assert_int_equal(remesh_ring(r, p, ring), r->degree[p]);
        }
}

static void a_collapse_takes_a_point_and_two_triangles(void **state)
{
    (void)state;
    for (uint32_t side = 0; side < 24; side++) {
        struct remesh r = opened(octahedron());
        uint32_t kept = side_point(&r, side);
        double place[3];
        memcpy(place, r.position[kept], sizeof place);
        assert_true(remesh_collapse_allowed(&r, side));
        remesh_collapse(&r, side, place, place);
        assert_linked(&r);
        assert_memory_equal(r.position[kept], place, sizeof place);
        assert_result(&r, 5, 6, 2);
    }
}

/* An octahedron without a point is a double pyramid over a triangle: its tips have three neighbours, the
 * others four. An edge of the triangle has the tips across, which would be left with two. An edge to a tip
 * may go, which leaves a tetrahedron, and none of that one's. */
static void a_point_keeps_three_neighbours(void **state)
{
    (void)state;
    struct remesh r = opened(octahedron());
    const double place[3] = {1, 0, 0};
    uint32_t to_tip = MESH_NONE;
    remesh_collapse(&r, 0, place, place);
    for (uint32_t side = 0; side < 24; side++) {
        if (r.triangle[side / 3][0] == MESH_NONE)
            continue;
        bool tip = r.degree[side_point(&r, side)] == 3 || r.degree[side_point(&r, side_next(side))] == 3;
        assert_int_equal(remesh_collapse_allowed(&r, side), tip);
        to_tip = tip ? side : to_tip;
    }
    double there[3];
    memcpy(there, r.position[side_point(&r, to_tip)], sizeof there);
    remesh_collapse(&r, to_tip, there, there);
    assert_linked(&r);
    for (uint32_t side = 0; side < 24; side++)
        if (r.triangle[side / 3][0] != MESH_NONE)
            assert_false(remesh_collapse_allowed(&r, side));
    assert_int_equal(r.points_alive, 4);
    assert_int_equal(r.triangles_alive, 4);
    remesh_clear(&r);
}

/* Two triangles glued along a ring: a prism's three walls, each of two triangles, closed by two tips. Of an
 * edge of a ring of three, the ends have the ring's third point in common beside the two points across:
 * without it the surface would be pinched there. */
static void a_neck_of_three_edges_does_not_collapse(void **state)
{
    (void)state;
    static const uint32_t triangles[12][3] = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4},
                                              {2, 0, 3}, {2, 3, 5}, {3, 4, 6}, {4, 5, 6},
                                              {5, 3, 6}, {1, 0, 7}, {2, 1, 7}, {0, 2, 7}};
    static const double points[8][3] = {{1, 0, 0},      {-0.5, 0.9, 0},  {-0.5, -0.9, 0}, {1, 0, 1},
                                        {-0.5, 0.9, 1}, {-0.5, -0.9, 1}, {0, 0, 2},       {0, 0, -1}};
    struct mesh mesh = {0};
    struct error err = {0};
    assert_ok(mesh_init(&mesh, 8, 12, true, &err), &err);
    memcpy(mesh.position, points, sizeof points);
    memcpy(mesh.normal, points, sizeof points);
    memcpy(mesh.triangle, triangles, sizeof triangles);
    struct remesh r = opened(mesh);
    assert_linked(&r);
    assert_false(remesh_collapse_allowed(&r, 0)); /* 0 1, with 4 and 7 across, and 2 */
    assert_true(r.degree[4] > 3 && r.degree[7] == 3);
    assert_true(remesh_split(&r, 3 * 9 + 1, points[7],
                             points[7])); /* 7 gains a neighbour: only the link is left to refuse */
    assert_false(remesh_collapse_allowed(&r, 0));
    assert_true(remesh_collapse_allowed(&r, 3 * 6 + 1)); /* 4 6: a tip may go */
    assert_result(&r, 9, 14, 2);
}

static void a_split_adds_a_point_and_two_triangles(void **state)
{
    (void)state;
    for (uint32_t side = 0; side < 24; side++) {
        struct remesh r = opened(octahedron());
        double place[3];
        const double *a = r.position[side_point(&r, side)], *b = r.position[side_point(&r, side_next(side))];
        for (int axis = 0; axis < 3; axis++)
            place[axis] = a[axis] + b[axis];
        assert_true(remesh_split(&r, side, place, place));
        assert_linked(&r);
        assert_int_equal(r.degree[6], 4);
        assert_result(&r, 7, 10, 2);
    }
}

static void a_flip_joins_the_two_points_across(void **state)
{
    (void)state;
    int flipped = 0;
    for (uint32_t side = 0; side < 30; side++) {
        struct remesh r = opened(octahedron());
        const double place[3] = {0.7, 0.7, 0.1};
        assert_true(remesh_split(&r, 0, place, place));
        if (remesh_flip_allowed(&r, side)) {
            uint32_t c = side_point(&r, side_next(side_next(side)));
            uint32_t d = side_point(&r, side_next(side_next(side_across(&r, side)))), ring[RING_MAX];
            bool joined = false;
            remesh_flip(&r, side);
            assert_linked(&r);
            for (int i = 0, count = remesh_ring(&r, c, ring); i < count; i++)
                joined |= side_point(&r, side_next(ring[i])) == d;
            assert_true(joined);
            flipped++;
        }
        struct mesh mesh = {0};
        struct error err = {0};
        assert_ok(remesh_close(&r, &mesh, &err), &err);
        remesh_clear(&r);
        assert_int_equal(mesh.triangle_count, 10);
        assert_ok(mesh_connect(&mesh, &err), &err);
        assert_int_equal(mesh.edge_count, 15);
        mesh_clear(&mesh);
    }
    assert_true(flipped > 0);
}

/* A neck 0 1 2 as above whose lower end has two points, 7 and 8: across 0 7 lie 1 and
 * 2, which the neck joins. */
static void a_flip_that_would_double_an_edge_is_refused(void **state)
{
    (void)state;
    static const uint32_t triangles[14][3] = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3},
                                              {2, 3, 5}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}, {1, 0, 7},
                                              {0, 2, 7}, {2, 1, 8}, {1, 7, 8}, {7, 2, 8}};
    struct mesh mesh = {0};
    struct error err = {0};
    assert_ok(mesh_init(&mesh, 9, 14, true, &err), &err);
    memset(mesh.position, 0, 9 * sizeof *mesh.position);
    memset(mesh.normal, 0, 9 * sizeof *mesh.normal);
    memcpy(mesh.triangle, triangles, sizeof triangles);
    struct remesh r = opened(mesh);
    assert_linked(&r);
    assert_true(r.degree[0] > 3 && r.degree[7] > 3);
    assert_false(remesh_flip_allowed(&r, 3 * 9 + 1));
    assert_true(remesh_flip_allowed(&r, 3 * 0 + 2)); /* 4 0, with 1 and 3 across */
    remesh_clear(&r);
}

static void a_mesh_with_a_hole_is_refused(void **state)
{
    (void)state;
    struct mesh mesh = octahedron();
    struct remesh r;
    struct error err = {0};
    mesh.triangle_count = 7;
    assert_refused(remesh_open(&r, &mesh, &err), STATUS_INPUT, "not closed", &err);
    assert_non_null(mesh.position);
    mesh_clear(&mesh);
}

static struct mesh relaxed_cube(void)
{
    struct octree tree;
    struct mesh mesh = {0};
    struct error err = {0};
    struct surface_stats stats;
    struct surface_options options = surface_defaults();
    options.triangles = 2000;
    assert_ok(octree_init(&tree, 1, 1, &err), &err);
    assert_ok(surface_make(&tree, &options, &mesh, &stats, &err), &err);
    octree_clear(&tree);
    return mesh;
}

/* To the bit: both formats hold all digits. */
static void a_relaxed_mesh_comes_back_from_its_file(void **state)
{
    (void)state;
    const char *names[] = {"relaxed.ply", "relaxed.obj"};
    struct mesh mesh = relaxed_cube();
    for (int i = 0; i < 2; i++) {
        struct mesh read = {0};
        struct error err = {0};
        assert_ok(mesh_save(&mesh, names[i], &err), &err);
        assert_ok(mesh_load(names[i], &read, &err), &err);
        assert_int_equal(read.point_count, mesh.point_count);
        assert_int_equal(read.triangle_count, mesh.triangle_count);
        assert_memory_equal(read.triangle, mesh.triangle, mesh.triangle_count * sizeof *mesh.triangle);
        assert_memory_equal(read.position, mesh.position, mesh.point_count * sizeof *mesh.position);
        mesh_clear(&read);
    }
    mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_collapse_takes_a_point_and_two_triangles),
        cmocka_unit_test(a_point_keeps_three_neighbours),
        cmocka_unit_test(a_neck_of_three_edges_does_not_collapse),
        cmocka_unit_test(a_split_adds_a_point_and_two_triangles),
        cmocka_unit_test(a_flip_joins_the_two_points_across),
        cmocka_unit_test(a_flip_that_would_double_an_edge_is_refused),
        cmocka_unit_test(a_mesh_with_a_hole_is_refused),
        cmocka_unit_test(a_relaxed_mesh_comes_back_from_its_file),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
