/* The paper's step: what springs, dampers, pressure and breaking do. */
#include "balloon.h"
#include "common/random.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/let_go.h"

/* Moves and speeds every point at random, by up to `size`. */
static void shake(struct sim *sim, double size)
{
    uint64_t random = 7;
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++) {
            sim->position[p][i] += size * (2 * random_unit(&random) - 1);
            sim->velocity[p][i] += size * (2 * random_unit(&random) - 1);
        }
}

static double spring_energy(const struct sim *sim)
{
    double energy = 0;
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        const uint32_t *p = sim->edge_point[e];
        double stretched = vec3_distance(sim->position[p[0]], sim->position[p[1]]) - sim->rest_length[e];
        energy += sim->current_spring_const[e] * stretched * stretched / 2;
    }
    return energy;
}

static void at_rest_without_pressure_nothing_moves_by_a_bit(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=0"));
    double before[3];
    memcpy(before, b.sim.position[17], sizeof before);
    steps(&b, 1000);
    assert_memory_equal(before, b.sim.position[17], sizeof before);
    assert_near(sim_measure(&b.sim).kinetic_energy, 0, 0);
    close_balloon(&b);
}

/* Central differences of size h err by h^2 f'''/6; with h = 1e-4 and lengths near 20 that is below 1e-8 of
 * the force, and rounding adds about 1e-16 x energy / h = 1e-8. */
static void spring_forces_are_the_slope_of_their_energy(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0"));
    shake(&b.sim, 3);
    sim_forces(&b.sim);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++) {
            const double h = 1e-4, place = b.sim.position[p][i];
            b.sim.position[p][i] = place + h;
            double above = spring_energy(&b.sim);
            b.sim.position[p][i] = place - h;
            double below = spring_energy(&b.sim);
            b.sim.position[p][i] = place;
            assert_near(b.sim.force[p][i], (below - above) / (2 * h), 1e-5);
        }
    close_balloon(&b);
}

/* Forces between two points are equal and opposite, and along the line between them. The sums are over 126
 * forces of about 100 at distances of about 45: rounding stays below 1e-9. */
static void springs_and_dampers_keep_momentum_and_angular_momentum(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=0"));
    shake(&b.sim, 3);
    sim_forces(&b.sim);
    double force[3] = {0}, torque[3] = {0};
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        double moment[3];
        vec3_cross(b.sim.position[p], b.sim.force[p], moment);
        for (int i = 0; i < 3; i++) {
            force[i] += b.sim.force[p][i];
            torque[i] += moment[i];
        }
    }
    assert_near(vec3_length(force), 0, 1e-9);
    assert_near(vec3_length(torque), 0, 1e-9);
    close_balloon(&b);
}

/* Witkin's damper: k_d (v . l)/|l| along l. Two points that part at speed 1 feel k_d each
 * way; across l, nothing. */
static void a_damper_resists_the_speed_along_its_edge(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=0", "balloons[0].spring=0", "balloons[0].damping=3"));
    struct sim *sim = &b.sim;
    const uint32_t p = sim->edge_point[0][0], q = sim->edge_point[0][1];
    double along[3];
    vec3_sub(sim->position[p], sim->position[q], along);
    const double length = vec3_length(along);
    for (uint32_t e = 1; e < sim->edge_count; e++)
        sim->edge_active[e] = 0;
    for (int i = 0; i < 3; i++)
        sim->velocity[p][i] = along[i] / length;
    sim_forces(sim);
    assert_near(vec3_dot(sim->force[p], along) / length, -3, 1e-12);
    assert_near(vec3_dot(sim->force[q], along) / length, 3, 1e-12);
    vec3_cross(along, (double[3]){1, 2, 3}, sim->velocity[p]);
    sim_forces(sim);
    assert_near(vec3_length(sim->force[p]), 0, 1e-9);
    close_balloon(&b);
}

static void pressure_pushes_every_point_outward_with_the_same_force(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=7"));
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        assert_near(vec3_length(b.sim.force[p]), 7, 1e-9);
        assert_near(vec3_dot(b.sim.normal[p], b.sim.position[p]), 45,
                    0.2); /* outward; the facets lean a little */
    }
    close_balloon(&b);
}

static void an_edge_past_the_threshold_lets_go_at_the_end_of_the_step(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=0", "balloons[0].point_mass=1e6")); /* hardly moves */
    const uint32_t p = b.sim.edge_point[0][0];
    double *place = b.sim.position[p];
    for (int i = 0; i < 3; i++)
        place[i] *= 2.1; /* its edges of about 25 become about 56, past 2 x the mean */
    steps(&b, 1);
    assert_true(b.sim.broken > 0);
    for (uint32_t e = 0; e < b.sim.edge_count; e++) {
        const uint32_t *q = b.sim.edge_point[e];
        double length = vec3_distance(b.sim.position[q[0]], b.sim.position[q[1]]);
        assert_int_equal(b.sim.edge_active[e], !(length > b.sim.settings[0].threshold_length));
        assert_near(sim_edge_length(&b.sim, e), length, 1e-12);
    }
    close_balloon(&b);
}

