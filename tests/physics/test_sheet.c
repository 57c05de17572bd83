/* Springs by cotangents, masses by areas: an irregular sheet that is pulled evenly is stretched evenly,
 * and one that is pushed evenly moves evenly. */
#include "common/random.h"
#include "common/vec3.h"
#include "unit/balloon.h"

enum { SIDE = 16 };

static double cotangent(const struct mesh *mesh, uint32_t at, uint32_t a, uint32_t b)
{
    double u[3], v[3], cross[3];
    vec3_sub(mesh->position[a], mesh->position[at], u);
    vec3_sub(mesh->position[b], mesh->position[at], v);
    vec3_cross(u, v, cross);
    return vec3_dot(u, v) / vec3_length(cross);
}

/* A square of SIDE x SIDE cells whose inner points are off their places by up to .2 of a cell; each cell is
 * cut along the diagonal that has the larger angles beside it. */
static void make_sheet(struct mesh *mesh)
{
    uint64_t random = 17;
    const uint32_t row = SIDE + 1;
    if (mesh_init(mesh, (size_t)row * row, 2 * SIDE * SIDE, false, NULL))
        abort();
    for (uint32_t p = 0; p < row * row; p++) {
        const uint32_t i = p % row, j = p / row;
        const bool inner = i > 0 && j > 0 && i < SIDE && j < SIDE;
        mesh->position[p][0] = i + (inner ? 0.4 * random_unit(&random) - 0.2 : 0);
        mesh->position[p][1] = j + (inner ? 0.4 * random_unit(&random) - 0.2 : 0);
        mesh->position[p][2] = 0;
    }
    for (uint32_t cell = 0, t = 0; cell < SIDE * SIDE; cell++) {
        const uint32_t a = cell / SIDE * row + cell % SIDE, b = a + 1, c = b + row, d = a + row;
        const bool other = cotangent(mesh, b, a, c) + cotangent(mesh, d, a, c) < 0;
        const uint32_t first[2][3] = {{a, b, c}, {a, b, d}}, second[2][3] = {{a, c, d}, {b, c, d}};
        memcpy(mesh->triangle[t++], first[other], sizeof first[other]);
        memcpy(mesh->triangle[t++], second[other], sizeof second[other]);
    }
    if (mesh_connect(mesh, NULL))
        abort();
}

/* The rim is held at the stretch 1.5, the inside let go from anywhere near, until it is at rest: standard
 * deviation of the stretch of edges over its mean. */
static double spread(const char *stiffness)
{
    struct balloon b;
    struct error err = {0};
    uint64_t random = 23;
    open_balloon(&b, 0,
                 SETTINGS(stiffness, "balloons[0].radius=0", "balloons[0].pressure=0",
                          "balloons[0].damping=0.5", "balloons[0].threshold=1e300", "time.step=0.01",
                          "time.integrator=symplectic-euler"));
    sim_clear(&b.sim);
    mesh_clear(&b.mesh);
    make_sheet(&b.mesh);
    assert_ok(sim_open(&b.sim, &b.scene, &b.mesh, 1, &err), &err);
    struct sim *sim = &b.sim;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        double *x = sim->position[p];
        const bool rim = fmax(fabs(x[0]), fabs(x[1])) > SIDE / 2.0 - 0.4; /* the sheet's middle is near 0 */
        if (rim)
            sim->mass[p] = 1e12;
        for (int i = 0; i < 2; i++)
            x[i] = 1.5 * x[i] + (rim ? 0 : 0.4 * random_unit(&random) - 0.2);
    }
    for (int i = 0; i < 3000; i++)
        assert_ok(sim_step(sim, &err), &err);
    double sum = 0, squares = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        const double stretch = sim_edge_length(sim, e) / sim->rest_length[e];
        sum += stretch;
        squares += stretch * stretch;
    }
    const double mean = sum / sim->edge_count, variance = squares / sim->edge_count - mean * mean;
    close_balloon(&b);
    return sqrt(fmax(variance, 0)) / mean;
}

/* Even stretch is the exact state of rest of a flat sheet, but where a diagonal has angles beside it that the
 * cotangents cannot balance: 0 in place of a negative sum. With one constant for all springs the same sheet
 * is uneven by percents. */
static void an_even_pull_stretches_an_irregular_sheet_evenly(void **state)
{
    (void)state;
    const double even = spread("balloons[0].stiffness=cotangent"),
                 uneven = spread("balloons[0].stiffness=uniform");
    print_message("# spread of stretch %.6f, with uniform constants %.4f\n", even, uneven);
    assert_true(even < 0.002);
    assert_true(uneven > 0.01);
}

/* All angles of 60 degrees but at the twelve points of five edges: constants near the scene's. */
static void regular_triangles_have_the_scenes_constant(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, SETTINGS("balloons[0].stiffness=cotangent"));
    double sum = 0;
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        sum += b.sim.init_spring_const[e] / b.sim.edge_count;
    assert_near(sum, 20, 0.5);
    close_balloon(&b);
}

