/* Meshes that are no pleasure: edges of no length, slivers, flat and inverted triangles, points that lie on
 * each other or belong to nothing, balloons of any size anywhere, numbered in any order. */
#include "hard.h"
#include "unit/folder.h"

#include "common/array.h"

/* As open_balloon, with a mesh that is already there. */
static void open_on(struct balloon *b, const char *const *changes)
{
    struct error err = {0};
    assert_ok(scene_from_mesh("shape", &b->scene, &err), &err);
    for (; *changes; changes++)
        assert_ok(scene_set(&b->scene, *changes, &err), &err);
    assert_ok(scene_check(&b->scene, &err), &err);
    assert_ok(sim_open(&b->sim, &b->scene, &b->mesh, 1, &err), &err);
}

/* Two seconds under the paper's pressure, in which everything stays within what pressure can do. */
static void assert_bounded_run(struct balloon *b)
{
    while (b->sim.time < 2) {
        steps(b, 1);
        assert_true(energy_of(b) < 2 * reachable(b, b->sim.settings[0].pressure));
    }
    assert_finite(&b->sim);
}

/* Moves the first point of the mesh's first edge to this share of the way to the second. */
static void shorten_first_edge(struct mesh *mesh, double share)
{
    double *a = mesh->position[mesh->edge[0][0]];
    const double *b = mesh->position[mesh->edge[0][1]];
    for (int i = 0; i < 3; i++)
        a[i] = share == 1 ? b[i] : a[i] + share * (b[i] - a[i]);
}

static void an_edge_of_length_zero_at_rest(void **state)
{
    (void)state;
    struct balloon b = {0};
    shape_icosphere(2, &b.mesh);
    shorten_first_edge(&b.mesh, 1);
    open_on(&b, HARD());
    assert_bounded_run(&b);
    close_balloon(&b);
}

static void slivers_of_aspect_1e_6(void **state)
{
    (void)state;
    struct balloon b = {0};
    shape_icosphere(2, &b.mesh);
    shorten_first_edge(&b.mesh, 1 - 1e-6);
    open_on(&b, HARD());
    assert_bounded_run(&b);
    close_balloon(&b);
}

/* A corner in the middle of the opposite edge: it has no normal of its own. */
static void a_triangle_that_is_flat_at_rest(void **state)
{
    (void)state;
    struct balloon b = {0};
    shape_icosphere(2, &b.mesh);
    const uint32_t *p = b.mesh.triangle[0];
    for (int i = 0; i < 3; i++)
        b.mesh.position[p[0]][i] = (b.mesh.position[p[1]][i] + b.mesh.position[p[2]][i]) / 2;
    open_on(&b, HARD());
    assert_bounded_run(&b);
    close_balloon(&b);
}

/* A point is thrown through the balloon to the other side; what it has in energy is given to the
 * rest and lost in dampers. */
static void a_triangle_turned_inside_out_in_flight(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HARD("balloons[0].pressure=0"));
    steps(&b, 1);
    for (int i = 0; i < 3; i++)
        b.sim.position[17][i] *= -1;
    guard_outdated(&b.sim);
    double before = energy_of(&b);
    for (int i = 0; i < 20; i++) {
        steps(&b, 50);
        assert_true(energy_of(&b) < before);
        before = energy_of(&b);
    }
    assert_finite(&b.sim);
    close_balloon(&b);
}

static void a_point_on_another_that_no_edge_joins_it_to(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HARD());
    const uint32_t far = b.sim.point_count - 1;
    memcpy(b.sim.position[0], b.sim.position[far], sizeof *b.sim.position);
    guard_outdated(&b.sim);
    const double begin = energy_of(&b);
    while (b.sim.time < 2) {
        steps(&b, 1);
        const double most = sqrt(begin) + sqrt(reachable(&b, 10));
        assert_true(energy_of(&b) < 2 * most * most);
    }
    assert_finite(&b.sim);
    close_balloon(&b);
}