static void a_triangle_goes_when_two_of_its_edges_have_gone(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=0"));
    sim_break_edge(&b.sim, b.sim.triangle_edge[5][0]);
    steps(&b, 1);
    assert_true(b.sim.triangle_active[5]);
    sim_break_edge(&b.sim, b.sim.triangle_edge[5][1]);
    steps(&b, 1);
    assert_false(b.sim.triangle_active[5]);
    assert_int_equal(sim_measure(&b.sim).triangles_active, b.sim.triangle_count - 1);
    close_balloon(&b);
}

static void a_point_without_skin_has_no_normal_and_no_pressure(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, SETTINGS("balloons[0].pressure=10"));
    const uint32_t lost = b.sim.triangle_point[0][0];
    for (uint32_t e = 0; e < b.sim.edge_count; e++)
        if (b.sim.edge_point[e][0] == lost || b.sim.edge_point[e][1] == lost)
            sim_break_edge(&b.sim, e);
    steps(&b, 2);
    const double speed = vec3_length(b.sim.velocity[lost]);
    steps(&b, 1);
    assert_near(vec3_length(b.sim.normal[lost]), 0, 0);
    assert_near(vec3_length(b.sim.velocity[lost]), speed, 0); /* it flies on, unpushed */
    close_balloon(&b);
}

static void a_balloon_that_is_blown_to_dust_stays_finite(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, SETTINGS("balloons[0].pressure=100"));
    steps(&b, 400);
    struct sim_measures m = sim_measure(&b.sim);
    assert_true(m.triangles_active < b.sim.triangle_count / 2);
    assert_true(isfinite(m.kinetic_energy) && isfinite(m.volume) && isfinite(m.mean_radius));
    close_balloon(&b);
}

static void coincident_points_and_flat_triangles_exert_nothing(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    const uint32_t *p = b.sim.edge_point[0];
    memcpy(b.sim.position[p[0]], b.sim.position[p[1]], sizeof *b.sim.position);
    sim_forces(&b.sim);
    for (uint32_t i = 0; i < b.sim.point_count; i++)
        assert_true(isfinite(vec3_length(b.sim.force[i])));
    close_balloon(&b);
}

static void both_eulers_are_of_first_order(void **state)
{
    (void)state;
    static const char *const names[] = {"time.integrator=symplectic-euler", "time.integrator=explicit-euler"};
    static const char *const step[] = {"time.step=0.001", "time.step=0.0005", "time.step=0.00025"};
    for (int n = 0; n < 2; n++) {
        double radius[3];
        for (int i = 0; i < 3; i++) {
            struct balloon b;
            open_balloon(&b, 2, SETTINGS(names[n], step[i], "balloons[0].pressure=4"));
            steps(&b, 200 << i); /* to t = 0.2 */
            radius[i] = sim_measure(&b.sim).mean_radius;
            close_balloon(&b);
        }
        /* halving the step halves the error, up to the next order: within 10 % at these steps */
        assert_near((radius[0] - radius[1]) / (radius[1] - radius[2]), 2, 0.2);
    }
}

static void time_does_not_drift(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("time.step=0.1", "balloons[0].pressure=0"));
    steps(&b, 1000);
    assert_near(b.sim.time, 100, 0); /* a running sum of 0.1 would be 1.4e-12 off */
    close_balloon(&b);
}

/* The guard's bound is sufficient: at .99 of it a disturbed balloon calms down. */
static void the_stable_step_is_stable(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, SETTINGS("balloons[0].pressure=0"));
    b.sim.whole_step = b.sim.step = 0.99 * guard_stable_step(&b.sim);
    shake(&b.sim, 0.01);
    steps(&b, 20);
    const double early = sim_measure(&b.sim).kinetic_energy;
    steps(&b, 2000);
    assert_true(sim_measure(&b.sim).kinetic_energy < early);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_rest_without_pressure_nothing_moves_by_a_bit),
        cmocka_unit_test(spring_forces_are_the_slope_of_their_energy),
        cmocka_unit_test(springs_and_dampers_keep_momentum_and_angular_momentum),
        cmocka_unit_test(a_damper_resists_the_speed_along_its_edge),
        cmocka_unit_test(pressure_pushes_every_point_outward_with_the_same_force),
        cmocka_unit_test(an_edge_past_the_threshold_lets_go_at_the_end_of_the_step),
        cmocka_unit_test(a_triangle_goes_when_two_of_its_edges_have_gone),
        cmocka_unit_test(a_point_without_skin_has_no_normal_and_no_pressure),
        cmocka_unit_test(a_balloon_that_is_blown_to_dust_stays_finite),
        cmocka_unit_test(coincident_points_and_flat_triangles_exert_nothing),
        cmocka_unit_test(both_eulers_are_of_first_order),
        cmocka_unit_test(time_does_not_drift),
        cmocka_unit_test(the_stable_step_is_stable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