/* Each point off its place along the sphere, by up to a third of an edge. */
static void shift_points(struct mesh *mesh)
{
    const double far = vec3_distance(mesh->position[mesh->edge[0][0]], mesh->position[mesh->edge[0][1]]) / 3;
    uint64_t random = 29;
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        double *x = mesh->position[p], radius = vec3_length(x);
        for (int i = 0; i < 3; i++)
            x[i] += far * (2 * random_unit(&random) - 1) / sqrt(3);
        const double scale = radius / vec3_length(x);
        for (int i = 0; i < 3; i++)
            x[i] *= scale;
    }
}

/* Standard deviation over mean of the speeds at which points of an irregular sphere begin to go outwards,
 * pushed by a pressure on areas. */
static double spread_outwards(const char *masses)
{
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 3,
                 SETTINGS(masses, "balloons[0].pressure_on=areas", "balloons[0].pressure=0.1",
                          "balloons[0].spring=0", "balloons[0].damping=0", "balloons[0].threshold=1e300",
                          "time.integrator=symplectic-euler", "time.step=0.001"));
    sim_clear(&b.sim);
    shift_points(&b.mesh);
    assert_ok(sim_open(&b.sim, &b.scene, &b.mesh, 1, &err), &err);
    const uint32_t count = b.sim.point_count;
    double mass = 0, sum = 0, squares = 0;
    for (uint32_t p = 0; p < count; p++)
        mass += b.sim.mass[p];
    assert_near(mass, 0.11 * count, 1e-12 * count);
    steps(&b, 10);
    for (uint32_t p = 0; p < count; p++) {
        const double *x = b.sim.position[p], speed = vec3_dot(b.sim.velocity[p], x) / vec3_length(x);
        sum += speed;
        squares += speed * speed;
    }
    const double mean = sum / count, variance = squares / count - mean * mean;
    close_balloon(&b);
    return sqrt(fmax(variance, 0)) / mean;
}

/* Points of one mass go as fast as the skin around them is wide. */
static void an_even_pressure_moves_an_irregular_sphere_evenly(void **state)
{
    (void)state;
    const double even = spread_outwards("balloons[0].mass_by=areas"),
                 uneven = spread_outwards("balloons[0].mass_by=points");
    print_message("# spread of speeds %.4f, with points of one mass %.4f\n", even, uneven);
    assert_true(even < 0.005);
    assert_true(uneven > 0.05);
}

/* Each edge's threshold over its own rest length: all of an evenly stretched balloon let go at
 * once, and none before. */
static void thresholds_may_be_each_edges_own(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].threshold_of=edge", "balloons[0].threshold=1.5", "time.step=1e-9",
                          "balloons[0].pressure=0", "balloons[0].damping=0"));
    for (int k = 0; k < 2; k++) {
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int i = 0; i < 3; i++)
                b.sim.position[p][i] *= k ? 1.51 / 1.49 : 1.49;
        steps(&b, 1);
        assert_int_equal(b.sim.broken, k ? b.sim.edge_count : 0);
    }
    close_balloon(&b);
}

/* In the balloon's own height, straight from row to row and constant beyond them: so a factor is that at the
 * middle of the spring, and what springs hold at twice their lengths is the sum of their own halves of
 * k r^2. */
static void springs_are_as_stiff_as_their_height_says(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].spring=20", "balloons[0].threshold=9",
                          "balloons[0].spring_by_height.profile=((0.1, 1.0), (0.5, 3.0), (0.9, 2.0))"));
    double low = INFINITY, high = -INFINITY, held = 0;
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        low = fmin(low, b.sim.position[p][1]);
        high = fmax(high, b.sim.position[p][1]);
    }
    for (uint32_t e = 0; e < b.sim.edge_count; e++) {
        const uint32_t *p = b.sim.edge_point[e];
        const double h = ((b.sim.position[p[0]][1] + b.sim.position[p[1]][1]) / 2 - low) / (high - low);
        const double factor = h < 0.1 ? 1 : h < 0.5 ? 1 + 5 * (h - 0.1) : h < 0.9 ? 3 - 2.5 * (h - 0.5) : 2;
        assert_near(b.sim.current_spring_const[e], 20 * factor, 1e-12 * 60);
        held += 20 * factor * b.sim.rest_length[e] * b.sim.rest_length[e] / 2;
    }
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] *= 2;
    assert_near(sim_measure(&b.sim).elastic_energy, held, 1e-12 * held);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_even_pull_stretches_an_irregular_sheet_evenly),
        cmocka_unit_test(regular_triangles_have_the_scenes_constant),
        cmocka_unit_test(an_even_pressure_moves_an_irregular_sphere_evenly),
        cmocka_unit_test(thresholds_may_be_each_edges_own),
        cmocka_unit_test(springs_are_as_stiff_as_their_height_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