static void points_that_no_triangle_uses_stay_where_they_are(void **state)
{
    (void)state;
    struct balloon b = {0};
    struct mesh sphere = {0};
    struct error err = {0};
    shape_icosphere(2, &sphere);
    assert_ok(mesh_init(&b.mesh, sphere.point_count + 1, sphere.triangle_count, false, &err), &err);
    memcpy(b.mesh.position, sphere.position, sphere.point_count * sizeof *sphere.position);
    memcpy(b.mesh.triangle, sphere.triangle, sphere.triangle_count * sizeof *sphere.triangle);
    memcpy(b.mesh.position[sphere.point_count], (double[3]){0.1, 0.2, 0.3}, sizeof *sphere.position);
    assert_ok(mesh_connect(&b.mesh, &err), &err);
    open_on(&b, HARD());
    double before[3];
    memcpy(before, b.sim.position[sphere.point_count], sizeof before);
    assert_bounded_run(&b);
    assert_memory_equal(before, b.sim.position[sphere.point_count], sizeof before);
    mesh_clear(&sphere);
    close_balloon(&b);
}

/* Saves a sphere of which the triangles from 0 to `turned` have been wound the other way, and
 * loads it as a scene does. */
static enum status load_turned(uint32_t turned, struct mesh *mesh, struct mesh_report *report,
                               struct error *err)
{
    struct scene scene = {0};
    struct mesh sphere;
    shape_icosphere(2, &sphere);
    for (uint32_t t = 0; t < turned && t < sphere.triangle_count; t++) {
        const uint32_t p = sphere.triangle[t][1];
        sphere.triangle[t][1] = sphere.triangle[t][2];
        sphere.triangle[t][2] = p;
    }
    assert_ok(mesh_save(&sphere, "turned.ply", err), err);
    mesh_clear(&sphere);
    assert_ok(scene_from_mesh("turned.ply", &scene, err), err);
    enum status status = sim_load_meshes(&scene, mesh, report, err);
    scene_clear(&scene);
    return status;
}

static void inconsistent_winding_is_refused_with_the_edge(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    struct mesh_report report;
    struct error err = {0};
    assert_refused(load_turned(5, &mesh, &report, &err), STATUS_INPUT, "turned.ply: the edge from (", &err);
    mesh_clear(&mesh);
}

static void an_inside_out_sphere_is_turned_and_swells(void **state)
{
    (void)state;
    struct balloon b = {0};
    struct mesh_report report;
    struct error err = {0};
    assert_ok(load_turned(UINT32_MAX, &b.mesh, &report, &err), &err);
    assert_true(report.volume < 0);
    open_on(&b, HARD("balloons[0].pressure=4"));
    assert_bounded_run(&b);
    assert_true(sim_measure(&b.sim).mean_radius > 45);
    close_balloon(&b);
}

/* Lengths times s and forces times s: times stay. Places over s are equal but for rounding, which 200 steps
 * of a balloon that is nowhere near chaos do not raise above 1e-9 of a radius. */
static void lengths_from_1e_6_to_1e6_give_the_same_balloon(void **state)
{
    (void)state;
    static const double sizes[] = {1, 1e-6, 1e6};
    struct balloon b[3];
    for (int k = 0; k < 3; k++) {
        char radius[64], pressure[64];
        snprintf(radius, sizeof radius, "balloons[0].radius=%g", sizes[k]);
        snprintf(pressure, sizeof pressure, "balloons[0].pressure=%g", 0.1 * sizes[k]);
        open_balloon(&b[k], 2, HARD(radius, pressure));
        steps(&b[k], 200);
        assert_int_equal(b[k].sim.substeps, b[0].sim.substeps);
        for (uint32_t p = 0; p < b[k].sim.point_count; p++)
            for (int i = 0; i < 3; i++)
                assert_near(b[k].sim.position[p][i] / sizes[k], b[0].sim.position[p][i], 1e-9);
    }
    for (int k = 0; k < 3; k++)
        close_balloon(&b[k]);
}

/* At 1e6 radii a place is rounded to 1.2e-10 radii, an edge of .3 radii to 1e-9 of its length, which a static
 * balloon passes on to its radius; dynamics add to that as a random walk over 200 steps: 1e-7 is ample. */
static void a_balloon_a_million_radii_away_swells_as_much(void **state)
{
    (void)state;
    double radius[2];
    for (int far = 0; far < 2; far++) {
        struct balloon b;
        open_balloon(&b, 2,
                     HARD("balloons[0].radius=0.5", "balloons[0].pressure=0.5",
                          far ? "balloons[0].position=[5e5, -5e5, 5e5]" : "balloons[0].position=[0, 0, 0]"));
        steps(&b, 200);
        radius[far] = sim_measure(&b.sim).mean_radius;
        close_balloon(&b);
    }
    assert_true(radius[0] > 0.55);
    assert_near(radius[1] / radius[0], 1, 1e-7);
}

/* Points in another order, each triangle begun at another corner: sums of forces in another order, whose
 * rounding a hundred steps do not raise above 1e-9 radii. */
static void renumbered_points_edges_and_triangles_move_alike(void **state)
{
    (void)state;
    struct balloon b, other = {0};
    struct error err = {0};
    open_balloon(&b, 2, HARD());
    const uint32_t points = b.mesh.point_count, triangles = b.mesh.triangle_count;
    assert_ok(mesh_init(&other.mesh, points, triangles, false, &err), &err);
    for (uint32_t p = 0; p < points; p++)
        memcpy(other.mesh.position[(p * 5 + 3) % points], b.mesh.position[p],
               sizeof *b.mesh.position); /* 162 and 5 have no common factor */
    for (uint32_t t = 0; t < triangles; t++)
        for (uint32_t k = 0; k < 3; k++)
            other.mesh.triangle[(t * 7 + 1) % triangles][k] = (b.mesh.triangle[t][(k + t) % 3] * 5 + 3) %
                                                              points;
    assert_ok(mesh_connect(&other.mesh, &err), &err);
    open_on(&other, HARD());
    steps(&b, 100);
    steps(&other, 100);
    for (uint32_t p = 0; p < points; p++)
        for (int i = 0; i < 3; i++)
            assert_near(other.sim.position[(p * 5 + 3) % points][i], b.sim.position[p][i], 45e-9);
    close_balloon(&b);
    close_balloon(&other);
}

/* Components that hang together nowhere move as each would in a run of its own, to the bit. */
static void several_components_move_as_in_separate_runs(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon alone, both = {0};
    open_balloon(&alone, 2, HARD("balloons[0].radius=0"));
    const uint32_t points = alone.mesh.point_count, triangles = alone.mesh.triangle_count;
    assert_ok(mesh_init(&both.mesh, 2 * (size_t)points, 2 * (size_t)triangles, false, &err), &err);
    for (uint32_t i = 0; i < 2; i++) {
        memcpy(both.mesh.position + i * points, alone.mesh.position, points * sizeof *alone.mesh.position);
        for (uint32_t t = 0; t < triangles; t++)
            for (int k = 0; k < 3; k++)
                both.mesh.triangle[i * triangles + t][k] = alone.mesh.triangle[t][k] + i * points;
    }
    assert_ok(mesh_connect(&both.mesh, &err), &err);
    open_on(&both, HARD("balloons[0].radius=0"));
    steps(&alone, 100);
    steps(&both, 100);
    for (uint32_t p = 0; p < 2 * points; p++)
        for (int i = 0; i < 3; i++) /* the mean of twice as many points is rounded otherwise */
            assert_near(both.sim.position[p][i], alone.sim.position[p % points][i], 1e-9);
    close_balloon(&alone);
    close_balloon(&both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_of_length_zero_at_rest),
        cmocka_unit_test(slivers_of_aspect_1e_6),
        cmocka_unit_test(a_triangle_that_is_flat_at_rest),
        cmocka_unit_test(a_triangle_turned_inside_out_in_flight),
        cmocka_unit_test(a_point_on_another_that_no_edge_joins_it_to),
        cmocka_unit_test(points_that_no_triangle_uses_stay_where_they_are),
        cmocka_unit_test(inconsistent_winding_is_refused_with_the_edge),
        cmocka_unit_test(an_inside_out_sphere_is_turned_and_swells),
        cmocka_unit_test(lengths_from_1e_6_to_1e6_give_the_same_balloon),
        cmocka_unit_test(a_balloon_a_million_radii_away_swells_as_much),
        cmocka_unit_test(renumbered_points_edges_and_triangles_move_alike),
        cmocka_unit_test(several_components_move_as_in_separate_runs),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
